//! Frontier that hangs together: open parts of neighbouring edges, measured as one.

use geometry::Point2;
use geometry::planar::{EdgeLedger, Interval};

use super::Closing;
use crate::volume::LocalVolume;

/// One open part of one frontier edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPart {
    /// Index into [`LocalVolume::frontier`].
    pub edge: usize,
    /// The open part, as parameters along that edge.
    pub span: Interval,
    /// Its length, metres.
    pub length_m: f64,
}

/// Open parts that hang together along the boundary, in boundary order.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The parts.
    pub parts: Vec<ChainPart>,
    /// Their length together, metres.
    pub length_m: f64,
    /// Whether it counts as frontier: it is no sliver, or held with slivers of others.
    pub counts: bool,
}

impl Chain {
    fn new(part: ChainPart) -> Self {
        Self { length_m: part.length_m, parts: vec![part], counts: false }
    }

    /// Whether a point of a frontier edge, given by its parameter, is on the chain.
    pub(crate) fn holds(&self, edge: usize, at: f64) -> bool {
        let on = |part: &ChainPart| part.edge == edge && part.span.from <= at && at <= part.span.to;
        self.parts.iter().any(on)
    }

    /// The ends of its parts, in the frame of its volume, in boundary order.
    pub(crate) fn segments<'a>(
        &'a self,
        volume: &'a LocalVolume,
    ) -> impl Iterator<Item = (Point2, Point2)> + Clone + 'a {
        self.parts.iter().map(|part| {
            let edge = &volume.frontier[part.edge];
            (edge.at(part.span.from), edge.at(part.span.to))
        })
    }

    fn extend(&mut self, parts: Vec<ChainPart>) {
        self.length_m += parts.iter().map(|part| part.length_m).sum::<f64>();
        self.parts.extend(parts);
    }
}

/// The chains of a volume: slivers are judged by the length of what hangs together, not edge by
/// edge, because a long frontier may consist of many short edges.
pub(crate) fn chains(volume: &LocalVolume, ledgers: &[EdgeLedger<Closing>]) -> Vec<Chain> {
    let mut chains: Vec<Chain> = Vec::new();
    for (edge, ledger) in ledgers.iter().enumerate() {
        if ledger.is_closed() {
            continue;
        }
        let edge_m = volume.frontier[edge].length_m();
        for span in ledger.open() {
            let part = ChainPart { edge, span, length_m: span.share() * edge_m };
            match chains.last_mut() {
                Some(chain) if follows(volume, chain.parts.last(), &part) => {
                    chain.extend(vec![part]);
                }
                _ => chains.push(Chain::new(part)),
            }
        }
    }
    // The boundary is a circle: the last chain may run on into the first.
    if chains.len() > 1 {
        let first = chains[0].parts.first().copied();
        let last = chains.last().and_then(|chain| chain.parts.last()).copied();
        if let (Some(first), Some(_)) = (first, last)
            && follows(volume, last.as_ref(), &first)
        {
            let head = chains.remove(0);
            if let Some(tail) = chains.last_mut() {
                tail.extend(head.parts);
            }
        }
    }
    chains
}

fn follows(volume: &LocalVolume, before: Option<&ChainPart>, part: &ChainPart) -> bool {
    let Some(before) = before else { return false };
    let next = if before.edge + 1 == volume.frontier.len() { 0 } else { before.edge + 1 };
    next == part.edge
        && before.span.to >= 1.0
        && part.span.from <= 0.0
        && volume.continues(before.edge)
}
