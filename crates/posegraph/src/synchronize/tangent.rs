//! A basis of the tangent space at each vertex.

use pose::nalgebra::DMatrix;

use super::problem::{Block, Problem};

/// An orthonormal basis of the tangent space, vertex by vertex.
///
/// A basis vector is a block of `B` rows of length `r`. First come turns within the span of a
/// rotation's rows (`d (d - 1) / 2`), then turns out of it (`(r - d) d`), then translations (`r`).
pub(crate) struct Tangent<const B: usize> {
    rank: usize,
    rows: usize,
    /// For each vertex, basis vector, row and column.
    basis: Vec<f64>,
}

impl<const B: usize> Tangent<B> {
    /// Dimension of the tangent space of a vertex at a rank.
    pub(crate) fn size(rank: usize) -> usize {
        let d = B - 1;
        d * (d - 1) / 2 + (rank - d) * d + rank
    }

    /// Dimension of the tangent space of a vertex.
    pub(crate) fn width(&self) -> usize {
        Self::size(self.rank)
    }

    /// Whether a basis vector turns a rotation (or else moves a translation).
    pub(crate) fn turns(&self, index: usize) -> bool {
        index < self.width() - self.rank
    }

    pub(crate) fn new(rows: usize, x: &[f64]) -> Self {
        let (d, rank) = (B - 1, x.len() / rows);
        let (size, stride) = (Self::size(rank), B * rank);
        let mut basis = vec![0.0; rows / B * size * stride];
        for (vertex, basis) in basis.chunks_exact_mut(size * stride).enumerate() {
            let row = |a: usize, c: usize| x[c * rows + vertex * B + a];
            let mut vectors = basis.chunks_exact_mut(stride);
            let mut next = || vectors.next().expect("the size counts every basis vector");
            for a in 0..d {
                for b in 0..a {
                    let vector = next();
                    for c in 0..rank {
                        vector[a * rank + c] = row(b, c) * std::f64::consts::FRAC_1_SQRT_2;
                        vector[b * rank + c] = -row(a, c) * std::f64::consts::FRAC_1_SQRT_2;
                    }
                }
            }
            if rank > d {
                let span = DMatrix::from_fn(rank, d, |c, a| row(a, c));
                for outside in complement(&span) {
                    for a in 0..d {
                        next()[a * rank..(a + 1) * rank].copy_from_slice(&outside);
                    }
                }
            }
            for c in 0..rank {
                next()[d * rank + c] = 1.0;
            }
        }
        Self { rank, rows, basis }
    }

    fn of(&self, vertex: usize) -> &[f64] {
        let length = self.width() * B * self.rank;
        &self.basis[vertex * length..][..length]
    }

    /// Coordinates of a stacked matrix: its products with the basis.
    pub(crate) fn coordinates(&self, g: &[f64]) -> Vec<f64> {
        let (rank, rows) = (self.rank, self.rows);
        let mut out = Vec::with_capacity(rows / B * self.width());
        for vertex in 0..rows / B {
            for vector in self.of(vertex).chunks_exact(B * rank) {
                let mut sum = 0.0;
                for a in 0..B {
                    for c in 0..rank {
                        sum += vector[a * rank + c] * g[c * rows + vertex * B + a];
                    }
                }
                out.push(sum);
            }
        }
        out
    }

    /// The stacked matrix with these coordinates.
    pub(crate) fn vector(&self, coordinates: &[f64]) -> Vec<f64> {
        let (rank, rows) = (self.rank, self.rows);
        let mut out = vec![0.0; rows * rank];
        for (vertex, coordinates) in coordinates.chunks_exact(self.width()).enumerate() {
            for (vector, &share) in self.of(vertex).chunks_exact(B * rank).zip(coordinates) {
                for a in 0..B {
                    for c in 0..rank {
                        out[c * rows + vertex * B + a] += share * vector[a * rank + c];
                    }
                }
            }
        }
        out
    }

    /// Sets the coordinates of the vertices that stand still to 0.
    pub(crate) fn hold(&self, problem: &Problem<B>, coordinates: &mut [f64]) {
        for (vertex, coordinates) in coordinates.chunks_exact_mut(self.width()).enumerate() {
            if problem.component[vertex] == vertex {
                coordinates.fill(0.0);
            }
        }
    }

    /// `⟨e, S f⟩` for basis vectors `e` of one vertex and `f` of another; `S` acts on rows.
    pub(crate) fn reduce(&self, left: usize, right: usize, s: &Block<B>, out: &mut [f64]) {
        let (rank, size, stride) = (self.rank, self.width(), B * self.rank);
        let (left, right) = (self.of(left), self.of(right));
        let mut turned = vec![0.0; stride];
        for (f, vector) in right.chunks_exact(stride).enumerate() {
            for a in 0..B {
                for c in 0..rank {
                    turned[a * rank + c] = (0..B).map(|b| s[a][b] * vector[b * rank + c]).sum();
                }
            }
            for (e, vector) in left.chunks_exact(stride).enumerate() {
                out[e * size + f] = vector.iter().zip(&turned).map(|(x, y)| x * y).sum();
            }
        }
    }
}

/// An orthonormal basis of what is orthogonal to orthonormal columns, from the axes (Gram-Schmidt).
fn complement(span: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let rank = span.nrows();
    let mut found: Vec<Vec<f64>> = Vec::new();
    let mut used = vec![false; rank];
    while found.len() < rank - span.ncols() {
        // The axis that is farthest from what is there already keeps the most of itself.
        let mut best: Option<(f64, usize, Vec<f64>)> = None;
        for axis in (0..rank).filter(|&axis| !used[axis]) {
            let mut v = vec![0.0; rank];
            v[axis] = 1.0;
            for _ in 0..2 {
                for column in span.column_iter() {
                    let share: f64 = column.iter().zip(&v).map(|(a, b)| a * b).sum();
                    v.iter_mut().zip(column.iter()).for_each(|(v, c)| *v -= share * c);
                }
                for other in &found {
                    let share: f64 = other.iter().zip(&v).map(|(a, b)| a * b).sum();
                    v.iter_mut().zip(other).for_each(|(v, o)| *v -= share * o);
                }
            }
            let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            if best.as_ref().is_none_or(|(most, ..)| norm > *most) {
                best = Some((norm, axis, v));
            }
        }
        let (norm, axis, mut v) = best.expect("there are as many axes as dimensions");
        used[axis] = true;
        v.iter_mut().for_each(|x| *x /= norm);
        found.push(v);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::Tangent;
    use crate::synchronize::stiefel::{orthonormalise, retract};

    #[test]
    fn the_basis_is_orthonormal_and_stays_on_the_manifold_to_first_order() {
        for rank in [3, 4, 5, 7] {
            let rows = 3 * 4;
            let mut x: Vec<f64> =
                (0..rows * rank).map(|k| ((k * 29 + 7) % 23) as f64 - 11.0).collect();
            orthonormalise::<4>(rows, &mut x);
            let tangent = Tangent::<4>::new(rows, &x);
            let size = rows / 4 * Tangent::<4>::size(rank);
            for k in 0..size {
                let mut unit = vec![0.0; size];
                unit[k] = 1.0;
                let vector = tangent.vector(&unit);
                let back = tangent.coordinates(&vector);
                for (j, entry) in back.iter().enumerate() {
                    assert!((entry - unit[j]).abs() < 1e-12, "rank {rank}: {k} {j}");
                }
                let small: Vec<f64> = vector.iter().map(|v| 1e-5 * v).collect();
                let moved = retract::<4>(rows, &x, &small);
                for (index, y) in moved.iter().enumerate() {
                    assert!((y - x[index] - small[index]).abs() < 1e-9);
                }
            }
        }
    }
}
