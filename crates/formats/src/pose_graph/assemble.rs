//! From the ids of a file to the dense indices of a graph.

use posegraph::FactorGraph;

use super::read::Collected;
use super::records::Record;
use super::report::{GraphFileReport, GraphWarning, Tally, WarningKind};

/// Finds the index of an id: by a table where the ids are dense, else by bisection.
struct Ids {
    sorted: Vec<u64>,
    first: u64,
    table: Vec<u32>,
}

impl Ids {
    /// All ids that occur, ascending and once each.
    fn new(occurring: impl Iterator<Item = u64> + Clone) -> Self {
        let (mut first, mut last, mut count) = (u64::MAX, 0, 0_u64);
        for id in occurring.clone() {
            first = first.min(id);
            last = last.max(id);
            count += 1;
        }
        let span = last.saturating_sub(first);
        if span >= count.saturating_mul(4) || span >= u64::from(u32::MAX) {
            let mut sorted: Vec<u64> = occurring.collect();
            sorted.sort_unstable();
            sorted.dedup();
            return Self { sorted, first: 0, table: Vec::new() };
        }
        const ABSENT: u32 = u32::MAX;
        let mut table = vec![ABSENT; span as usize + 1];
        for id in occurring {
            table[(id - first) as usize] = 0;
        }
        let mut sorted = Vec::with_capacity(table.len());
        for (id, index) in (first..=last).zip(&mut table) {
            if *index != ABSENT {
                *index = sorted.len() as u32;
                sorted.push(id);
            }
        }
        Self { sorted, first, table }
    }

    /// The index of an id that occurs.
    fn index(&self, id: u64) -> usize {
        if self.table.is_empty() {
            self.sorted.partition_point(|&other| other < id)
        } else {
            self.table[(id - self.first) as usize] as usize
        }
    }

    fn contains(&self, id: u64) -> bool {
        self.sorted.binary_search(&id).is_ok()
    }
}

/// Puts the graph together: ids ascending, factors in the order of the file.
pub(super) fn assemble<P: Record<D>, const D: usize>(
    collected: Collected<P, D>,
) -> (FactorGraph<P, D>, GraphFileReport) {
    let Collected { vertices, vertex_lines, ends, mut factors, edge_lines, fixed, mut report } =
        collected;
    let occurring = vertices.iter().map(|(id, _)| *id);
    let ids = Ids::new(occurring.chain(ends.iter().flat_map(|&(from, to)| [from, to])));

    let mut initial: Vec<Option<P>> = vec![None; ids.sorted.len()];
    let mut repeated = Tally::default();
    let (mut repeated_id, mut conflicting) = (0, false);
    for ((id, pose), &line) in vertices.iter().zip(&vertex_lines) {
        match &mut initial[ids.index(*id)] {
            Some(before) => {
                if repeated.add(line as usize) {
                    repeated_id = *id;
                }
                conflicting |= before != pose;
            }
            slot => *slot = Some(*pose),
        }
    }

    let mut missing = Tally::default();
    for ((factor, &(from, to)), &line) in factors.iter_mut().zip(&ends).zip(&edge_lines) {
        (factor.from, factor.to) = (ids.index(from), ids.index(to));
        if initial[factor.from].is_none() || initial[factor.to].is_none() {
            missing.add(line as usize);
        }
    }

    let mut strangers = Tally::default();
    let mut stranger = 0;
    let mut held = Vec::with_capacity(fixed.len());
    for (id, line) in fixed {
        if ids.contains(id) {
            held.push(ids.index(id));
        } else if strangers.add(line as usize) {
            stranger = id;
        }
    }
    held.sort_unstable();
    held.dedup();

    let graph = FactorGraph { ids: ids.sorted, initial, fixed: held, factors };
    if !vertices.is_empty() {
        let mut without = graph.ids.iter().zip(&graph.initial).filter(|(_, pose)| pose.is_none());
        let first_id = without.clone().next().map_or(0, |(id, _)| *id);
        let vertices = without.by_ref().count();
        report.warnings.extend(missing.warning(WarningKind::MissingVertex { first_id, vertices }));
    }
    let kind = WarningKind::RepeatedVertex { first_id: repeated_id, conflicting };
    report.warnings.extend(repeated.warning(kind));
    report.warnings.extend(strangers.warning(WarningKind::FixedStranger { first_id: stranger }));
    report.warnings.extend(repeated_edges(&graph, &edge_lines));
    (graph, report)
}

/// Edges that are equal in every number to an edge before them between the same vertices.
///
/// Among very many parallel edges only the nearest are compared, so that the cost stays linear.
fn repeated_edges<P: Record<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    lines: &[u32],
) -> Option<GraphWarning> {
    let factors = &graph.factors;
    let ends = |index: usize| (factors[index].from, factors[index].to);
    let mut order: Vec<(usize, usize, usize)> =
        (0..factors.len()).map(|index| (ends(index).0, ends(index).1, index)).collect();
    order.sort_unstable();
    const COMPARED: usize = 16;
    let (mut count, mut first) = (0, u32::MAX);
    for group in order.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|group| group.len() > 1) {
        for (at, &(_, _, index)) in group.iter().enumerate() {
            let before = &group[at.saturating_sub(COMPARED)..at];
            if before.iter().any(|&(_, _, before)| factors[before] == factors[index]) {
                count += 1;
                first = first.min(lines[index]);
            }
        }
    }
    let (kind, first_line) = (WarningKind::RepeatedEdge, first as usize);
    (count > 0).then_some(GraphWarning { kind, count, first_line })
}
