//! How a recording opens: its views, and what its text page says.

mod arrange;
mod depth;
mod flight;
mod graph;
mod parts;
mod plan;
mod replay;
mod solid;
mod text;
mod views;

pub(crate) use depth::{DEPTH_PLOTS, DepthLook, send_depth};
pub(crate) use flight::send_flight;
pub(crate) use graph::{GraphLook, send_graph};
pub(crate) use plan::send_plan;
pub(crate) use replay::send_replay;
pub(crate) use solid::send_solid;
pub(crate) use text::{about, result};
pub(crate) use views::send;
