//! Correction: the whole pose graph is optimised at every place recognition (\[ISRR19\] 6.2).
//!
//! What loop closure gives a map with one global frame; the relative map does without.
//!
//! 1. A new vertex is placed by its odometry edge, from where the one before it is believed to be.
//! 2. Where the robot recognises a place, all measured edges become factors (`estimate`). The weight
//!    of an odometry edge is that of its noise, whose variance grows with its length (\[ISRR19\] eq. 5);
//!    a place edge has noise of its own. The paper does not print its weights; these are those
//!    that make the optimum the most likely one.
//! 3. `posegraph::optimize` runs to convergence from the poses at hand. The first vertex is held.
//! 4. The map takes the new poses and does whatever it has to: a grid applies all scans again.
//! 5. The event tells what it cost: vertices, factors, iterations, and how far vertices moved.
//!
//! An optimisation that ends at something that is not finite is not taken; the poses stay.

mod estimate;
mod events;
mod given;

pub use estimate::{Correction, CorrectionParams};
pub use events::CorrectionEvent;
pub use given::GivenPoses;
