#![doc = include_str!("../README.md")]

pub mod command;
pub mod config;
pub mod run;
pub mod sweep;
