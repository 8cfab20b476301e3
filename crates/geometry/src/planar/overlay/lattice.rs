//! Corners on a lattice of 1 µm, counted from a whole metre nearby.

use crate::Point2;
use crate::planar::PlanarError;

/// Step of the lattice, metres.
pub const LATTICE_M: f64 = 1e-6;

/// How far a corner may lie from the middle of all corners of an operation, along each axis, metres.
///
/// Half of what 32 bits hold, because the engine adds coordinates.
pub const REACH_M: f64 = 1000.0;

const STEPS_PER_M: f64 = 1e6;

/// The lattice of one operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    /// Whole metres, so that a corner has the same place on the lattice of every operation.
    origin_m: (f64, f64),
}

impl Lattice {
    /// A lattice around these points.
    ///
    /// # Errors
    /// [`PlanarError::Unsnappable`] names the first point that is not finite or too far out.
    pub fn around<'a>(
        points: impl Iterator<Item = &'a Point2> + Clone,
    ) -> Result<Self, PlanarError> {
        let (mut low, mut high) =
            (Point2::new(f64::MAX, f64::MAX), Point2::new(-f64::MAX, -f64::MAX));
        for point in points.clone() {
            if !(point.x.is_finite() && point.y.is_finite()) {
                return Err(unsnappable(point));
            }
            low = low.inf(point);
            high = high.sup(point);
        }
        let middle = |a: f64, b: f64| (0.5 * a + 0.5 * b).round();
        let origin_m = if low.x > high.x {
            (0.0, 0.0)
        } else {
            (middle(low.x, high.x), middle(low.y, high.y))
        };
        let far =
            |p: &&Point2| (p.x - origin_m.0).abs() > REACH_M || (p.y - origin_m.1).abs() > REACH_M;
        // Beyond this the lattice is finer than the floats.
        let coarse = origin_m.0.abs().max(origin_m.1.abs()) > 1e9;
        match points.clone().find(|point| coarse || far(point)) {
            Some(point) => Err(unsnappable(point)),
            None => Ok(Self { origin_m }),
        }
    }

    /// The lattice point nearest to a point, in steps.
    pub fn snap(&self, point: &Point2) -> (i32, i32) {
        let step = |v: f64, origin: f64| ((v - origin) * STEPS_PER_M).round() as i32;
        (step(point.x, self.origin_m.0), step(point.y, self.origin_m.1))
    }

    /// Where a lattice point is.
    pub fn place(&self, steps: (i32, i32)) -> Point2 {
        // In whole steps first: the same lattice point gives the same bits from every origin.
        let metres = |k: i32, origin: f64| (origin * STEPS_PER_M + f64::from(k)) / STEPS_PER_M;
        Point2::new(metres(steps.0, self.origin_m.0), metres(steps.1, self.origin_m.1))
    }
}

fn unsnappable(point: &Point2) -> PlanarError {
    PlanarError::Unsnappable { x: point.x, y: point.y, reach_m: REACH_M }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lattice_point_is_the_same_from_every_origin() {
        let point = Point2::new(123.456_789, -7.000_001);
        for far in [Point2::new(900.0, 0.0), Point2::new(-321.0, 500.0), point] {
            let lattice = Lattice::around([point, far].iter()).expect("finite");
            let once = lattice.place(lattice.snap(&point));
            assert_eq!(once, point);
            assert_eq!(lattice.place(lattice.snap(&once)), once);
        }
    }

    #[test]
    fn what_cannot_be_snapped_is_refused() {
        let near = Point2::origin();
        for far in [
            Point2::new(f64::NAN, 0.0),
            Point2::new(0.0, f64::INFINITY),
            Point2::new(3000.0, 0.0),
            Point2::new(1e300, 1e300),
        ] {
            let refused = Lattice::around([near, far].iter());
            assert!(matches!(refused, Err(PlanarError::Unsnappable { .. })), "{far}");
        }
        assert!(Lattice::around([].iter()).is_ok());
    }
}
