//! One tetrahedron: four vertices and four neighbours.

/// Stands for no vertex, no tetrahedron or no neighbour.
pub(crate) const NONE: u32 = u32::MAX;
/// The vertex at infinity: it joins each face of the convex hull to a ghost tetrahedron.
pub(crate) const GHOST: u32 = u32::MAX - 1;

/// The corners of the face opposite each corner: with that corner they make a positive tetrahedron.
pub(crate) const FACE: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// A tetrahedron; positively oriented unless it is a ghost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tet {
    /// Its vertices; the first is [`NONE`] when the slot is free.
    pub(crate) v: [u32; 4],
    /// Across the face opposite each vertex: four times the neighbour, plus the index of the common
    /// face there.
    pub(crate) n: [u32; 4],
}

impl Tet {
    /// A slot that holds nothing.
    pub(crate) const FREE: Self = Self { v: [NONE; 4], n: [NONE; 4] };

    /// Whether the slot holds a tetrahedron.
    #[inline]
    pub(crate) fn is_live(&self) -> bool {
        self.v[0] != NONE
    }

    /// Whether the vertex at infinity is a corner.
    #[inline]
    pub(crate) fn is_ghost(&self) -> bool {
        self.v.contains(&GHOST)
    }

    /// Where among its corners a vertex is.
    #[inline]
    pub(crate) fn index_of(&self, vertex: u32) -> Option<usize> {
        self.v.iter().position(|&v| v == vertex)
    }

    /// The corners of the face opposite corner `face`, in the order of [`FACE`].
    #[inline]
    pub(crate) fn face(&self, face: usize) -> [u32; 3] {
        FACE[face].map(|i| self.v[i])
    }
}

/// The corners of a face in ascending order, to compare faces by.
#[inline]
pub(crate) fn sorted3([a, b, c]: [u32; 3]) -> [u32; 3] {
    let (a, b) = if a < b { (a, b) } else { (b, a) };
    if c > b {
        [a, b, c]
    } else if c > a {
        [a, c, b]
    } else {
        [c, a, b]
    }
}
