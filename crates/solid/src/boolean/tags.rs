//! Step 1: numbers for faces, and back.

use crate::{Label, Origin, Polyhedron};

/// What is known of each face of a result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Provenance {
    /// Its label: coplanar neighbours of one label are merged, which leaves fewer faces.
    #[default]
    Labels,
    /// Its label, and the origin of the operand's face that it is part of.
    Origins,
}

/// What each number stands for.
#[derive(Clone, Debug)]
pub(super) struct Tags {
    provenance: Provenance,
    known: Vec<(Label, Origin)>,
    /// Operands taken so far.
    operands: u32,
}

impl Tags {
    pub(super) fn new(provenance: Provenance) -> Self {
        Self { provenance, known: Vec::new(), operands: 0 }
    }

    /// Numbers for the faces of an operand. An operand without origins is the view of its number.
    pub(super) fn of(&mut self, mesh: &Polyhedron) -> Vec<u32> {
        let view = self.operands;
        self.operands += 1;
        match self.provenance {
            Provenance::Labels => mesh.labels().iter().map(|label| label.code().into()).collect(),
            Provenance::Origins => {
                let first = self.known.len() as u32;
                let origin = |face: usize| match mesh.origins() {
                    Some(origins) => origins[face],
                    None => Origin { view, face: face as u32 },
                };
                let faces = mesh.labels().iter().enumerate();
                self.known.extend(faces.map(|(face, &label)| (label, origin(face))));
                (first..self.known.len() as u32).collect()
            }
        }
    }

    pub(super) fn label(&self, tag: u32) -> Label {
        match self.provenance {
            Provenance::Labels => {
                if tag == 0 {
                    Label::Obstacle
                } else {
                    Label::Frontier
                }
            }
            Provenance::Origins => self.known.get(tag as usize).map_or(Label::Obstacle, |k| k.0),
        }
    }

    pub(super) fn origin(&self, tag: u32) -> Option<Origin> {
        match self.provenance {
            Provenance::Labels => None,
            Provenance::Origins => self.known.get(tag as usize).map(|known| known.1),
        }
    }
}
