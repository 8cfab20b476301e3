//! What is true: the place, the robot in it, and what was really seen.

use geometry::Point3;
use metrics::{FlightWitness, VoxelCoverage};
use worlds::World3d;

use super::ink::{Faces, Ink, dots, lines, placed};
use crate::palette;

/// The true path so far is drawn in stretches of so many points: each is sent once.
const STRETCH: usize = 64;

/// What is drawn under `truth/`.
#[derive(Default)]
pub(super) struct Truth {
    stretch: Vec<Point3>,
    count: usize,
}

impl Truth {
    /// Draws what does not change: the surfaces, and how many voxels count.
    pub(super) fn place(&mut self, ink: &mut Ink, world: &World3d, coverage: &VoxelCoverage) {
        let mut faces = Faces::default();
        let at = |vertex: u32| &world.vertices()[vertex as usize];
        for corners in world.triangles() {
            faces.push(corners.map(at), palette::TRUE_SURFACE);
        }
        ink.always("truth/place", &faces.mesh());
        let start = Point3::from(world.world_from_start().translation);
        self.stretch = vec![start];
        let hidden: Vec<Point3> = (0..coverage.size().iter().product())
            .filter(|&at| coverage.counts(at))
            .map(|at| coverage.centre_in_world(at))
            .collect();
        // Thinned: a viewer needs to see where they are, not to count them.
        let thin = hidden.len().div_ceil(4000).max(1);
        let some: Vec<Point3> = hidden.into_iter().step_by(thin).collect();
        ink.always("truth/counts", &dots(&some, &[palette::TRUE_UNSEEN], 0.7));
    }

    /// Draws the truth at the end of a step.
    pub(super) fn step(&mut self, ink: &mut Ink, witness: &FlightWitness, newly_seen: &[usize]) {
        let world_from_body = witness.world_from_body();
        let at = Point3::from(world_from_body.translation);
        if self.stretch.last() != Some(&at) {
            self.stretch.push(at);
            let part = format!("truth/path/{}", self.count);
            ink.draw(&part, &lines(std::slice::from_ref(&self.stretch), palette::TRUE_PATH, 1.5));
            if self.stretch.len() >= STRETCH {
                self.stretch = vec![at];
                self.count += 1;
            }
        }
        ink.draw("truth/robot", &placed(&world_from_body));
        let fresh: Vec<Point3> =
            newly_seen.iter().map(|&at| witness.coverage().centre_in_world(at)).collect();
        ink.draw("truth/newly_seen", &dots(&fresh, &[palette::TRUE_SEEN], 2.0));
    }
}

/// The robot's body: a ball, and an arrow ahead; at all times, in its own frame.
pub(super) fn body(ink: &mut Ink, part: &str, radius_m: f64) {
    #[expect(clippy::cast_possible_truncation, reason = "for looking")]
    let radius = radius_m.max(0.05) as f32;
    let ball = rerun::Ellipsoids3D::from_half_sizes([[radius; 3]])
        .with_colors([rerun::Color::from_u32(palette::ROBOT)])
        .with_fill_mode(rerun::FillMode::Solid);
    ink.always(part, &ball);
    let ahead = rerun::Arrows3D::from_vectors([[3.0 * radius, 0.0, 0.0]])
        .with_colors([rerun::Color::from_u32(palette::ROBOT)])
        .with_radii([0.25 * radius]);
    ink.always(&format!("{part}/ahead"), &ahead);
}
