//! Steps 2 and 7: operands that are not exactly coplanar.

use crate::{Point3, Polyhedron, Vector3};

/// How far vertices are moved, metres, on each axis at most.
pub const JITTER_M: f64 = 1e-8;

/// Steele, Lea and Flood's SplitMix64.
pub(crate) fn mixed(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A number from -1 to 1 that depends on nothing but its arguments.
fn hashed(view: u64, vertex: usize, axis: usize) -> f64 {
    let bits = mixed(mixed(view).wrapping_add(vertex as u64 * 3 + axis as u64)) >> 11;
    bits as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The view with every vertex moved by up to `amplitude_m` on each axis, by a hash of the view and the
/// vertex: the same call gives the same mesh, two views are moved differently.
///
/// Vertices at one place move apart unless they are one vertex. A view whose faces come nearer to each
/// other than the amplitude may intersect itself afterwards.
pub fn jittered(view: &Polyhedron, seed: u64, amplitude_m: f64) -> Polyhedron {
    let moved = |(vertex, point): (usize, &Point3)| {
        point + Vector3::from_fn(|axis, _| hashed(seed, vertex, axis)) * amplitude_m
    };
    let vertices = view.vertices().iter().enumerate().map(moved).collect();
    let (_, faces, labels, origins) = view.clone().into_parts();
    Polyhedron::from_sound_parts(vertices, faces, labels, origins)
}

/// How much of a move is by chance.
const BY_CHANCE: f64 = 0.25;

/// At most so many times its face moves a vertex at a sharp corner.
pub(super) const FARTHEST: f64 = 4.0;

/// The mesh with its faces moved outwards by about `by_m`, inwards where that is negative.
///
/// Each vertex moves along the mean of the directions of its faces, weighted by their angles there, as
/// far as the face that gains least needs, four times `by_m` at most; and by up to a quarter of `by_m`
/// on each axis by a hash of `seed` and the vertex. So faces that were coplanar with those of another
/// mesh are on a known side of them, and meet no edge at which the other's faces meet. A mesh whose
/// faces come nearer to each other than that may intersect itself afterwards. O(v + f).
pub(super) fn grown(mesh: &Polyhedron, seed: u64, by_m: f64) -> Polyhedron {
    let mut direction = vec![Vector3::zeros(); mesh.vertices().len()];
    let normal = |face: usize| mesh.scaled_normal(face).try_normalize(0.0);
    for (face, corners) in mesh.faces().iter().enumerate() {
        let Some(normal) = normal(face) else { continue };
        let [a, b, c] = mesh.corners(face);
        for (vertex, (at, to, from)) in corners.iter().zip([(a, b, c), (b, c, a), (c, a, b)]) {
            direction[*vertex as usize] += normal * (to - at).angle(&(from - at));
        }
    }
    for along in &mut direction {
        *along = along.try_normalize(0.0).unwrap_or_default();
    }
    let mut least = vec![1.0_f64; direction.len()];
    for (face, corners) in mesh.faces().iter().enumerate() {
        let Some(normal) = normal(face) else { continue };
        for &vertex in corners {
            let gain = direction[vertex as usize].dot(&normal);
            least[vertex as usize] = least[vertex as usize].min(gain);
        }
    }
    let moved = |(vertex, point): (usize, &Point3)| {
        let chance = Vector3::from_fn(|axis, _| hashed(seed, vertex, axis)) * BY_CHANCE;
        point + (direction[vertex] / least[vertex].max(1.0 / FARTHEST) + chance) * by_m
    };
    let vertices = mesh.vertices().iter().enumerate().map(moved).collect();
    let (_, faces, labels, origins) = mesh.clone().into_parts();
    Polyhedron::from_sound_parts(vertices, faces, labels, origins)
}

/// What is tried in turn where a jitter is asked for: that many times as far, by another chance each time.
/// Layers that another jitter left, as thin as this one, are passed sooner by a smaller one.
const TIMES: [f64; 12] = [1.0, 1.0, 0.3, 2.0, 0.1, 4.0, 0.03, 8.0, 20.0, 50.0, 100.0, 1000.0];

/// What is tried in turn where none is asked for and faces are in one plane up to rounding: that many times
/// what is rounding, at most [`JITTER_M`], or what is rounding where that is more.
const ROUNDINGS: [f64; 7] = [4.0, 4.0, 16.0, 64.0, 256.0, 1024.0, 4096.0];

/// How far the second operand is moved, in the order tried, metres: for a jitter that is asked for, or for 0 where
/// none is.
pub(super) fn distances(asked_m: f64, rounding_m: f64) -> Vec<f64> {
    if asked_m > 0.0 {
        return TIMES.map(|times| times * asked_m).to_vec();
    }
    let most_m = JITTER_M.max(4.0 * rounding_m);
    let mut all = ROUNDINGS.map(|times| (times * rounding_m).min(most_m)).to_vec();
    all.retain(|&jitter_m| jitter_m > 0.0);
    all
}
