#![doc = include_str!("../README.md")]

pub mod command;
pub mod config;
pub mod export;
mod files;
pub mod flight;
pub mod logs;
pub mod replay;
mod report;
pub mod run;
mod stopwatch;
pub mod sweep;
mod table;

pub use report::ReportError;
pub use table::TableError;
