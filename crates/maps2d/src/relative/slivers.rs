//! Slivers that are more than slivers together.
//!
//! Where several volumes look into an opening from nearly the same place, their frontiers there cross
//! each other at small angles, and each closes a part of the others'. What remains is the boundary of
//! their union, all open, but cut into slivers that belong to one volume each. Hence slivers are
//! judged together with the open parts that go on where they end, whoever they belong to: if none
//! of those counts, and all of them together reach as far as a sliver may be long, the longest is
//! held, and counts until it is closed.

use geometry::Point2;
use geometry::planar::segment_segment_distance;
use posegraph::{Placed, Scope};

use super::RelativeMap;
use super::retire::MOST_ASKED;
use crate::MapProbe;

/// Open parts of two volumes go on where the other ends if they come this near to each other, as a
/// share of the length of a sliver: placement moves them apart.
const JOIN_SHARE: f64 = 0.3;

/// Slivers together are more than slivers if they reach so many times as far as one may be long:
/// around clutter many small ones lie close to each other, and nothing is behind them.
const TOGETHER: f64 = 2.0;

/// An open part near a sliver.
struct Piece {
    row: usize,
    from: Point2,
    to: Point2,
    /// Length of its chain, metres.
    chain_m: f64,
    counts: bool,
}

impl RelativeMap {
    /// Looks at the slivers that are new, and holds what has to be.
    ///
    /// A sliver that is what is left of another is not looked at again, nor one that a volume was born
    /// with: it is met as a part of the cluster when a frontier beside it turns into slivers.
    ///
    /// Slivers of retired volumes are taken as they were when these were retired: more may be held
    /// than if nothing were ever retired, never less.
    ///
    /// Cost: a scope and the open parts around for each of them.
    pub(super) fn hold_slivers(&mut self, probe: &mut dyn MapProbe) {
        let mut slivers = std::mem::take(&mut self.work.slivers);
        slivers.sort_unstable_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        slivers.dedup();
        let mut scope = Scope::default();
        for &(vertex, edge, at) in &slivers {
            if scope.root() != Some(vertex) {
                let radius_m = self.params.consolidation_radius_m;
                self.scratch.place_nearest(&self.full, vertex, radius_m, MOST_ASKED, &mut scope);
            }
            self.hold_sliver(&scope, edge, at, probe);
        }
        // Holding one makes no new ones.
        slivers.clear();
        self.work.slivers = slivers;
    }

    /// Looks at the sliver on an edge of the root of a scope.
    fn hold_sliver(&mut self, scope: &Scope, edge: usize, at: f64, probe: &mut dyn MapProbe) {
        let sliver_m = self.params.sliver_m;
        let Some(state) = scope.root().and_then(|vertex| self.volume(vertex)) else { return };
        let found = state.chains.iter().find(|chain| !chain.counts && chain.holds(edge, at));
        let Some(sliver) = found else { return };
        let seeds: Vec<(Point2, Point2)> = sliver.segments(&state.volume).collect();
        let pieces = self.pieces_around(scope.placed(), &seeds);
        let cluster = joined(&pieces, &seeds, JOIN_SHARE * sliver_m);
        if cluster.iter().any(|piece| piece.counts)
            || extent_m(&cluster, &seeds) < TOGETHER * sliver_m
        {
            return;
        }
        let longest = cluster.iter().max_by(|a, b| {
            a.chain_m
                .total_cmp(&b.chain_m)
                .then(b.row.cmp(&a.row))
                .then(b.from.x.total_cmp(&a.from.x))
        });
        let Some(piece) = longest else { return };
        let row = scope.placed()[piece.row];
        let middle = row.root_from_vertex.inverse_transform(&middle(&piece.from, &piece.to));
        let Some(holder) = self.volumes[row.vertex].as_deref_mut() else { return };
        holder.held.push(middle);
        self.remeasure(row.vertex);
        self.restore_if_it_counts(row.vertex, probe);
    }

    /// The open parts of all volumes of a scope that come nearer to a sliver than slivers are long,
    /// in the frame of the root.
    fn pieces_around(&self, rows: &[Placed], seeds: &[(Point2, Point2)]) -> Vec<Piece> {
        let near_m = TOGETHER * self.params.sliver_m;
        let Some(centre) = seeds.first().map(|seed| seed.0) else { return Vec::new() };
        let reach_m = seeds.iter().map(|seed| (seed.1 - centre).norm()).fold(0.0, f64::max);
        let mut pieces = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            let Some(state) = self.volume(row.vertex).filter(|state| state.has_open()) else {
                continue;
            };
            let (disc, radius_m) = state.open_disc;
            let apart_m = (row.root_from_vertex.transform(&disc) - centre).norm();
            if apart_m > radius_m + reach_m + near_m {
                continue;
            }
            for chain in &state.chains {
                for (from, to) in chain.segments(&state.volume) {
                    let from = row.root_from_vertex.transform(&from);
                    let to = row.root_from_vertex.transform(&to);
                    let middle = middle(&from, &to);
                    let half_m = 0.5 * (to - from).norm();
                    if (middle - centre).norm() > half_m + reach_m + near_m {
                        continue;
                    }
                    let near = |seed: &(Point2, Point2)| {
                        segment_segment_distance(&from, &to, &seed.0, &seed.1) <= near_m
                    };
                    if seeds.iter().any(near) {
                        let (chain_m, counts) = (chain.length_m, chain.counts);
                        pieces.push(Piece { row: i, from, to, chain_m, counts });
                    }
                }
            }
        }
        pieces
    }
}

/// The pieces that hang together with the seeds, one joining the next.
fn joined<'a>(pieces: &'a [Piece], seeds: &[(Point2, Point2)], join_m: f64) -> Vec<&'a Piece> {
    let mut open: Vec<(Point2, Point2)> = seeds.to_vec();
    let mut left: Vec<&Piece> = pieces.iter().collect();
    let mut cluster = Vec::new();
    while let Some((a, b)) = open.pop() {
        left.retain(|piece| {
            let joins = segment_segment_distance(&piece.from, &piece.to, &a, &b) <= join_m;
            if joins {
                open.push((piece.from, piece.to));
                cluster.push(*piece);
            }
            !joins
        });
    }
    cluster
}

/// How far a cluster reaches: the diagonal of its bounds, metres.
fn extent_m(cluster: &[&Piece], seeds: &[(Point2, Point2)]) -> f64 {
    let ends = cluster
        .iter()
        .flat_map(|piece| [piece.from, piece.to])
        .chain(seeds.iter().flat_map(|seed| [seed.0, seed.1]));
    let empty = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
    let (low, high) = ends.fold(empty, |(low, high), end| (low.inf(&end), high.sup(&end)));
    (high - low).norm()
}

fn middle(from: &Point2, to: &Point2) -> Point2 {
    Point2::from((from.coords + to.coords) * 0.5)
}
