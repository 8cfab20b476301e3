//! A robot that visits every node of a cubic lattice.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};

use super::measure::{Draw, Noise, Synthetic, measure};

/// Parameters of a [`lattice`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Nodes along each edge of the cube; their cube is the number of poses.
    pub side: usize,
    /// Distance of neighbours, metres.
    pub spacing_m: f64,
    /// The share of neighbours, other than the next pose, that are measured.
    pub closure_probability: f64,
    /// Noise of every measurement.
    pub noise: Noise,
    /// Seed of the closures and of the noise.
    pub seed: u64,
}

impl Default for Lattice {
    fn default() -> Self {
        let noise = Noise { translation_m: 0.05, rotation_rad: 0.02 };
        Self { side: 20, spacing_m: 2.0, closure_probability: 0.4, noise, seed: 1 }
    }
}

/// Back and forth through a cube, layer by layer, turning by random right angles; each pose is
/// measured from the one before, and from some earlier ones beside and beneath it.
pub fn lattice(params: &Lattice) -> Synthetic<Se3, 6> {
    let side = params.side;
    let mut draw = Draw::new(params.seed);
    // Snakes, so that every step is to a neighbour; the index of a node is its own inverse.
    let node = |k: usize| {
        let (layer, rest) = (k / (side * side), k % (side * side));
        let row = rest / side;
        let row = if layer.is_multiple_of(2) { row } else { side - 1 - row };
        // The snake of a layer turns round in every row of the walk, counted over all layers.
        let walked = k / side;
        let column = if walked.is_multiple_of(2) { rest % side } else { side - 1 - rest % side };
        [column, row, layer]
    };
    let index = |[column, row, layer]: [usize; 3]| {
        let row_in_walk = if layer.is_multiple_of(2) { row } else { side - 1 - row };
        let walked = layer * side + row_in_walk;
        let rest = if walked.is_multiple_of(2) { column } else { side - 1 - column };
        walked * side + rest
    };
    let count = side * side * side;
    let mut rotation = UnitQuaternion::identity();
    let mut truth = Vec::with_capacity(count);
    let mut pairs = Vec::with_capacity(count * 2);
    for k in 0..count {
        let at = node(k);
        let [x, y, z] = at.map(|n| n as f64 * params.spacing_m);
        let axis = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()][draw.below(3)];
        let quarter = std::f64::consts::FRAC_PI_2 * (draw.below(3) as f64 - 1.0);
        rotation *= UnitQuaternion::from_axis_angle(&axis, quarter);
        rotation.renormalize();
        truth.push(Se3::new(Vector3::new(x, y, z), rotation));
        if k > 0 {
            pairs.push((k - 1, k));
        }
        for axis in 0..3 {
            for step in [-1_isize, 1] {
                let mut beside = at;
                let Some(moved) = at[axis].checked_add_signed(step).filter(|&n| n < side) else {
                    continue;
                };
                beside[axis] = moved;
                let other = index(beside);
                if other + 1 < k && draw.uniform() < params.closure_probability {
                    pairs.push((other, k));
                }
            }
        }
    }
    measure(truth, &pairs, &params.noise, params.seed.wrapping_add(1))
}
