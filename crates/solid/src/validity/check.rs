//! The levels, and what breaks them.

use std::fmt;

use super::crossings::{Contact, Crossing, crossings_of, flat_faces};
use super::{edges, vertices};
use crate::Polyhedron;

/// The most crossings that [`check`] looks for: a mesh with more is beyond repair by hand.
const MOST_CROSSINGS: usize = 10_000;

/// One thing that is wrong with a mesh, and where.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Defect {
    /// An edge with an odd number of faces: there is a hole beside it.
    OpenEdge {
        /// The ends of the edge, ascending.
        vertices: [u32; 2],
        /// Its faces.
        faces: Vec<u32>,
    },
    /// An edge that its faces do not pass as often one way as the other.
    TwistedEdge {
        /// The ends of the edge, ascending.
        vertices: [u32; 2],
        /// Its faces.
        faces: Vec<u32>,
    },
    /// An edge with more than two faces.
    CrowdedEdge {
        /// The ends of the edge, ascending.
        vertices: [u32; 2],
        /// Its faces.
        faces: Vec<u32>,
    },
    /// A vertex round which the faces are not one fan.
    PinchedVertex {
        /// The vertex.
        vertex: u32,
        /// How many fans meet there.
        fans: usize,
    },
    /// A face whose corners lie exactly on one line.
    FlatFace {
        /// The face.
        face: u32,
    },
    /// Two faces that meet where they should not.
    Crossing(Crossing),
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let edge = |f: &mut fmt::Formatter<'_>, [a, b]: &[u32; 2], faces: &[u32], what: &str| {
            write!(f, "edge {a}-{b} {what}: face")?;
            if faces.len() != 1 {
                write!(f, "s")?;
            }
            for (i, face) in faces.iter().enumerate() {
                write!(f, "{} {face}", if i == 0 { "" } else { "," })?;
            }
            Ok(())
        };
        match self {
            Self::OpenEdge { vertices, faces } => edge(f, vertices, faces, "is open"),
            Self::TwistedEdge { vertices, faces } => {
                edge(f, vertices, faces, "has faces that are not oriented alike")
            }
            Self::CrowdedEdge { vertices, faces } => {
                edge(f, vertices, faces, "has more than two faces")
            }
            Self::PinchedVertex { vertex, fans } => {
                write!(f, "vertex {vertex} joins {fans} fans of faces")
            }
            Self::FlatFace { face } => write!(f, "face {face} is flat: its corners are collinear"),
            Self::Crossing(crossing) => write!(f, "{crossing}"),
        }
    }
}

/// What [`check`] found out about a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Validity {
    /// Every edge has an even number of faces.
    pub closed: bool,
    /// Every edge is passed as often one way as the other.
    pub oriented: bool,
    /// Every edge has two faces, and the faces round each vertex are one fan.
    pub manifold: bool,
    /// A face is flat, or two faces meet where they should not; false where only the topology was
    /// checked.
    pub self_intersecting: bool,
    /// What is wrong: edges, vertices, flat faces, crossings, each kind in ascending order. At most
    /// 10,000 crossings are listed.
    pub defects: Vec<Defect>,
}

impl Validity {
    /// Whether the mesh is closed, oriented, 2-manifold and not self-intersecting.
    pub fn is_valid(&self) -> bool {
        self.closed && self.oriented && self.manifold && !self.self_intersecting
    }

    /// The crossings among the defects.
    pub fn crossings(&self) -> impl Iterator<Item = &Crossing> {
        self.defects.iter().filter_map(|defect| match defect {
            Defect::Crossing(crossing) => Some(crossing),
            _ => None,
        })
    }
}

/// The first three levels of a mesh: closed, oriented, 2-manifold. O(n log n).
pub fn check_topology(mesh: &Polyhedron) -> Validity {
    let (edges, mut defects) = edges::check(mesh);
    let pinched = vertices::pinched(mesh, &edges.uses);
    let manifold = !edges.crowded && !edges.open && pinched.is_empty();
    defects.extend(pinched);
    Validity {
        closed: !edges.open,
        oriented: !edges.twisted,
        manifold,
        self_intersecting: false,
        defects,
    }
}

/// All levels of a mesh. O(n log n) where few boxes of faces touch; 50,000 faces take a fraction of
/// a second.
pub fn check(mesh: &Polyhedron) -> Validity {
    let mut validity = check_topology(mesh);
    let flat = flat_faces(mesh);
    let found = crossings_of(mesh, &flat, MOST_CROSSINGS);
    validity.self_intersecting = !flat.is_empty() || !found.is_empty();
    validity.defects.extend(flat.iter().map(|&face| Defect::FlatFace { face }));
    validity.defects.extend(found.into_iter().map(Defect::Crossing));
    validity
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.faces;
        let verb = match self.contact {
            Contact::Cross => "cross",
            Contact::Touch => "touch",
            Contact::Overlap => "overlap in one plane",
        };
        let [x, y, z] = [self.at.x, self.at.y, self.at.z].map(crate::error::shown);
        write!(f, "faces {a} and {b} {verb} near ({x}, {y}, {z})")
    }
}
