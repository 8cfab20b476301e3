//! The same scans in three pictures: by odometry only, as optimised, and relative to the current pose.

use geometry::Point2;
use pose::Se2;
use rerun::RecordingStream;

use super::cloud::{Thin, thinned};
use super::record::{KeyframeSeen, SettledSeen};
use crate::InstrumentError;
use crate::columns::{Growing, Lines, Now, Points};
use crate::palette;
use crate::recorder::draw_robot;

/// Where pictures are.
pub(super) const PICTURES: [&str; 3] = ["by_odometry", "as_optimised", "around_the_robot"];

/// Rows of `pictures/..`.
pub(super) struct Pictures {
    /// Returns of each keyframe, in its frame.
    walls: Vec<Vec<Point2>>,
    odometry: Vec<Se2>,
    odometry_thin: Thin,
    odometry_walls: Growing<Points>,
    odometry_path: Growing<Lines>,
    odometry_robot: Lines,
    /// Poses by the last optimisation, and from there on by steps.
    optimised: Vec<Se2>,
    optimised_walls: Points,
    optimised_recent: Points,
    optimised_path: Lines,
    optimised_closures: Lines,
    optimised_frontier: Lines,
    optimised_robot: Lines,
    settled: usize,
    closures: Vec<(usize, usize)>,
    around_walls: Points,
    around_path: Lines,
    around_robot: Lines,
    /// Relative placement is drawn at every so many keyframes.
    every: u64,
}

impl Pictures {
    pub fn new(every: u64) -> Self {
        let [odometry, optimised, around] = PICTURES;
        let points = |picture: &str, part: &str, radius, order| {
            Points::new(format!("pictures/{picture}/{part}"), radius, order)
        };
        let lines = |picture: &str, part: &str, radius, order| {
            Lines::new(format!("pictures/{picture}/{part}"), radius, order)
        };
        Self {
            walls: Vec::new(),
            odometry: Vec::new(),
            odometry_thin: Thin::default(),
            odometry_walls: Growing::new(move |part| {
                Points::new(format!("pictures/{odometry}/walls/{part}"), -1.0, 5.0)
            }),
            odometry_path: Growing::new(move |part| {
                Lines::new(format!("pictures/{odometry}/path/{part}"), -0.8, 10.0)
            }),
            odometry_robot: lines(odometry, "robot", -1.8, 40.0),
            optimised: Vec::new(),
            optimised_walls: points(optimised, "walls", -1.0, 5.0),
            optimised_recent: points(optimised, "recent_walls", -1.0, 6.0),
            optimised_path: lines(optimised, "path", -0.8, 10.0),
            optimised_closures: lines(optimised, "closures", -0.5, 8.0),
            optimised_frontier: lines(optimised, "frontier_left", -2.2, 20.0),
            optimised_robot: lines(optimised, "robot", -1.8, 40.0),
            settled: 0,
            closures: Vec::new(),
            around_walls: points(around, "walls", -1.2, 5.0),
            around_path: lines(around, "scope", -0.7, 10.0),
            around_robot: lines(around, "robot", -1.8, 40.0),
            every,
        }
    }

    pub fn closed(&mut self, known: usize, current: usize) {
        self.closures.push((known, current));
    }

    pub fn keyframe(&mut self, seen: &KeyframeSeen<'_>, now: &Now) {
        self.walls.push(thinned(seen.returns));
        self.by_odometry(seen, now);
        self.as_optimised(seen, now);
        if now.step.unsigned_abs().is_multiple_of(self.every) {
            self.around(seen, now);
        }
    }

    fn by_odometry(&mut self, seen: &KeyframeSeen<'_>, now: &Now) {
        let pose = seen.odom_from_keyframe;
        for point in self.walls.last().into_iter().flatten() {
            let at = pose.transform(point);
            if self.odometry_thin.takes(&at) {
                self.odometry_walls.push(&at, &at, palette::OBSTACLE);
            }
        }
        if let Some(last) = self.odometry.last() {
            let (from, to) = (Point2::from(last.translation), Point2::from(pose.translation));
            self.odometry_path.push(&from, &to, palette::ODOMETRY);
        }
        self.odometry.push(pose);
        self.odometry_walls.end_row(now);
        self.odometry_path.end_row(now);
        draw_robot(&mut self.odometry_robot, &pose);
        self.odometry_robot.end_row(now);
    }

    fn as_optimised(&mut self, seen: &KeyframeSeen<'_>, now: &Now) {
        let before = self.optimised.last().copied();
        let pose = before.map_or_else(Se2::identity, |before| before * seen.last_from_keyframe);
        self.optimised.push(pose);
        let mut thin = Thin::default();
        for (pose, walls) in self.optimised.iter().zip(&self.walls).skip(self.settled) {
            for point in walls.iter().map(|point| pose.transform(point)) {
                if thin.takes(&point) {
                    self.optimised_recent.point(&point, palette::WALL_CLOSED);
                }
            }
        }
        self.optimised_recent.end_row(now);
        draw_robot(&mut self.optimised_robot, &pose);
        self.optimised_robot.end_row(now);
    }

    /// Draws everything in the picture of the optimised graph anew.
    pub fn settle(&mut self, seen: &SettledSeen<'_>, now: &Now) {
        self.optimised.clear();
        self.optimised.extend_from_slice(seen.map_from_keyframe);
        self.settled = self.optimised.len();
        let mut thin = Thin::default();
        for (pose, walls) in self.optimised.iter().zip(&self.walls) {
            for point in walls.iter().map(|point| pose.transform(point)) {
                if thin.takes(&point) {
                    self.optimised_walls.point(&point, palette::OBSTACLE);
                }
            }
        }
        self.optimised_walls.end_row(now);
        self.optimised_recent.end_row(now);
        let at = |pose: &Se2| Point2::from(pose.translation);
        self.optimised_path.strip(self.optimised.iter().map(at), palette::CORRECTED);
        self.optimised_path.end_row(now);
        for &(known, current) in &self.closures {
            let (Some(a), Some(b)) = (self.optimised.get(known), self.optimised.get(current))
            else {
                continue;
            };
            self.optimised_closures.segment(&at(a), &at(b), palette::PLACE);
        }
        self.optimised_closures.end_row(now);
        for (from, to) in seen.frontier_in_map {
            self.optimised_frontier.segment(from, to, palette::FRONTIER);
        }
        self.optimised_frontier.end_row(now);
    }

    /// Keyframes around the current one, each placed along its shortest path; the picture keeps the
    /// directions of odometry, so that it does not spin.
    fn around(&mut self, seen: &KeyframeSeen<'_>, now: &Now) {
        let turned = Se2::from_angle(seen.odom_from_keyframe.angle());
        let mut thin = Thin::default();
        for &(keyframe, current_from_keyframe, parent) in seen.around {
            let pose = turned * current_from_keyframe;
            for point in self.walls.get(keyframe).into_iter().flatten() {
                let at = pose.transform(point);
                if thin.takes(&at) {
                    self.around_walls.point(&at, palette::OBSTACLE);
                }
            }
            let parent = parent.and_then(|parent| seen.around.get(parent));
            if let Some((_, current_from_parent, _)) = parent {
                let from = Point2::from((turned * *current_from_parent).translation);
                let to = Point2::from(pose.translation);
                self.around_path.segment(&from, &to, palette::SCOPE);
            }
        }
        self.around_walls.end_row(now);
        self.around_path.end_row(now);
        draw_robot(&mut self.around_robot, &turned);
        self.around_robot.end_row(now);
    }

    pub fn held_bytes(&self) -> usize {
        self.odometry_walls.held_bytes()
            + self.optimised_walls.held_bytes()
            + self.optimised_recent.held_bytes()
            + self.around_walls.held_bytes()
            + self.around_path.held_bytes()
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.odometry_walls.send(stream)?;
        self.odometry_path.send(stream)?;
        for lines in [
            &mut self.odometry_robot,
            &mut self.optimised_path,
            &mut self.optimised_closures,
            &mut self.optimised_frontier,
            &mut self.optimised_robot,
            &mut self.around_path,
            &mut self.around_robot,
        ] {
            lines.send(stream)?;
        }
        for points in
            [&mut self.optimised_walls, &mut self.optimised_recent, &mut self.around_walls]
        {
            points.send(stream)?;
        }
        Ok(())
    }
}
