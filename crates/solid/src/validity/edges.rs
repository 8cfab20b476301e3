//! Step 1: which faces pass which edge, and which way.

use super::Defect;
use crate::Polyhedron;

/// One passage of a face along an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Use {
    /// The ends of the edge, ascending.
    pub(super) edge: [u32; 2],
    pub(super) face: u32,
    /// Whether the face passes from the smaller end to the greater.
    pub(super) ascends: bool,
}

/// All passages in the order of their edges, and what they come to.
#[derive(Clone, Debug, Default)]
pub(super) struct Edges {
    pub(super) uses: Vec<Use>,
    pub(super) open: bool,
    pub(super) twisted: bool,
    pub(super) crowded: bool,
}

/// Runs of passages of the same edge.
pub(super) fn runs(uses: &[Use]) -> impl Iterator<Item = &[Use]> {
    uses.chunk_by(|a, b| a.edge == b.edge)
}

pub(super) fn check(mesh: &Polyhedron) -> (Edges, Vec<Defect>) {
    let mut uses: Vec<Use> = (mesh.faces().iter().enumerate())
        .flat_map(|(face, &[a, b, c])| {
            [(a, b), (b, c), (c, a)].map(|(from, to)| Use {
                edge: [from.min(to), from.max(to)],
                face: face as u32,
                ascends: from < to,
            })
        })
        .collect();
    uses.sort_unstable();
    let mut edges = Edges::default();
    let mut defects = Vec::new();
    for run in runs(&uses) {
        let ascending = run.iter().filter(|passage| passage.ascends).count();
        let vertices = run[0].edge;
        let faces = || run.iter().map(|passage| passage.face).collect();
        if run.len() % 2 == 1 {
            edges.open = true;
            defects.push(Defect::OpenEdge { vertices, faces: faces() });
        }
        // An open edge of one face is not twisted: it can be oriented.
        if run.len() > 1 && ascending.abs_diff(run.len() - ascending) > run.len() % 2 {
            edges.twisted = true;
            defects.push(Defect::TwistedEdge { vertices, faces: faces() });
        }
        if run.len() > 2 {
            edges.crowded = true;
            defects.push(Defect::CrowdedEdge { vertices, faces: faces() });
        }
    }
    edges.uses = uses;
    (edges, defects)
}
