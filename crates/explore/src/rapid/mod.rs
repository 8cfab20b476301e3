//! The rapid policy: towards the frontier in view with the least change of heading, else along the
//! graph to the nearest vertex with frontier (\[ISRR19\] 5, \[Zie18\] 2.9).
//!
//! How a run comes to its end: a goal is given up when it is reached and still there; when no motion
//! towards it keeps even the least clearance, from where it was seen or from another place; and when
//! the robot has acted for longer than going there takes, and nothing new was left or gone, or went
//! for the same goal again and again (`patience`). A goal that is given up takes the frontier around it
//! out of the count for good. Every part of a place is allowed so many actions before all others come
//! first, and again as many when nothing is left elsewhere, until that has brought no new ground for
//! long; then what is left is given up (`haunts`). Parts lie a step from each other where places are
//! recognised, so a bounded place has finitely many of them. That holds for maps whose frontier belongs
//! to vertices; for others only the rules before hold. Without recognition drift may found ever
//! new ones: then the step limit ends the run, as not complete.

mod approach;
mod behind;
mod drive;
mod haunts;
mod look;
mod patience;
mod react;
mod way;

use std::collections::BTreeMap;

use probe::VertexId;
use sensing::Robot;

use crate::{ExploreProbe, Explorer};

use behind::{Behind, Served};
use haunts::Haunts;
use patience::Patience;
use react::Pursuit;

/// What the policy remembers between steps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// What is left of the way along the graph, last leg first.
    pub way: Vec<(VertexId, f64)>,
    /// Scans since the robot came to this place.
    pub turns_here: u32,
    /// The frontier of another vertex that the way is driven for, if not that of its last vertex.
    pub served: Option<Served>,
    /// How long the robot goes on while nothing changes.
    pub patience: Patience,
    /// Where the robot has acted so often that other places come first.
    pub haunts: Haunts,
    /// The goal of the last move.
    pub pursuit: Option<Pursuit>,
    /// How often the robot was sent to a vertex, and what it had left when it was sent last.
    pub sent: BTreeMap<VertexId, (u32, f64)>,
    /// A vertex that the robot was sent to in vain: its goals are given up on arrival.
    pub in_vain: Option<VertexId>,
    /// The frontier that a "normal point" serves, in the body frame of now, until it is looked at.
    pub behind: Option<Behind>,
}

impl Explorer {
    pub(crate) fn act_rapid(&mut self, robot: &mut dyn Robot, probe: &mut dyn ExploreProbe) {
        let params = self.params.policy.rapid().clone();
        if params.look_first && self.look_first(robot, &params, probe) {
            return;
        }
        if self.follow_way(robot, &params, probe) || self.go_behind(robot, &params, probe) {
            return;
        }
        self.rapid.haunts.acted(self.standing.vertex);
        // Giving goals up may leave nothing in view. Each round closes some, or has the place wait, which
        // comes to its last turn: so this ends.
        loop {
            if self.leave_haunt(robot, &params, probe) {
                return;
            }
            let mut candidates = std::mem::take(&mut self.candidates);
            self.maps[0].in_view(&self.standing, &mut candidates);
            let acted = if candidates.is_empty() {
                None
            } else {
                Some(self.react(robot, &candidates, &params, probe))
            };
            self.candidates = candidates;
            match acted {
                Some(true) => return,
                Some(false) => continue,
                None => break,
            }
        }
        if !self.look_around(robot, &params, probe) && !self.go_on(robot, &params, probe) {
            self.deliberate(robot, &params, probe);
        }
    }
}
