//! The largest clique of a graph.
//!
//! 1. A greedy clique is the first bound: from vertices in order of degree, each time the candidate
//!    with most neighbours among the candidates.
//! 2. Branch and bound: candidates are coloured greedily; a clique takes at most one of each colour,
//!    so that a branch with too few colours is cut (Tomita and Seki 2003).
//! 3. After [`BRANCHES`] branches the largest clique so far is returned, without proof.

/// Branches that are looked at before the search gives up.
const BRANCHES: usize = 2_000;

/// Vertices that the greedy search starts from.
const STARTS: usize = 20;

/// Which vertices are joined, as rows of bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Adjacency {
    count: usize,
    words: usize,
    bits: Vec<u64>,
}

impl Adjacency {
    pub fn new(count: usize) -> Self {
        let words = count.div_ceil(64);
        Self { count, words, bits: vec![0; count * words] }
    }

    pub fn join(&mut self, a: usize, b: usize) {
        self.bits[a * self.words + b / 64] |= 1 << (b % 64);
        self.bits[b * self.words + a / 64] |= 1 << (a % 64);
    }

    fn row(&self, vertex: usize) -> &[u64] {
        &self.bits[vertex * self.words..(vertex + 1) * self.words]
    }

    fn shared(&self, vertex: usize, with: &[u64]) -> usize {
        self.row(vertex).iter().zip(with).map(|(a, b)| (a & b).count_ones() as usize).sum()
    }
}

/// A clique, ascending, and whether it was proven to be the largest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Clique {
    pub vertices: Vec<usize>,
    pub proven: bool,
}

/// The largest clique, or a large one where the search has to end early.
pub(super) fn largest_clique(graph: &Adjacency) -> Clique {
    let mut order: Vec<usize> = (0..graph.count).collect();
    let all: Vec<u64> = (0..graph.words)
        .map(|word| (0..64).filter(|bit| word * 64 + bit < graph.count).map(|bit| 1 << bit).sum())
        .collect();
    order.sort_by_key(|&vertex| std::cmp::Reverse(graph.shared(vertex, &all)));
    let mut best = Vec::new();
    for &first in order.iter().take(STARTS) {
        let found = greedy(graph, first);
        if found.len() > best.len() {
            best = found;
        }
    }
    let mut search = Search { graph, best, own: Vec::new(), left: BRANCHES };
    let proven = search.expand(all);
    search.best.sort_unstable();
    Clique { vertices: search.best, proven }
}

fn members(set: &[u64]) -> impl Iterator<Item = usize> {
    set.iter().enumerate().flat_map(|(word, &bits)| {
        (0..64).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| word * 64 + bit)
    })
}

fn greedy(graph: &Adjacency, first: usize) -> Vec<usize> {
    let mut own = vec![first];
    let mut candidates = graph.row(first).to_vec();
    // Neighbours among the candidates, counted once: what falls away hardly changes the order.
    let mut order: Vec<(usize, usize)> =
        members(&candidates).map(|vertex| (graph.shared(vertex, &candidates), vertex)).collect();
    order.sort_by_key(|&(shared, vertex)| (std::cmp::Reverse(shared), vertex));
    for (_, vertex) in order {
        if candidates[vertex / 64] >> (vertex % 64) & 1 == 1 {
            own.push(vertex);
            for (word, row) in candidates.iter_mut().zip(graph.row(vertex)) {
                *word &= row;
            }
        }
    }
    own
}

struct Search<'a> {
    graph: &'a Adjacency,
    best: Vec<usize>,
    own: Vec<usize>,
    left: usize,
}

impl Search<'_> {
    /// Looks for cliques that continue the current one; false where it had to give up.
    fn expand(&mut self, mut candidates: Vec<u64>) -> bool {
        if self.left == 0 {
            return false;
        }
        self.left -= 1;
        let coloured = self.colour(&candidates);
        for &(colour, vertex) in coloured.iter().rev() {
            if self.own.len() + colour <= self.best.len() {
                return true;
            }
            self.own.push(vertex);
            let next: Vec<u64> =
                candidates.iter().zip(self.graph.row(vertex)).map(|(a, b)| a & b).collect();
            if next.iter().all(|&word| word == 0) {
                if self.own.len() > self.best.len() {
                    self.best.clone_from(&self.own);
                }
            } else if !self.expand(next) {
                self.own.pop();
                return false;
            }
            self.own.pop();
            candidates[vertex / 64] &= !(1 << (vertex % 64));
        }
        true
    }

    /// Candidates by colour, from 1, no two of one colour joined.
    fn colour(&self, candidates: &[u64]) -> Vec<(usize, usize)> {
        let mut rest = candidates.to_vec();
        let mut coloured = Vec::new();
        let mut colour = 0;
        while rest.iter().any(|&word| word != 0) {
            colour += 1;
            let mut class = rest.clone();
            loop {
                let first = members(&class).next();
                let Some(vertex) = first else { break };
                rest[vertex / 64] &= !(1 << (vertex % 64));
                class[vertex / 64] &= !(1 << (vertex % 64));
                for (word, row) in class.iter_mut().zip(self.graph.row(vertex)) {
                    *word &= !row;
                }
                coloured.push((colour, vertex));
            }
        }
        coloured
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{RngCore, SeedableRng};

    /// By trying all sets.
    fn exhaustive(joined: &[Vec<bool>]) -> usize {
        let count = joined.len();
        let is_clique = |set: u32| {
            let inside: Vec<usize> = (0..count).filter(|k| set >> k & 1 == 1).collect();
            inside.iter().all(|&a| inside.iter().all(|&b| a == b || joined[a][b]))
        };
        (0u32..1 << count)
            .filter(|&set| is_clique(set))
            .map(|set| set.count_ones() as usize)
            .max()
            .unwrap_or(0)
    }

    #[test]
    fn the_clique_is_as_large_as_any() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for count in 1..13 {
            for share in [20, 50, 90] {
                let mut graph = Adjacency::new(count);
                let mut joined = vec![vec![false; count]; count];
                let pairs = (0..count).flat_map(|a| (0..a).map(move |b| (a, b)));
                for (a, b) in pairs.filter(|_| random.next_u64() % 100 < share) {
                    graph.join(a, b);
                    (joined[a][b], joined[b][a]) = (true, true);
                }
                let found = largest_clique(&graph);
                assert!(found.proven);
                assert_eq!(found.vertices.len(), exhaustive(&joined));
                for &a in &found.vertices {
                    assert!(found.vertices.iter().all(|&b| a == b || joined[a][b]));
                }
            }
        }
    }

    #[test]
    fn a_planted_clique_is_found_among_many() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut graph = Adjacency::new(400);
        for a in 0..400 {
            for b in 0..a {
                let planted = a % 4 == 0 && b % 4 == 0;
                if planted || random.next_u64() % 100 < 10 {
                    graph.join(a, b);
                }
            }
        }
        let expected: Vec<usize> = (0..400).step_by(4).collect();
        assert_eq!(largest_clique(&graph).vertices, expected);
        assert_eq!(largest_clique(&Adjacency::new(0)).vertices, Vec::<usize>::new());
    }
}
