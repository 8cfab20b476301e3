//! Running a robot that flies: the twin in space of [`run`](crate::run), with the same folder of results.
//!
//! | file | what |
//! |---|---|
//! | `experiment`, `place` | from a config to a place of space with a start |
//! | `maps`, `stages`, `timed`, `drive` | the maps of one robot, what they cost, and its run to its end |
//! | `rider`, `accuracy` | what comes of one map: rows, sums, free space against the truth |
//! | `watch`, `fan`, `record` | who looks on: a recording, or nobody |
//! | `session` | all robots of an experiment |
//! | `report`, `steps` | the files of a run |

mod accuracy;
mod drive;
mod experiment;
mod fan;
mod maps;
mod place;
mod record;
mod report;
mod rider;
mod session;
mod stages;
mod steps;
mod timed;
mod watch;

pub use drive::{FlightRun, fly};
pub use experiment::FlightExperiment;
pub use place::{FlightPlace, build_flight_place};
pub(crate) use record::create_recording;
pub use record::start_flight_recording;
pub use report::{FlightMetrics, FlightTiming};
pub use session::{FlightOutcome, flight_files, run_flight};
pub use stages::StageTiming;
pub use steps::{FlightRow, flight_parquet};
pub use watch::{FlightSeen, FlightWatch};
