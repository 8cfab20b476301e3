//! Blocks of the inverse from the factor.

use std::collections::BTreeMap;

use pose::nalgebra::{DMatrix, SMatrix};

use super::tree::{Clique, CliqueTree, HELD};

impl<const D: usize> CliqueTree<D> {
    /// The blocks of the inverse in the columns of `variable` and the rows of each of `wanted`; 0 for
    /// those that are held.
    ///
    /// Solves for unit columns on the ways to the roots only: going up, only they are not 0; coming
    /// down, only they are asked for. Cost: `D` times the numbers stored along the ways.
    pub(crate) fn inverse_blocks(
        &self,
        variable: usize,
        wanted: &[usize],
    ) -> Vec<SMatrix<f64, D, D>> {
        if !self.has(variable) {
            return vec![SMatrix::zeros(); wanted.len()];
        }
        let mut forward: BTreeMap<usize, SMatrix<f64, D, D>> = BTreeMap::new();
        forward.insert(variable, SMatrix::identity());
        for at in self.way_up(variable) {
            let clique = &self.cliques[at];
            let width = clique.frontals.len() * D;
            let mut x = gathered(clique, &forward);
            for column in 0..width {
                let numbers = column_of(clique, column, x.nrows());
                for k in 0..D {
                    let solved = x[(column, k)] / numbers[column];
                    x[(column, k)] = solved;
                    for row in column + 1..numbers.len() {
                        x[(row, k)] -= numbers[row] * solved;
                    }
                }
            }
            for (place, &variable) in clique.frontals.iter().chain(&clique.separator).enumerate() {
                forward.insert(variable, x.fixed_view::<D, D>(place * D, 0).into_owned());
            }
        }
        // Blocks that are known, over all ways: shared upper parts are solved once.
        let mut known: BTreeMap<usize, SMatrix<f64, D, D>> = BTreeMap::new();
        for &target in wanted.iter().filter(|target| self.has(**target)) {
            let mut way = self.way_up(target);
            way.reverse();
            for at in way {
                let clique = &self.cliques[at];
                if known.contains_key(&clique.frontals[0]) {
                    continue;
                }
                let width = clique.frontals.len();
                let mut x = gathered(clique, &known);
                for (place, variable) in clique.frontals.iter().enumerate() {
                    let block = forward.get(variable).copied().unwrap_or_else(SMatrix::zeros);
                    x.fixed_view_mut::<D, D>(place * D, 0).copy_from(&block);
                }
                for column in (0..width * D).rev() {
                    let numbers = column_of(clique, column, x.nrows());
                    for k in 0..D {
                        let mut value = x[(column, k)];
                        for row in column + 1..numbers.len() {
                            value -= numbers[row] * x[(row, k)];
                        }
                        x[(column, k)] = value / numbers[column];
                    }
                }
                for (place, &variable) in clique.frontals.iter().enumerate() {
                    known.insert(variable, x.fixed_view::<D, D>(place * D, 0).into_owned());
                }
            }
        }
        wanted
            .iter()
            .map(|target| known.get(target).copied().unwrap_or_else(SMatrix::zeros))
            .collect()
    }

    /// The cliques from that of a variable up to its root.
    fn way_up(&self, variable: usize) -> Vec<usize> {
        let mut way = Vec::new();
        let mut at = self.clique_of[variable];
        while at != HELD {
            way.push(at);
            at = self.cliques[at].parent;
        }
        way
    }

    /// The diagonal blocks of the inverse of all variables, by vertex; 0 for those that are held.
    ///
    /// Cost: as the factorisation.
    pub(crate) fn diagonal_of_inverse(&self) -> Vec<SMatrix<f64, D, D>> {
        let mut blocks = vec![SMatrix::zeros(); self.clique_of.len()];
        self.each_clique(|clique, _, all| {
            for (at, &variable) in clique.frontals.iter().enumerate() {
                blocks[variable] = all.fixed_view::<D, D>(at * D, at * D).into_owned();
            }
        });
        blocks
    }

    /// The blocks of the inverse in the columns of the first and the rows of the second variable of each
    /// pair; 0 where one of them is held, and where no clique holds both.
    ///
    /// Variables that a term joins always share a clique. Cost: as the factorisation.
    pub(crate) fn inverse_within_cliques(
        &self,
        pairs: &[(usize, usize)],
    ) -> Vec<SMatrix<f64, D, D>> {
        let mut of_variable: Vec<Vec<usize>> = vec![Vec::new(); self.clique_of.len()];
        for (index, &(a, b)) in pairs.iter().enumerate() {
            of_variable[a].push(index);
            of_variable[b].push(index);
        }
        let mut blocks = vec![SMatrix::zeros(); pairs.len()];
        // The clique that each variable was placed in last, as a stamp for `place`.
        let mut placed = vec![HELD; self.clique_of.len()];
        self.each_clique(|clique, place, all| {
            let own = clique.frontals[0];
            for &variable in clique.frontals.iter().chain(&clique.separator) {
                placed[variable] = own;
            }
            for &index in clique.frontals.iter().flat_map(|&variable| &of_variable[variable]) {
                let (a, b) = pairs[index];
                if placed[a] == own && placed[b] == own {
                    blocks[index] = all.fixed_view::<D, D>(place[b], place[a]).into_owned();
                }
            }
        });
        blocks
    }

    /// Calls back with each clique, the rows at which its variables stand, and its covariance.
    ///
    /// From the roots down: with `Σ_SS` of the separator, which is part of the parent's, and
    /// `Y = L_S L_F⁻¹`, the frontals have `Σ_SF = -Σ_SS Y` and `Σ_FF = L_F⁻ᵀ L_F⁻¹ - Yᵀ Σ_SF`
    /// (Takahashi et al. 1973; Kaess and Dellaert 2009).
    fn each_clique(&self, mut told: impl FnMut(&Clique, &[usize], &DMatrix<f64>)) {
        let mut place = vec![0; self.clique_of.len()];
        let mut open: Vec<(usize, DMatrix<f64>)> =
            self.roots.iter().map(|&root| (root, DMatrix::zeros(0, 0))).collect();
        while let Some((at, of_separator)) = open.pop() {
            let clique = &self.cliques[at];
            let (width, rest) = (clique.frontals.len() * D, clique.separator.len() * D);
            let all = covariance_of_clique(clique, width, rest, of_separator);
            for (at, &variable) in clique.frontals.iter().chain(&clique.separator).enumerate() {
                place[variable] = at * D;
            }
            told(clique, &place, &all);
            for &child in &clique.children {
                let separator = &self.cliques[child].separator;
                let mut part = DMatrix::zeros(separator.len() * D, separator.len() * D);
                for (j, &column) in separator.iter().enumerate() {
                    for (i, &row) in separator.iter().enumerate() {
                        let block = all.fixed_view::<D, D>(place[row], place[column]);
                        part.fixed_view_mut::<D, D>(i * D, j * D).copy_from(&block);
                    }
                }
                open.push((child, part));
            }
        }
    }
}

/// A column of the factor of a clique.
fn column_of(clique: &Clique, column: usize, rows: usize) -> &[f64] {
    &clique.factor[column * rows..(column + 1) * rows]
}

/// What is known of the variables of a clique, one block beneath the other; 0 for the others.
fn gathered<const D: usize>(
    clique: &Clique,
    known: &BTreeMap<usize, SMatrix<f64, D, D>>,
) -> DMatrix<f64> {
    let count = clique.frontals.len() + clique.separator.len();
    let mut x = DMatrix::zeros(count * D, D);
    for (place, variable) in clique.frontals.iter().chain(&clique.separator).enumerate() {
        if let Some(block) = known.get(variable) {
            x.fixed_view_mut::<D, D>(place * D, 0).copy_from(block);
        }
    }
    x
}

/// The covariance of frontals and separator of a clique, given that of its separator.
fn covariance_of_clique(
    clique: &Clique,
    width: usize,
    rest: usize,
    of_separator: DMatrix<f64>,
) -> DMatrix<f64> {
    let rows = width + rest;
    let factor = DMatrix::from_column_slice(rows, width, &clique.factor);
    let mut inverse = DMatrix::identity(width, width);
    factor.view((0, 0), (width, width)).solve_lower_triangular_mut(&mut inverse);
    let mut all = DMatrix::zeros(rows, rows);
    let mut of_frontals = inverse.tr_mul(&inverse);
    if rest > 0 {
        let reach = factor.view((width, 0), (rest, width)) * &inverse;
        let cross = -(&of_separator * &reach);
        of_frontals -= reach.tr_mul(&cross);
        all.view_mut((width, 0), (rest, width)).copy_from(&cross);
        all.view_mut((0, width), (width, rest)).copy_from(&cross.transpose());
        all.view_mut((width, width), (rest, rest)).copy_from(&of_separator);
    }
    all.view_mut((0, 0), (width, width)).copy_from(&of_frontals);
    all
}
