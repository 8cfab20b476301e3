//! The journal: one line for each finished job.
//!
//! The first line says which sweep it belongs to. A line is written by one call, so that a kill
//! leaves whole lines and at most one torn last one, which is dropped when the journal is opened
//! again.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use super::job::{Outcome, Plan};
use crate::run::{GIT_HASH, VERSION};
use crate::table::{Cell, Row};

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JournalError {
    /// The system refused.
    #[error("{}: {reason}", path.display())]
    Io {
        /// The journal.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// It was begun for another config, other files or by another program.
    #[error(
        "{}: found the journal of another sweep ({found}), expected this one ({expected}); \
         --force begins anew, --out chooses another folder", path.display()
    )]
    Other {
        /// The journal.
        path: PathBuf,
        /// Name, program and identity in it.
        found: String,
        /// The same of this sweep.
        expected: String,
    },
    /// A line that is not what was written.
    #[error("{}:{line}: found no finished job, expected one; --force begins anew", path.display())]
    Damaged {
        /// The journal.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
    },
    /// Another process writes it.
    #[error("{}: another sweep is at work in this folder", path.display())]
    Busy {
        /// The journal.
        path: PathBuf,
    },
}

fn io_at(path: &Path) -> impl Fn(io::Error) -> JournalError {
    let path = path.to_owned();
    move |reason| JournalError::Io { path: path.clone(), reason }
}

/// A job's number and what came of it.
pub(crate) type Entry = (usize, Outcome);

/// A journal that grows; nobody else writes it meanwhile.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Opens a journal, or begins one: drops a torn last line and tells what is done.
    ///
    /// # Errors
    /// [`JournalError::Other`] for another sweep's, [`JournalError::Busy`] where another process
    /// writes it.
    pub(crate) fn open(path: &Path, plan: &Plan) -> Result<(Self, Vec<Entry>), JournalError> {
        let options = OpenOptions::new().read(true).append(true).create(true).clone();
        let mut file = options.open(path).map_err(io_at(path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(JournalError::Busy { path: path.to_owned() });
            }
            Err(TryLockError::Error(reason)) => return Err(io_at(path)(reason)),
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(io_at(path))?;
        let (entries, whole) = entries(path, &bytes, plan)?;
        if whole < bytes.len() {
            file.set_len(whole as u64).map_err(io_at(path))?;
            file.seek(SeekFrom::End(0)).map_err(io_at(path))?;
        }
        let mut journal = Self { path: path.to_owned(), file };
        if whole == 0 {
            journal.line(&header(plan))?;
        }
        Ok((journal, entries))
    }

    /// What is done according to a journal that somebody else may be writing.
    ///
    /// # Errors
    /// As [`open`](Self::open), but never busy.
    pub(crate) fn read(path: &Path, plan: &Plan) -> Result<Vec<Entry>, JournalError> {
        let bytes = std::fs::read(path).map_err(io_at(path))?;
        Ok(entries(path, &bytes, plan)?.0)
    }

    /// Writes down that a job is done.
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn append(&mut self, job: usize, outcome: &Outcome) -> Result<(), JournalError> {
        self.line(&json!({
            "job": job,
            "results": outcome.results.iter().map(object).collect::<Vec<_>>(),
            "timing": outcome.timing.iter().map(object).collect::<Vec<_>>(),
            "curves": outcome.curves.iter().map(object).collect::<Vec<_>>(),
        }))
    }

    fn line(&mut self, value: &Value) -> Result<(), JournalError> {
        let line = format!("{value}\n");
        self.file.write_all(line.as_bytes()).map_err(io_at(&self.path))
    }
}

fn header(plan: &Plan) -> Value {
    json!({
        "sweep": plan.name,
        "version": VERSION,
        "git_hash": GIT_HASH,
        "identity": plan.identity,
    })
}

/// The jobs in the bytes of a journal, and how many bytes whole lines take.
fn entries(path: &Path, bytes: &[u8], plan: &Plan) -> Result<(Vec<Entry>, usize), JournalError> {
    let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
    let mut lines = bytes[..whole].split(|&byte| byte == b'\n').enumerate();
    let parse = |line: &[u8]| serde_json::from_slice::<Value>(line).ok();
    let mut entries = Vec::new();
    if whole > 0 {
        let expected = header(plan);
        let found = lines.next().and_then(|(_, line)| parse(line));
        if found.as_ref() != Some(&expected) {
            let found = found.as_ref().map_or_else(|| "no header".to_owned(), told);
            let expected = told(&expected);
            return Err(JournalError::Other { path: path.to_owned(), found, expected });
        }
    }
    for (at, line) in lines.filter(|(_, line)| !line.is_empty()) {
        let entry = parse(line).as_ref().and_then(entry);
        let damaged = || JournalError::Damaged { path: path.to_owned(), line: at + 1 };
        entries.push(entry.ok_or_else(damaged)?);
    }
    Ok((entries, whole))
}

/// A header in one phrase.
fn told(header: &Value) -> String {
    let word = |key: &str| header[key].as_str().unwrap_or("?").to_owned();
    let short = |text: String| text.chars().take(8).collect::<String>();
    let (hash, identity) = (short(word("git_hash")), short(word("identity")));
    format!("{}, driftlab {} {hash}, {identity}", word("sweep"), word("version"))
}

/// Each cell is written as text, so that numbers come back bit for bit.
fn object(row: &Row) -> Value {
    let cells = row.iter().map(|(name, cell)| (name.clone(), Value::String(cell.encode())));
    Value::Object(cells.collect::<Map<_, _>>())
}

fn entry(line: &Value) -> Option<Entry> {
    let rows = |key: &str| -> Option<Vec<Row>> { line[key].as_array()?.iter().map(row).collect() };
    let job = usize::try_from(line["job"].as_u64()?).ok()?;
    let outcome =
        Outcome { results: rows("results")?, timing: rows("timing")?, curves: rows("curves")? };
    Some((job, outcome))
}

fn row(value: &Value) -> Option<Row> {
    let cells = value.as_object()?.iter();
    cells.map(|(name, cell)| Some((name.clone(), Cell::decode(cell.as_str()?)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(identity: &str) -> Plan {
        Plan { name: "a".into(), identity: identity.into(), jobs: Vec::new() }
    }

    fn outcome(number: f64) -> Outcome {
        // Names out of the alphabet's order, which has to stay.
        let row = vec![("z".to_owned(), Cell::Number(number)), ("b".to_owned(), Cell::Count(7))];
        Outcome { results: vec![row.clone()], timing: vec![row.clone(), row], curves: vec![] }
    }

    #[test]
    fn what_was_written_is_read_and_a_torn_line_is_dropped_wherever_it_is_torn() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("journal.jsonl");
        let all = [(4, outcome(0.1 + 0.2)), (0, outcome(f64::INFINITY)), (2, outcome(-0.0))];
        let (mut journal, before) = Journal::open(&path, &plan("x")).expect("a new journal");
        assert!(before.is_empty());
        for (job, outcome) in &all {
            journal.append(*job, outcome).expect("written");
        }
        drop(journal);
        let whole = std::fs::read(&path).expect("a journal");
        let ends: Vec<usize> =
            (0..whole.len()).filter(|&at| whole[at] == b'\n').map(|at| at + 1).collect();
        for cut in 0..=whole.len() {
            std::fs::write(&path, &whole[..cut]).expect("torn");
            let lines = ends.iter().filter(|&&end| end <= cut).count();
            let (mut journal, found) = Journal::open(&path, &plan("x")).expect("resumed");
            assert_eq!(found, all[..lines.saturating_sub(1)], "cut at {cut}");
            for (job, outcome) in &all[found.len()..] {
                journal.append(*job, outcome).expect("written");
            }
            drop(journal);
            assert_eq!(std::fs::read(&path).expect("a journal"), whole, "cut at {cut}");
        }
    }

    #[test]
    fn another_sweep_and_damage_are_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("journal.jsonl");
        drop(Journal::open(&path, &plan("x")).expect("a new journal"));
        let error = Journal::open(&path, &plan("y")).expect_err("another's");
        assert!(matches!(error, JournalError::Other { .. }), "{error}");
        let error = Journal::read(&path, &plan("y")).expect_err("another's");
        assert!(error.to_string().contains("journal of another sweep (a, driftlab"), "{error}");
        let mut text = std::fs::read_to_string(&path).expect("a journal");
        text.push_str("{\"job\":1}\n");
        std::fs::write(&path, text).expect("damaged");
        let error = Journal::open(&path, &plan("x")).expect_err("damaged");
        assert!(error.to_string().contains("journal.jsonl:2: found no finished job"), "{error}");
    }

    #[test]
    fn one_at_a_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("journal.jsonl");
        let first = Journal::open(&path, &plan("x")).expect("a new journal");
        let error = Journal::open(&path, &plan("x")).expect_err("it is held");
        assert!(matches!(error, JournalError::Busy { .. }), "{error}");
        drop(first);
        assert!(Journal::open(&path, &plan("x")).is_ok());
    }
}
