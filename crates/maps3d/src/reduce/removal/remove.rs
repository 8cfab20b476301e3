//! The loop of removals.

use nalgebra::Vector3;

use super::contribution::{contribution, relevance};
use super::{Contribution, Mend, Rings};
use crate::image::{FilledImage, Pixel};
use crate::reduce::Stop;
use crate::reduce::heap::IndexedHeap;
use crate::reduce::hole::{self, HoleMethod};

/// One removal, told to whoever watches.
#[derive(Clone, Copy, Debug)]
pub(in crate::reduce) struct Removal<'a> {
    pub pixel: Pixel,
    pub contribution_m: f64,
    /// The hole, in order.
    pub hole: &'a [Pixel],
    /// Triangles of the hole.
    pub pieces: &'a [[u16; 3]],
    pub rings: &'a Rings,
}

/// The state of a reduction by removal.
struct State {
    kind: Contribution,
    rings: Rings,
    inside: IndexedHeap,
    border: IndexedHeap,
    mend: Mend,
    around: Vec<[f32; 3]>,
}

/// Removes vertices until `stop`, and gives back what is left.
///
/// 1. The contribution of every vertex is measured and put on a heap: those inside by `kind`, those on
///    the border of the image by their relevance along it. The four corners stay.
/// 2. The least is taken out. Of the two heaps that one is asked that has more left of what it began
///    with, so that both shrink alike, as the thesis's counts do.
/// 3. The hole is triangulated on whole pixels.
/// 4. The neighbours are measured anew.
///
/// The thesis reduces the border after all else (scenario 5, line 11); that leaves single vertices
/// with thousands of neighbours. O(n log n).
pub(in crate::reduce) fn remove(
    image: &FilledImage,
    kind: Contribution,
    method: HoleMethod,
    stop: &Stop,
    mut watch: impl FnMut(Removal<'_>),
) -> Rings {
    let mut state = State::new(image, kind);
    let began = [state.inside.len() as u64, state.border.len() as u64];
    let limit = stop.error_m().unwrap_or(f64::INFINITY);
    let least = stop.vertices().unwrap_or(0).max(4);
    while state.rings.alive() > least {
        let left = [state.inside.len() as u64, state.border.len() as u64];
        let border_first = left[1] * began[0] > left[0] * began[1];
        let open =
            |heap: &IndexedHeap| heap.first().is_some_and(|(key, _)| f64::from(key) <= limit);
        let from_border = match (open(&state.inside), open(&state.border)) {
            (false, false) => break,
            (inside, border) => border && (border_first || !inside),
        };
        let heap = if from_border { &mut state.border } else { &mut state.inside };
        let Some((key, vertex)) = heap.pop() else { break };
        if state.rings.of(vertex).len() > hole::LARGEST {
            continue;
        }
        state.take_out(vertex, method);
        watch(Removal {
            pixel: state.rings.pixel(vertex),
            contribution_m: f64::from(key),
            hole: &state.mend.polygon,
            pieces: state.mend.pieces(),
            rings: &state.rings,
        });
    }
    state.rings
}

impl State {
    fn new(image: &FilledImage, kind: Contribution) -> Self {
        let mut state = Self {
            kind,
            rings: Rings::grid(image),
            inside: IndexedHeap::default(),
            border: IndexedHeap::default(),
            mend: Mend::default(),
            around: Vec::new(),
        };
        let (mut inside, mut border) = (Vec::with_capacity(image.pixels()), Vec::new());
        for vertex in 0..image.pixels() as u32 {
            if let Some(key) = state.key_of(vertex) {
                let nodes =
                    if state.rings.is_on_border(vertex) { &mut border } else { &mut inside };
                nodes.push((key, vertex));
            }
        }
        state.inside = IndexedHeap::new(inside, image.pixels());
        state.border = IndexedHeap::new(border, image.pixels());
        state
    }

    #[inline]
    fn point(&self, vertex: u32) -> Vector3<f64> {
        Vector3::from(self.rings.point_in_camera(vertex).map(f64::from))
    }

    /// What a vertex contributes; none for the corners of the image.
    #[expect(clippy::cast_possible_truncation, reason = "an order, not a measurement")]
    fn key_of(&mut self, vertex: u32) -> Option<f32> {
        if self.rings.is_on_border(vertex) {
            if self.rings.is_corner(vertex) {
                return None;
            }
            let ring = self.rings.of(vertex);
            let (after, before) = (self.point(ring[0]), self.point(ring[ring.len() - 1]));
            return Some(relevance(&before, &self.point(vertex), &after) as f32);
        }
        self.around.clear();
        for &neighbour in self.rings.of(vertex) {
            self.around.push(self.rings.point_in_camera(neighbour));
        }
        let point = self.rings.point_in_camera(vertex);
        Some(contribution(self.kind, point, &self.around) as f32)
    }

    /// Removes a vertex, closes its hole and measures its neighbours.
    fn take_out(&mut self, vertex: u32, method: HoleMethod) {
        self.mend.take_out(&mut self.rings, vertex, method);
        for place in 0..self.mend.ring.len() {
            let neighbour = self.mend.ring[place];
            if let Some(key) = self.key_of(neighbour) {
                let on_border = self.rings.is_on_border(neighbour);
                let heap = if on_border { &mut self.border } else { &mut self.inside };
                heap.set(neighbour, key);
            }
        }
    }
}
