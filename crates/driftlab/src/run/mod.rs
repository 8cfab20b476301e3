//! Running an experiment, and the folder that it leaves.

mod folder;
mod place;
mod provenance;
mod report;
mod steps;

pub use folder::{FolderError, RunFolder, names};
pub use place::{Place, build_place};
pub use provenance::{GIT_HASH, Input, Provenance, VERSION};
pub use report::{MapMetrics, MapTiming, MetricsReport, TimingReport, quantile, to_file, to_json};
pub use steps::{StepRow, StepsError, to_parquet};
