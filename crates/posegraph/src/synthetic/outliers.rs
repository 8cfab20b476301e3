//! Loop closures that are wrong.

use pose::nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};

use super::measure::Draw;
use crate::factors::{Factor, FactorGraph};
use crate::synchronize::Rigid;

/// A graph with wrong loop closures among its own.
#[derive(Clone, Debug, PartialEq)]
pub struct WithOutliers<P, const D: usize> {
    /// The graph; wrong closures stand behind all other factors.
    pub graph: FactorGraph<P, D>,
    /// Indices of the wrong factors, ascending.
    pub wrong: Vec<usize>,
}

/// What wrong loop closures look like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrong {
    /// As between two random poses in the box around the map: nothing speaks for them.
    #[default]
    Anywhere,
    /// As between two poses at the same place: two places that look alike are taken for one. Translations
    /// are normal with a deviation of 0.3 m, rotations of 10 degrees around each axis.
    Alike,
}

/// Metres, of each axis.
const ALIKE_M: f64 = 0.3;

/// Radians, around each axis.
const ALIKE_RAD: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// Adds wrong loop closures as between random poses until they are this share of all loop closures.
///
/// [`with_wrong_closures`] of [`Wrong::Anywhere`].
pub fn with_outliers<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    map: &[P],
    share: f64,
    seed: u64,
) -> WithOutliers<P, D> {
    with_wrong_closures(graph, map, share, seed, Wrong::Anywhere)
}

/// Adds wrong loop closures until they are this share of all loop closures.
///
/// Each joins two random vertices that are not neighbours in the order of vertices; its information is
/// that of a random genuine closure. `map` holds `map_from_body` of every vertex. `share` is taken into
/// 0..=0.99; a graph without closures stays as it is, for there is no information to copy.
pub fn with_wrong_closures<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    map: &[P],
    share: f64,
    seed: u64,
    wrong: Wrong,
) -> WithOutliers<P, D> {
    let mut graph = graph.clone();
    let vertices = graph.ids.len().min(map.len());
    let genuine: Vec<usize> = (0..graph.factors.len())
        .filter(|&index| graph.factors[index].from.abs_diff(graph.factors[index].to) > 1)
        .collect();
    let first = graph.factors.len();
    if genuine.is_empty() || vertices < 3 {
        return WithOutliers { graph, wrong: Vec::new() };
    }
    let share = share.clamp(0.0, 0.99);
    let count = (genuine.len() as f64 * share / (1.0 - share)).round() as usize;
    let (low, high) = bounds(map);
    let mut draw = Draw::new(seed);
    for _ in 0..count {
        let (from, to) = loop {
            let (a, b) = (draw.below(vertices), draw.below(vertices));
            if a.abs_diff(b) > 1 {
                break (a.min(b), a.max(b));
            }
        };
        let from_from_to = match wrong {
            Wrong::Anywhere => {
                let [a, b] = std::array::from_fn(|_| anywhere::<P, D>(&mut draw, low, high));
                a.between(&b)
            }
            Wrong::Alike => {
                let step = SVector::from_fn(|k, _| {
                    draw.normal() * if k < P::DIM { ALIKE_M } else { ALIKE_RAD }
                });
                P::identity().retract(&step)
            }
        };
        let information = graph.factors[genuine[draw.below(genuine.len())]].information;
        graph.factors.push(Factor { from, to, from_from_to, information });
    }
    let wrong = (first..graph.factors.len()).collect();
    WithOutliers { graph, wrong }
}

/// The corners of the box around all positions.
fn bounds<P: Rigid<D>, const D: usize>(map: &[P]) -> (Vector3<f64>, Vector3<f64>) {
    let positions = map.iter().map(|pose| Vector3::from(pose.columns()[P::DIM]));
    let (low, high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    positions.fold((low, high), |(low, high), at| (low.inf(&at), high.sup(&at)))
}

/// A random pose within a box, all directions alike.
fn anywhere<P: Rigid<D>, const D: usize>(
    draw: &mut Draw,
    low: Vector3<f64>,
    high: Vector3<f64>,
) -> P {
    let share = Vector3::from_fn(|_, _| draw.uniform());
    let at = low + (high - low).component_mul(&share);
    let mut columns = [[0.0; 3]; 4];
    if P::DIM == 2 {
        let (sin, cos) = (std::f64::consts::TAU * draw.uniform()).sin_cos();
        columns[0] = [cos, sin, 0.0];
        columns[1] = [-sin, cos, 0.0];
    } else {
        // Four normal numbers point anywhere on the sphere of unit quaternions.
        let [w, x, y, z] = std::array::from_fn(|_| draw.normal());
        let turn = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        let matrix = turn.to_rotation_matrix();
        for (column, out) in columns.iter_mut().take(3).enumerate() {
            *out = matrix.matrix().column(column).into_owned().into();
        }
    }
    columns[P::DIM] = at.into();
    P::from_columns(&columns)
}
