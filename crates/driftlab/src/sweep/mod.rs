//! The same work over many inputs, in parallel, that can be killed and goes on where it was.
//!
//! A sweep is a list of jobs. Each finished job is one line of a journal in the folder of the
//! sweep; the tables are made from the journal alone, in the order of the jobs. However often a
//! sweep was killed, on how many threads and in how many shards it ran, the tables but for the
//! times are the same, byte for byte.
//!
//! | file | what |
//! |---|---|
//! | `job` | what a job is, and what came of it |
//! | `parallel` | jobs on all cores |
//! | `journal` | one line for each finished job; what a kill left of it |
//! | `folder` | the files of a sweep, resuming, shards, merging |
//! | `experiments` | one experiment over axes and seeds |
//! | `prepared` | one combination, of the plane or of space |
//! | `curve` | coverage over distance, in few points |
//! | `outliers`, `summary` | robust methods against wrong loop closures, and their table |

mod curve;
mod experiments;
mod folder;
mod job;
mod journal;
mod outliers;
mod parallel;
mod prepared;
mod summary;

pub use experiments::RunFailure;
pub use folder::SweepError;
pub use journal::JournalError;
pub use outliers::GraphFileError;

pub(crate) use experiments::Experiments;
pub(crate) use folder::{Folder, file_names};
pub(crate) use job::{Job, Outcome, Plan, Shard};
pub(crate) use outliers::Outliers;
pub(crate) use parallel::each;
pub(crate) use summary::markdown;
