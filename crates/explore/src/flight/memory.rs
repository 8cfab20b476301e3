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

    /// Notes that it is looked at from there.
    pub(super) fn note(&mut self, target: &Target, from_in_owner: Point3, same_m: f64) {
        let tried = self.by_owner.entry(target.owner).or_default();
        let near = |tried: &Tried| (tried.in_owner - target.in_owner).norm() < same_m;
        match tried.iter().position(near) {
            Some(at) => tried[at].from_in_owner.push(from_in_owner),
            None => {
                tried.push(Tried { in_owner: target.in_owner, from_in_owner: vec![from_in_owner] })
            }
        }
    }

    fn of(&self, target: &Target, same_m: f64) -> Option<&Tried> {
        let tried = self.by_owner.get(&target.owner)?;
        tried.iter().find(|tried| (tried.in_owner - target.in_owner).norm() < same_m)
    }
}
