//! The listener: takes the events of one map's robot and keeps rows until they are sent.

mod belief;
mod consolidation;
mod correction;
mod explore;
mod graph;
mod grid;
mod happened;
mod places;
mod planner;
mod polygons;
mod quarrel;
mod sensing;
mod steps;
mod truth;

pub use quarrel::Quarrel;
pub use steps::{Recorder, StepEnd};

use geometry::Point2;
use pose::Se2;

use crate::columns::Lines;
use crate::palette;

/// A robot as a chevron with its tip ahead; 0.7 m long.
pub(crate) fn draw_robot(lines: &mut Lines, frame_from_body: &Se2) {
    let outline = [(-0.3, 0.3), (0.4, 0.0), (-0.3, -0.3)];
    let outline = outline.map(|(x, y)| frame_from_body.transform(&Point2::new(x, y)));
    lines.strip(outline, palette::ROBOT);
}
