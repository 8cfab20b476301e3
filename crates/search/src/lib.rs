#![doc = include_str!("../README.md")]

mod astar;
mod breadth;
mod depth;
mod dijkstra;
mod error;
mod graph;
mod scratch;
mod tree;

pub use astar::{
    AstarEvent, Route, astar, astar_nearest, astar_nearest_with, astar_where, astar_where_with,
    astar_with,
};
pub use breadth::{BreadthEvent, breadth_first, breadth_first_with};
pub use depth::{DepthEvent, DepthFirst, depth_first, depth_first_with};
pub use dijkstra::{
    DijkstraEvent, Nearest, dijkstra, dijkstra_nearest, dijkstra_nearest_with, dijkstra_with,
    dijkstra_within, dijkstra_within_with,
};
pub use error::SearchError;
pub use graph::Graph;
pub use scratch::Scratch;
pub use tree::{Back, Settled, Tree};
