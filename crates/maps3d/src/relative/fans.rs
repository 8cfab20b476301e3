//! The free space of the views around a vertex as tetrahedra, with the frontier that is open as goals.

use std::collections::BTreeMap;

use pose::Se3;
use probe::VertexId;
use solid::tetrahedra::BoundaryFace;
use solid::{Label, Point3, SolidError, Tetrahedra};

use super::insert::PlacedView;
use super::volume::Shape;
use super::{RelativeMap, ViewState};
use crate::plan::{FansKnown, Space};
use crate::view::placed_fan;
use crate::{Hovering, Map3dProbe, Maps3dError};

/// Points of a way that views are chosen by lie so far apart, metres.
const SAMPLE_M: f64 = 0.25;

/// With so many views that hold all of a way that any view does there are enough.
const ENOUGH: usize = 4;

/// The views around a vertex as volumes for one planner, in the frame of that vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Fans {
    /// One for each view, the nearest along the graph first.
    pub volumes: Vec<Tetrahedra>,
    /// Where their cameras were.
    pub lenses: Vec<Point3>,
    finders: Vec<Finder>,
}

impl Fans {
    /// The views and their cameras.
    pub fn cameras(&self) -> impl Iterator<Item = (u32, &Se3)> {
        self.finders.iter().map(|finder| (finder.view, &finder.camera_from_root))
    }
}

/// How the tetrahedron of a fan is found that holds a point.
#[derive(Clone, Debug)]
struct Finder {
    view: u32,
    camera_from_root: Se3,
    /// By face of the view, its tetrahedron.
    inside_of: Vec<Option<u32>>,
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
        let mut placed = self.all_placed_views();
        placed.truncate(most);
        self.fans_of(&placed, true)
    }

    /// The fans of those views in scope of a vertex that look along a way to a place near another, at most so many,
    /// without frontier; and where the way starts and ends, in the frame of the vertex. `None` where the other vertex
    /// is not in scope.
    ///
    /// Points of the shortest way along the graph, and of the straight line, are looked for in all views: first come
    /// those that hold most of what no view before them holds, then, up to a few, those that hold most.
    /// O(views in scope).
    pub(super) fn fans_between(
        &mut self,
        hovering: &Hovering,
        other: VertexId,
        place_in_other: &Point3,
        most: usize,
        probe: &mut dyn Map3dProbe,
    ) -> Option<(Fans, [Point3; 2])> {
        self.cover(hovering.vertex.max(other));
        self.take_scope(hovering.vertex, probe);
        let rows = self.scope.placed();
        let goal = rows.iter().position(|row| row.vertex == other)?;
        let from = Point3::from(hovering.vertex_from_body.translation);
        let to = rows[goal].root_from_vertex.transform(place_in_other);
        if !to.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut stops = vec![from, to];
        let mut row = Some(goal);
        while let Some(at) = row {
            stops.push(rows[at].root_from_vertex.translation.into());
            row = rows[at].parent.map(|parent| parent as usize);
        }
        let mut samples = Vec::new();
        for leg in stops.windows(2) {
            let count = ((leg[1] - leg[0]).norm() / SAMPLE_M).ceil().max(1.0);
            let at = |i: usize| leg[0] + (leg[1] - leg[0]) * (i as f64 / count);
            samples.extend((0..=count as usize).map(at));
        }
        let placed = self.all_placed_views();
        let held: Vec<Vec<bool>> = placed
            .iter()
            .map(|placed| {
                let camera_from_root = placed.root_from_camera.inverse();
                let volume = &self.views[placed.view as usize].volume;
                let holds = |p: &Point3| volume.contains(&camera_from_root.transform(p));
                samples.iter().map(holds).collect()
            })
            .collect();
        let mut open = vec![true; samples.len()];
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < most.min(placed.len()) {
            let gain = |at: &usize| {
                let both = held[*at].iter().zip(&open).filter(|(held, open)| **held && **open);
                let all = held[*at].iter().filter(|held| **held);
                (both.count(), all.count())
            };
            let left = (0..placed.len()).filter(|at| !chosen.contains(at));
            // The nearest of equals.
            let Some(best) = left.rev().max_by_key(gain) else { break };
            let (new, all) = gain(&best);
            if all == 0 || (new == 0 && chosen.len() >= ENOUGH) {
                break;
            }
            for (open, held) in open.iter_mut().zip(&held[best]) {
                *open &= !held;
            }
            chosen.push(best);
        }
        let placed: Vec<PlacedView> = chosen.into_iter().map(|at| placed[at]).collect();
        Some((self.fans_of(&placed, false), [from, to]))
    }

    /// The space of fans without frontier; `ends` stand for the tetrahedra that they are in.
    pub(super) fn space_of(&self, fans: &Fans, ends: &[Point3]) -> Result<Space, Maps3dError> {
        let volumes: Vec<&Tetrahedra> = fans.volumes.iter().collect();
        let find = |volume: usize, at: &Point3| {
            let finder = fans.finders.get(volume)?;
            let in_camera = finder.camera_from_root.transform(at);
            let face = self.views[finder.view as usize].volume.holds(&in_camera, Shape::PLAIN)?;
            finder.inside_of.get(usize::from(face)).copied().flatten()
        };
        Space::of_fans(&volumes, &FansKnown { lenses: &fans.lenses, find: &find, ends })
    }

    fn fans_of(&self, placed: &[PlacedView], with_frontier: bool) -> Fans {
        let mut fans = Fans::default();
        for PlacedView { view, root_from_camera, .. } in placed {
            let state = &self.views[*view as usize];
            if let Ok((fan, inside_of)) = self.fan_of(state, root_from_camera, with_frontier) {
                fans.volumes.push(fan);
                let camera_from_root = root_from_camera.inverse();
                fans.finders.push(Finder { view: *view, camera_from_root, inside_of });
                fans.lenses.push(root_from_camera.translation.into());
            }
        }
        fans
    }

    fn fan_of(
        &self,
        state: &ViewState,
        root_from_camera: &Se3,
        with_frontier: bool,
    ) -> Result<(Tetrahedra, Vec<Option<u32>>), SolidError> {
        let volume = &state.volume;
        let Ok(in_camera) = volume.polyhedron() else { return Ok(Default::default()) };
        let mut fan = placed_fan(&in_camera, root_from_camera)?;
        let inside_of: Vec<Option<u32>> = fan.boundary.iter().map(|f| f.tetrahedra[0]).collect();
        let beside = if with_frontier { beside(&fan) } else { BTreeMap::new() };
        fan.boundary.retain(|face| face.label == Label::Obstacle);
        if !with_frontier {
            return Ok((fan, inside_of));
        }
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
        Ok((fan, inside_of))
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
