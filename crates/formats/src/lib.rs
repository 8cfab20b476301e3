#![doc = include_str!("../README.md")]

pub mod bag;
pub mod depth;
pub mod depth_file;
pub mod depth_folder;
pub mod gzip;
pub mod laser;
pub mod log;
pub mod map_yaml;
pub mod mcap;
pub mod mesh;
pub mod moving_ai;
pub mod pcd;
pub mod pgm;
pub mod ply;
pub mod ply_cloud;
pub mod png;
pub mod pose_graph;
pub mod tiff;
pub mod tum;

mod binary;
mod cloud;
mod error;
mod gray;
mod lexer;
mod lines;
mod lzf;
mod messages;
mod records;
mod sniff;

pub use cloud::Cloud;
pub use depth::DepthPixels;
pub use error::{FormatError, MAX_CELLS, Position};
pub use gray::GrayImage;
pub use lines::text;
pub use sniff::{Kind, sniff};
