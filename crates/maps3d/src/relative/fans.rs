//! The free space of the views around a vertex as tetrahedra, with the frontier that is open as goals.

use std::collections::BTreeMap;

use pose::Se3;
use probe::VertexId;
use solid::tetrahedra::BoundaryFace;
use solid::{Label, Point3, SolidError, Tetrahedra};

use super::insert::PlacedView;
use super::{RelativeMap, ViewState};
use crate::view::placed_fan;

/// The views around a vertex as volumes for one planner, in the frame of that vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Fans {
    /// One for each view, the nearest along the graph first.
    pub volumes: Vec<Tetrahedra>,
    /// Where their cameras were.
    pub lenses: Vec<Point3>,
}

impl RelativeMap {
    /// The fans of the views in scope of a vertex, at most so many, the nearest along the graph first.
    ///
    /// A fan joins the camera to each face of its view. What bounds it: obstacle faces are walls; frontier
    /// faces are free to pass, since a way that leaves one volume there is in another or nowhere; and every
    /// place to go to on frontier that counts, as the policy takes them, is a small frontier face of its own.
    /// A view whose fan rounding breaks is left out. O(f log f) for f faces of these views.
    pub(super) fn fans_around(&mut self, vertex: VertexId, most: usize) -> Fans {
        self.cover(vertex);
        self.take_scope(vertex, &mut probe::Off);
        let placed = self.all_placed_views();
        let mut fans = Fans::default();
        for PlacedView { view, root_from_camera, .. } in placed.into_iter().take(most) {
            let state = &self.views[view as usize];
            if let Ok(fan) = self.fan_of(state, &root_from_camera) {
                fans.volumes.push(fan);
                fans.lenses.push(root_from_camera.translation.into());
            }
        }
        fans
    }

    fn fan_of(&self, state: &ViewState, root_from_camera: &Se3) -> Result<Tetrahedra, SolidError> {
        let volume = &state.volume;
        let Ok(in_camera) = volume.polyhedron() else { return Ok(Tetrahedra::default()) };
        let mut fan = placed_fan(&in_camera, root_from_camera)?;
        let inside_of: Vec<Option<u32>> = fan.boundary.iter().map(|f| f.tetrahedra[0]).collect();
        let beside = beside(&fan);
        fan.boundary.retain(|face| face.label == Label::Obstacle);
        for spot in state.parts.iter().flat_map(|part| self.spots_of(state, part)) {
            // A face that leads to the camera has no tetrahedron of its own: that next to it, beyond its edge.
            let own = inside_of.get(usize::from(spot.face)).copied().flatten();
            let inside = own.or_else(|| {
                let [a, b, c] = volume.face(spot.face).map(u32::from);
                let of = |p: u32, q: u32| beside.get(&[p.min(q), p.max(q)]).copied();
                of(a, b).or_else(|| of(b, c)).or_else(|| of(c, a))
            });
            let Some(inside) = inside else { continue };
            let first = fan.vertices.len() as u32;
            fan.vertices.extend(spot.piece_in_camera.map(|p| root_from_camera.transform(&p)));
            fan.boundary.push(BoundaryFace {
                corners: [first, first + 1, first + 2],
                face: u32::from(spot.face),
                label: Label::Frontier,
                tetrahedra: [Some(inside), None],
            });
        }
        Ok(fan)
    }
}

/// By edge of the border of the surface, the tetrahedron that has it.
fn beside(fan: &Tetrahedra) -> BTreeMap<[u32; 2], u32> {
    let mut beside = BTreeMap::new();
    for (t, (corners, neighbours)) in fan.tetrahedra.iter().zip(&fan.neighbours).enumerate() {
        // The camera is the fourth corner; across the faces that hold it is the next of the fan, or none.
        for at in (0..3).filter(|&at| neighbours[at].is_none()) {
            let [p, q] = [corners[(at + 1) % 3], corners[(at + 2) % 3]];
            beside.insert([p.min(q), p.max(q)], t as u32);
        }
    }
    beside
}
