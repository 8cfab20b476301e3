//! What a probe sees of a tetrahedralisation.

use super::mesh::{Mesh, NONE};

/// The mesh at the moment of an event.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    mesh: &'a Mesh,
}

impl<'a> From<&'a Mesh> for Snapshot<'a> {
    fn from(mesh: &'a Mesh) -> Self {
        Self { mesh }
    }
}

impl<'a> Snapshot<'a> {
    /// All points, in the order of insertion; vertices of events count them.
    pub fn points(&self) -> &'a [[f64; 3]] {
        &self.mesh.points
    }

    /// The vertices of all tetrahedra without those at infinity.
    pub fn tetrahedra(&self) -> impl Iterator<Item = [u32; 4]> + 'a {
        let mesh = self.mesh;
        mesh.finite().map(move |t| mesh.tet(t).v)
    }

    /// The vertices of a tetrahedron by its slot; `None` for one at infinity or a slot that is free.
    pub fn tetrahedron(&self, slot: u32) -> Option<[u32; 4]> {
        let tet = self.mesh.tets.get(slot as usize)?;
        (tet.v[0] != NONE && !tet.is_ghost()).then_some(tet.v)
    }
}

/// What an exchange of tetrahedra was for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// To bring in a missing segment.
    Segment,
    /// To bring in a missing facet.
    Facet,
    /// To put a point on what is stuck, for the time being.
    Divide,
    /// To take such a point off the boundary again.
    Suppress,
    /// To be rid of a point that the input does not have.
    Remove,
}

impl Cause {
    /// The cause in small letters.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Segment => "segment",
            Self::Facet => "facet",
            Self::Divide => "divide",
            Self::Suppress => "suppress",
            Self::Remove => "remove",
        }
    }
}

/// Facts about a running tetrahedralisation, in the past tense.
#[derive(Clone, Copy, Debug)]
pub enum TetrahedraEvent<'a> {
    /// A point was inserted.
    Inserted {
        /// The point, in the order of insertion.
        vertex: u32,
        /// How many tetrahedra had it in their spheres, and went.
        removed: usize,
        /// The mesh after it.
        mesh: Snapshot<'a>,
        /// The slots of the new tetrahedra.
        made: &'a [u32],
    },
    /// All points were in.
    Triangulated {
        /// The Delaunay tetrahedra.
        mesh: Snapshot<'a>,
        /// How many points it has that are corners of the box round the input.
        box_corners: usize,
        /// The faces that must appear.
        facets: &'a [[u32; 3]],
    },
    /// Some tetrahedra were exchanged for others: a flip, a reconnection, a point put in or taken out.
    Exchanged {
        /// What for.
        cause: Cause,
        /// The tetrahedra that went.
        removed: &'a [[u32; 4]],
        /// Those that came.
        made: &'a [[u32; 4]],
        /// The points, for the vertices.
        points: &'a [[f64; 3]],
    },
    /// A segment or facet that was missing is in the mesh.
    Recovered {
        /// Its corners: two or three.
        corners: &'a [u32],
        /// The points, for the corners.
        points: &'a [[f64; 3]],
    },
    /// A Steiner point was put in.
    SteinerPlaced {
        /// Its vertex.
        vertex: u32,
        /// Where it is.
        point: [f64; 3],
        /// What for.
        cause: Cause,
    },
    /// A Steiner point was taken out.
    SteinerRemoved {
        /// Its vertex.
        vertex: u32,
        /// Where it was.
        point: [f64; 3],
    },
    /// Inside and outside were told apart.
    Classified {
        /// The tetrahedra that are inside.
        inside: &'a [[u32; 4]],
        /// How many are outside.
        outside: usize,
        /// The points, for the vertices.
        points: &'a [[f64; 3]],
    },
    /// All was done.
    Finished {
        /// The result.
        result: &'a super::Tetrahedra,
    },
}

probe::variants!(TetrahedraEvent<'_>: Inserted, Triangulated, Exchanged, Recovered, SteinerPlaced,
    SteinerRemoved, Classified, Finished);
