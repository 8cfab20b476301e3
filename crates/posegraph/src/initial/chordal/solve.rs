//! The two linear problems of the chordal initialisation.

use crate::factors::FactorGraph;
use crate::synchronize::measurements::{Measurements, Relative};
use crate::synchronize::rounding::nearest_rotation;
use crate::synchronize::sparse::{BlockCholesky, Part, Pattern};
use crate::synchronize::{Columns, Rigid};

/// `map_from_body` of every vertex by chordal initialisation: see the
/// [module](mod@crate::initial::chordal).
pub fn chordal<P: Rigid<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Vec<P> {
    let measurements = Measurements::new(graph);
    let pattern =
        Pattern::new(measurements.count, measurements.relatives.iter().map(|r| (r.from, r.to)));
    let held = held(graph, &measurements);
    let columns = chordal_columns(P::DIM, &measurements, &pattern, &held);
    columns.iter().map(P::from_columns).collect()
}

/// What stays where it is: vertices that the graph fixes, and the first of each component without.
pub(crate) fn held<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    measurements: &Measurements,
) -> Vec<Option<Columns>> {
    let components = measurements.components(|_| true);
    let given = |v: usize| graph.initial.get(v).copied().flatten().unwrap_or_else(P::identity);
    let mut held: Vec<Option<Columns>> = vec![None; measurements.count];
    let mut has_fixed = vec![false; measurements.count];
    for &v in graph.fixed.iter().filter(|&&v| v < measurements.count) {
        held[v] = Some(given(v).columns());
        has_fixed[components[v]] = true;
    }
    for v in 0..measurements.count {
        if components[v] == v && !has_fixed[v] {
            held[v] = Some(given(v).columns());
        }
    }
    held
}

pub(crate) fn chordal_columns(
    dim: usize,
    measurements: &Measurements,
    pattern: &Pattern,
    held: &[Option<Columns>],
) -> Vec<Columns> {
    let mut poses: Vec<Columns> = held.iter().map(|pose| pose.unwrap_or([[0.0; 3]; 4])).collect();
    rotations(dim, measurements, pattern, held, &mut poses);
    for (pose, held) in poses.iter_mut().zip(held) {
        if held.is_none() {
            *pose = nearest_rotation(dim, pose);
        }
    }
    translations(dim, measurements, pattern, held, &mut poses);
    poses
}

/// Minimises `Σ κ ‖R_j - R_i R̃_ij‖²` over matrices `R` of which the held ones are given.
fn rotations(
    dim: usize,
    measurements: &Measurements,
    pattern: &Pattern,
    held: &[Option<Columns>],
    poses: &mut [Columns],
) {
    let mut system = BlockCholesky::new(pattern, dim);
    let rows = system.rows();
    // Row k of a vertex's block is column k of its matrix; one right-hand side for each axis.
    let mut rhs = vec![0.0; rows * dim];
    for relative in &measurements.relatives {
        let Relative { from, to, rotation: weight, columns, .. } = relative;
        let (i, j) = (pattern.position[*from], pattern.position[*to]);
        for k in 0..dim {
            add_diagonal(&mut system, held, *from, i, k, *weight);
            add_diagonal(&mut system, held, *to, j, k, *weight);
        }
        if held[*from].is_none() && held[*to].is_none() {
            let pair = pattern.find(i, j);
            for l in 0..dim {
                for k in 0..dim {
                    // Row of `from`, column of `to`, or its transpose.
                    let (row, column) = if i > j { (l, k) } else { (k, l) };
                    system.add(Part::Below(pair), row, column, -weight * columns[k][l]);
                }
            }
        }
        for axis in 0..dim {
            let rhs = &mut rhs[axis * rows..][..rows];
            if let (Some(known), None) = (&held[*from], &held[*to]) {
                for k in 0..dim {
                    let value: f64 = (0..dim).map(|l| known[l][axis] * columns[k][l]).sum();
                    rhs[j * dim + k] += weight * value;
                }
            }
            if let (None, Some(known)) = (&held[*from], &held[*to]) {
                for l in 0..dim {
                    let value: f64 = (0..dim).map(|k| known[k][axis] * columns[k][l]).sum();
                    rhs[i * dim + l] += weight * value;
                }
            }
        }
    }
    if !solve(&mut system, pattern, held, dim, &mut rhs) {
        return;
    }
    for (v, pose) in poses.iter_mut().enumerate().filter(|(v, _)| held[*v].is_none()) {
        let at = pattern.position[v] * dim;
        for axis in 0..dim {
            for k in 0..dim {
                pose[k][axis] = rhs[axis * rows + at + k];
            }
        }
    }
}

/// Minimises `Σ τ ‖t_j - t_i - R_i t̃_ij‖²` over the translations that are not held.
fn translations(
    dim: usize,
    measurements: &Measurements,
    pattern: &Pattern,
    held: &[Option<Columns>],
    poses: &mut [Columns],
) {
    let mut system = BlockCholesky::new(pattern, 1);
    let rows = system.rows();
    let mut rhs = vec![0.0; rows * dim];
    for relative in &measurements.relatives {
        let Relative { from, to, translation: weight, columns, .. } = relative;
        let (i, j) = (pattern.position[*from], pattern.position[*to]);
        add_diagonal(&mut system, held, *from, i, 0, *weight);
        add_diagonal(&mut system, held, *to, j, 0, *weight);
        if held[*from].is_none() && held[*to].is_none() {
            system.add(Part::Below(pattern.find(i, j)), 0, 0, -weight);
        }
        for axis in 0..dim {
            let leap: f64 = (0..dim).map(|l| poses[*from][l][axis] * columns[dim][l]).sum();
            let rhs = &mut rhs[axis * rows..][..rows];
            if held[*to].is_none() {
                let known = held[*from].map_or(0.0, |known| known[dim][axis]);
                rhs[j] += weight * (leap + known);
            }
            if held[*from].is_none() {
                let known = held[*to].map_or(0.0, |known| known[dim][axis]);
                rhs[i] += weight * (known - leap);
            }
        }
    }
    if !solve(&mut system, pattern, held, 1, &mut rhs) {
        return;
    }
    for (v, pose) in poses.iter_mut().enumerate().filter(|(v, _)| held[*v].is_none()) {
        for axis in 0..dim {
            pose[dim][axis] = rhs[axis * rows + pattern.position[v]];
        }
    }
}

fn add_diagonal(
    system: &mut BlockCholesky,
    held: &[Option<Columns>],
    vertex: usize,
    at: usize,
    k: usize,
    weight: f64,
) {
    if held[vertex].is_none() {
        system.add(Part::Diagonal(at), k, k, weight);
    }
}

/// Held vertices get a diagonal of 1 and a right-hand side of 0. A vertex that no positive weight
/// reaches makes the matrix singular; a small multiple of the identity then decides.
fn solve(
    system: &mut BlockCholesky,
    pattern: &Pattern,
    held: &[Option<Columns>],
    size: usize,
    rhs: &mut [f64],
) -> bool {
    for (v, _) in held.iter().enumerate().filter(|(_, held)| held.is_some()) {
        for k in 0..size {
            system.add(Part::Diagonal(pattern.position[v]), k, k, 1.0);
        }
    }
    let mut solved = system.factorize();
    if !solved {
        let mut shift = 1e-12 * system.largest_diagonal();
        for _ in 0..4 {
            for v in 0..pattern.count() {
                for k in 0..size {
                    system.add(Part::Diagonal(v), k, k, shift);
                }
            }
            solved = system.factorize();
            if solved {
                break;
            }
            shift *= 100.0;
        }
    }
    if solved {
        system.solve(rhs);
    }
    solved
}
