//! What an overlay tells: the lists that \[Zie18\] 2.6 works through line by line.

use probe::Probe;

use super::{Overlay, Source};
use crate::Point2;

/// Steps of building a union, an intersection or a difference (\[Zie18\] 2.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OverlayEvent {
    /// Two input edges meet on the boundary of the result (\[Zie18\] 2.6.1).
    Intersected {
        /// Where.
        at: Point2,
        /// The edge of the first input.
        first: Source,
        /// The edge of the second input.
        second: Source,
        /// Whether the first enters there what lies to the left of the second (eq. 2.11); else it
        /// leaves it.
        entry: bool,
    },
    /// Two edges were joined at an intersection (\[Zie18\] 2.6.2).
    Merged {
        /// Where.
        at: Point2,
        /// The edge that the boundary comes by.
        before: Source,
        /// The edge that it goes on with.
        after: Source,
    },
    /// A closed ring came out (\[Zie18\] 2.6.3).
    LoopClosed {
        /// Which ring of the result.
        ring: usize,
        /// How many corners it has.
        corners: usize,
        /// Its area, square metres; negative for a hole.
        area_m2: f64,
    },
}

probe::variants!(OverlayEvent: Intersected, Merged, LoopClosed);

/// Tells of a result: its intersections, then its merges, then its loops.
pub(super) fn tell<T: Copy>(result: &Overlay<T>, probe: &mut impl Probe<OverlayEvent>) {
    let corners = || {
        result.region.rings.iter().zip(&result.sources).flat_map(|(ring, sources)| {
            (0..ring.points.len()).filter_map(move |i| {
                let before = if i == 0 { sources.len() - 1 } else { i - 1 };
                let (before_edge, after_edge) = (sources[before], sources[i]);
                let along = ring.points[i] - ring.points[before];
                let on = ring.points[ring.next(i)] - ring.points[i];
                (before_edge.input != after_edge.input).then_some((
                    ring.points[i],
                    before_edge,
                    after_edge,
                    along.perp(&on),
                ))
            })
        })
    };
    for (at, before, after, turn) in corners() {
        // The cross product of the first with the second edge, whichever way the boundary goes.
        let cross = if before.input < after.input { turn } else { -turn };
        let (first, second) =
            if before.input < after.input { (before, after) } else { (after, before) };
        probe.emit(OverlayEvent::Intersected { at, first, second, entry: cross >= 0.0 });
    }
    for (at, before, after, _) in corners() {
        probe.emit(OverlayEvent::Merged { at, before, after });
    }
    for (index, ring) in result.region.rings.iter().enumerate() {
        probe.emit(OverlayEvent::LoopClosed {
            ring: index,
            corners: ring.points.len(),
            area_m2: 0.5 * ring.twice_area_m2(),
        });
    }
}
