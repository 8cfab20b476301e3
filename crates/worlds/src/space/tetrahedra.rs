//! The surface where a function is zero, by marching tetrahedra.

use std::collections::BTreeMap;

use geometry::Point3;

use super::blocks::Soup;

/// The six tetrahedra of a cube around its diagonal from corner 0 to corner 7 (Kuhn's): the same cut on
/// both sides of every face, so that neighbouring cubes match.
const KUHN: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// Triangles where `value` crosses zero, on a lattice of `counts` cubes of side `cell_m` from `low`.
///
/// The border of the lattice counts as above zero, so that the surface closes. Vertices are shared. A
/// value of exactly zero counts as above.
pub(super) fn surface(
    low: &Point3,
    cell_m: f64,
    counts: [usize; 3],
    value: impl Fn(&Point3) -> f64,
) -> Soup {
    let sizes = counts.map(|count| count + 1);
    let index = |[x, y, z]: [usize; 3]| (z * sizes[1] + y) * sizes[0] + x;
    let place = |at: usize| {
        let [x, y, z] = [at % sizes[0], at / sizes[0] % sizes[1], at / sizes[0] / sizes[1]];
        (low + geometry::Vector3::new(x as f64, y as f64, z as f64) * cell_m, [x, y, z])
    };
    let values: Vec<f64> = (0..sizes.iter().product())
        .map(|at| {
            let (point, steps) = place(at);
            let is_border = (0..3).any(|k| steps[k] == 0 || steps[k] == counts[k]);
            let here = value(&point);
            if is_border { here.max(0.5 * cell_m) } else { here }
        })
        .collect();
    let mut soup = Soup::default();
    let mut known: BTreeMap<(usize, usize), u32> = BTreeMap::new();
    for z in 0..counts[2] {
        for y in 0..counts[1] {
            for x in 0..counts[0] {
                let corner = |i: usize| index([x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)]);
                for tetrahedron in KUHN {
                    let corners = tetrahedron.map(corner);
                    let mut cut = |a: usize, b: usize| {
                        let (a, b) = (a.min(b), a.max(b));
                        *known.entry((a, b)).or_insert_with(|| {
                            // Not too near to a corner: no triangle is flatter than it need be.
                            let share = (values[a] / (values[a] - values[b])).clamp(0.05, 0.95);
                            let (from, to) = (place(a).0, place(b).0);
                            soup.0.push(from + (to - from) * share);
                            soup.0.len() as u32 - 1
                        })
                    };
                    let (below, above): (Vec<usize>, Vec<usize>) =
                        corners.iter().partition(|corner| values[**corner] < 0.0);
                    match (below.as_slice(), above.as_slice()) {
                        ([a], [b, c, d]) | ([b, c, d], [a]) => {
                            soup.1.push([cut(*a, *b), cut(*a, *c), cut(*a, *d)]);
                        }
                        ([a, b], [c, d]) => {
                            let quad = [cut(*a, *c), cut(*a, *d), cut(*b, *d), cut(*b, *c)];
                            soup.1.push([quad[0], quad[1], quad[2]]);
                            soup.1.push([quad[0], quad[2], quad[3]]);
                        }
                        _ => {}
                    }
                }
            }
        }
    }
    soup
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_closes() {
        let low = Point3::new(-2.0, -2.0, -2.0);
        let (vertices, triangles) = surface(&low, 0.25, [16; 3], |p| p.coords.norm() - 1.5);
        assert!(vertices.iter().all(|v| (v.coords.norm() - 1.5).abs() < 0.05));
        let mut edges = BTreeMap::new();
        for [a, b, c] in &triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                *edges.entry((p.min(q), p.max(q))).or_insert(0) += 1;
            }
        }
        assert!(edges.values().all(|count| *count == 2));
        // Where the function never gets above zero, the border closes it.
        let (_, closed) = surface(&low, 1.0, [4; 3], |_| -1.0);
        assert!(!closed.is_empty());
    }
}
