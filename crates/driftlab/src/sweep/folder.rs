//! The folder of a sweep: what is done in it, and the tables that are made from that.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::job::{Job, Outcome, Plan, Shard};
use super::journal::{Journal, JournalError};
use crate::files::replace_file;
use crate::table::{Row, Table, TableError};

/// Names of the files in a sweep's folder.
pub(crate) mod file_names {
    /// What was measured: one row per run and map.
    pub(crate) const RESULTS: &str = "results.parquet";
    /// What depends on the clock and on memory.
    pub(crate) const TIMING: &str = "timing.parquet";
    /// How each run went.
    pub(crate) const CURVES: &str = "curves.parquet";
    /// `results.parquet` as text.
    pub(crate) const RESULTS_CSV: &str = "results.csv";
    /// The resolved config.
    pub(crate) const CONFIG: &str = "sweep.toml";
    /// Version, commit, seeds, inputs.
    pub(crate) const PROVENANCE: &str = "provenance.toml";
    /// All that a sweep makes when it ends.
    pub(crate) const ALL: [&str; 6] = [RESULTS, TIMING, CURVES, RESULTS_CSV, CONFIG, PROVENANCE];
}

/// How the journals' names start and end.
const JOURNAL: (&str, &str) = ("journal", ".jsonl");

/// Why a sweep could not go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// Results without a journal: of another program, or of a sweep whose journal is gone.
    #[error(
        "{}: found results and no journal to go on from, expected neither; --force replaces them",
        path.display()
    )]
    Occupied {
        /// The results.
        path: PathBuf,
    },
    /// The folder cannot be made or written.
    #[error("{}: cannot be written ({reason}); expected a folder for the sweep", path.display())]
    Unwritable {
        /// The folder or file.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// A journal that cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// Two journals tell different results of one job.
    #[error("job {job}: found two different results, expected the same from every shard")]
    Contradiction {
        /// Its number.
        job: usize,
    },
    /// A table could not be made.
    #[error("{file}: {reason}")]
    Table {
        /// The file.
        file: &'static str,
        /// What is wrong.
        reason: TableError,
    },
}

/// The folder of a sweep.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
    journal: Journal,
    done: BTreeMap<usize, Outcome>,
}

impl Folder {
    /// Opens the folder for work, and tells from its journals what is done.
    ///
    /// With `force`, whatever a sweep left there goes first. Journals of other shards are read,
    /// not written.
    ///
    /// # Errors
    /// [`SweepError::Occupied`], a journal of another sweep, and what the system refuses.
    pub(crate) fn open(
        path: &Path,
        plan: &Plan,
        shard: Option<Shard>,
        force: bool,
    ) -> Result<Self, SweepError> {
        let refused = |reason| SweepError::Unwritable { path: path.to_owned(), reason };
        fs::create_dir_all(path).map_err(refused)?;
        if force {
            let files = file_names::ALL.iter().map(|name| path.join(name));
            for file in files.chain(journals(path).map_err(refused)?) {
                match fs::remove_file(&file) {
                    Err(reason) if reason.kind() != io::ErrorKind::NotFound => {
                        return Err(SweepError::Unwritable { path: file, reason });
                    }
                    _ => {}
                }
            }
        }
        let results = path.join(file_names::RESULTS);
        if results.exists() && journals(path).map_err(refused)?.is_empty() {
            return Err(SweepError::Occupied { path: results });
        }
        let own = path.join(journal_name(shard));
        let (journal, entries) = Journal::open(&own, plan)?;
        let mut folder = Self { path: path.to_owned(), journal, done: BTreeMap::new() };
        folder.take(entries)?;
        for other in journals(path).map_err(refused)?.into_iter().filter(|other| *other != own) {
            folder.take(Journal::read(&other, plan)?)?;
        }
        Ok(folder)
    }

    /// Writes down what the journals of another folder hold, too.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub(crate) fn merge(&mut self, other: &Path, plan: &Plan) -> Result<(), SweepError> {
        let refused = |reason| SweepError::Unwritable { path: other.to_owned(), reason };
        for journal in journals(other).map_err(refused)? {
            let entries = Journal::read(&journal, plan)?;
            for (job, outcome) in entries.iter().filter(|(job, _)| !self.done.contains_key(job)) {
                self.journal.append(*job, outcome)?;
            }
            self.take(entries)?;
        }
        Ok(())
    }

    fn take(&mut self, entries: Vec<(usize, Outcome)>) -> Result<(), SweepError> {
        for (job, outcome) in entries {
            match self.done.get(&job) {
                None => drop(self.done.insert(job, outcome)),
                // Times may differ; what was measured may not.
                Some(known)
                    if known.results == outcome.results && known.curves == outcome.curves => {}
                Some(_) => return Err(SweepError::Contradiction { job }),
            }
        }
        Ok(())
    }

    /// Whether a job is done.
    pub(crate) fn is_done(&self, job: &Job) -> bool {
        self.done.contains_key(&job.number)
    }

    /// What came of a job, if it is done.
    pub(crate) fn outcome(&self, job: &Job) -> Option<&Outcome> {
        self.done.get(&job.number)
    }

    /// Writes down that a job is done.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn add(&mut self, job: &Job, outcome: Outcome) -> Result<(), SweepError> {
        self.journal.append(job.number, &outcome)?;
        self.done.insert(job.number, outcome);
        Ok(())
    }

    /// The three tables of the jobs that are done, in the order of the plan.
    pub(crate) fn tables(&self, plan: &Plan) -> [(&'static str, Table); 3] {
        let table = |of: fn(&Outcome) -> &Vec<Row>| {
            let rows = plan.jobs.iter().filter_map(|job| Some((job, self.outcome(job)?)));
            Table::of(rows.flat_map(|(job, outcome)| {
                of(outcome).iter().map(|row| job.labels.iter().chain(row).cloned().collect())
            }))
        };
        [
            (file_names::RESULTS, table(|outcome| &outcome.results)),
            (file_names::TIMING, table(|outcome| &outcome.timing)),
            (file_names::CURVES, table(|outcome| &outcome.curves)),
        ]
    }

    /// Writes the tables; `csv` writes the results as text, too.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn write_tables(&self, plan: &Plan, csv: bool) -> Result<(), SweepError> {
        let [results, timing, curves] = self.tables(plan);
        if csv {
            self.write(file_names::RESULTS_CSV, results.1.to_csv().as_bytes())?;
        }
        // The results last, as the sign that all the others are there.
        for (file, table) in [timing, curves, results] {
            if table.rows.is_empty() && file == file_names::CURVES {
                continue;
            }
            let bytes = table.to_parquet().map_err(|reason| SweepError::Table { file, reason })?;
            self.write(file, &bytes)?;
        }
        Ok(())
    }

    /// Writes a file whole or not at all.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), SweepError> {
        let path = self.path.join(name);
        replace_file(&path, bytes).map_err(|reason| SweepError::Unwritable { path, reason })
    }
}

fn journal_name(shard: Option<Shard>) -> String {
    let (start, end) = JOURNAL;
    match shard {
        None => format!("{start}{end}"),
        Some(Shard { index, count }) => format!("{start}.{index}of{count}{end}"),
    }
}

/// The journals in a folder, by name.
fn journals(folder: &Path) -> Result<Vec<PathBuf>, io::Error> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(JOURNAL.0) && name.ends_with(JOURNAL.1) {
            all.push(entry.path());
        }
    }
    all.sort();
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Cell;

    fn plan() -> Plan {
        let job = |number: usize| Job {
            number,
            labels: vec![("seed".to_owned(), Cell::Count(number as u64))],
        };
        Plan { name: "a".into(), identity: "x".into(), jobs: [0, 1, 3].map(job).to_vec() }
    }

    fn outcome(number: usize) -> Outcome {
        let row = vec![("d_max_m".to_owned(), Cell::Number(number as f64 / 3.0))];
        Outcome { results: vec![row.clone(), row], ..Outcome::default() }
    }

    fn results(folder: &Path) -> Vec<u8> {
        fs::read(folder.join(file_names::RESULTS)).expect("results")
    }

    #[test]
    fn the_order_in_which_jobs_end_and_who_did_them_leaves_no_trace() {
        let root = tempfile::tempdir().expect("a folder");
        let plan = plan();
        let (one, two) = (root.path().join("one"), root.path().join("two"));
        let mut folder = Folder::open(&one, &plan, None, false).expect("a new folder");
        for job in &plan.jobs {
            folder.add(job, outcome(job.number)).expect("written");
        }
        folder.write_tables(&plan, true).expect("written");
        drop(folder);

        for index in [2, 1] {
            let shard = Shard { index, count: 2 };
            let mut folder = Folder::open(&two, &plan, Some(shard), false).expect("a shard");
            for job in plan.jobs.iter().rev().filter(|job| shard.has(job)) {
                assert!(!folder.is_done(job));
                folder.add(job, outcome(job.number)).expect("written");
            }
        }
        let merged = Folder::open(&two, &plan, None, false).expect("all shards");
        assert!(plan.jobs.iter().all(|job| merged.is_done(job)));
        merged.write_tables(&plan, false).expect("written");
        assert_eq!(results(&one), results(&two));
        let csv = fs::read_to_string(one.join(file_names::RESULTS_CSV)).expect("text");
        assert_eq!(csv.lines().count(), 7, "{csv}");
        assert!(csv.starts_with("seed,d_max_m\n0,0\n0,0\n1,0.33333"), "{csv}");
    }

    #[test]
    fn folders_are_merged_and_contradictions_told() {
        let root = tempfile::tempdir().expect("a folder");
        let plan = plan();
        let paths = ["one", "two", "all"].map(|name| root.path().join(name));
        for (path, jobs) in [(&paths[0], &plan.jobs[..2]), (&paths[1], &plan.jobs[1..])] {
            let mut folder = Folder::open(path, &plan, None, false).expect("a new folder");
            jobs.iter().for_each(|job| folder.add(job, outcome(job.number)).expect("written"));
        }
        let mut all = Folder::open(&paths[2], &plan, None, false).expect("a new folder");
        all.merge(&paths[0], &plan).expect("merged");
        all.merge(&paths[1], &plan).expect("merged");
        assert!(plan.jobs.iter().all(|job| all.is_done(job)));
        let mut liar = Folder::open(&paths[0], &plan, None, true).expect("anew");
        liar.add(&plan.jobs[2], outcome(1)).expect("written");
        let error = all.merge(&paths[0], &plan).expect_err("another result");
        assert!(matches!(error, SweepError::Contradiction { job: 3 }), "{error}");
    }

    #[test]
    fn results_of_others_are_not_touched_without_force() {
        let root = tempfile::tempdir().expect("a folder");
        fs::write(root.path().join(file_names::RESULTS), "mine").expect("a file");
        let error = Folder::open(root.path(), &plan(), None, false).expect_err("occupied");
        assert!(matches!(error, SweepError::Occupied { .. }), "{error}");
        assert!(Folder::open(root.path(), &plan(), None, true).is_ok());
        assert!(!root.path().join(file_names::RESULTS).exists());
    }
}
