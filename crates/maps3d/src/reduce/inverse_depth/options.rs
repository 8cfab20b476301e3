//! How the project's own reduction chooses.

use crate::Maps3dError;

/// How the project's own reduction chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseDepth {
    /// No pixel counts for more than this, metres: what is far off belongs to another surface. Below 400
    /// vertices it is larger, in proportion.
    pub cap_m: f64,
    /// How much a face's summed distance counts against its largest: 0 the largest alone, 1 the sum.
    pub sum_weight: f64,
    /// Distances count more for faces seen under an angle whose sine is below this.
    pub edge_on: f64,
    /// Fewer than 400 vertices are chosen by a median of nine pixels, which lone outliers do not get
    /// through; more of them need what is narrow.
    pub median: bool,
    /// Of faces above 4,096 pixels every second row is looked at, above 16,384 every fourth.
    pub skip_rows: bool,
    /// Rounds in which sides are turned.
    pub flip_rounds: usize,
    /// How much the distance of a missing pixel counts, from 0 to 1: it was never measured, and lies at
    /// the far distance by agreement.
    pub missing_weight: f64,
    /// Depths of vertices are fitted to all pixels; pixels farther off than this hardly count,
    /// metres. Not at all where it is 0.
    pub fit_m: f64,
}

impl Default for InverseDepth {
    fn default() -> Self {
        Self {
            cap_m: 0.3,
            sum_weight: 0.7,
            edge_on: 0.1,
            median: true,
            skip_rows: true,
            flip_rounds: 2,
            fit_m: 0.05,
            missing_weight: 0.02,
        }
    }
}

/// Below so many vertices, more are put in and thinned out; and the cap is larger, in proportion: a face
/// that covers several surfaces has most of its pixels beyond any small cap, and the sum would no longer
/// tell good from bad.
pub(super) const COARSE: f64 = 400.0;

impl InverseDepth {
    /// Refuses what is out of its range.
    pub(in crate::reduce) fn check(&self) -> Result<(), Maps3dError> {
        let refuse = |option, found, expected| Err(Maps3dError::Option { option, found, expected });
        if self.cap_m.is_nan() || self.cap_m <= 0.0 {
            return refuse("cap_m", self.cap_m, "a distance above 0 m");
        }
        for (option, share) in [
            ("sum_weight", self.sum_weight),
            ("edge_on", self.edge_on),
            ("missing_weight", self.missing_weight),
        ] {
            if !(0.0..=1.0).contains(&share) {
                return refuse(option, share, "a number from 0 to 1");
            }
        }
        if self.fit_m.is_nan() || self.fit_m < 0.0 {
            return refuse("fit_m", self.fit_m, "a distance from 0 m up");
        }
        Ok(())
    }

    /// The cap while there are so many vertices, metres.
    pub(super) fn cap_at(&self, vertices: usize) -> f64 {
        self.cap_m * (COARSE / vertices as f64).max(1.0)
    }

    pub(super) fn is_few(count: usize) -> bool {
        (count as f64) < COARSE
    }

    /// How many vertices are put in where `count` are asked for: four times as many as are few.
    pub(super) fn first_of(count: usize) -> usize {
        if Self::is_few(count) { (4 * count).min(2 * COARSE as usize) } else { count }
    }

    /// Of how many rows of a face one is looked at while vertices are put in, by twice its area.
    pub(super) fn stride_of(&self, doubled_area: i64) -> usize {
        let [half, quarter] = [8_192, 32_768];
        if !self.skip_rows || doubled_area < half {
            1
        } else if doubled_area < quarter {
            2
        } else {
            4
        }
    }

    /// Vertices at measured depths, chosen by their distance alone: what a bound on the error asks for.
    pub(super) fn exact() -> Self {
        Self {
            cap_m: f64::INFINITY,
            sum_weight: 0.0,
            edge_on: 0.0,
            median: false,
            skip_rows: false,
            flip_rounds: 0,
            fit_m: 0.0,
            missing_weight: 1.0,
        }
    }
}
