//! The grid of a face: two of its sides are the axes, cut into 2^20 steps each.
//!
//! On such a grid the face is the triangle (0, 0), (S, 0), (0, S), and all of its three sides can be kept
//! exactly: a point on a side that is rounded along the side stays on it. So nothing that is cut out of a face
//! bends its boundary, and areas of the parts add up to that of the face in whole numbers.

use geometry::planar::overlay::StepRings;
use nalgebra::{Point3, Vector3};

/// Steps along a side of a face.
pub const STEPS: i32 = 1 << 20;

/// Twice the area of every face on its grid, square steps.
pub const TWICE_AREA: i64 = (STEPS as i64) * (STEPS as i64);

/// A face with its grid, in some frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceGrid {
    origin: Point3<f64>,
    along: [Vector3<f64>; 2],
    /// Across the face, out of its volume; its length is twice the area, square metres.
    normal: Vector3<f64>,
}

impl FaceGrid {
    /// The grid of a face with these corners, counter-clockwise seen from outside.
    pub fn new([a, b, c]: [Point3<f64>; 3]) -> Self {
        let along = [b - a, c - a];
        Self { origin: a, along, normal: along[0].cross(&along[1]) }
    }

    /// The corners.
    pub fn corners(&self) -> [Point3<f64>; 3] {
        [self.origin, self.origin + self.along[0], self.origin + self.along[1]]
    }

    /// The area of the face, square metres.
    pub fn area_m2(&self) -> f64 {
        0.5 * self.normal.norm()
    }

    /// Unit vector out of the volume; of no length for a face without area.
    pub fn outward(&self) -> Vector3<f64> {
        self.normal.try_normalize(0.0).unwrap_or_default()
    }

    /// Where a place on the grid is, in the frame of the face; halves and shares of steps are places too.
    pub fn point(&self, [x, y]: [f64; 2]) -> Point3<f64> {
        let step = 1.0 / f64::from(STEPS);
        self.origin + self.along[0] * (x * step) + self.along[1] * (y * step)
    }

    /// The corners of what lies on the face within a box of its grid, all in one plane; the number of those that
    /// count. A box may stand out beyond the long side of the face.
    pub fn patch(&self, [low, high]: [[i32; 2]; 2]) -> ([Point3<f64>; 4], usize) {
        if low == [0, 0] && high == [STEPS, STEPS] {
            let [a, b, c] = self.corners();
            return ([a, b, c, c], 3);
        }
        let places = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
        (places.map(|place| self.point(place.map(f64::from))), 4)
    }

    /// The metric area of one square step, square metres.
    pub fn step_m2(&self) -> f64 {
        self.area_m2() / (0.5 * TWICE_AREA as f64)
    }

    /// Functions of points of the frame: distance from the plane times twice the area, and the place on the
    /// grid below the point; `None` for a face without area.
    pub fn functions(&self) -> Option<[Affine; 3]> {
        let squared = self.normal.norm_squared();
        let [along_x, along_y] = self.along;
        let scale = f64::from(STEPS) / squared;
        let x = along_y.cross(&self.normal) * scale;
        let y = self.normal.cross(&along_x) * scale;
        let all = [self.normal, x, y]
            .map(|slope| Affine { slope, offset: -slope.dot(&self.origin.coords) });
        all.iter().all(|f| f.slope.iter().all(|v| v.is_finite())).then_some(all)
    }
}

/// An affine function of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    slope: Vector3<f64>,
    offset: f64,
}

impl Affine {
    /// Its value.
    #[inline]
    pub fn at(&self, point: &Point3<f64>) -> f64 {
        self.slope.dot(&point.coords) + self.offset
    }
}

/// The whole face as a ring.
pub fn whole(out: &mut StepRings) {
    out.clear();
    out.push([[0, 0], [STEPS, 0], [0, STEPS]]);
}

/// Whether all corners lie on the face.
pub fn is_within(rings: &StepRings) -> bool {
    let within = |&[x, y]: &[i32; 2]| x >= 0 && y >= 0 && x + y <= STEPS;
    rings.rings().all(|ring| ring.iter().all(within))
}

/// Cuts what lies beyond the face off a closed chain of places on its grid, of any size; the rest ends up in
/// `chain`, empty where nothing is left.
///
/// Where an edge leaves the face, the new corner lies on the side of the face exactly. It does not depend on
/// the direction in which the edge is walked, so that two chains with a common edge still have one.
pub fn clip(chain: &mut Vec<[i64; 2]>, spare: &mut Vec<[i64; 2]>) {
    let steps = i64::from(STEPS);
    let sides: [fn([i64; 2]) -> i64; 3] = [|p| p[0], |p| p[1], |p| i64::from(STEPS) - p[0] - p[1]];
    for (side, inside) in sides.iter().enumerate() {
        if chain.iter().all(|&p| inside(p) >= 0) {
            continue;
        }
        spare.clear();
        let mut a = chain[chain.len() - 1];
        for &b in chain.iter() {
            let (of_a, of_b) = (inside(a), inside(b));
            if (of_a >= 0) != (of_b >= 0) {
                let (p, q, of_p, of_q) =
                    if a < b { (a, b, of_a, of_b) } else { (b, a, of_b, of_a) };
                let cut = |axis: usize| {
                    let far = i128::from(q[axis] - p[axis]) * i128::from(of_p);
                    p[axis] + round_div(far, i128::from(of_p) - i128::from(of_q))
                };
                spare.push(match side {
                    0 => [0, cut(1)],
                    1 => [cut(0), 0],
                    _ => {
                        let x = cut(0).clamp(0, steps);
                        [x, steps - x]
                    }
                });
            }
            if of_b >= 0 {
                spare.push(b);
            }
            a = b;
        }
        std::mem::swap(chain, spare);
        tidy(chain);
        if chain.is_empty() {
            return;
        }
    }
}

/// Cuts what lies beyond a line off a closed chain of places: where the function is negative. As
/// [`clip`], what is cut does not depend on the direction in which an edge is walked.
pub fn clip_line(
    chain: &mut Vec<[i64; 2]>,
    spare: &mut Vec<[i64; 2]>,
    inside: impl Fn([i64; 2]) -> f64,
) {
    if chain.iter().all(|&p| inside(p) >= 0.0) {
        return;
    }
    spare.clear();
    let mut a = chain[chain.len() - 1];
    for &b in chain.iter() {
        let (of_a, of_b) = (inside(a), inside(b));
        if (of_a >= 0.0) != (of_b >= 0.0) {
            let (p, q, of_p, of_q) = if a < b { (a, b, of_a, of_b) } else { (b, a, of_b, of_a) };
            let along = of_p / (of_p - of_q);
            let cut = |axis: usize| p[axis] + ((q[axis] - p[axis]) as f64 * along).round() as i64;
            spare.push([cut(0), cut(1)]);
        }
        if of_b >= 0.0 {
            spare.push(b);
        }
        a = b;
    }
    std::mem::swap(chain, spare);
    tidy(chain);
}

/// Leaves out corners that follow each other at one place, and chains without three.
pub fn tidy(chain: &mut Vec<[i64; 2]>) {
    chain.dedup();
    if chain.len() > 1 && chain.first() == chain.last() {
        chain.pop();
    }
    if chain.len() < 3 {
        chain.clear();
    }
}

/// The quotient, rounded to the nearest; halves up.
fn round_div(a: i128, b: i128) -> i64 {
    let (a, b) = if b < 0 { (-a, -b) } else { (a, b) };
    (2 * a + b).div_euclid(2 * b) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_cut_off_ends_on_the_sides() {
        let s = i64::from(STEPS);
        let mut chain = vec![[-5, -7], [s + 11, 3], [s / 2, 3 * s], [-s, 17]];
        clip(&mut chain, &mut Vec::new());
        for &[x, y] in &chain {
            assert!(x >= 0 && y >= 0 && x + y <= s, "{x} {y}");
        }
        let mut far = vec![[-1, 0], [-9, 4], [-3, 8]];
        clip(&mut far, &mut Vec::new());
        assert!(far.is_empty());
        let mut inner = vec![[1, 1], [5, 1], [2, 9]];
        clip(&mut inner, &mut Vec::new());
        assert_eq!(inner, [[1, 1], [5, 1], [2, 9]]);
    }

    #[test]
    fn a_common_edge_is_cut_at_one_place() {
        let (a, b) = ([-1001, 33], [s(0.3), 90_001]);
        let cut = |chain: &[[i64; 2]]| {
            let mut chain = chain.to_vec();
            clip(&mut chain, &mut Vec::new());
            chain.into_iter().find(|p| p[0] == 0 && p[1] > 33 && p[1] < 1000)
        };
        let one = cut(&[a, b, [s(0.1), s(0.5)]]);
        assert_eq!(one, cut(&[b, a, [7, 2]]));
        assert!(one.is_some());
    }

    fn s(share: f64) -> i64 {
        (share * f64::from(STEPS)) as i64
    }

    #[test]
    fn places_and_functions_agree() {
        let at = |x, y, z| Point3::new(x, y, z);
        let grid = FaceGrid::new([at(1.0, 2.0, 3.0), at(2.0, 2.5, 3.0), at(1.0, 3.0, 5.0)]);
        let [height, x, y] = grid.functions().expect("an area");
        let place = grid.point([1000.0, 77_777.5]);
        assert!(height.at(&place).abs() < 1e-12);
        assert!((x.at(&place) - 1000.0).abs() < 1e-6 && (y.at(&place) - 77_777.5).abs() < 1e-6);
        assert!(height.at(&(place + grid.outward())) > 0.0);
        let flat = FaceGrid::new([at(0.0, 0.0, 1.0), at(1.0, 1.0, 1.0), at(2.0, 2.0, 1.0)]);
        assert_eq!((flat.functions(), flat.area_m2()), (None, 0.0));
    }
}
