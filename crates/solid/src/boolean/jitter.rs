//! Step 6: views that are not exactly coplanar.

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
