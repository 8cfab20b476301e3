//! A reduction from start to end.

use probe::{Off, Probe};

use super::ReduceEvent;
use super::collapse::{Refusal, Work};
use crate::{Point3, Polyhedron};

/// When a reduction ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// No original vertex may be farther than this from the result, metres.
    pub error_m: f64,
    /// It ends at this many faces; 0 for as few as the error allows.
    pub faces: usize,
}

/// How often each test said no.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Refusals {
    /// The surface would no longer be the 2-manifold that it is.
    pub link: usize,
    /// A label's region would change its border.
    pub label: usize,
    /// A face would be flat or turn over.
    pub fold: usize,
    /// An original vertex would be farther than the bound.
    pub bound: usize,
    /// Faces would meet.
    pub crossing: usize,
}

impl Refusals {
    fn count(&mut self, why: Refusal) {
        *match why {
            Refusal::Link => &mut self.link,
            Refusal::Label => &mut self.label,
            Refusal::Fold => &mut self.fold,
            Refusal::Bound => &mut self.bound,
            Refusal::Crossing => &mut self.crossing,
        } += 1;
    }
}

/// What came of a reduction.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// The mesh; its vertices are some of those of the input, unmoved.
    pub mesh: Polyhedron,
    /// The greatest distance of an original vertex from the face that it is kept with, metres: no less
    /// than its distance from the mesh.
    pub error_m: f64,
    /// Vertices that were taken out.
    pub removed: usize,
    /// How often each test said no.
    pub refusals: Refusals,
}

/// Reduces a mesh; see [`reduce_with`].
pub fn reduce(mesh: &Polyhedron, goal: &Goal) -> Reduced {
    reduce_with(mesh, goal, &mut Off)
}

/// Takes vertices out of a mesh, the cheapest first, until the goal is reached or nothing can go, and
/// tells `probe` about it.
///
/// Vertices on a border of the surface, on an edge of more than two faces, or at which the surface
/// touches itself stay.
///
/// What holds of the mesh holds of the result: closed, oriented, 2-manifold, the same Euler
/// characteristic, the same regions of labels next to each other, and free of self-intersections where
/// the mesh is. O(n log n) where few boxes of faces touch; some 50 microseconds per vertex.
pub fn reduce_with(
    mesh: &Polyhedron,
    goal: &Goal,
    probe: &mut impl for<'x> Probe<ReduceEvent<'x>>,
) -> Reduced {
    probe.emit(ReduceEvent::Started { mesh });
    let mut work = Work::new(mesh, goal.error_m, f64::INFINITY);
    let mut refusals = Refusals::default();
    let (mut removed, mut shown) = (0, work.mesh.count);
    while work.mesh.count > goal.faces {
        let Some(next) = work.next() else { break };
        match work.attempt(next.from, next.to) {
            Err(why) => refusals.count(why),
            Ok(()) => {
                removed += 1;
                if !probe.on() {
                    continue;
                }
                let [from, to] = [next.from, next.to].map(|v| work.mesh.vertices[v as usize]);
                let (faces, error_m) = (work.mesh.count, work.kept.greatest_m);
                probe.emit(ReduceEvent::Collapsed { from, to, faces, error_m });
                if 2 * faces <= shown {
                    shown = faces;
                    probe.emit(ReduceEvent::Halved { mesh: &work.mesh.finish(), error_m });
                }
            }
        }
    }
    let (mesh, error_m) = (work.mesh.finish(), work.kept.greatest_m);
    let reduced = Reduced { mesh, error_m, removed, refusals };
    probe.emit(ReduceEvent::Finished { reduced: &reduced });
    reduced
}

/// What came of cleaning.
#[derive(Clone, Debug, PartialEq)]
pub struct Cleaned {
    /// The mesh.
    pub mesh: Polyhedron,
    /// Where vertices were taken out, metres.
    pub removed: Vec<Point3>,
    /// Removals that were not done because faces would have met.
    pub undone: usize,
}

/// Draws edges no longer than `length_m` together where that changes neither topology nor labels,
/// makes no faces meet, and moves the surface by no more than `length_m`.
///
/// Cost as of [`reduce_with`], for the short edges alone but for getting ready.
pub fn clean(mesh: &Polyhedron, length_m: f64) -> Cleaned {
    let mut work = Work::new(mesh, length_m, length_m);
    let (mut removed, mut undone) = (Vec::new(), 0);
    while let Some(next) = work.next() {
        let from = work.mesh.vertices[next.from as usize];
        match work.attempt(next.from, next.to) {
            Ok(()) => removed.push(from),
            Err(Refusal::Crossing) => undone += 1,
            Err(_) => {}
        }
    }
    if removed.is_empty() {
        return Cleaned { mesh: mesh.clone(), removed, undone };
    }
    Cleaned { mesh: work.mesh.finish(), removed, undone }
}
