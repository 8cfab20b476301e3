//! A corridor that leads back into itself.

use geometry::Point2;
use pose::Se2;

use super::range::{length, refuse};
use crate::{World2d, WorldError};

/// The endless corridor of \[Zie18\] fig. 2.15: a rectangular ring around a block.
///
/// The figure has no measures; the defaults make a lap of 56 m along the middle.
#[derive(Clone, Debug, PartialEq)]
pub struct CorridorParams {
    /// Outer extent along x, metres.
    pub width_m: f64,
    /// Outer extent along y, metres.
    pub height_m: f64,
    /// Width of the corridor, metres; below half of either extent.
    pub corridor_m: f64,
}

impl Default for CorridorParams {
    fn default() -> Self {
        Self { width_m: 20.0, height_m: 14.0, corridor_m: 3.0 }
    }
}

impl CorridorParams {
    /// Checks the measures.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        length("width_m", self.width_m)?;
        length("height_m", self.height_m)?;
        length("corridor_m", self.corridor_m)?;
        let good = 2.0 * self.corridor_m < self.width_m.min(self.height_m);
        refuse(good, "corridor_m", self.corridor_m, "below half of width_m and of height_m")
    }
}

/// The corridor, its outer lower-left corner at the world's origin.
///
/// The robot starts in the middle of the lower-left corner and heads along +x.
///
/// # Errors
/// As [`CorridorParams::check`].
pub fn corridor(params: &CorridorParams) -> Result<World2d, WorldError> {
    params.check()?;
    let CorridorParams { width_m, height_m, corridor_m } = *params;
    let inset = |by_m: f64| {
        let (right, top) = (width_m - by_m, height_m - by_m);
        let corners = [(by_m, by_m), (right, by_m), (right, top), (by_m, top)];
        corners.map(|(x, y)| Point2::new(x, y)).to_vec()
    };
    let world_from_start = Se2::new(corridor_m / 2.0, corridor_m / 2.0, 0.0);
    World2d::from_polygons("corridor", vec![inset(0.0), inset(corridor_m)], world_from_start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_around_a_block() {
        let world = corridor(&CorridorParams::default()).expect("the defaults are good");
        let free = |x: f64, y: f64| world.is_free(&Point2::new(x, y));
        assert!(free(1.5, 1.5) && free(18.5, 1.5) && free(18.5, 12.5) && free(1.5, 12.5));
        assert!(!free(10.0, 7.0) && !free(-1.0, 7.0) && !free(21.0, 7.0));
        let start = Point2::from(world.world_from_start().translation);
        assert!((world.caster().distance_to(&start) - 1.5).abs() < 1e-9);
    }

    #[test]
    fn bad_fields_are_named() {
        let good = CorridorParams::default();
        let fields = [
            ("width_m", CorridorParams { width_m: 0.0, ..good.clone() }),
            ("height_m", CorridorParams { height_m: f64::NAN, ..good.clone() }),
            ("corridor_m", CorridorParams { corridor_m: 7.0, ..good.clone() }),
            ("corridor_m", CorridorParams { corridor_m: -1.0, ..good }),
        ];
        for (name, params) in fields {
            let Err(WorldError::Parameter { field, .. }) = corridor(&params).map(drop) else {
                panic!("{name} was let pass")
            };
            assert_eq!(field, name);
        }
    }
}
