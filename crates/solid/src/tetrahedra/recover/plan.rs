//! How hard and in which order missing things are searched for.

use crate::tetrahedra::flips::{Effort, FLAT};

/// Plain flips.
const PLAIN: Effort = Effort { depth: 0, ring: 16, tries: 0, flattest: FLAT };
/// Flips after a flip that clears the way.
const SHALLOW: Effort = Effort { depth: 1, ring: 24, tries: 20, flattest: FLAT };
/// Two flips that clear the way, one for the other.
const DEEP: Effort = Effort { depth: 2, ring: 24, tries: 30, flattest: FLAT };
/// As a last resort nearly flat tetrahedra may be made; a far search costs less than a division.
pub(super) const ANYHOW: Effort = Effort { depth: 3, ring: 40, tries: 500, flattest: 0.0 };

/// Flips on a detour, which has to be short.
pub(super) const DETOUR: Effort = SHALLOW;

/// One way to go about it. Which constraints are stuck, and where points go, depends on the order; where
/// one plan leaves no room for a point another one mostly does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    /// What is done for all that is missing, before what is left is divided.
    pub(super) efforts: &'static [Effort],
    /// What turns the order; 0 keeps that of the input.
    turn: u32,
}

/// The plans, in the order tried.
pub(crate) const PLANS: [Plan; 8] = [
    Plan { efforts: &[PLAIN, SHALLOW, DEEP], turn: 0 },
    Plan { efforts: &[PLAIN, SHALLOW, DEEP], turn: 1 },
    Plan { efforts: &[PLAIN, SHALLOW], turn: 0 },
    Plan { efforts: &[PLAIN, SHALLOW, DEEP], turn: 2 },
    Plan { efforts: &[PLAIN, SHALLOW], turn: 3 },
    Plan { efforts: &[PLAIN, SHALLOW, DEEP], turn: 4 },
    Plan { efforts: &[PLAIN, SHALLOW, ANYHOW], turn: 0 },
    Plan { efforts: &[PLAIN, SHALLOW, DEEP, ANYHOW], turn: 5 },
];

impl Plan {
    /// Puts things into the order of the plan.
    pub(super) fn arrange(&self, ids: &mut [u32]) {
        if self.turn > 0 {
            ids.sort_by_key(|id| {
                (id ^ self.turn.wrapping_mul(0x85eb_ca6b)).wrapping_mul(0x9e37_79b1)
            });
        }
    }
}
