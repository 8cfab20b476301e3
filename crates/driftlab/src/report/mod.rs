//! Tables and plots from the folders of sweeps and runs.
//!
//! | file | what |
//! |---|---|
//! | `study` | a folder, read back |
//! | `group` | runs that differ in nothing but their seed |
//! | `stats` | means, spreads, intervals |
//! | `published` | what the sources print, beside what we measured |
//! | `tables` | the tables |
//! | `curves`, `over_axes`, `chart` | the plots |
//! | `page` | Markdown, and one HTML page that holds everything |
//! | `sections` | what a report consists of |

mod chart;
mod curves;
mod group;
mod legend;
mod over_axes;
mod page;
mod published;
mod sections;
mod stats;
mod study;
mod tables;

pub use study::ReportError;

pub(crate) use group::{Group, groups};
pub(crate) use page::{Section, html, markdown};
pub(crate) use published::beside;
pub(crate) use sections::sections;
pub(crate) use stats::Share;
pub(crate) use study::Study;
pub(crate) use tables::{TextTable, results};

use crate::table::Row;

/// Values of axes as the title of a plot: those that differ within the study.
fn setting(study: &Study, axes: &Row) -> String {
    let varied = study.axes();
    let told = axes.iter().filter(|(axis, _)| varied.iter().any(|(known, _)| known == axis));
    let told: Vec<String> = told.map(|(axis, value)| format!("{axis} {}", value.shown())).collect();
    if told.is_empty() { study.name.clone() } else { told.join(", ") }
}

/// The same without the names of the axes.
fn short_setting(study: &Study, axes: &Row) -> String {
    let varied = study.axes();
    let told = axes.iter().filter(|(axis, _)| varied.iter().any(|(known, _)| known == axis));
    let told: Vec<String> = told.map(|(_, value)| value.shown()).collect();
    if told.is_empty() { study.name.clone() } else { told.join(", ") }
}
