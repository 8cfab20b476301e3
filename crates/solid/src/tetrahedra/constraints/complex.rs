//! The edges and faces that the tetrahedra must have.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Multiplies and folds: no seed, so that the same input takes the same steps.
#[derive(Clone, Copy, Default)]
struct Fold(u64);

impl Hasher for Fold {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }
    #[inline]
    fn write_u64(&mut self, value: u64) {
        let mixed = u128::from(value ^ self.0 ^ 0x9e37_79b9_7f4a_7c15) * 0xd6e8_feb8_6659_fd93;
        self.0 = (mixed as u64) ^ ((mixed >> 64) as u64);
    }
}

/// A map with integer keys that is looked up, and never walked through.
type FoldMap<V> = HashMap<u64, V, BuildHasherDefault<Fold>>;

/// An edge that must appear.
#[derive(Clone, Debug)]
pub(crate) struct Segment {
    /// Its ends.
    pub(crate) ends: [u32; 2],
    /// Its faces.
    pub(crate) faces: Vec<u32>,
    /// Whether it is in the mesh, and must stay.
    pub(crate) held: bool,
    /// Whether it still is one: one that was split is not.
    pub(crate) live: bool,
}

/// A face that must appear.
#[derive(Clone, Debug)]
pub(crate) struct Facet {
    /// Its corners, in the order of the input face.
    pub(crate) corners: [u32; 3],
    /// The input face that it is, or is a part of.
    pub(crate) input: u32,
    /// How many input faces lie here.
    pub(crate) copies: u32,
    /// Whether it is in the mesh, and must stay.
    pub(crate) held: bool,
    /// Whether it still is one.
    pub(crate) live: bool,
}

/// The triangles of the input, by edges.
#[derive(Clone, Debug, Default)]
pub(crate) struct Constraints {
    by_ends: FoldMap<u32>,
    /// All segments that ever were.
    pub(crate) segments: Vec<Segment>,
    /// All facets that ever were.
    pub(crate) facets: Vec<Facet>,
    /// Whether faces are protected yet.
    pub(crate) guard_facets: bool,
}

#[inline]
fn key(a: u32, b: u32) -> u64 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    (u64::from(low) << 32) | u64::from(high)
}

impl Constraints {
    /// Adds a triangle, with its edges. A second one on the same corners counts as a copy.
    pub(crate) fn add(&mut self, corners: [u32; 3], input: u32) -> u32 {
        if let Some(facet) = self.facet(corners[0], corners[1], corners[2]) {
            self.facets[facet as usize].copies += 1;
            return facet;
        }
        let id = self.facets.len() as u32;
        self.facets.push(Facet { corners, input, copies: 1, held: false, live: true });
        for i in 0..3 {
            let segment = self.add_segment(corners[i], corners[(i + 1) % 3]);
            self.segments[segment as usize].faces.push(id);
        }
        id
    }

    /// The segment between two vertices, made if there is none.
    fn add_segment(&mut self, a: u32, b: u32) -> u32 {
        if let Some(&id) = self.by_ends.get(&key(a, b)) {
            return id;
        }
        let id = self.segments.len() as u32;
        let ends = [a.min(b), a.max(b)];
        self.segments.push(Segment { ends, faces: Vec::new(), held: false, live: true });
        self.by_ends.insert(key(a, b), id);
        id
    }

    /// Makes an edge without triangles one that must appear, held or not.
    pub(crate) fn hold_bare(&mut self, a: u32, b: u32, held: bool) {
        let id = self.add_segment(a, b);
        self.segments[id as usize].held = held;
    }

    /// Forgets an edge without triangles.
    pub(crate) fn drop_bare(&mut self, a: u32, b: u32) {
        if let Some(id) = self.segment(a, b)
            && self.segments[id as usize].faces.is_empty()
        {
            self.segments[id as usize].live = false;
            self.segments[id as usize].held = false;
            self.by_ends.remove(&key(a, b));
        }
    }

    /// Takes a triangle out; edges that no triangle has any more go too.
    pub(crate) fn remove(&mut self, facet: u32) {
        let corners = self.facets[facet as usize].corners;
        self.facets[facet as usize].live = false;
        self.facets[facet as usize].held = false;
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let Some(&id) = self.by_ends.get(&key(a, b)) else { continue };
            let segment = &mut self.segments[id as usize];
            segment.faces.retain(|&f| f != facet);
            if segment.faces.is_empty() {
                segment.live = false;
                segment.held = false;
                self.by_ends.remove(&key(a, b));
            }
        }
    }

    /// The segment between two vertices.
    #[inline]
    pub(crate) fn segment(&self, a: u32, b: u32) -> Option<u32> {
        self.by_ends.get(&key(a, b)).copied()
    }

    /// The facet on three vertices.
    #[inline]
    pub(crate) fn facet(&self, a: u32, b: u32, c: u32) -> Option<u32> {
        let id = self.segment(a, b)?;
        let has_c = |&&f: &&u32| self.facets[f as usize].corners.contains(&c);
        self.segments[id as usize].faces.iter().find(has_c).copied()
    }

    /// Whether an edge of the mesh must stay.
    #[inline]
    pub(crate) fn holds_edge(&self, a: u32, b: u32) -> bool {
        self.segment(a, b).is_some_and(|id| self.segments[id as usize].held)
    }

    /// Whether a face of the mesh must stay.
    #[inline]
    pub(crate) fn holds_face(&self, a: u32, b: u32, c: u32) -> bool {
        self.guard_facets && self.facet(a, b, c).is_some_and(|id| self.facets[id as usize].held)
    }
}
