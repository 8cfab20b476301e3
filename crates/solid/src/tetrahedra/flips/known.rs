//! What was found out before, so that it is not computed again.

use super::goal::Goal;
use crate::tetrahedra::mesh::{Mesh, NONE, Ring, sorted3};

/// How many answers about what is in the way are kept.
const ANSWERS: usize = 1 << 11;
/// How many rings that no flip removes are kept.
const BARREN: usize = 1 << 14;

/// An answer: whether a face, or an edge with [`NONE`], is in the way of the goal of that number.
#[derive(Clone, Copy, Debug)]
struct Answer {
    what: [u32; 3],
    goal: u32,
    in_way: bool,
}

/// Two tables in which what comes later overwrites what came before. Both hold what depends on places
/// alone, so that flips that are made or taken back leave it true; a point that goes, after which another
/// one may have its number, does not.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    answers: Vec<Answer>,
    goal: Option<Goal>,
    number: u32,
    barren: Vec<u64>,
    salt: u64,
}

/// Spreads the bits of a number over all of them (the finaliser of a known generator of numbers).
#[inline]
fn mixed(x: u64) -> u64 {
    let x = (x ^ (x >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    let x = (x ^ (x >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    x ^ (x >> 32)
}

#[inline]
fn pair(a: u32, b: u32) -> u64 {
    (u64::from(a) << 32) | u64::from(b)
}

impl Known {
    /// Forgets all.
    pub(super) fn forget(&mut self) {
        self.goal = None;
        self.salt += 1;
    }

    /// 1 where a face is in the way of the goal.
    #[inline]
    pub(super) fn of_face(&mut self, mesh: &Mesh, goal: Goal, face: [u32; 3]) -> i32 {
        match goal {
            // With an end in common they do not pass one another.
            Goal::Segment([a, b]) if !face.contains(&a) && !face.contains(&b) => {
                i32::from(self.answer(mesh, goal, sorted3(face)))
            }
            _ => 0,
        }
    }

    /// 1 where an edge is in the way of the goal.
    #[inline]
    pub(super) fn of_edge(&mut self, mesh: &Mesh, goal: Goal, u: u32, v: u32) -> i32 {
        match goal {
            Goal::Facet(corners) if !corners.contains(&u) && !corners.contains(&v) => {
                i32::from(self.answer(mesh, goal, [u.min(v), u.max(v), NONE]))
            }
            _ => 0,
        }
    }

    fn answer(&mut self, mesh: &Mesh, goal: Goal, what: [u32; 3]) -> bool {
        if self.goal != Some(goal) {
            self.goal = Some(goal);
            self.number = self.number.wrapping_add(1);
            if self.number == 0 || self.answers.is_empty() {
                self.number = 1;
                self.answers.clear();
                self.answers.resize(ANSWERS, Answer { what: [NONE; 3], goal: 0, in_way: false });
            }
        }
        let place = mixed(pair(what[0], what[1]) ^ u64::from(what[2]).rotate_left(16));
        let place = place as usize % ANSWERS;
        let known = self.answers[place];
        if known.goal == self.number && known.what == what {
            return known.in_way;
        }
        let in_way = if what[2] == NONE {
            goal.of_edge(mesh, what[0], what[1])
        } else {
            goal.of_face(mesh, what)
        } > 0;
        self.answers[place] = Answer { what, goal: self.number, in_way };
        in_way
    }

    /// A number for a ring and how flat tetrahedra may be, whatever tetrahedron it starts from.
    pub(super) fn name(&self, u: u32, v: u32, ring: &Ring, flattest: f64) -> u64 {
        let mut name = mixed(pair(u.min(v), u.max(v)) ^ flattest.to_bits() ^ self.salt);
        let mut behind = ring.vertices.last().copied().unwrap_or(NONE);
        for &on in &ring.vertices {
            let turned = if u < v { pair(behind, on) } else { pair(on, behind) };
            name = name.wrapping_add(mixed(turned));
            behind = on;
        }
        name
    }

    /// Whether no flip removes the ring of that name, as was found out before.
    #[inline]
    pub(super) fn is_barren(&self, name: u64) -> bool {
        self.barren.get(name as usize % BARREN) == Some(&name)
    }

    /// Keeps that no flip removes the ring of that name.
    pub(super) fn note_barren(&mut self, name: u64) {
        if self.barren.is_empty() {
            self.barren.resize(BARREN, 0);
        }
        self.barren[name as usize % BARREN] = name;
    }
}
