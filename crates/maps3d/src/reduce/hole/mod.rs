//! Triangulation of the hole that a removed vertex leaves (\[Mos15\] 3.6).
//!
//! | file | method |
//! |---|---|
//! | `ear.rs` | ear clipping (3.6.1), shortest diagonal first |
//! | `optimal.rs` | least total length of diagonals, by dynamic programming (table 5.2) |
//! | `monotone.rs` | partition into monotone polygons, then their triangulation (3.6.2, 3.6.3) |
//! | `delaunay.rs` | constrained Delaunay: ears, then flips (3.6.4) |
//!
//! A hole is a simple polygon of pixels of positive turn; neighbouring sides may lie on one line.
//! All methods decide in whole numbers, and make `n - 2` triangles of positive turn.

mod delaunay;
mod ear;
mod monotone;
mod optimal;

use crate::image::Pixel;

/// How a hole is triangulated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HoleMethod {
    /// Ear clipping, the ear of the shortest diagonal first.
    #[default]
    EarClipping,
    /// The least total length of diagonals.
    OptimalEdgeLength,
    /// Partition into monotone polygons, the thesis's choice.
    Monotone,
    /// Constrained Delaunay.
    ConstrainedDelaunay,
}

impl HoleMethod {
    /// All methods.
    pub const ALL: [Self; 4] =
        [Self::EarClipping, Self::OptimalEdgeLength, Self::Monotone, Self::ConstrainedDelaunay];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::EarClipping => "ear-clipping",
            Self::OptimalEdgeLength => "optimal-edge-length",
            Self::Monotone => "monotone",
            Self::ConstrainedDelaunay => "constrained-delaunay",
        }
    }

    /// The method of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }
}

/// A triangle of a hole: places in the list of its pixels.
pub(super) type Piece = [u16; 3];

/// Room that the methods use again.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub pieces: Vec<Piece>,
    ear: ear::Ears,
    optimal: optimal::Table,
    monotone: monotone::Sweep,
}

/// The most pixels around a hole; a vertex with more neighbours is not removed. Places in a hole are
/// added to each other in 16 bits.
pub(super) const LARGEST: usize = (u16::MAX / 2) as usize;

/// Triangulates a hole; the triangles are left in `scratch.pieces`.
///
/// `polygon` has 3 to [`LARGEST`] pixels.
pub(super) fn triangulate(method: HoleMethod, polygon: &[Pixel], scratch: &mut Scratch) {
    scratch.pieces.clear();
    match (method, polygon.len()) {
        (_, 3) => scratch.pieces.push([0, 1, 2]),
        (HoleMethod::EarClipping, _) => ear::clip(polygon, &mut scratch.ear, &mut scratch.pieces),
        (HoleMethod::OptimalEdgeLength, ..=optimal::LARGEST) => {
            optimal::triangulate(polygon, &mut scratch.optimal, &mut scratch.pieces);
        }
        (HoleMethod::Monotone, _) => {
            monotone::triangulate(polygon, &mut scratch.monotone, &mut scratch.pieces);
        }
        (HoleMethod::ConstrainedDelaunay | HoleMethod::OptimalEdgeLength, _) => {
            ear::clip(polygon, &mut scratch.ear, &mut scratch.pieces);
            delaunay::flip(polygon, &mut scratch.pieces);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangulate::orient;
    use proptest::prelude::*;

    /// A polygon that a pixel in its middle sees whole, with some sides on one line.
    fn star() -> impl Strategy<Value = Vec<Pixel>> {
        prop::collection::btree_set((0..9_u16, 0..9_u16), 3..24).prop_filter_map("a star", |set| {
            let middle = [4_i64, 4];
            let mut points: Vec<[i64; 2]> = set
                .into_iter()
                .map(|(c, r)| [i64::from(c), i64::from(r)])
                .filter(|p| *p != middle)
                .collect();
            let at = |p: &[i64; 2]| (p[0] - middle[0], p[1] - middle[1]);
            let half = |(x, y): (i64, i64)| y < 0 || (y == 0 && x < 0);
            points.sort_by(|p, q| {
                let (p, q) = (at(p), at(q));
                half(p)
                    .cmp(&half(q))
                    .then((q.0 * p.1 - q.1 * p.0).cmp(&0))
                    .then((p.0 * p.0 + p.1 * p.1).cmp(&(q.0 * q.0 + q.1 * q.1)))
            });
            points.dedup_by(|b, a| {
                let (p, q) = (at(a), at(b));
                half(p) == half(q) && q.0 * p.1 == q.1 * p.0
            });
            let n = points.len();
            let turns = (0..n).all(|i| {
                let (p, q) = (at(&points[i]), at(&points[(i + 1) % n]));
                p.0 * q.1 - p.1 * q.0 > 0
            });
            (n >= 3 && turns).then(|| points.iter().map(|p| p.map(|x| x as u16)).collect())
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]
        #[test]
        fn every_method_covers_the_hole_once(polygon in star()) {
            let area: i64 = (1..polygon.len() - 1)
                .map(|i| orient(polygon[0], polygon[i], polygon[i + 1]))
                .sum();
            let mut lengths = Vec::new();
            for method in HoleMethod::ALL {
                let mut scratch = Scratch::default();
                triangulate(method, &polygon, &mut scratch);
                let n = polygon.len();
                prop_assert_eq!(scratch.pieces.len(), n - 2, "{:?}", method);
                let mut covered = 0;
                let mut sides = std::collections::BTreeSet::new();
                let mut length = 0.0;
                for piece in &scratch.pieces {
                    let [a, b, c] = piece.map(|i| polygon[usize::from(i)]);
                    let turn = orient(a, b, c);
                    prop_assert!(turn > 0, "{:?} {:?}", method, piece);
                    covered += turn;
                    for i in 0..3 {
                        let (p, q) = (piece[i], piece[(i + 1) % 3]);
                        prop_assert!(sides.insert((p, q)));
                        let [p, q] = [p, q].map(|i| polygon[usize::from(i)].map(f64::from));
                        length += (p[0] - q[0]).hypot(p[1] - q[1]);
                    }
                }
                prop_assert_eq!(covered, area);
                for i in 0..n {
                    prop_assert!(sides.contains(&(i as u16, ((i + 1) % n) as u16)));
                }
                lengths.push(length);
            }
            prop_assert!(lengths.iter().all(|l| *l >= lengths[1] - 1e-9), "{:?}", lengths);
        }
    }
}
