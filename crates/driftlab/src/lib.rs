#![doc = include_str!("../README.md")]

pub mod command;
pub mod config;
mod files;
pub mod replay;
mod report;
pub mod run;
mod stopwatch;
pub mod sweep;
mod table;

pub use report::ReportError;
pub use table::TableError;
