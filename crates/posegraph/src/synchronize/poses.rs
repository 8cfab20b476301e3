//! Between poses and the stacked matrix.

use super::problem::Problem;
use super::{Columns, Rigid};

/// Stacks poses at rank `d`.
pub(crate) fn stack<const B: usize>(problem: &Problem<B>, poses: &[Columns]) -> Vec<f64> {
    let (rows, d) = (problem.rows(), B - 1);
    let mut x = vec![0.0; rows * d];
    for (vertex, pose) in poses.iter().enumerate() {
        let at = problem.pattern.position[vertex] * B;
        for c in 0..d {
            for k in 0..B {
                x[c * rows + at + k] = pose[k][c];
            }
        }
    }
    x
}

/// Poses of a point of rank `d`.
pub(crate) fn unstack<const B: usize>(problem: &Problem<B>, x: &[f64]) -> Vec<Columns> {
    let (rows, d) = (problem.rows(), B - 1);
    (0..problem.pattern.count())
        .map(|vertex| {
            let at = problem.pattern.position[vertex] * B;
            let mut pose = [[0.0; 3]; 4];
            for c in 0..d {
                for k in 0..B {
                    pose[k][c] = x[c * rows + at + k];
                }
            }
            pose
        })
        .collect()
}

/// Moves every component as a whole, so that its first vertex stands where `reference` has it.
///
/// `components` holds the first vertex of the component of each vertex.
pub(crate) fn align<P: Rigid<D>, const D: usize>(
    poses: &mut [P],
    components: &[usize],
    reference: impl Fn(usize) -> P,
) {
    let motions: Vec<Option<P>> = components
        .iter()
        .enumerate()
        .map(|(v, &first)| (v == first).then(|| reference(v).compose(&poses[v].inverse())))
        .collect();
    for (pose, &first) in poses.iter_mut().zip(components) {
        if let Some(motion) = &motions[first] {
            *pose = motion.compose(pose);
        }
    }
}
