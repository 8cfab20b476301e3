#![doc = include_str!("../README.md")]

mod cells;

pub use cells::CellMap;
