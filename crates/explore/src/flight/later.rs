//! Frontier that nothing can be done about yet (step 3): it is put off.

use std::collections::BTreeMap;

use probe::VertexId;

/// Which vertices have frontier that was put off, in rounds.
///
/// Frontier that no place has in view now is often closed later, by looks from the other side of a wall; or
/// these lead to a place that has it in view. So it waits until nothing else is left, which begins a new
/// round. A round in which nobody looked at anything is followed by the last one: what is left then is given
/// up.
#[derive(Clone, Debug, Default)]
pub(super) struct Later {
    /// By vertex, the round in which it was put off last.
    rounds: BTreeMap<VertexId, u32>,
    round: u32,
    looks_before: u64,
    is_last: bool,
}

impl Later {
    /// Whether frontier of a vertex is to be dealt with in this round.
    pub(super) fn comes_now(&self, vertex: VertexId) -> bool {
        self.rounds.get(&vertex).is_none_or(|&round| round < self.round)
    }

    /// Whether frontier of a vertex was put off in an earlier round.
    pub(super) fn comes_again(&self, vertex: VertexId) -> bool {
        self.rounds.get(&vertex).is_some_and(|&round| round < self.round)
    }

    /// Puts frontier of a vertex off to the next round.
    pub(super) fn put_off(&mut self, vertex: VertexId) {
        self.rounds.insert(vertex, self.round);
    }

    /// Begins a new round after so many looks.
    pub(super) fn begin_round(&mut self, looks: u64) {
        self.is_last = looks == self.looks_before;
        self.looks_before = looks;
        self.round += 1;
    }

    /// The number of the round.
    pub(super) fn round(&self) -> u32 {
        self.round
    }

    /// Whether this is not the first round.
    pub(super) fn is_late(&self) -> bool {
        self.round > 0
    }

    /// Whether what is left is given up.
    pub(super) fn is_last(&self) -> bool {
        self.is_last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_off_comes_again_and_the_last_round_follows_an_idle_one() {
        let (a, b) = (VertexId(1), VertexId(2));
        let mut later = Later::default();
        assert!(later.comes_now(a) && !later.comes_again(a));
        later.put_off(a);
        assert!(!later.comes_now(a) && later.comes_now(b));
        later.begin_round(7);
        assert!(later.comes_again(a) && !later.comes_again(b) && !later.is_last());
        later.put_off(a);
        assert!(!later.comes_again(a));
        later.begin_round(9);
        assert!(later.comes_now(a) && !later.is_last());
        later.begin_round(9);
        assert!(later.is_last());
    }
}
