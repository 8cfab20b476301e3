//! What can be chosen about the voxel map.

use crate::Maps3dError;

/// Parameters of the voxel map.
#[derive(Clone, Debug, PartialEq)]
pub struct VoxelParams {
    /// Side of a cell, metres.
    pub cell_m: f64,
    /// Depth up to which a ray tells anything, metres: a ray without a reading is free so far.
    pub range_m: f64,
    /// Whether a ray without a reading is free up to the range; else it tells nothing.
    pub misses_are_free: bool,
    /// Log odds that a hit adds, hundredths.
    pub hit: i8,
    /// Log odds that a ray takes from a cell that it goes through, hundredths.
    pub miss: i8,
    /// The least log odds of a cell, hundredths; above -128.
    pub least: i8,
    /// The largest log odds of a cell, hundredths.
    pub most: i8,
    /// Frontier that hangs together over less than this does not count, square metres.
    pub sliver_m2: f64,
    /// Large frontier is told as points about so far apart, metres.
    pub point_spacing_m: f64,
    /// Whether looks are kept, so that the map is made anew when poses are corrected. Else corrected
    /// poses are not supported: the map stays where odometry put it.
    pub reintegrate: bool,
}

impl Default for VoxelParams {
    /// Cells of 5 cm; probabilities of 0.7 for a hit and 0.4 for a miss, kept between 0.12 and 0.78.
    fn default() -> Self {
        Self {
            cell_m: 0.05,
            range_m: 8.0,
            misses_are_free: true,
            hit: 85,
            miss: -40,
            least: -120,
            most: 127,
            sliver_m2: 0.05,
            point_spacing_m: 0.8,
            reintegrate: false,
        }
    }
}

impl VoxelParams {
    /// Checks the fields.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] with the first that is out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        let refuse = |option, found, expected| Err(Maps3dError::Option { option, found, expected });
        if !(0.001..=10.0).contains(&self.cell_m) {
            return refuse("cell_m", self.cell_m, "from 0.001 to 10 m");
        }
        if !(self.range_m >= self.cell_m && self.range_m <= 10_000.0 * self.cell_m) {
            return refuse("range_m", self.range_m, "from 1 to 10,000 cells");
        }
        for (option, found, good) in [
            ("hit", self.hit, self.hit > 0),
            ("miss", self.miss, self.miss < 0),
            ("least", self.least, self.least < 0 && self.least > i8::MIN),
            ("most", self.most, self.most > 0),
        ] {
            if !good {
                return refuse(
                    option,
                    found.into(),
                    "hits and most above 0, misses and least below",
                );
            }
        }
        if !(0.0..=1e6).contains(&self.sliver_m2) {
            return refuse("sliver_m2", self.sliver_m2, "a number from 0 to 1e6");
        }
        if !(self.point_spacing_m >= 0.01 && self.point_spacing_m <= 1e6) {
            return refuse("point_spacing_m", self.point_spacing_m, "from 0.01 to 1e6 m");
        }
        Ok(())
    }
}
