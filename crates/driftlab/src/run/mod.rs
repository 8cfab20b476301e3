//! Running an experiment, and the folder that it leaves.
//!
//! | file | what |
//! |---|---|
//! | `experiment`, `place` | from a config to a place with a start |
//! | `drive`, `sides`, `at_work`, `timed` | one robot's run to its end, its maps, and what it cost |
//! | `disagree` | where several maps of one robot first disagree |
//! | `watch`, `fan`, `record`, `exporting` | who looks on: a recording, an export, or nobody |
//! | `session` | all robots of an experiment |
//! | `report`, `steps`, `provenance` | the files of a run |
//! | `folder` | how they get their names |

mod at_work;
mod disagree;
mod drive;
mod experiment;
mod exporting;
mod fan;
mod folder;
mod place;
mod provenance;
mod record;
mod report;
mod session;
mod sides;
mod steps;
mod timed;
mod watch;

pub use at_work::AtWork;
pub use disagree::Disagreement;
pub use drive::{MapRun, drive};
pub(crate) use drive::{ending_name, state_name};
pub use experiment::Experiment;
pub(crate) use experiment::robots_of;
pub use exporting::Exporting;
pub use fan::Fan;
pub(crate) use fan::of_the_map_at_work;
pub use folder::{FolderError, RunFolder, names};
pub(crate) use place::{JITTER_TRIES, jitter};
pub use place::{Place, build_place};
pub use provenance::{GIT_HASH, Input, Provenance, VERSION};
pub use record::start_recording;
pub(crate) use record::{every_of, level_of};
pub(crate) use report::as_object;
pub use report::{
    CorrectionTiming, MapMetrics, MapTiming, MapsMetrics, MapsTiming, MetricsReport, TimingReport,
    quantile, to_file, to_json,
};
pub use session::{Outcome, RunError, files, run_experiment};
pub(crate) use sides::{TruePoses, map_of};
pub use steps::{StepRow, to_parquet};
pub(crate) use timed::TimedProbe;
pub use watch::{StepSeen, Watch};
