//! What is known around a keyframe: its scan, and those taken just before and after it.

use pose::Se2;

use crate::matching::{Surfaces, Table};
use crate::{Keyframe, Measured, SurfacePoint};

/// A keyframe with its neighbours along the odometry, as one piece in its frame.
#[derive(Clone, Debug, Default)]
pub struct Place {
    /// Keyframes, the one in the middle first, and their frames in its frame.
    pub members: Vec<(usize, Se2)>,
    /// All returns, in the frame of the one in the middle.
    pub points: Vec<SurfacePoint>,
}

impl Place {
    /// The place around `middle`: up to `before` and `after` keyframes beside it, none farther than
    /// `local_m`. `steps[i]` leads from keyframe i to keyframe i + 1.
    pub fn around(
        keyframes: &[Keyframe],
        steps: &[Measured],
        middle: usize,
        (before, after): (usize, usize),
        local_m: f64,
    ) -> Self {
        let mut members = vec![(middle, Se2::identity())];
        let mut middle_from = Se2::identity();
        for i in (middle.saturating_sub(before)..middle).rev() {
            let Some(step) = steps.get(i) else { break };
            middle_from = middle_from * step.from_from_to.inverse();
            if middle_from.distance() > local_m {
                break;
            }
            members.push((i, middle_from));
        }
        middle_from = Se2::identity();
        for i in middle + 1..(middle + after + 1).min(keyframes.len()) {
            let Some(step) = steps.get(i - 1) else { break };
            middle_from = middle_from * step.from_from_to;
            if middle_from.distance() > local_m {
                break;
            }
            members.push((i, middle_from));
        }
        let mut points = Vec::new();
        for (i, middle_from_member) in &members {
            let of_member = keyframes[*i].surface.iter();
            points.extend(of_member.map(|point| point.moved(middle_from_member)));
        }
        Self { members, points }
    }

    /// Its surfaces, sorted for looking up what is nearest.
    pub fn surfaces(&self) -> Surfaces {
        Surfaces::new(&self.points, 0.2)
    }

    /// Its table of scores.
    pub fn table(&self, cell_m: f64) -> Table {
        Table::new(self.points.iter().map(|point| point.point), cell_m)
    }

    /// Its keyframes with their frames.
    pub fn keyframes<'a>(&self, all: &'a [Keyframe]) -> Vec<(&'a Keyframe, Se2)> {
        self.members.iter().map(|&(i, pose)| (&all[i], pose)).collect()
    }
}

/// One point for each cell of a grid that has any, the first; and of these every so many-th, so that no
/// more than `most` are left.
pub fn thinned(points: &[SurfacePoint], cell_m: f64, most: usize) -> Vec<SurfacePoint> {
    let cell = |metres: f64| (metres / cell_m).floor() as i64;
    let mut by_cell: Vec<(i64, i64, usize)> = points
        .iter()
        .enumerate()
        .map(|(i, point)| (cell(point.point.x), cell(point.point.y), i))
        .collect();
    by_cell.sort_unstable();
    by_cell.dedup_by_key(|(x, y, _)| (*x, *y));
    let mut first: Vec<usize> = by_cell.into_iter().map(|(_, _, i)| i).collect();
    first.sort_unstable();
    let kept: Vec<SurfacePoint> = first.into_iter().map(|i| points[i]).collect();
    if kept.len() <= most || most == 0 {
        return kept;
    }
    (0..most).map(|i| kept[i * kept.len() / most]).collect()
}
