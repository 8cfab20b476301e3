//! Running an experiment, and the folder that it leaves.
//!
//! | file | what |
//! |---|---|
//! | `experiment`, `place` | from a config to a place with a start |
//! | `drive`, `timed` | one robot's run to its end, and what it cost |
//! | `watch` | who looks on: a recording, or nobody |
//! | `report`, `steps`, `provenance` | the files of a run |
//! | `folder` | how they get their names |

mod drive;
mod experiment;
mod folder;
mod place;
mod provenance;
mod report;
mod steps;
mod timed;
mod watch;

pub use drive::{MapRun, drive};
pub use experiment::Experiment;
pub use folder::{FolderError, RunFolder, names};
pub use place::{Place, build_place};
pub use provenance::{GIT_HASH, Input, Provenance, VERSION};
pub use report::{MapMetrics, MapTiming, MetricsReport, TimingReport, quantile, to_file, to_json};
pub use steps::{StepRow, StepsError, to_parquet};
pub use watch::{StepSeen, Watch};
