#![doc = include_str!("../README.md")]

pub mod map_yaml;
pub mod mesh;
pub mod moving_ai;
pub mod pgm;
pub mod ply;
pub mod png;
pub mod pose_graph;
pub mod tum;

mod error;
mod gray;
mod lexer;
mod lines;
mod sniff;

pub use error::{FormatError, MAX_CELLS, Position};
pub use gray::GrayImage;
pub use lines::text;
pub use sniff::{Kind, sniff};
