//! SE-Sync's quadratic form over poses with orthonormal columns in a space of `r ≥ d` dimensions.

use super::measurements::Measurements;
use super::sparse::Pattern;

/// A block of `B = d + 1` rows and columns, row by row.
pub(crate) type Block<const B: usize> = [[f64; B]; B];

struct Edge<const B: usize> {
    from: usize,
    to: usize,
    /// The measured motion as a homogeneous matrix.
    motion: Block<B>,
    /// Weight of each column of `[R t]`.
    weights: [f64; B],
}

/// The quadratic form `F(X) = ⟨X, M X⟩ = Σ ‖(X_j - X_i T̃_ij) Ω_ij^½‖²`.
///
/// `X` stacks, for each vertex in the order of the pattern, the `d` columns of `R_i` and `t_i` as
/// `B = d + 1` rows of length `r`; it is kept column after column (`r` columns of `rows()` numbers).
pub(crate) struct Problem<const B: usize> {
    pub(crate) pattern: Pattern,
    edges: Vec<Edge<B>>,
    diagonal: Vec<Block<B>>,
    /// The block in row `high`, column `low` of each pair.
    below: Vec<Block<B>>,
    /// One vertex of its component, for each vertex; new indices.
    pub(crate) component: Vec<usize>,
    /// The same with measurements that weigh no translation left out.
    pub(crate) anchor: Vec<usize>,
    /// `Σ κ d + τ ‖t̃‖²`: the size of the terms that the cost is the difference of.
    pub(crate) scale: f64,
}

impl<const B: usize> Problem<B> {
    pub(crate) fn new(measurements: &Measurements) -> Self {
        let d = B - 1;
        let relatives = &measurements.relatives;
        let pattern = Pattern::new(measurements.count, relatives.iter().map(|r| (r.from, r.to)));
        let renumbered = |components: Vec<usize>| -> Vec<usize> {
            pattern.vertex.iter().map(|&v| pattern.position[components[v]]).collect()
        };
        let component = renumbered(measurements.components(|_| true));
        let anchor = renumbered(measurements.components(|r| r.translation > 0.0));
        let mut scale = 0.0;
        let mut diagonal = vec![[[0.0; B]; B]; pattern.count()];
        let mut below = vec![[[0.0; B]; B]; pattern.pairs.len()];
        let edges: Vec<Edge<B>> = relatives
            .iter()
            .map(|relative| {
                let mut motion = [[0.0; B]; B];
                let mut weights = [relative.rotation; B];
                weights[d] = relative.translation;
                for (k, column) in relative.columns.iter().take(B).enumerate() {
                    for l in 0..d {
                        motion[l][k] = column[l];
                    }
                }
                let t = relative.columns[d];
                motion[d][d] = 1.0;
                scale += relative.rotation * d as f64
                    + relative.translation * t.iter().map(|x| x * x).sum::<f64>();
                let position = &pattern.position;
                Edge { from: position[relative.from], to: position[relative.to], motion, weights }
            })
            .collect();
        for edge in &edges {
            let pair = pattern.find(edge.from, edge.to);
            for a in 0..B {
                diagonal[edge.to][a][a] += edge.weights[a];
                for b in 0..B {
                    let mut sum = 0.0;
                    for k in 0..B {
                        sum += edge.motion[a][k] * edge.weights[k] * edge.motion[b][k];
                    }
                    diagonal[edge.from][a][b] += sum;
                    let entry = edge.motion[a][b] * edge.weights[b];
                    if edge.from > edge.to {
                        below[pair][a][b] -= entry;
                    } else {
                        below[pair][b][a] -= entry;
                    }
                }
            }
        }
        Self { pattern, edges, diagonal, below, component, anchor, scale }
    }

    /// Rows of `X`.
    pub(crate) fn rows(&self) -> usize {
        self.pattern.count() * B
    }

    /// The cost `F(X)`, summed over measurements.
    pub(crate) fn cost(&self, x: &[f64]) -> f64 {
        let n = self.rows();
        let mut cost = 0.0;
        for x in x.chunks_exact(n) {
            for edge in &self.edges {
                let gap = edge.gap(x);
                for k in 0..B {
                    cost += edge.weights[k] * gap[k] * gap[k];
                }
            }
        }
        cost
    }

    /// The cost, and `M X` into `out`; from the residuals, so that both stay exact where they are small.
    pub(crate) fn cost_and_product(&self, x: &[f64], out: &mut [f64]) -> f64 {
        let n = self.rows();
        let mut cost = 0.0;
        out.fill(0.0);
        for (x, out) in x.chunks_exact(n).zip(out.chunks_exact_mut(n)) {
            for edge in &self.edges {
                let mut gap = edge.gap(x);
                for k in 0..B {
                    let weighted = edge.weights[k] * gap[k];
                    cost += weighted * gap[k];
                    gap[k] = weighted;
                    out[edge.to * B + k] += weighted;
                }
                for l in 0..B {
                    let mut sum = 0.0;
                    for k in 0..B {
                        sum += edge.motion[l][k] * gap[k];
                    }
                    out[edge.from * B + l] -= sum;
                }
            }
        }
        cost
    }

    /// The largest diagonal entries of `M` in the rows of rotations and in those of translations.
    pub(crate) fn largest_diagonal(&self) -> (f64, f64) {
        self.diagonal.iter().fold((0.0_f64, 0.0_f64), |(r, t), block| {
            let rotation = (0..B - 1).map(|k| block[k][k]).fold(r, f64::max);
            (rotation, t.max(block[B - 1][B - 1]))
        })
    }

    /// Blocks of `M` for the certificate: the diagonal one of a vertex.
    pub(crate) fn diagonal(&self) -> &[Block<B>] {
        &self.diagonal
    }

    /// Blocks of `M`: row `high`, column `low` of each pair of the pattern.
    pub(crate) fn below(&self) -> &[Block<B>] {
        &self.below
    }
}

impl<const B: usize> Edge<B> {
    /// `x_j - T̃ᵀ x_i`, one number for each column of `[R t]`.
    #[inline]
    fn gap(&self, x: &[f64]) -> [f64; B] {
        let (from, to) = (self.from * B, self.to * B);
        let mut gap = [0.0; B];
        for k in 0..B {
            let mut sum = x[to + k];
            for l in 0..B {
                sum -= self.motion[l][k] * x[from + l];
            }
            gap[k] = sum;
        }
        gap
    }
}
