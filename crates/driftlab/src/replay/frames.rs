//! Frames in frames over time, as transforms of a log tell them.

use std::collections::BTreeMap;
use std::sync::Arc;

use formats::log::{Stamp, Transform};
use pose::Se3;

/// Poses of one thing over time.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    poses: Vec<(Stamp, Se3)>,
}

impl Track {
    pub fn push(&mut self, stamp: Stamp, pose: Se3) {
        self.poses.push((stamp, pose));
    }

    /// Puts poses into the order of time; of one time they stay in the order of the log.
    pub fn sort(&mut self) {
        self.poses.sort_by_key(|pose| pose.0);
    }

    pub fn is_empty(&self) -> bool {
        self.poses.is_empty()
    }

    /// Whether it holds one pose only, which then holds at all times.
    fn is_fixed(&self) -> bool {
        self.poses.len() == 1
    }

    /// How far a time is from those that are known, seconds; 0 within them.
    pub fn beyond_secs(&self, stamp: Stamp) -> f64 {
        let (Some(first), Some(last)) = (self.poses.first(), self.poses.last()) else {
            return f64::INFINITY;
        };
        if self.is_fixed() {
            return 0.0;
        }
        first.0.secs_since(stamp).max(stamp.secs_since(last.0)).max(0.0)
    }

    /// The pose at a time, for the thing that is the n-th of its kind at that time: clocks that are coarse,
    /// or stood still, give several the same. Of several poses at that time the n-th, or the last.
    pub fn nth_at(&self, stamp: Stamp, nth: usize) -> Option<Se3> {
        let first = self.poses.partition_point(|pose| pose.0 < stamp);
        let same = self.poses[first..].iter().take_while(|pose| pose.0 == stamp);
        match same.take(nth + 1).last() {
            Some(pose) => Some(pose.1),
            None => self.at(stamp),
        }
    }

    /// The pose at a time: between two by the twist from one to the other, beyond the ends as there; of
    /// several at one time the last.
    pub fn at(&self, stamp: Stamp) -> Option<Se3> {
        let next = self.poses.partition_point(|pose| pose.0 <= stamp);
        let Some(before) = next.checked_sub(1).map(|i| &self.poses[i]) else {
            return self.poses.first().map(|pose| pose.1);
        };
        let Some(after) = self.poses.get(next) else { return Some(before.1) };
        let share = stamp.secs_since(before.0) / after.0.secs_since(before.0);
        let step = before.1.inverse_mul(&after.1).log();
        Some(before.1.boxplus(&(step * share)))
    }
}

/// The forest of frames.
#[derive(Clone, Debug, Default)]
pub(super) struct Frames {
    /// By child: its parent, and its pose in it.
    of: BTreeMap<Arc<str>, (Arc<str>, Track)>,
}

/// Frames between one and its root, at most: more is a circle.
const DEEPEST: usize = 64;

impl Frames {
    /// Takes a transform; one with another parent than before starts anew.
    pub fn push(&mut self, transform: &Transform) {
        let Transform { header, child_frame, parent_from_child } = transform;
        let parent = Arc::clone(&header.frame);
        let entry = self.of.entry(Arc::clone(child_frame));
        let (known, track) = entry.or_insert_with(|| (Arc::clone(&parent), Track::default()));
        if *known != parent {
            (*known, *track) = (parent, Track::default());
        }
        track.push(header.stamp, *parent_from_child);
    }

    pub fn sort(&mut self) {
        self.of.values_mut().for_each(|(_, track)| track.sort());
    }

    /// Where `child` is in `ancestor` at a time; `None` where no chain leads there.
    pub fn lookup(&self, ancestor: &str, child: &str, stamp: Stamp) -> Option<Se3> {
        let mut at = child;
        let mut at_from_child = Se3::identity();
        for _ in 0..DEEPEST {
            if at == ancestor {
                return Some(at_from_child);
            }
            let (parent, track) = self.of.get(at)?;
            at_from_child = track.at(stamp)? * at_from_child;
            at = parent;
        }
        None
    }

    /// Whether a chain leads from `ancestor` to `child`, at any time.
    pub fn leads(&self, ancestor: &str, child: &str) -> bool {
        let up = |at: &&str| self.of.get(*at).map(|(parent, _)| &**parent);
        std::iter::successors(Some(child), up).take(DEEPEST).any(|at| at == ancestor)
    }

    /// The frame that odometry is given in, above a frame: the nearest whose name ends in `odom`.
    pub fn odometry_above(&self, child: &str) -> Option<Arc<str>> {
        let mut at = child;
        for _ in 0..DEEPEST {
            let (parent, _) = self.of.get(at)?;
            if parent.ends_with("odom") {
                return Some(Arc::clone(parent));
            }
            at = parent;
        }
        None
    }

    /// How far a time is from those at which the chain to a frame is known, seconds.
    pub fn beyond_secs(&self, ancestor: &str, child: &str, stamp: Stamp) -> f64 {
        let mut at = child;
        let mut most: f64 = 0.0;
        for _ in 0..DEEPEST {
            if at == ancestor {
                break;
            }
            let Some((parent, track)) = self.of.get(at) else { break };
            most = most.max(track.beyond_secs(stamp));
            at = parent;
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formats::log::{Header, spatial};
    use pose::Se2;

    fn transform(parent: &str, child: &str, secs: f64, pose: Se2) -> Transform {
        Transform {
            header: Header::new(Stamp::from_secs(secs), parent),
            child_frame: child.into(),
            parent_from_child: spatial(&pose),
        }
    }

    #[test]
    fn chains_are_walked_and_poses_between_two_are_between() {
        let mut frames = Frames::default();
        frames.push(&transform("odom", "base", 2.0, Se2::new(2.0, 0.0, 0.0)));
        frames.push(&transform("odom", "base", 1.0, Se2::new(0.0, 0.0, 0.0)));
        frames.push(&transform("base", "laser", 0.0, Se2::new(0.0, 0.5, 0.0)));
        frames.sort();
        let at = |secs| {
            let found = frames.lookup("odom", "laser", Stamp::from_secs(secs)).expect("a chain");
            (found.translation.x, found.translation.y)
        };
        assert_eq!(at(1.5), (1.0, 0.5));
        assert_eq!(at(0.0), (0.0, 0.5));
        assert_eq!(at(9.0), (2.0, 0.5));
        assert_eq!(frames.odometry_above("laser").as_deref(), Some("odom"));
        assert_eq!(frames.beyond_secs("odom", "laser", Stamp::from_secs(5.0)), 3.0);
        assert_eq!(frames.lookup("map", "laser", Stamp::from_secs(1.0)), None);
    }

    #[test]
    fn what_has_the_same_stamp_goes_together_in_order() {
        let mut track = Track::default();
        for (secs, x) in [(1.0, 10.0), (1.0, 11.0), (2.0, 20.0)] {
            track.push(Stamp::from_secs(secs), spatial(&Se2::new(x, 0.0, 0.0)));
        }
        track.sort();
        let x_of =
            |secs, nth| track.nth_at(Stamp::from_secs(secs), nth).map(|pose| pose.translation.x);
        assert_eq!(
            [x_of(1.0, 0), x_of(1.0, 1), x_of(1.0, 5)],
            [Some(10.0), Some(11.0), Some(11.0)]
        );
        assert_eq!([x_of(1.5, 0), x_of(2.0, 0)], [Some(15.5), Some(20.0)]);
    }

    #[test]
    fn a_circle_of_frames_leads_nowhere() {
        let mut frames = Frames::default();
        frames.push(&transform("a", "b", 0.0, Se2::identity()));
        frames.push(&transform("b", "a", 0.0, Se2::identity()));
        assert_eq!(frames.lookup("odom", "a", Stamp::from_secs(0.0)), None);
        assert_eq!(frames.odometry_above("a"), None);
    }
}
