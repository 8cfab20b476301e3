//! Two views held against each other: frontier of one inside the volume of the other is closed
//! (\[ISRR19\] 4.3, 4.4).

use geometry::planar::overlay::{StepOverlay, StepRings};
use nalgebra::Point3;
use pose::Se3;
use probe::{EdgeId, PathId, Probe};

use super::book::{Cause, Closing, ClosingId};
use super::doubt::Doubt;
use super::events::ConsolidationEvent;
use super::grid::{self, FaceGrid};
use super::ledger::OpenPart;
use super::slice::{Covered, Slicer};
use super::volume::{LocalVolume, Shape};
use super::{RelativeMap, RelativeParams, ViewState};
use crate::Map3dProbe;

/// Memory that comparisons reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    slicer: Slicer,
    overlay: StepOverlay,
    before: StepRings,
    after: StepRings,
    /// Faces changed by the pair at hand: index, what is open now.
    pub changed: Vec<(usize, OpenPart)>,
    doubt: Doubt,
    /// Views whose ledgers changed, each with one that closed something there.
    pub touched: Vec<(u32, u32)>,
}

/// A view to be closed, one that closes, and how they lie to each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// The view whose frontier is looked at.
    pub view: u32,
    /// The view whose volume may hold it.
    pub against: u32,
    /// The camera of `against` in the frame of that of `view`.
    pub camera_from_against: Se3,
    /// Odometry on the way between the two, at most, metres.
    pub odometry_m: f64,
}

/// Why frontier is closed as looks and edges come.
pub(super) const USUAL: [Cause; 2] = [Cause::Inside, Cause::Wall];

/// The shape in which a volume closes, by cause; `behind_m` is how far behind its obstacles, for
/// [`Cause::Behind`] alone.
pub(super) fn shape_of(cause: Cause, behind_m: f32, params: &RelativeParams) -> Shape {
    let shift_m = match cause {
        Cause::Inside => -params.shrink_m,
        Cause::Wall => params.wall_closing_m,
        Cause::Behind => behind_m.into(),
    };
    Shape { inset_px: params.inset_px, shift_m }
}

/// Where drift may have moved frontier by more than this, what stands before it says nothing, metres.
const MOST_BEHIND_M: f64 = 4.0;

impl RelativeMap {
    /// Closes what of the open frontier of one view the volume of another accounts for, one cause after the
    /// other: usually first what lies inside, then what is left along its walls.
    ///
    /// `path` gives the edges between them; it is asked once, when something is closed.
    pub(super) fn compare(
        &mut self,
        pair: &Pair,
        causes: &[Cause],
        path: &mut dyn FnMut() -> Vec<EdgeId>,
        probe: &mut dyn Map3dProbe,
    ) {
        let is_last = causes.contains(&Cause::Behind);
        let behind_m = if is_last { self.behind_m(pair) } else { 0.0 };
        if pair.view == pair.against || !may_touch(self, pair, behind_m.into()) {
            return;
        }
        // Slivers are not worth the time: they do not count, and get no larger.
        let view = &self.views[pair.view as usize];
        let mut counts = vec![false; view.open.len()];
        for piece in view.parts.iter().flat_map(|part| &part.pieces) {
            counts[usize::from(piece.face)] = true;
        }
        let mut path_id: Option<PathId> = None;
        let mut taken = false;
        for &cause in causes {
            if cause != Cause::Inside && self.params.wall_closing_m <= 0.0 {
                continue;
            }
            let mut work = std::mem::take(&mut self.work);
            let (view, against) =
                (&self.views[pair.view as usize], &self.views[pair.against as usize]);
            let shape = shape_of(cause, behind_m, &self.params);
            work.close(view, &against.volume, pair, (cause, shape), |face| counts[face]);
            // Looks of one vertex are exact to each other. What would be given up is closed by whoever can.
            if view.vertex != against.vertex && !is_last {
                work.leave_doubtful(view, against, pair, &mut taken, &self.params);
            }
            if !work.changed.is_empty() {
                let path = *path_id.get_or_insert_with(|| self.book.remember(path()));
                let (view, by, step) = (pair.view, pair.against, self.looks);
                let behind_m = if cause == Cause::Behind { behind_m } else { 0.0 };
                let id = self.book.close(Closing { cause, view, by, step, path, behind_m });
                self.write(pair, cause, id, path, &mut work, probe);
                work.touched.push((view, by));
            }
            self.work = work;
        }
    }

    /// How far behind obstacles of the other view frontier is closed that is about to be given up, metres: twice as far
    /// as along walls, or as far as drift may have moved it.
    #[expect(clippy::cast_possible_truncation, reason = "rounded once, and kept so")]
    fn behind_m(&self, pair: &Pair) -> f32 {
        let (centre, radius_m) = self.views[pair.view as usize].open_ball;
        let moved_m = self.drift.reach_m(pair.odometry_m, centre.coords.norm() + radius_m);
        let least_m = 2.0 * self.params.wall_closing_m;
        if moved_m <= MOST_BEHIND_M { least_m.max(moved_m) as f32 } else { least_m as f32 }
    }

    /// Writes the changed faces of a pair into the ledger of the view, and tells.
    fn write(
        &mut self,
        pair: &Pair,
        cause: Cause,
        id: ClosingId,
        path: PathId,
        work: &mut Work,
        probe: &mut dyn Map3dProbe,
    ) {
        let on = Probe::<ConsolidationEvent<'_>>::on(probe);
        let mut closed_m2 = 0.0;
        for (face, after) in work.changed.drain(..) {
            if on {
                let state = &self.views[pair.view as usize];
                let before = &state.open[face];
                closed_m2 += (before.share() - after.share()) * state.grid(face).area_m2();
                probe.emit(ConsolidationEvent::Closed {
                    view: pair.view,
                    state,
                    face,
                    before,
                    after: &after,
                    cause,
                    by: pair.against,
                    path: self.book.edges(path),
                });
            }
            let state = &mut self.views[pair.view as usize];
            state.open[face] = after;
            state.closings.push((face as u16, id));
        }
        if on {
            let Pair { view, against, camera_from_against, .. } = *pair;
            let event = ConsolidationEvent::PairCompared {
                view,
                against,
                camera_from_against,
                cause,
                closed_m2,
            };
            probe.emit(event);
        }
    }
}

impl Work {
    /// Fills `changed` with what is open of the frontier faces of `view` that hold for `wanted`, where a
    /// volume takes something from them.
    pub fn close(
        &mut self,
        view: &ViewState,
        volume: &LocalVolume,
        pair: &Pair,
        (cause, shape): (Cause, Shape),
        wanted: impl Fn(usize) -> bool,
    ) {
        self.changed.clear();
        let against_from_camera = pair.camera_from_against.inverse();
        let mut loaded = false;
        let solid: Vec<bool> = match cause {
            Cause::Inside => Vec::new(),
            Cause::Wall | Cause::Behind => {
                let mut solid = vec![false; volume.surface_count()];
                volume.obstacles().for_each(|face| solid[face as usize] = true);
                solid
            }
        };
        let is_solid = |face: u16| solid[face as usize];
        let only: Option<&dyn Fn(u16) -> bool> =
            if cause == Cause::Inside { None } else { Some(&is_solid) };
        for (index, open) in view.open.iter().enumerate() {
            let Some(bounds) = open.bounds().filter(|_| wanted(index)) else { continue };
            let corners = view.volume.points(view.volume.frontier()[index]);
            let face = FaceGrid::new(corners.map(|point| against_from_camera.transform(&point)));
            let (corners, count) = face.patch(bounds);
            if is_beside(volume, &corners[..count]) {
                continue;
            }
            if !loaded {
                self.slicer.load(volume, shape);
                loaded = true;
            }
            if let Some(after) = self.take((open, bounds), volume, shape, &face, only) {
                self.changed.push((index, after));
            }
        }
    }

    /// Takes out of `changed` the faces about which the two views contradict each other. The evidence is gathered
    /// once for a pair, when `taken` is false.
    fn leave_doubtful(
        &mut self,
        view: &ViewState,
        against: &ViewState,
        pair: &Pair,
        taken: &mut bool,
        params: &RelativeParams,
    ) {
        if self.changed.is_empty() || params.contradiction_share >= 1.0 {
            return;
        }
        if !std::mem::replace(taken, true) {
            let camera_from_against = &pair.camera_from_against;
            self.doubt.take(&view.volume, &against.volume, camera_from_against, params);
        }
        let doubt = &self.doubt;
        self.changed.retain(|(face, _)| {
            !doubt.is_about(view.volume.points(view.volume.frontier()[*face]), params)
        });
    }

    /// What is left of the open part of a face beside a volume; `None` where nothing is taken.
    fn take(
        &mut self,
        (open, bounds): (&OpenPart, [[i32; 2]; 2]),
        volume: &LocalVolume,
        shape: Shape,
        face: &FaceGrid,
        only: Option<&dyn Fn(u16) -> bool>,
    ) -> Option<OpenPart> {
        match self.slicer.slice(volume, shape, face, bounds, only) {
            Covered::Nothing => None,
            Covered::Everything => Some(OpenPart::closed()),
            Covered::Slices => {
                open.rings_into(&mut self.before);
                self.overlay.difference(&self.before, &self.slicer.slices, &mut self.after);
                // Crossings are rounded: what would not lie on the face, or not be less, is let be.
                let is_less = self.after.twice_area() < self.before.twice_area();
                (is_less && grid::is_within(&self.after)).then(|| OpenPart::of(&self.after))
            }
        }
    }
}

/// Whether a polygon in the frame `camera` of a volume lies beyond one side of its image, or behind.
fn is_beside(volume: &LocalVolume, corners: &[Point3<f64>]) -> bool {
    let camera = volume.camera();
    let [last_column, last_row] = volume.extent().map(f64::from);
    // The place in the image times the depth; with the depth it tells on which side of the image.
    let sides = |p: &Point3<f64>| {
        let [u, v] = [camera.cx * p.z + camera.fx * p.x, camera.cy * p.z + camera.fy * p.y];
        [u, last_column * p.z - u, v, last_row * p.z - v, p.z]
    };
    (0..5).any(|side| corners.iter().all(|corner| sides(corner)[side] < 0.0))
}

/// Whether the open frontier of a view comes near the volume of the other at all.
fn may_touch(map: &RelativeMap, pair: &Pair, behind_m: f64) -> bool {
    let (view, against) = (&map.views[pair.view as usize], &map.views[pair.against as usize]);
    let (centre, radius_m) = view.open_ball;
    let apart = centre - pair.camera_from_against.translation;
    // A step in depth is longer along rays to the side.
    let grown_m = 2.0 * (2.0 * map.params.wall_closing_m).max(behind_m);
    let reach_m = radius_m + against.volume.reach_m() + grown_m;
    apart.coords.norm_squared() <= reach_m * reach_m
}
