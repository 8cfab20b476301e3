//! Corners of a local polygon and what they are (\[Zie18\] eq. 2.2).

use geometry::{Point2, Vector2};

use crate::volume::LocalVolume;

/// What has become of a frontier corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerState {
    /// Nobody looked beyond.
    Open,
    /// It lies inside a neighbour.
    Free,
    /// Nobody gets there.
    GivenUp,
}

/// A frontier corner, in the frame of its vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where it is.
    pub at: Point2,
    /// Unit vector into the unknown.
    pub normal: Vector2,
    /// Half of the frontier edges beside it, metres.
    pub length_m: f64,
    /// Whether it lies at the sensor: turning is enough to look behind it.
    pub spoke: bool,
    /// What has become of it.
    pub state: CornerState,
}

/// The frontier corners of a volume in boundary order, all open.
///
/// A corner where no ray hit is frontier; so is the middle of each edge at the sensor.
pub(super) fn corners_of(volume: &LocalVolume) -> Vec<Corner> {
    let is_hit = |point: &Point2| {
        volume.obstacles.iter().any(|wall| wall.from == *point || wall.to == *point)
            || volume.posts.contains(point)
    };
    let mut corners: Vec<Corner> = Vec::new();
    for edge in &volume.frontier {
        let along = edge.to - edge.from;
        let normal = Vector2::new(along.y, -along.x).try_normalize(0.0);
        let normal = normal.unwrap_or_else(Vector2::zeros);
        let half_m = 0.5 * edge.length_m();
        let mut open = |at: Point2, length_m: f64, spoke: bool| match corners.last_mut() {
            Some(last) if last.at == at => {
                last.length_m += length_m;
                let both = last.normal + normal;
                last.normal = both.try_normalize(0.0).unwrap_or(normal);
            }
            _ => corners.push(Corner { at, normal, length_m, spoke, state: CornerState::Open }),
        };
        if edge.spoke {
            open(edge.at(0.5), 2.0 * half_m, true);
            continue;
        }
        for end in [edge.from, edge.to] {
            if !is_hit(&end) {
                open(end, half_m, false);
            }
        }
    }
    // The boundary closes: the last corner may be the first again.
    if corners.len() > 1
        && let (Some(first), Some(last)) = (corners.first().copied(), corners.last().copied())
        && first.at == last.at
    {
        corners.pop();
        corners[0].length_m += last.length_m;
    }
    corners
}
