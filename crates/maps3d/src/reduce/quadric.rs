//! Error quadrics: what the field does today.

use nalgebra::Vector3;

use super::Stop;
use super::heap::IndexedHeap;
use super::hole;
use super::removal::{Mend, Removal, Rings};
use crate::image::FilledImage;
use crate::triangulate::{grid_faces, orient};

/// The squared distance from some planes, as a form of how far a point lies from the vertex that holds
/// it: `[xx, xy, xz, x, yy, yz, y, zz, z, 1]`, and the weight in it.
///
/// Short numbers do for a form about its own vertex, and take half the memory: they are off by
/// 0.25 mm for each metre that a vertex moves. About the camera they would be off by millimetres at
/// once.
#[derive(Clone, Copy, Debug, Default)]
struct Quadric([f32; 10], f32);

impl Quadric {
    /// The squared distance from the plane of a normal through the vertex, times a weight.
    fn of_plane(normal: &Vector3<f64>, weight: f64) -> Self {
        let [a, b, c] = [normal.x, normal.y, normal.z];
        let form = [a * a, a * b, a * c, 0.0, b * b, b * c, 0.0, c * c, 0.0, 0.0];
        Self::rounded(form.map(|x| weight * x), weight)
    }

    #[expect(clippy::cast_possible_truncation, reason = "see the type")]
    fn rounded(form: [f64; 10], weight: f64) -> Self {
        Self(form.map(|x| x as f32), weight as f32)
    }

    fn add(&mut self, other: &Self) {
        for (sum, term) in self.0.iter_mut().zip(other.0) {
            *sum += term;
        }
        self.1 += other.1;
    }

    /// The same form about a vertex that lies elsewhere.
    fn about(&self, at: &Vector3<f64>) -> Self {
        let [xx, xy, xz, x, yy, yz, y, zz, z, _] = self.0.map(f64::from);
        let there = [
            xx * at.x + xy * at.y + xz * at.z + x,
            xy * at.x + yy * at.y + yz * at.z + y,
            xz * at.x + yz * at.y + zz * at.z + z,
        ];
        let one = self.at(at).max(0.0);
        let form = [xx, xy, xz, there[0], yy, yz, there[1], zz, there[2], one];
        Self::rounded(form, f64::from(self.1))
    }

    fn at(&self, p: &Vector3<f64>) -> f64 {
        let [xx, xy, xz, x, yy, yz, y, zz, z, one] = self.0.map(f64::from);
        let (px, py, pz) = (p.x, p.y, p.z);
        (xx * px + 2.0 * (xy * py + xz * pz + x)) * px
            + (yy * py + 2.0 * (yz * pz + y)) * py
            + (zz * pz + 2.0 * z) * pz
            + one
    }
}

struct State<'a> {
    image: &'a FilledImage,
    rings: Rings,
    quadrics: Vec<Quadric>,
    heap: IndexedHeap,
    mend: Mend,
}

/// Removes vertices by collapsing the edge whose quadric says that it costs least (Garland and
/// Heckbert 1997), until `stop`.
///
/// A vertex goes into one of its neighbours, never to a new place, so that vertices stay pixels; only
/// where that leaves all faces of positive turn, so that the triangulation stays planar. The border of
/// the image counts as a surface of its own; its vertices go along it, the four corners stay. A bound
/// is compared with the root of the cost per weight. O(n log n).
pub(super) fn collapse(
    image: &FilledImage,
    stop: &Stop,
    mut watch: impl FnMut(Removal<'_>),
) -> Rings {
    let mut state = State::new(image);
    let limit = stop.error_m().unwrap_or(f64::INFINITY);
    let least = stop.vertices().unwrap_or(0).max(4);
    while state.rings.alive() > least {
        let Some((_, vertex)) = state.heap.pop() else { break };
        let Some((cost, place)) = state.cheapest(vertex) else { continue };
        let into = state.rings.of(vertex)[place];
        let weight = state.quadrics[vertex as usize].1 + state.quadrics[into as usize].1;
        let share = if cost.is_finite() { cost / f64::from(weight) } else { cost };
        let contribution_m = share.sqrt();
        if contribution_m > limit {
            break;
        }
        let moved = state.point(into) - state.point(vertex);
        let gone = state.quadrics[vertex as usize].about(&moved);
        state.quadrics[into as usize].add(&gone);
        state.mend.collapse(&mut state.rings, vertex, place);
        for at in 0..state.mend.ring.len() {
            state.measure(state.mend.ring[at]);
        }
        for at in 0..state.rings.of(into).len() {
            state.measure(state.rings.of(into)[at]);
        }
        watch(Removal {
            pixel: state.rings.pixel(vertex),
            contribution_m,
            hole: &state.mend.polygon,
            pieces: state.mend.pieces(),
            rings: &state.rings,
        });
    }
    state.rings
}

impl<'a> State<'a> {
    fn new(image: &'a FilledImage) -> Self {
        let rings = Rings::grid(image);
        let quadrics = vec![Quadric::default(); image.pixels()];
        let heap = IndexedHeap::default();
        let mut state = Self { image, rings, quadrics, heap, mend: Mend::default() };
        for face in grid_faces(image.columns(), image.rows()) {
            let face = face.map(|index| state.rings.number_at(index as usize));
            let [a, b, c] = face.map(|vertex| state.point(vertex));
            let doubled = (b - a).cross(&(c - a));
            let area = 0.5 * doubled.norm();
            if area > 0.0 {
                let normal = doubled / (2.0 * area);
                let quadric = Quadric::of_plane(&normal, area / 3.0);
                for vertex in face {
                    state.quadrics[vertex as usize].add(&quadric);
                }
            }
        }
        state.weigh_border();
        let mut nodes = Vec::with_capacity(image.pixels());
        for vertex in 0..image.pixels() as u32 {
            if let Some((cost, _)) = state.cheapest(vertex) {
                nodes.push((Self::key(cost), vertex));
            }
        }
        state.heap = IndexedHeap::new(nodes, image.pixels());
        state
    }

    #[expect(clippy::cast_possible_truncation, reason = "an order, not a measurement")]
    fn key(cost: f64) -> f32 {
        cost as f32
    }

    fn point(&self, vertex: u32) -> Vector3<f64> {
        self.image.point_in_camera(self.rings.pixel(vertex)).coords
    }

    /// The wall between the camera and the border counts, so that its steps stay where they are.
    fn weigh_border(&mut self) {
        for vertex in 0..self.image.pixels() as u32 {
            if !self.rings.is_on_border(vertex) {
                continue;
            }
            let next = self.rings.of(vertex)[0];
            let (a, b) = (self.point(vertex), self.point(next));
            let along = (b - a).normalize();
            // Perpendicular to the edge within the wall.
            let within = a - along * along.dot(&a);
            if within.norm() > 0.0 {
                let normal = within.normalize();
                let weight = (b - a).norm_squared();
                let quadric = Quadric::of_plane(&normal, weight);
                for vertex in [vertex, next] {
                    self.quadrics[vertex as usize].add(&quadric);
                }
            }
        }
    }

    fn measure(&mut self, vertex: u32) {
        match self.cheapest(vertex) {
            Some((cost, _)) => self.heap.set(vertex, Self::key(cost)),
            None => self.heap.remove(vertex),
        }
    }

    /// The neighbour that a vertex goes into most cheaply, as a place in its ring.
    fn cheapest(&self, vertex: u32) -> Option<(f64, usize)> {
        let ring = self.rings.of(vertex);
        let n = ring.len();
        let on_border = self.rings.is_on_border(vertex);
        if n > hole::LARGEST || (on_border && self.rings.is_corner(vertex)) {
            return None;
        }
        let (own, held) = (self.point(vertex), self.quadrics[vertex as usize]);
        let mut best: Option<(f64, usize)> = None;
        for place in 0..n {
            if on_border && place != 0 && place != n - 1 {
                continue;
            }
            let there = f64::from(self.quadrics[ring[place] as usize].0[9]);
            let cost = held.at(&(self.point(ring[place]) - own)).max(0.0) + there;
            // Short numbers end at 1e38: what lies beyond costs more than anything.
            let cost = if cost.is_nan() { f64::INFINITY } else { cost };
            if best.is_none_or(|(least, _)| cost < least) && self.sees_all(ring, place) {
                best = Some((cost, place));
            }
        }
        best
    }

    /// Whether every triangle from the corner at `place` turns positively.
    fn sees_all(&self, ring: &[u32], place: usize) -> bool {
        let n = ring.len();
        let at = |step: usize| self.rings.pixel(ring[(place + step) % n]);
        (1..n - 1).all(|step| orient(at(0), at(step), at(step + 1)) > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadric_is_the_squared_distance() {
        let normal = Vector3::new(1.0, 2.0, -2.0) / 3.0;
        let (p, moved) = (Vector3::new(0.3, -4.0, 2.2), Vector3::new(-1.0, 0.5, 0.25));
        let quadric = Quadric::of_plane(&normal, 2.0);
        let distance = normal.dot(&p);
        assert!((quadric.at(&p) - 2.0 * distance * distance).abs() < 1e-5);
        let other = quadric.about(&moved);
        assert!((other.at(&(p - moved)) - quadric.at(&p)).abs() < 1e-5);
    }
}
