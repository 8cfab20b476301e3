//! A person's questions: why is this frontier left, and who removed that one.

use geometry::planar::{Interval, StarPolygon};
use posegraph::{Scope, ScopeScratch};
use probe::{EdgeId, VertexId};

use super::{Cause, RelativeMap};
use crate::volume::FrontierEdge;

/// Why a part of a frontier is still open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WhyLeft {
    /// No volume within twice the scope covers it: nobody has seen what lies behind.
    Unseen,
    /// A volume would cover it, but is too far away along the graph to be trusted.
    OutOfScope {
        /// That volume.
        by: VertexId,
        /// How far it is along the graph, metres.
        distance_m: f64,
        /// The radius of the scope, metres.
        radius_m: f64,
    },
    /// It hangs together over less than the named length and does not count.
    Sliver {
        /// Length of what hangs together, metres.
        chain_m: f64,
        /// The length from which on frontier counts, metres.
        least_m: f64,
    },
}

/// What became of a part of a frontier edge.
#[derive(Clone, Debug, PartialEq)]
pub enum Fate {
    /// It is open.
    Left(WhyLeft),
    /// It is closed.
    Gone {
        /// Why.
        cause: Cause,
        /// Which volume closed it.
        by: VertexId,
        /// When: the count of scans taken then.
        step: u32,
        /// The measured edges between the two volumes along which they were placed.
        path: Vec<EdgeId>,
    },
}

/// A part of a frontier edge and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontierPiece {
    /// The edge, in the frame of its volume.
    pub edge: FrontierEdge,
    /// The part.
    pub span: Interval,
    /// What became of it.
    pub fate: Fate,
}

impl RelativeMap {
    /// Tells of every part of the frontier of a volume whether it is left and why, or who removed
    /// it; the parts of an edge come in order and add up to the edge.
    ///
    /// Cost: one scope of twice the radius; meant for people, not for the loop.
    pub fn explain(&self, vertex: VertexId) -> Vec<FrontierPiece> {
        let Some(state) = self.volume(vertex) else { return Vec::new() };
        let mut scope = Scope::default();
        let radius_m = self.params.consolidation_radius_m;
        ScopeScratch::default().place(&self.full, vertex, 2.0 * radius_m, &mut scope);
        let mut pieces = Vec::new();
        for (i, (edge, ledger)) in state.volume.frontier.iter().zip(&state.ledgers).enumerate() {
            let mut of_edge: Vec<FrontierPiece> = ledger
                .closed()
                .iter()
                .map(|closed| FrontierPiece {
                    edge: *edge,
                    span: closed.span,
                    fate: Fate::Gone {
                        cause: closed.reason.cause,
                        by: closed.reason.by,
                        step: closed.reason.step,
                        path: self.book.edges(closed.reason.path).to_vec(),
                    },
                })
                .collect();
            for span in ledger.open() {
                let least_m = self.params.sliver_m;
                let chain = state
                    .chains
                    .iter()
                    .find(|chain| chain.parts.iter().any(|p| p.edge == i && p.span == span));
                let why = match chain {
                    Some(chain) if chain.counts => self.who_would(&scope, edge, &span),
                    _ => {
                        let chain_m = chain.map_or(0.0, |chain| chain.length_m);
                        WhyLeft::Sliver { chain_m, least_m }
                    }
                };
                of_edge.push(FrontierPiece { edge: *edge, span, fate: Fate::Left(why) });
            }
            of_edge.sort_by(|a, b| a.span.from.total_cmp(&b.span.from));
            pieces.extend(of_edge);
        }
        pieces
    }

    fn who_would(&self, scope: &Scope, edge: &FrontierEdge, span: &Interval) -> WhyLeft {
        let middle = edge.at(span.middle());
        let radius_m = self.params.consolidation_radius_m;
        for row in scope.placed().iter().filter(|row| row.distance_m > radius_m) {
            let Some(other) = self.volume(row.vertex) else { continue };
            let inner: &StarPolygon = &other.volume.inner;
            if inner.contains(&row.root_from_vertex.inverse_transform(&middle)) {
                return WhyLeft::OutOfScope {
                    by: row.vertex,
                    distance_m: row.distance_m,
                    radius_m,
                };
            }
        }
        WhyLeft::Unseen
    }
}
