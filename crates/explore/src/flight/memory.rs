//! From where which frontier was looked at, by place relative to the graph.

use std::collections::BTreeMap;

use geometry::{Point3, Vector3};
use pose::Se3;
use probe::VertexId;

/// Frontier to be looked at: a point, the way across it, and how much it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The vertex whose views it belongs to.
    pub owner: VertexId,
    /// The point in the frame of the owner.
    pub in_owner: Point3,
    /// The point in the frame that it is spoken of in.
    pub at: Point3,
    /// Unit vector across, into the unknown, in the same frame.
    pub normal: Vector3,
    /// Area that it stands for, square metres.
    pub area_m2: f64,
}

impl Target {
    /// The same target seen from another frame.
    pub(super) fn moved(&self, other_from_this: &Se3) -> Self {
        Self {
            at: other_from_this.transform(&self.at),
            normal: other_from_this.rotation * self.normal,
            ..*self
        }
    }
}

/// Where the robot looked at a piece of frontier from.
#[derive(Clone, Debug)]
struct Tried {
    in_owner: Point3,
    from_in_owner: Vec<Point3>,
    /// From how many of these places its direction was seen, and from how many something solid before it.
    seen: usize,
    hidden: usize,
}

/// All tries, by owner.
#[derive(Clone, Debug, Default)]
pub(super) struct Tries {
    by_owner: BTreeMap<VertexId, Vec<Tried>>,
}

impl Tries {
    /// From how many places this frontier was looked at.
    pub(super) fn count(&self, target: &Target, same_m: f64) -> usize {
        self.of(target, same_m).map_or(0, |tried| tried.from_in_owner.len())
    }

    /// Whether it was looked at from about there.
    pub(super) fn was_tried(&self, target: &Target, from_in_owner: &Point3, same_m: f64) -> bool {
        self.of(target, same_m).is_some_and(|tried| {
            tried.from_in_owner.iter().any(|from| (from - from_in_owner).norm() < same_m)
        })
    }

    /// Whether a depth was read in its direction from a place that it was looked at from. It is where the robot
    /// took it to be, and closed by what was seen there, or it is not there: another look tells nothing new.
    pub(super) fn was_seen(&self, target: &Target, same_m: f64) -> bool {
        self.of(target, same_m).is_some_and(|tried| tried.seen > 0)
    }

    /// Whether something solid stood before it wherever it was looked at from, at least once.
    pub(super) fn is_hidden(&self, target: &Target, same_m: f64) -> bool {
        self.of(target, same_m).is_some_and(|tried| tried.hidden > 0 && tried.hidden >= tried.seen)
    }

    /// Notes what was seen in its direction from the last of these places: something solid before it, or not.
    pub(super) fn note_seen(&mut self, target: &Target, is_hidden: bool, same_m: f64) {
        let near = |tried: &&mut Tried| (tried.in_owner - target.in_owner).norm() < same_m;
        let tried = self.by_owner.get_mut(&target.owner);
        if let Some(tried) = tried.and_then(|tried| tried.iter_mut().find(near)) {
            tried.seen += 1;
            tried.hidden += usize::from(is_hidden);
        }
    }

    /// Notes that it is looked at from there.
    pub(super) fn note(&mut self, target: &Target, from_in_owner: Point3, same_m: f64) {
        let tried = self.by_owner.entry(target.owner).or_default();
        let near = |tried: &Tried| (tried.in_owner - target.in_owner).norm() < same_m;
        match tried.iter().position(near) {
            Some(at) => tried[at].from_in_owner.push(from_in_owner),
            None => {
                let from_in_owner = vec![from_in_owner];
                tried.push(Tried { in_owner: target.in_owner, from_in_owner, seen: 0, hidden: 0 });
            }
        }
    }

    fn of(&self, target: &Target, same_m: f64) -> Option<&Tried> {
        let tried = self.by_owner.get(&target.owner)?;
        tried.iter().find(|tried| (tried.in_owner - target.in_owner).norm() < same_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frontier_is_hidden_where_every_look_saw_something_before_it() {
        let at = Point3::new(1.0, 2.0, 3.0);
        let target =
            Target { owner: VertexId(3), in_owner: at, at, normal: Vector3::x(), area_m2: 1.0 };
        let mut tries = Tries::default();
        tries.note_seen(&target, true, 0.4);
        assert!(!tries.was_seen(&target, 0.4), "nobody went to look");
        for (i, is_hidden) in [true, true, false].into_iter().enumerate() {
            tries.note(&target, Point3::new(i as f64, 0.0, 0.0), 0.4);
            assert_eq!(tries.was_seen(&target, 0.4), i > 0);
            tries.note_seen(&target, is_hidden, 0.4);
            assert_eq!(tries.is_hidden(&target, 0.4), i < 2);
        }
        assert_eq!(tries.count(&target, 0.4), 3);
    }
}
