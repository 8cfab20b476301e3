//! What a sweep consists of.

use sha2::{Digest as _, Sha256};

use crate::run::{GIT_HASH, VERSION};
use crate::table::Row;

/// A sweep before it starts: every job, and what it depends on.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The name of the sweep.
    pub(crate) name: String,
    /// A hash of everything that the results follow from: config, files, program.
    pub(crate) identity: String,
    /// Every job, in the order of the rows.
    pub(crate) jobs: Vec<Job>,
}

/// One piece of work that is done whole or not at all.
#[derive(Clone, Debug)]
pub(crate) struct Job {
    /// Its number in the plan of the whole sweep; stable, and not always its place in the list.
    pub(crate) number: usize,
    /// What tells it from the others: the first columns of its rows.
    pub(crate) labels: Row,
}

/// What came of a job: rows of each table, without the labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Outcome {
    /// Rows of `results.parquet`: the same for the same job.
    pub(crate) results: Vec<Row>,
    /// Rows of `timing.parquet`: what depends on the clock and on memory.
    pub(crate) timing: Vec<Row>,
    /// Rows of `curves.parquet`: how it went; the same for the same job.
    pub(crate) curves: Vec<Row>,
}

/// Every n-th job, so that n machines share a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    /// Which of them, from 1.
    pub(crate) index: usize,
    /// How many there are.
    pub(crate) count: usize,
}

impl Shard {
    /// Whether a job belongs to this shard.
    pub(crate) fn has(&self, job: &Job) -> bool {
        job.number % self.count == self.index - 1
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            Some((index.trim().parse().ok()?, count.trim().parse().ok()?))
        });
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("expected i/n with 1 <= i <= n, as in 2/8".to_owned()),
        }
    }
}

impl Plan {
    /// A hash of the parts that the results follow from, and of the program.
    pub(crate) fn identity(parts: &[&str]) -> String {
        let mut hash = Sha256::new();
        for part in [VERSION, GIT_HASH].iter().chain(parts) {
            hash.update((part.len() as u64).to_le_bytes());
            hash.update(part.as_bytes());
        }
        hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_jobs() {
        let shards: Vec<Shard> =
            ["1/3", "2/3", " 3 / 3"].iter().map(|text| text.parse().expect("a shard")).collect();
        for number in 0..10 {
            let job = Job { number, labels: Row::new() };
            assert_eq!(shards.iter().filter(|shard| shard.has(&job)).count(), 1, "{number}");
        }
        for text in ["0/3", "4/3", "3", "a/b", "1/0", ""] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn parts_do_not_run_into_each_other() {
        assert_ne!(Plan::identity(&["ab", "c"]), Plan::identity(&["a", "bc"]));
    }
}
