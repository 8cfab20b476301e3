//! Which colour means what; the text page lists the same.

use maps2d::relative::Cause;

use crate::columns::{Rgba, rgb, rgba};

pub(crate) const BACKGROUND: Rgba = rgb(250, 250, 247);

pub(crate) const TRUE_WALL: Rgba = rgb(70, 74, 82);
pub(crate) const TRUE_PATH: Rgba = rgb(125, 160, 220);
pub(crate) const TRUE_VIEW: Rgba = rgb(150, 40, 160);
pub(crate) const ROBOT: Rgba = rgb(20, 60, 210);

/// Of space, before a dark background.
pub(crate) const SURFACE: Rgba = rgb(170, 175, 185);
pub(crate) const TRUE_SURFACE: Rgba = rgb(120, 126, 140);
pub(crate) const TRUE_SEEN: Rgba = rgb(90, 220, 110);
pub(crate) const TRUE_UNSEEN: Rgba = rgb(110, 110, 150);

pub(crate) const OBSTACLE: Rgba = rgb(110, 10, 20);
pub(crate) const FRONTIER: Rgba = rgb(255, 120, 0);
pub(crate) const IGNORED: Rgba = rgb(240, 200, 110);
pub(crate) const FREE: Rgba = rgb(140, 205, 140);
pub(crate) const WALL_CLOSED: Rgba = rgb(165, 165, 170);
pub(crate) const UNREACHABLE: Rgba = rgb(190, 110, 200);

pub(crate) const SCOPE: Rgba = rgb(175, 175, 235);
pub(crate) const ODOMETRY: Rgba = rgb(60, 110, 180);
pub(crate) const PLACE: Rgba = rgb(220, 30, 120);
pub(crate) const WITHDRAWN: Rgba = rgb(0, 0, 0);

/// The pose graph before and after a correction.
pub(crate) const BEFORE: Rgba = rgb(225, 180, 150);
pub(crate) const CORRECTED: Rgba = rgb(20, 130, 110);

pub(crate) const GOAL: Rgba = rgb(220, 20, 40);
pub(crate) const ROUTE: Rgba = rgb(230, 60, 60);
pub(crate) const BEST: Rgba = rgb(20, 140, 60);
pub(crate) const WORST: Rgba = rgb(235, 190, 60);
pub(crate) const REFUSED: Rgba = rgb(150, 150, 150);
pub(crate) const GIVEN_UP: Rgba = rgb(120, 60, 160);

/// Where the beliefs of several maps first part.
pub(crate) const QUARREL: Rgba = rgb(0, 0, 0);

pub(crate) const HIT: Rgba = rgb(200, 20, 40);
pub(crate) const MISS: Rgba = rgb(120, 170, 220);
pub(crate) const NOTHING_CLOSED: Rgba = rgb(170, 170, 170);
pub(crate) const REOPENED: Rgba = rgb(255, 0, 200);

/// Classes of cells: true coverage.
pub(crate) const CELL_UNSEEN: u8 = 1;
pub(crate) const CELL_SEEN: u8 = 2;
pub(crate) const CELL_NEW: u8 = 3;
/// Classes of cells: the belief of a grid.
pub(crate) const CELL_FREE: u8 = 4;
pub(crate) const CELL_OCCUPIED: u8 = 5;
pub(crate) const CELL_CHANGED: u8 = 6;

/// Every class of cells with its name and colour; 0 is drawn as nothing.
pub(crate) const CELL_CLASSES: [(u8, &str, Rgba); 7] = [
    (0, "unknown", rgba(0, 0, 0, 0)),
    (CELL_UNSEEN, "reachable, not seen yet", rgb(222, 222, 226)),
    (CELL_SEEN, "really seen", rgb(196, 232, 196)),
    (CELL_NEW, "first seen at this step", rgb(130, 215, 140)),
    (CELL_FREE, "believed free", rgb(226, 238, 250)),
    (CELL_OCCUPIED, "believed occupied", rgb(110, 10, 20)),
    (CELL_CHANGED, "changed at this step", rgb(150, 195, 240)),
];

/// Colours of the maps in the plots, in their order.
pub(crate) const MAPS: [Rgba; 6] = [
    rgb(230, 110, 0),
    rgb(40, 110, 200),
    rgb(40, 150, 70),
    rgb(160, 60, 170),
    rgb(120, 120, 120),
    rgb(200, 30, 60),
];

/// The colour of what was closed for a cause.
pub(crate) fn of_cause(cause: Cause) -> Rgba {
    match cause {
        Cause::Inside => FREE,
        Cause::Wall => WALL_CLOSED,
        Cause::Unreachable => UNREACHABLE,
    }
}

/// From the best to the worst, by a share in 0..=1.
pub(crate) fn ramp(share: f64) -> Rgba {
    let mix =
        |a: u8, b: u8| (f64::from(a) + share.clamp(0.0, 1.0) * (f64::from(b) - f64::from(a))) as u8;
    let (a, b) = (BEST.to_be_bytes(), WORST.to_be_bytes());
    rgb(mix(a[0], b[0]), mix(a[1], b[1]), mix(a[2], b[2]))
}
