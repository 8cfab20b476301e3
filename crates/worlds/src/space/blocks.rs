//! Right-angled places: everything is solid until it is carved, and may be filled again.

use std::collections::BTreeMap;

use geometry::{Point3, Vector3};

/// Two cuts nearer than this are one, metres.
const SAME_CUT_M: f64 = 1e-6;

/// A sequence of blocks that are carved out of a solid, or filled; the last one counts.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    blocks: Vec<(Point3, Point3, bool)>,
}

/// Corners of triangles, and three of them for each triangle.
pub(super) type Soup = (Vec<Point3>, Vec<[u32; 3]>);

impl Blocks {
    /// Makes a block free; corners in any order.
    pub(super) fn carve(&mut self, a: [f64; 3], b: [f64; 3]) {
        self.put(a, b, false);
    }

    /// Makes a block solid; corners in any order.
    pub(super) fn fill(&mut self, a: [f64; 3], b: [f64; 3]) {
        self.put(a, b, true);
    }

    fn put(&mut self, a: [f64; 3], b: [f64; 3], solid: bool) {
        let (a, b) = (Point3::from(a), Point3::from(b));
        self.blocks.push((a.inf(&b), a.sup(&b), solid));
    }

    /// Volume of what is free, cubic metres.
    #[cfg(test)]
    pub(super) fn free_m3(&self) -> f64 {
        let cells = self.cells();
        let side = |axis: usize, i: usize| cells.cuts[axis][i + 1] - cells.cuts[axis][i];
        let mut sum = 0.0;
        for x in 0..cells.counts[0] {
            for y in 0..cells.counts[1] {
                for z in 0..cells.counts[2] {
                    if !cells.solid[cells.index([x, y, z])] {
                        sum += side(0, x) * side(1, y) * side(2, z);
                    }
                }
            }
        }
        sum
    }

    /// The border between free and solid, without gaps: neighbours share whole edges.
    pub(super) fn border(&self) -> Soup {
        let cells = self.cells();
        let mut soup = Soup::default();
        let mut known = BTreeMap::new();
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for cut in 0..=cells.counts[axis] {
                for i in 0..cells.counts[u] {
                    for j in 0..cells.counts[v] {
                        let solid_at = |along: Option<usize>| {
                            along.filter(|along| *along < cells.counts[axis]).is_none_or(|along| {
                                let mut at = [0; 3];
                                (at[axis], at[u], at[v]) = (along, i, j);
                                cells.solid[cells.index(at)]
                            })
                        };
                        let (below, above) = (solid_at(cut.checked_sub(1)), solid_at(Some(cut)));
                        if below == above {
                            continue;
                        }
                        let mut corner = |di: usize, dj: usize| {
                            let mut at = [0; 3];
                            (at[axis], at[u], at[v]) = (cut, i + di, j + dj);
                            *known.entry(at).or_insert_with(|| {
                                let point: [f64; 3] = std::array::from_fn(|k| cells.cuts[k][at[k]]);
                                soup.0.push(Point3::from(point));
                                soup.0.len() as u32 - 1
                            })
                        };
                        let mut quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                        if above {
                            quad.reverse();
                        }
                        soup.1.push([quad[0], quad[1], quad[2]]);
                        soup.1.push([quad[0], quad[2], quad[3]]);
                    }
                }
            }
        }
        soup
    }

    fn cells(&self) -> Cells {
        let cuts: [Vec<f64>; 3] = std::array::from_fn(|axis| {
            let mut cuts: Vec<f64> =
                self.blocks.iter().flat_map(|(low, high, _)| [low[axis], high[axis]]).collect();
            cuts.sort_by(f64::total_cmp);
            cuts.dedup_by(|b, a| *b - *a < SAME_CUT_M);
            cuts
        });
        let counts: [usize; 3] = std::array::from_fn(|axis| cuts[axis].len().saturating_sub(1));
        let mut cells = Cells { solid: vec![true; counts.iter().product()], cuts, counts };
        for (low, high, solid) in &self.blocks {
            let ranges: [std::ops::Range<usize>; 3] = std::array::from_fn(|axis| {
                let at = |x: f64| cells.cuts[axis].partition_point(|cut| *cut < x - SAME_CUT_M);
                at(low[axis])..at(high[axis])
            });
            for x in ranges[0].clone() {
                for y in ranges[1].clone() {
                    for z in ranges[2].clone() {
                        let at = cells.index([x, y, z]);
                        cells.solid[at] = *solid;
                    }
                }
            }
        }
        cells
    }
}

/// Cells between the cuts that the blocks make.
struct Cells {
    cuts: [Vec<f64>; 3],
    counts: [usize; 3],
    solid: Vec<bool>,
}

impl Cells {
    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.counts[1] + y) * self.counts[2] + z
    }
}

/// An upright prism with so many sides; its lid and its floor only where asked for.
pub(super) fn prism(
    soup: &mut Soup,
    foot: &Point3,
    (radius_m, height_m): (f64, f64),
    (sides, turn_rad): (usize, f64),
    with_lid: bool,
) {
    let first = soup.0.len() as u32;
    for side in 0..sides {
        let angle = turn_rad + std::f64::consts::TAU * side as f64 / sides as f64;
        let out = Vector3::new(radius_m * angle.cos(), radius_m * angle.sin(), 0.0);
        soup.0.push(foot + out);
        soup.0.push(foot + out + Vector3::new(0.0, 0.0, height_m));
    }
    let at = |side: usize, top: u32| first + 2 * (side % sides) as u32 + top;
    for side in 0..sides {
        let [a, b, c, d] = [at(side, 0), at(side + 1, 0), at(side + 1, 1), at(side, 1)];
        soup.1.push([a, b, c]);
        soup.1.push([a, c, d]);
        if with_lid && side >= 2 {
            soup.1.push([at(0, 1), at(side - 1, 1), at(side, 1)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_border_closes_and_holds_the_volume() {
        let mut blocks = Blocks::default();
        blocks.carve([0.0, 0.0, 0.0], [4.0, 3.0, 2.0]);
        blocks.fill([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]);
        blocks.carve([3.5, 1.0, 0.5], [6.0, 2.0, 1.5]);
        assert!((blocks.free_m3() - (24.0 - 1.0 + 2.0)).abs() < 1e-12);
        let (vertices, triangles) = blocks.border();
        // Signed volume: the normals point into what is free.
        let mut volume = 0.0;
        let mut edges = BTreeMap::new();
        for [a, b, c] in &triangles {
            let [p, q, r] = [a, b, c].map(|i| vertices[*i as usize].coords);
            volume -= p.dot(&q.cross(&r)) / 6.0;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((*from, *to)).or_insert(0) += 1;
            }
        }
        assert!((volume - 25.0).abs() < 1e-9, "{volume}");
        for ((from, to), count) in &edges {
            assert_eq!(edges.get(&(*to, *from)), Some(count), "every edge has its twin");
        }
    }
}
