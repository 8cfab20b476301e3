//! A look comes in: it becomes a view, and is held against those around.

use pose::Se3;
use probe::Probe;

use super::book::Cause;
use super::events::ConsolidationEvent;
use super::pair::{Pair, USUAL};
use super::state::GivenUp;
use super::volume::LocalVolume;
use super::{RelativeMap, ViewState};
use crate::events::Relay;
use crate::{Look, Map3dProbe, Maps3dError, polyhedron_with};

/// A view of a scope, placed.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedView {
    pub view: u32,
    /// Row of the scope.
    pub row: u32,
    pub root_from_camera: Se3,
}

impl RelativeMap {
    /// Makes a view of a look, and compares it with all views in scope.
    pub(super) fn insert(
        &mut self,
        look: &Look<'_>,
        probe: &mut dyn Map3dProbe,
    ) -> Result<(), Maps3dError> {
        if !is_finite(&look.vertex_from_camera) {
            return Err(Maps3dError::Pose { vertex: look.vertex });
        }
        let options = self.params.view_through(&look.image.camera);
        let made = polyhedron_with(look.image, &options, &mut Relay(&mut *probe))?;
        let volume = LocalVolume::new(&made)?;
        self.cover(look.vertex);
        self.looks += 1;
        let view = self.views.len() as u32;
        let mut state = ViewState::new(look.vertex, look.vertex_from_camera, volume);
        state.measure(self.params.sliver_m2);
        if Probe::<ConsolidationEvent<'_>>::on(probe) {
            probe.emit(ConsolidationEvent::ViewAdded { view, state: &state });
        }
        self.views.push(state);
        self.views_of[look.vertex].push(view);
        self.shells.retain(|shell| shell.vertex != look.vertex);
        self.take_scope(look.vertex, probe);
        self.hear_of_given_up(view);
        self.compare_view(view, probe);
        Ok(())
    }

    /// Takes a new view out of later comparisons if it adds nothing: no frontier of its own counts after it
    /// was held against the others, and it closed none of theirs that did.
    ///
    /// What it sees is then bounded by what others see, but for slivers: were some of it beyond them all, it
    /// would hold frontier of theirs. So going round in known space costs no more each time.
    fn retire_if_idle(&mut self, view: u32, closed_others: bool, probe: &mut dyn Map3dProbe) {
        let state = &mut self.views[view as usize];
        if !closed_others && !state.counts() {
            state.retired = true;
            probe.emit(ConsolidationEvent::Retired { view });
        }
    }

    /// Holds a view on the root of the scope at hand against all others in it, both ways: its own frontier
    /// against the nearest first, then theirs against its volume.
    pub(super) fn compare_view(&mut self, view: u32, probe: &mut dyn Map3dProbe) {
        let placed = self.placed_views();
        let root_from_camera = self.views[view as usize].vertex_from_camera;
        self.work.touched.clear();
        for other in placed.iter().filter(|other| other.view != view) {
            let own = PlacedView { view, row: 0, root_from_camera };
            self.compare_rows(&own, other, &USUAL, probe);
        }
        self.measure_touched();
        for other in placed.iter().filter(|other| other.view != view) {
            if self.views[other.view as usize].counts() {
                let own = PlacedView { view, row: 0, root_from_camera };
                self.compare_rows(other, &own, &USUAL, probe);
            }
        }
        let before_m2: f64 = self.views.iter().map(|state| state.open_m2).sum();
        self.measure_touched();
        let after_m2: f64 = self.views.iter().map(|state| state.open_m2).sum();
        self.retire_if_idle(view, after_m2 < before_m2, probe);
    }

    /// Closes what of one placed view the other accounts for.
    pub(super) fn compare_rows(
        &mut self,
        of: &PlacedView,
        against: &PlacedView,
        causes: &[Cause],
        probe: &mut dyn Map3dProbe,
    ) {
        let camera_from_against = of.root_from_camera.inverse_mul(&against.root_from_camera);
        // By way of the root, so where neither is there it may be less.
        let of_row =
            |row: u32| self.scope.placed().get(row as usize).map_or(0.0, |at| at.odometry_m);
        let odometry_m = of_row(of.row) + of_row(against.row);
        let pair = Pair { view: of.view, against: against.view, camera_from_against, odometry_m };
        let scope = std::mem::take(&mut self.scope);
        let skeleton =
            std::mem::replace(&mut self.skeleton, super::map::empty_skeleton(&self.params));
        let mut path = || scope.path_between(&skeleton, of.row as usize, against.row as usize);
        self.compare(&pair, causes, &mut path, probe);
        (self.scope, self.skeleton) = (scope, skeleton);
    }

    /// The active views of the scope at hand, by rising distance of their vertices.
    pub(super) fn placed_views(&self) -> Vec<PlacedView> {
        let mut placed = self.all_placed_views();
        placed.retain(|placed| !self.views[placed.view as usize].retired);
        placed
    }

    /// The views of the scope at hand, by rising distance of their vertices, retired ones as well.
    pub(super) fn all_placed_views(&self) -> Vec<PlacedView> {
        let mut placed = Vec::new();
        for (row, at) in self.scope.placed().iter().enumerate() {
            for &view in self.views_of(at.vertex) {
                let state = &self.views[view as usize];
                let root_from_camera = at.root_from_vertex * state.vertex_from_camera;
                placed.push(PlacedView { view, row: row as u32, root_from_camera });
            }
        }
        placed
    }

    /// Measures the views whose ledgers changed.
    pub(super) fn measure_touched(&mut self) {
        let mut touched = std::mem::take(&mut self.work.touched);
        touched.sort_unstable();
        touched.dedup_by_key(|pair| pair.0);
        for &(view, _) in &touched {
            self.views[view as usize].measure(self.params.sliver_m2);
        }
        touched.clear();
        self.work.touched = touched;
    }

    /// A new view hears of places in scope that were given up for every view.
    fn hear_of_given_up(&mut self, view: u32) {
        let mut heard = false;
        for number in 0..self.given_up.len() as u32 {
            heard |= self.hear_of(view, number);
        }
        if heard {
            self.views[view as usize].measure(self.params.sliver_m2);
        }
    }

    /// A view on the root of the scope at hand hears of one such place; whether that is in scope.
    pub(super) fn hear_of(&mut self, view: u32, number: u32) -> bool {
        let (vertex, place, radius_m) = self.given_up[number as usize];
        let rows = self.scope.placed();
        let Some(at) = rows.iter().position(|row| row.vertex == vertex) else { return false };
        let in_root = rows[at].root_from_vertex.transform(&place);
        let over = (at > 0)
            .then(|| (self.book.remember(self.scope.path_between(&self.skeleton, 0, at)), number));
        let state = &mut self.views[view as usize];
        let place_in_camera = state.vertex_from_camera.inverse_transform(&in_root);
        state.given_up.push(GivenUp { place_in_camera, radius_m, over });
        true
    }
}

/// Whether every number of a pose is finite.
pub(super) fn is_finite(pose: &Se3) -> bool {
    use posegraph::RelativePose;
    RelativePose::is_finite(pose)
}
