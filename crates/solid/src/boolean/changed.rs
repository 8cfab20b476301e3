//! After step 5: which faces of a result need to be looked at.

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasherDefault, Hasher};

use super::jitter::mixed;
use crate::{Point3, Polyhedron};

/// Numbers made one number: nobody chooses them so that they fall together.
#[derive(Default)]
pub(super) struct Mixing(u64);

impl Hasher for Mixing {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(byte.into());
        }
    }

    fn write_u32(&mut self, number: u32) {
        self.write_u64(number.into());
    }

    fn write_u64(&mut self, number: u64) {
        self.0 = mixed(self.0.rotate_left(23) ^ number);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

pub(super) type Mixed = BuildHasherDefault<Mixing>;

/// A number for a place; one zero, whatever its sign.
pub(super) fn key(p: &Point3) -> u64 {
    (0..3).map(|i| (p[i] + 0.0).to_bits()).fold(0, |sum, bits| mixed(sum ^ bits))
}

/// The faces of a result that no operand has as they are, ascending: those along the curve where surfaces
/// meet, and what was made of others. O(n), expected.
pub(super) fn changed(mesh: &Polyhedron, operands: &[&Polyhedron]) -> Vec<u32> {
    let vertices = operands.iter().map(|operand| operand.vertices().len()).sum();
    let mut places: HashMap<u64, (u32, &Point3), Mixed> =
        HashMap::with_capacity_and_hasher(vertices, Mixed::default());
    let count = operands.iter().map(|operand| operand.faces().len()).sum();
    let mut faces: HashSet<(u64, u32), Mixed> =
        HashSet::with_capacity_and_hasher(count, Mixed::default());
    // Sorted corners, two and one.
    let sorted = |[a, b, c]: [u32; 3]| {
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        (u64::from(low) << 32 | u64::from(a ^ b ^ c ^ low ^ high), high)
    };
    let mut numbers = Vec::new();
    for operand in operands {
        numbers.clear();
        for vertex in operand.vertices() {
            let next = places.len() as u32;
            numbers.push(places.entry(key(vertex)).or_insert((next, vertex)).0);
        }
        faces.extend(operand.faces().iter().map(|face| sorted(face.map(|v| numbers[v as usize]))));
    }
    numbers.clear();
    numbers.extend(mesh.vertices().iter().map(|vertex| match places.get(&key(vertex)) {
        Some(&(number, place)) if place == vertex => number,
        _ => u32::MAX,
    }));
    let is_changed = |face: &[u32; 3]| {
        let corners = face.map(|v| numbers[v as usize]);
        corners.contains(&u32::MAX) || !faces.contains(&sorted(corners))
    };
    let all = mesh.faces().iter().enumerate();
    all.filter(|(_, face)| is_changed(face)).map(|(face, _)| face as u32).collect()
}

/// Faces lower than this share of the largest coordinate are thin: rounding may turn them round.
const THIN: f64 = 4096.0 * f64::EPSILON;

/// The faces with a height that is next to rounding, ascending. O(n).
///
/// Where surfaces only pass through each other, what is nearer to each other than rounding, and may meet by
/// it, is where a corner or an edge of one passes next to an edge of the other; and there a piece of a face
/// is thin.
pub(super) fn thin(mesh: &Polyhedron) -> Vec<u32> {
    let reach_m =
        mesh.bounds().map_or(0.0, |(low, high)| low.coords.amax().max(high.coords.amax()));
    let is_thin = |&face: &usize| {
        let [a, b, c] = mesh.corners(face);
        let longest =
            (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
        mesh.scaled_normal(face).norm_squared() <= longest * (THIN * reach_m).powi(2)
    };
    (0..mesh.faces().len()).filter(is_thin).map(|face| face as u32).collect()
}
