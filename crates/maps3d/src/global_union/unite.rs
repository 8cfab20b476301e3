//! Steps 1 to 3 and 5: views are united, one by one, and all anew where poses moved.

use probe::Probe;
use solid::boolean::{BooleanEvent, Options};
use solid::{Operation, Point3, Polyhedron, SolidError, boolean_with, clean, crossings, unite};

use super::surface::Surface;
use super::view::{View, body_at};
use super::{UnionEvent, UnionMap, walls};
use crate::Map3dProbe;

/// The least share of its volume that a map must keep in a union: more than rounding is never lost.
const KEPT_SHARE: f64 = 1.0 - 1e-6;

/// Jitter with which a view is united again where the map crosses itself after the union, metres.
const AGAIN_M: [f64; 3] = [1e-7, 1e-6, 1e-5];

impl UnionMap {
    fn options(&self) -> Options {
        Options { coincident_m: self.params.coincident_m, ..Options::default() }
    }

    /// The operand of a view: where it is in the map, with the place that the robot takes up.
    fn operand(&self, number: usize, jitter_m: f64) -> Polyhedron {
        let view = &self.views[number];
        let placed = view.placed(number as u32, self.params.step_in_m, jitter_m);
        let is_first = !self.views[..number].iter().any(|other| other.vertex == view.vertex);
        if !is_first {
            return placed;
        }
        let at = Point3::from(self.poses.of(view.vertex).translation);
        let Some(body) = body_at(&at, self.params.body_m) else { return placed };
        solid::boolean(&placed, &body, Operation::Union, &self.options()).unwrap_or(placed)
    }

    /// Step 2 for one view: the map with it, and how many faces the obstacle won.
    fn united_with(
        &self,
        number: usize,
        operand: &Polyhedron,
    ) -> Result<(Polyhedron, usize), SolidError> {
        let before = &self.united.mesh;
        let operation = Operation::Union;
        let refused = |reason| Err(SolidError::Engine { operation: operation.name(), reason });
        let mut settled = Settled(0);
        let after = if before.is_empty() {
            unite(std::slice::from_ref(operand), &self.options())?
        } else {
            boolean_with(before, operand, operation, &self.options(), &mut settled)?
        };
        let (had_m3, has_m3) = (before.volume_m3(), after.volume_m3());
        if has_m3 < KEPT_SHARE * had_m3 {
            return refused(format!("of {had_m3} cubic metres {has_m3} were left"));
        }
        if let Some(crossing) = crossings(&after, 1).first() {
            return refused(format!("in the result {crossing}"));
        }
        let (after, by_walls) = walls::settle(after, &self.views[..=number], self.params.wall_m);
        Ok((after, settled.0 + by_walls))
    }

    /// Steps 1 to 3 for the view of this number, which is in the list already.
    pub(super) fn unite_one(&mut self, number: usize, probe: &mut dyn Map3dProbe) {
        let mut operand = self.operand(number, self.params.jitter_m);
        let mut united = self.united_with(number, &operand);
        // The engine rounds where faces cross; the steeper they do, the less.
        for jitter_m in AGAIN_M.into_iter().filter(|jitter_m| *jitter_m > self.params.jitter_m) {
            if united.is_ok() {
                break;
            }
            self.counts.again += 1;
            operand = self.operand(number, jitter_m);
            united = self.united_with(number, &operand);
        }
        let View { vertex, map_from_camera, .. } = self.views[number];
        let view = number as u32;
        probe.emit(UnionEvent::Placed { view, vertex, map_from_camera, operand: &operand });
        self.counts.unions += 1;
        match united {
            Ok((map, settled)) => {
                probe.emit(UnionEvent::United { view, map: &map, settled });
                self.united = Surface::new(self.cleaned(map, probe));
            }
            Err(why) => {
                self.counts.refused += 1;
                self.views[number].aside = true;
                probe.emit(UnionEvent::Refused { view, why: &why });
                self.aside.push(Surface::new(operand));
            }
        }
    }

    /// Step 3, whenever the map grew enough.
    fn cleaned(&mut self, map: Polyhedron, probe: &mut dyn Map3dProbe) -> Polyhedron {
        let grown =
            map.faces().len() as f64 >= self.params.clean_growth * self.cleaned_faces as f64;
        if self.params.clean_m <= 0.0 || !grown {
            return map;
        }
        let cleaned = clean(&map, self.params.clean_m);
        self.cleaned_faces = cleaned.mesh.faces().len();
        probe.emit(UnionEvent::Cleaned { map: &cleaned.mesh, removed: &cleaned.removed });
        cleaned.mesh
    }

    /// Step 5: unites all views again if any of them moved by more than is let pass.
    pub(super) fn follow(&mut self, probe: &mut dyn Map3dProbe) {
        let mut moved_max_m = 0.0_f64;
        for view in &self.views {
            let now = self.poses.of(view.vertex) * view.vertex_from_camera;
            moved_max_m = moved_max_m.max(view.moves_by(&now));
        }
        if moved_max_m <= self.params.rebuild_m {
            return;
        }
        for view in &mut self.views {
            view.map_from_camera = self.poses.of(view.vertex) * view.vertex_from_camera;
            view.aside = false;
        }
        self.counts.rebuilds += 1;
        (self.volumes, self.cleaned_faces) = (None, 0);
        self.aside.clear();
        self.united = Surface::new(Polyhedron::empty());
        (0..self.views.len()).for_each(|number| self.unite_one(number, probe));
        let (views, map) = (self.views.len(), &self.united.mesh);
        probe.emit(UnionEvent::Rebuilt { views, moved_max_m, map });
        self.sort(probe);
    }
}

/// Counts the faces that the obstacle won.
struct Settled(usize);

impl Probe<BooleanEvent<'_>> for Settled {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, event: BooleanEvent<'_>) {
        if let BooleanEvent::Settled { faces, .. } = event {
            self.0 += faces.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use pose::Se3;
    use probe::{Off, VertexId};
    use sensing::{Camera, DepthImage};
    use solid::Label;

    use super::*;
    use crate::events::Relay;
    use crate::{Map3d, UnionParams};

    /// Takes views whose polyhedra are given: what a depth image never gives can be tried.
    fn take(map: &mut UnionMap, in_camera: Polyhedron, x_m: f64) {
        let map_from_camera =
            Se3::new(nalgebra::Vector3::new(x_m, 0.0, 0.0), Se3::identity().rotation);
        map.poses.cover(VertexId(0));
        map.views.push(View {
            vertex: VertexId(0),
            vertex_from_camera: map_from_camera,
            in_camera,
            volume: None,
            map_from_camera,
            aside: false,
        });
        map.unite_one(map.views.len() - 1, &mut Off);
        map.sort(&mut Off);
    }

    fn view() -> Polyhedron {
        let camera = Camera::new(30.0, 30.0, 15.5, 11.5);
        let image = DepthImage::new(32, camera, vec![3.0; 32 * 24]);
        let options = UnionParams::default().view;
        crate::polyhedron(&image, &options).expect("a sound image").polyhedron
    }

    #[test]
    fn a_view_that_the_union_refuses_stands_beside_the_map() {
        let mut map = UnionMap::new(UnionParams::default()).expect("usual options");
        take(&mut map, view(), 0.0);
        let (before, open_m2) = (map.polyhedron().clone(), map.tally().open_m2);
        // A view that lacks a face is no closed 2-manifold.
        let (vertices, mut faces, mut labels, _) = view().into_parts();
        let lost = faces.len() - 1;
        faces.truncate(lost);
        labels.truncate(lost);
        let open = Polyhedron::try_new(vertices, faces, labels).expect("faces that exist");
        take(&mut map, open, 1.0);
        assert!(map.polyhedron() == &before);
        assert_eq!((map.counts.refused, map.beside(), map.looks()), (1, 1, 2));
        assert_eq!(map.work().refused, 1);
        // Its frontier counts where it is outside of the map, and ways lead into its fan.
        assert!(map.tally().open_m2 > 0.5 * open_m2);
        map.fill(&mut Off);
        let volumes = map.volumes.as_mut().expect("it was filled");
        let planner = volumes.planner(0.0, &mut Relay(&mut Off)).expect("sound tetrahedra");
        let (from, to) = (Point3::new(-0.5, 0.0, 2.0), Point3::new(2.0, 0.0, 2.5));
        let plan = planner.plan(&from, &crate::Target::Point(to)).expect("both are inside");
        assert!(plan.is_some_and(|plan| plan.path_m < 3.0));
    }

    #[test]
    fn what_cannot_be_filled_is_fanned() {
        let mut map = UnionMap::new(UnionParams::default()).expect("usual options");
        take(&mut map, view(), 0.0);
        // A map that meets itself, as engines may leave one where faces are coplanar to rounding.
        let (low, high) = (Point3::new(0.0, 0.0, 1.0), Point3::new(1.0, 1.0, 2.0));
        let cube = Polyhedron::cuboid(&low, &high, Label::Frontier);
        let (mut vertices, mut faces, mut labels, _) = cube.clone().into_parts();
        let first = vertices.len() as u32;
        vertices.extend(cube.vertices().iter().map(|v| v + nalgebra::Vector3::repeat(0.3)));
        faces.extend(cube.faces().iter().map(|face| face.map(|v| v + first)));
        labels.extend(cube.labels());
        let crossed = Polyhedron::try_new(vertices, faces, labels).expect("faces that exist");
        map.united = Surface::new(crossed);
        assert!(map.fill(&mut Off) >= 2, "the fan of the one view, a wall of two faces at least");
        assert_eq!((map.counts.fillings, map.counts.refused_fillings), (0, 1));
        assert_eq!(map.work().refused, 1);
    }
}
