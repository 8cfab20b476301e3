//! All points, one after the other.

use probe::Probe;

use super::cavity::Cavity;
use super::locate::Place;
use super::start::{first_four, plant};
use crate::tetrahedra::events::TetrahedraEvent;
use crate::tetrahedra::mesh::Mesh;
use crate::tetrahedra::predicates::P3;

/// Builds the Delaunay tetrahedralisation of `points`, inserted in the order given, with ghosts.
/// Returns it and, for each point, the first point at the same place; `None` where all points are
/// coplanar.
pub(crate) fn delaunay_of(
    points: Vec<P3>,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Option<(Mesh, Vec<u32>)> {
    let corners = first_four(&points)?;
    let mut same: Vec<u32> = (0..points.len() as u32).collect();
    let mut mesh = Mesh::over(points);
    mesh.tets.reserve(7 * mesh.points.len());
    plant(&mut mesh, corners);
    let mut cavity = Cavity::default();
    let mut hint = 0;
    for vertex in 0..mesh.points.len() as u32 {
        if corners.contains(&vertex) {
            continue;
        }
        match mesh.locate(mesh.point(vertex), hint) {
            Place::On(other) => same[vertex as usize] = other,
            Place::In(t) => {
                hint = mesh.insert_in(vertex, t, &mut cavity);
                if probe.on() {
                    probe.emit(TetrahedraEvent::Inserted {
                        vertex,
                        removed: cavity.inside.len(),
                        mesh: (&mesh).into(),
                        made: &cavity.made,
                    });
                }
            }
        }
    }
    Some((mesh, same))
}
