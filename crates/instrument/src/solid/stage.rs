//! What every recording of work on a mesh stands on.

use std::fmt::Arguments;
use std::path::PathBuf;

use rerun::{Color, LineStrips3D, Mesh3D, Points3D, RecordingStream};
use solid::{Label, Point3, Polyhedron};

use crate::columns::{Rgba, fixed, rgb, rgba};
use crate::stage::Stage;
use crate::{InstrumentError, layout, palette};

/// What a recording of work on a mesh says about itself.
#[derive(Clone, Debug)]
pub struct SolidOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// Its name.
    pub name: String,
    /// What is done, in words (Markdown).
    pub about: String,
}

/// The colour of a label's faces.
pub(super) const fn colour(label: Label) -> Rgba {
    match label {
        Label::Obstacle => rgb(150, 150, 165),
        Label::Frontier => rgba(255, 140, 30, 200),
    }
}

/// A recording, the count of its events, and its first refusal.
pub(crate) struct SolidStage {
    stage: Stage,
    event: i64,
    refusal: Option<InstrumentError>,
}

impl SolidStage {
    /// Creates the file with its layout and text page; `panels` are its 3D views.
    pub(super) fn create(
        options: &SolidOptions,
        panels: &[(&str, &[&str])],
    ) -> Result<Self, InstrumentError> {
        Self::create_with(options, |stream| layout::send_solid(stream, panels))
    }

    /// As [`create`](Self::create), with a layout of its own.
    pub(crate) fn create_with(
        options: &SolidOptions,
        layout: impl FnOnce(&RecordingStream) -> Result<(), String>,
    ) -> Result<Self, InstrumentError> {
        let stage = Stage::create(&options.path, &options.name)?;
        layout(&stage.stream).map_err(|reason| stage.refused(reason))?;
        stage.about(format!("# {}\n\n{}\n", options.name, options.about))?;
        fixed(&stage.stream, &"/".into(), &rerun::ViewCoordinates::RIGHT_HAND_Z_UP())?;
        Ok(Self { stage, event: -1, refusal: None })
    }

    /// Says how plotted numbers look: name, title, colour.
    pub(crate) fn looks(&mut self, plots: &[(&str, &str, Rgba)]) {
        if let Err(refused) = self.stage.looks(plots.iter().copied()) {
            self.refusal.get_or_insert(refused);
        }
    }

    /// Plots a number at the event at hand.
    pub(crate) fn plot(&mut self, name: &str, value: f64) {
        if let Err(refused) = self.stage.plot(name, value) {
            self.refusal.get_or_insert(refused);
        }
    }

    /// Goes to the next event and writes one line about it.
    pub(crate) fn event(&mut self, variant: &'static str, line: Arguments<'_>) {
        self.event += 1;
        self.stage.stream.set_time_sequence("event", self.event);
        if let Err(refused) = self.stage.say("events/solid", variant, line) {
            self.refusal.get_or_insert(refused);
        }
    }

    fn note(&mut self, entity: &str, sent: Result<(), rerun::RecordingStreamError>) {
        if let Err(error) = sent {
            let entity = entity.to_owned();
            let refused = InstrumentError::Rows { entity, reason: error.to_string() };
            self.refusal.get_or_insert(refused);
        }
    }

    /// Shows a mesh in the colours of its labels; every face has corners of its own.
    pub(super) fn labelled(&mut self, entity: &str, mesh: &Polyhedron) {
        let colours: Vec<Rgba> = mesh.labels().iter().map(|&label| colour(label)).collect();
        self.mesh(entity, mesh, &colours);
    }

    /// Shows a mesh with a colour for each face.
    pub(super) fn mesh(&mut self, entity: &str, mesh: &Polyhedron, colours: &[Rgba]) {
        let mut corners = Vec::with_capacity(3 * mesh.faces().len());
        let mut normals = Vec::with_capacity(3 * mesh.faces().len());
        for face in 0..mesh.faces().len() {
            let normal = mesh.scaled_normal(face).try_normalize(0.0).unwrap_or_default();
            corners.extend(mesh.corners(face).map(short));
            normals.extend([short(&Point3::from(normal)); 3]);
        }
        let each = colours.iter().flat_map(|&colour| [Color::from_u32(colour); 3]);
        let shown = Mesh3D::new(corners).with_vertex_normals(normals).with_vertex_colors(each);
        let sent = self.stage.stream.log(entity, &shown);
        self.note(entity, sent);
    }

    /// Shows the edges of a mesh at all times, thin, in the colours of the labels beside them.
    pub(crate) fn outlined(&mut self, entity: &str, mesh: &Polyhedron) {
        for (name, label) in [("obstacle", Label::Obstacle), ("frontier", Label::Frontier)] {
            let mut edges: Vec<[u32; 2]> = (mesh.faces().iter().zip(mesh.labels()))
                .filter(|(_, of)| **of == label)
                .flat_map(|(&[a, b, c], _)| [[a, b], [b, c], [c, a]])
                .map(|[a, b]| [a.min(b), a.max(b)])
                .collect();
            edges.sort_unstable();
            edges.dedup();
            let at = |vertex: u32| short(&mesh.vertices()[vertex as usize]);
            let shown = LineStrips3D::new(edges.iter().map(|edge| edge.map(at)))
                .with_colors([Color::from_u32(colour(label))])
                .with_radii([rerun::Radius::new_ui_points(0.4)]);
            let entity = format!("{entity}/{name}");
            if let Err(refused) = fixed(&self.stage.stream, &entity.as_str().into(), &shown) {
                self.refusal.get_or_insert(refused);
            }
        }
    }

    /// Shows lines.
    pub(crate) fn lines(&mut self, entity: &str, ends: &[[Point3; 2]], colour: Rgba, points: f32) {
        let strips = ends.iter().map(|[from, to]| [short(from), short(to)]);
        let shown = LineStrips3D::new(strips)
            .with_colors([Color::from_u32(colour)])
            .with_radii([rerun::Radius::new_ui_points(points)]);
        let sent = self.stage.stream.log(entity, &shown);
        self.note(entity, sent);
    }

    /// Shows points.
    pub(crate) fn points(&mut self, entity: &str, at: &[Point3], colour: Rgba, points: f32) {
        let shown = Points3D::new(at.iter().map(short))
            .with_colors([Color::from_u32(colour)])
            .with_radii([rerun::Radius::new_ui_points(points)]);
        let sent = self.stage.stream.log(entity, &shown);
        self.note(entity, sent);
    }

    /// Ends the recording with its result; `metrics` is kept as JSON.
    pub(crate) fn finish(
        self,
        result: String,
        metrics: &serde_json::Value,
    ) -> Result<(), InstrumentError> {
        self.stage.finish(self.refusal, result, metrics)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a screen shows far less than a float holds")]
fn short(at: &Point3) -> [f32; 3] {
    [at.x as f32, at.y as f32, at.z as f32]
}

/// The colours of two operands.
pub(super) const OPERANDS: [Rgba; 2] = [palette::MAPS[1], palette::MAPS[2]];
