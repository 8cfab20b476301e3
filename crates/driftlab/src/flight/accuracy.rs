//! What a map believes free at the end of a flight, against the truth.

use geometry::Point3;
use maps3d::{Hovering, Known, Map3d};
use metrics::{FlightWitness, VoxelAccuracy};
use pose::Se3;
use probe::VertexId;

/// Voxels that a map is asked about, at most.
const MOST_ASKED: usize = 2000;

/// Farther from where the robot was a map is not asked, metres: there it sees what it does not go to.
const NEAR_M: f64 = 2.0;

/// Asks a map about voxels of the true place, each from the vertex that truly is nearest to it.
///
/// A map without a global frame can be asked no other way, and of one with a global frame it is what a robot meets
/// that hovers there: an error that all of its surroundings share does not count.
pub(super) fn accuracy(map: &dyn Map3d, witness: &FlightWitness, vertices: usize) -> VoxelAccuracy {
    let vertices = 0..u32::try_from(vertices).unwrap_or(u32::MAX);
    let known: Vec<(VertexId, Se3)> = vertices
        .filter_map(|at| {
            let vertex = VertexId(at);
            Some((vertex, witness.robot().world_from_vertex(vertex)?))
        })
        .collect();
    let mut is_free = |centre: &Point3| {
        let apart =
            |(_, pose): &&(VertexId, Se3)| (pose.translation - centre.coords).norm_squared();
        let nearest = known.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let (vertex, world_from_vertex) = nearest.filter(|near| apart(near) <= NEAR_M * NEAR_M)?;
        let hovering = Hovering { vertex: *vertex, vertex_from_body: Se3::identity() };
        Some(map.knows(&hovering, &world_from_vertex.inverse_transform(centre)) == Known::Free)
    };
    witness.coverage().accuracy(witness.robot().world(), MOST_ASKED, &mut is_free)
}
