//! From samples to a labelled star polygon (\[ISRR19\] 4.1).

use geometry::Point2;
use geometry::planar::{PlanarError, StarPolygon};
use geometry::predicates::orient;

use super::{EdgeKey, FrontierEdge, LocalVolume, ObstacleEdge, Options, Rim, Samples};

/// How samples become a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeParams {
    /// Hits whose ranges differ by this or more are not one surface, metres (δ in \[ISRR19\] 4.1,
    /// where its value is not printed).
    pub occlusion_gap_m: f64,
    /// What a point must be inside a volume to count as inside, metres. Without it the walls that two
    /// volumes share would be freed by rounding.
    pub strict_margin_m: f64,
    /// Choices of \[Zie18\].
    pub options: Options,
}

impl Default for VolumeParams {
    fn default() -> Self {
        Self { occlusion_gap_m: 1.0, strict_margin_m: 0.01, options: Options::default() }
    }
}

/// Builds the volume of what was seen from one place.
///
/// An edge is obstacle only between two hits whose ranges differ by less than the gap; every other
/// edge, and the two edges at the sensor beside each gap, are frontier.
///
/// # Errors
/// Samples whose order the exact predicates refuse, which only ranges beyond 1e100 m can cause.
pub fn build(samples: &Samples, params: &VolumeParams) -> Result<LocalVolume, PlanarError> {
    let all = samples.as_slice();
    let gap_m = params.occlusion_gap_m;
    let surface = |i: usize, j: usize| {
        let (a, b) = (&all[i], &all[j]);
        a.hit && b.hit && !params.options.is_occlusion(a, b, gap_m)
    };
    let kept = if params.options.thin_m > 0.0 {
        params.options.thin(all, |i| !samples.is_gap_after(i) && surface(i, i + 1))
    } else {
        (0..all.len()).collect()
    };

    let mut vertices: Vec<Point2> = Vec::with_capacity(kept.len());
    let mut gap_after: Vec<bool> = Vec::with_capacity(kept.len());
    let mut solid_after: Vec<bool> = Vec::with_capacity(kept.len());
    // Whether the edge after each kept sample is an obstacle.
    let mut bounds: Vec<bool> = Vec::with_capacity(kept.len());
    for (k, &i) in kept.iter().enumerate() {
        let j = kept[(k + 1) % kept.len()];
        // The samples between two kept ones are all surface, so the last of them decides.
        let before = if j == 0 { all.len() - 1 } else { j - 1 };
        let (a, b) = (all[i].end_in_anchor, all[j].end_in_anchor);
        let gap = samples.is_gap_after(before) || !turns_left(&a, &b);
        let thinned = before != i;
        let solid = !gap && (surface(before, j) && (thinned || surface(i, j)));
        vertices.push(a);
        gap_after.push(gap);
        solid_after.push(solid);
        bounds.push(solid);
        let both_hit = all[i].hit && all[j].hit;
        let middle = Point2::from((a.coords + b.coords) * 0.5);
        // The middle of a chord past the sensor itself may not lie between its ends in bearing.
        let between = turns_left(&a, &middle) && turns_left(&middle, &b);
        if params.options.insert_occlusion_vertex && !gap && !solid && both_hit && between {
            vertices.push(middle);
            gap_after.push(false);
            solid_after.push(false);
        }
    }

    // Hits at neither end of an obstacle edge.
    let mut posts = Vec::new();
    for (k, &i) in kept.iter().enumerate() {
        let before = (k + kept.len() - 1) % kept.len();
        if all[i].hit && !bounds[before] && !bounds[k] {
            posts.push(all[i].end_in_anchor);
        }
    }

    let polygon = StarPolygon::try_new(vertices, gap_after)?;
    let inner = polygon.shrunk(params.strict_margin_m);
    let (frontier, obstacles) = label(&polygon, &solid_after);
    let rim = Rim::new(&polygon, &obstacles, &posts);
    Ok(LocalVolume { polygon, inner, frontier, obstacles, posts, rim })
}

/// Whether `b` lies counter-clockwise of `a`, by less than half a turn.
fn turns_left(a: &Point2, b: &Point2) -> bool {
    orient(&Point2::origin(), a, b) > 0.0
}

fn label(polygon: &StarPolygon, solid_after: &[bool]) -> (Vec<FrontierEdge>, Vec<ObstacleEdge>) {
    let mut frontier = Vec::new();
    let mut obstacles = Vec::new();
    for (i, &solid) in solid_after.iter().enumerate() {
        let from = polygon.vertex(i);
        let to = polygon.vertex(polygon.next(i));
        let key = EdgeKey(2 * i as u32);
        if polygon.is_gap(i) {
            let origin = Point2::origin();
            let out = EdgeKey(key.0 + 1);
            frontier.push(FrontierEdge { key, from, to: origin, spoke: true });
            frontier.push(FrontierEdge { key: out, from: origin, to, spoke: true });
        } else if solid {
            obstacles.push(ObstacleEdge { key, from, to });
        } else {
            frontier.push(FrontierEdge { key, from, to, spoke: false });
        }
    }
    (frontier, obstacles)
}
