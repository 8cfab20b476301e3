//! A robot that wanders along the streets of a town.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use pose::Se2;

use super::measure::{Draw, Noise, Synthetic, measure};

/// Parameters of a walk: [`manhattan`] and [`city`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// Number of poses.
    pub poses: usize,
    /// Blocks along each side of the town; 0 chooses so that a place is seen about four times.
    pub blocks: usize,
    /// Steps from one crossing to the next.
    pub steps_per_block: usize,
    /// Length of a step, metres.
    pub step_m: f64,
    /// The share of earlier poses within reach that are measured.
    pub closure_probability: f64,
    /// Earlier poses within this many steps, along both axes, are within reach.
    pub reach_steps: usize,
    /// At most this many closures lead to one pose.
    pub closures_per_pose: usize,
    /// Noise of every measurement.
    pub noise: Noise,
    /// Seed of the way, of the closures and of the noise.
    pub seed: u64,
}

impl Walk {
    /// As the public M3500: a crossing every two steps.
    pub fn manhattan() -> Self {
        Self {
            poses: 3500,
            blocks: 0,
            steps_per_block: 2,
            step_m: 1.0,
            closure_probability: 0.05,
            reach_steps: 1,
            closures_per_pose: 3,
            noise: Noise { translation_m: 0.05, rotation_rad: 0.02 },
            seed: 1,
        }
    }

    /// As the public city10000: long streets, every second place seen again.
    pub fn city() -> Self {
        Self {
            poses: 10_000,
            steps_per_block: 8,
            closure_probability: 0.1,
            noise: Noise { translation_m: 0.03, rotation_rad: 0.01 },
            ..Self::manhattan()
        }
    }
}

/// A random walk over a grid of streets, [`Walk::manhattan`] at another size.
pub fn manhattan(poses: usize, seed: u64) -> Synthetic<Se2, 3> {
    walk(&Walk { poses, seed, ..Walk::manhattan() })
}

/// A drive through a town with long streets, [`Walk::city`] at another size.
pub fn city(poses: usize, seed: u64) -> Synthetic<Se2, 3> {
    walk(&Walk { poses, seed, ..Walk::city() })
}

/// A walk that turns at crossings only, straight on half of the time, never out of the town.
///
/// Each pose is measured from the one before and from some earlier poses within reach that are not
/// among the last ten.
pub fn walk(params: &Walk) -> Synthetic<Se2, 3> {
    const RECENT: usize = 10;
    let per_block = params.steps_per_block.max(1);
    let side = match params.blocks {
        // A town of b x b blocks has about 2 b² streets of `per_block` places.
        0 => ((params.poses as f64 / (8.0 * per_block as f64)).sqrt().ceil() as usize).max(2),
        blocks => blocks,
    };
    let limit = (side * per_block) as i64;
    let mut draw = Draw::new(params.seed);
    let (mut x, mut y, mut heading) = (0_i64, 0_i64, 0_usize);
    const AHEAD: [(i64, i64); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    let mut seen: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    let mut truth = Vec::with_capacity(params.poses);
    let mut pairs = Vec::with_capacity(params.poses * 2);
    let reach = params.reach_steps as i64;
    for k in 0..params.poses {
        if k > 0 {
            let at_crossing = x % per_block as i64 == 0 && y % per_block as i64 == 0;
            let inside = |turn: usize| {
                let (dx, dy) = AHEAD[(heading + turn) % 4];
                let block = per_block as i64;
                (0..=limit).contains(&(x + dx * block)) && (0..=limit).contains(&(y + dy * block))
            };
            if at_crossing {
                let wish = [0, 0, 1, 3][draw.below(4)];
                let other = if draw.below(2) == 0 { [1, 3] } else { [3, 1] };
                let turn = [wish, 0, other[0], other[1], 2].into_iter().find(|&turn| inside(turn));
                heading = (heading + turn.unwrap_or(2)) % 4;
            }
            x += AHEAD[heading].0;
            y += AHEAD[heading].1;
            pairs.push((k - 1, k));
        }
        let theta = FRAC_PI_2 * heading as f64;
        truth.push(Se2::new(x as f64 * params.step_m, y as f64 * params.step_m, theta));
        let mut found = 0;
        'near: for dx in -reach..=reach {
            for dy in -reach..=reach {
                for &other in seen.get(&(x + dx, y + dy)).into_iter().flatten() {
                    if found >= params.closures_per_pose {
                        break 'near;
                    }
                    if other + RECENT < k && draw.uniform() < params.closure_probability {
                        pairs.push((other, k));
                        found += 1;
                    }
                }
            }
        }
        seen.entry((x, y)).or_default().push(k);
    }
    measure(truth, &pairs, &params.noise, params.seed.wrapping_add(1))
}
