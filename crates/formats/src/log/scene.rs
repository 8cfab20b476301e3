//! Things to be drawn in a viewer.

use std::sync::Arc;

/// Line segments of one colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneLines {
    /// Both ends of each segment, metres.
    pub segments: Vec<[[f64; 3]; 2]>,
    /// Width on the screen, pixels.
    pub width_px: f64,
    /// Red, green, blue and opacity, each from 0 to 1.
    pub rgba: [f64; 4],
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneDot {
    /// Its centre, metres.
    pub at: [f64; 3],
    /// Its diameter, metres.
    pub diameter_m: f64,
    /// Red, green, blue and opacity, each from 0 to 1.
    pub rgba: [f64; 4],
}

/// A thing of a scene; it replaces an earlier one of the same name.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneEntity {
    /// Its name.
    pub id: String,
    /// The frame that its points are given in.
    pub frame: Arc<str>,
    /// Its lines.
    pub lines: Vec<SceneLines>,
    /// Its balls.
    pub dots: Vec<SceneDot>,
}

/// What an edge of a volume is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EdgeLabel {
    /// Something stands there.
    Obstacle,
    /// Nobody looked beyond.
    Frontier,
    /// Opened.
    Free,
}

impl EdgeLabel {
    fn rgba(self) -> [f64; 4] {
        match self {
            Self::Obstacle => [0.12, 0.12, 0.12, 1.0],
            Self::Frontier => [0.85, 0.15, 0.1, 1.0],
            Self::Free => [0.2, 0.6, 0.3, 0.5],
        }
    }
}

impl SceneEntity {
    /// A volume of the plane: its labelled edges, each with both ends, metres in `frame`.
    pub fn volume(
        id: impl Into<String>,
        frame: impl Into<Arc<str>>,
        edges: impl IntoIterator<Item = ([[f64; 2]; 2], EdgeLabel)>,
    ) -> Self {
        let mut of: [Vec<[[f64; 3]; 2]>; 3] = Default::default();
        for (ends, label) in edges {
            of[label as usize].push(ends.map(|[x, y]| [x, y, 0.0]));
        }
        let labels = [EdgeLabel::Obstacle, EdgeLabel::Frontier, EdgeLabel::Free];
        let lines = labels.into_iter().zip(of).filter(|(_, segments)| !segments.is_empty());
        let lines = lines
            .map(|(label, segments)| SceneLines { segments, width_px: 2.0, rgba: label.rgba() })
            .collect();
        Self { id: id.into(), frame: frame.into(), lines, dots: Vec::new() }
    }

    /// A pose graph: its vertices, metres in `frame`, and its edges between them, of which a place edge
    /// has another colour. Edges to vertices that are not there are left out.
    pub fn graph(
        id: impl Into<String>,
        frame: impl Into<Arc<str>>,
        vertices: &[[f64; 3]],
        edges: impl IntoIterator<Item = (usize, usize, bool)>,
    ) -> Self {
        let [mut odometry, mut places] = [Vec::new(), Vec::new()];
        for (a, b, place) in edges {
            if let (Some(&a), Some(&b)) = (vertices.get(a), vertices.get(b)) {
                if place { places.push([a, b]) } else { odometry.push([a, b]) }
            }
        }
        let coloured = [(odometry, [0.3, 0.4, 0.8, 1.0]), (places, [0.9, 0.5, 0.1, 1.0])];
        let lines = coloured.into_iter().filter(|(segments, _)| !segments.is_empty());
        let lines = lines.map(|(segments, rgba)| SceneLines { segments, width_px: 1.5, rgba });
        let dot = |&at| SceneDot { at, diameter_m: 0.15, rgba: [0.3, 0.4, 0.8, 1.0] };
        Self {
            id: id.into(),
            frame: frame.into(),
            lines: lines.collect(),
            dots: vertices.iter().map(dot).collect(),
        }
    }
}
