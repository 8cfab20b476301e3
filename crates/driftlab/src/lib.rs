#![doc = include_str!("../README.md")]

pub mod command;
pub mod config;
mod files;
pub mod run;
pub mod sweep;
mod table;

pub use table::TableError;
