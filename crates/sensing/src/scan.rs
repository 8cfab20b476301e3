//! A planar range scan.

/// What one ray of a scan says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Something stands at this range, in metres, from 0 up to the sensor's range.
    Hit(f64),
    /// Nothing up to the sensor's range.
    Miss,
}

/// One scan of a planar range sensor; bearings and ranges are in the `sensor` frame.
///
/// A range that is NaN, infinite, negative or at least [`range_max_m`](Self::range_max_m) is "no
/// return": the ray met nothing within range.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// Bearing of the first ray, radians, counter-clockwise from the sensor's x axis.
    pub first_bearing_rad: f64,
    /// Angle from each ray to the next, radians, positive.
    pub bearing_step_rad: f64,
    /// One range per ray, metres.
    pub ranges_m: Vec<f64>,
    /// Range beyond which the sensor sees nothing, metres.
    pub range_max_m: f64,
}

impl Scan {
    /// A scan from its parts, in the units of the fields.
    pub fn new(
        first_bearing_rad: f64,
        bearing_step_rad: f64,
        ranges_m: Vec<f64>,
        range_max_m: f64,
    ) -> Self {
        Self { first_bearing_rad, bearing_step_rad, ranges_m, range_max_m }
    }

    /// Number of rays.
    pub fn len(&self) -> usize {
        self.ranges_m.len()
    }

    /// Whether the scan has no ray.
    pub fn is_empty(&self) -> bool {
        self.ranges_m.is_empty()
    }

    /// Bearing of ray `i`, radians.
    pub fn bearing_rad(&self, i: usize) -> f64 {
        self.first_bearing_rad + self.bearing_step_rad * i as f64
    }

    /// The angle from the first ray to the last, radians.
    pub fn span_rad(&self) -> f64 {
        self.bearing_step_rad * self.ranges_m.len().saturating_sub(1) as f64
    }

    /// Whether the rays close a full circle: the last is one step before the first.
    pub fn is_full_circle(&self) -> bool {
        let circle = self.bearing_step_rad * self.ranges_m.len() as f64;
        (circle - std::f64::consts::TAU).abs() < 0.5 * self.bearing_step_rad
    }

    /// What ray `i` says.
    pub fn reading(&self, i: usize) -> Reading {
        let range_m = self.ranges_m[i];
        if range_m >= 0.0 && range_m < self.range_max_m {
            Reading::Hit(range_m)
        } else {
            Reading::Miss
        }
    }

    /// All rays: bearing in radians, and what it says.
    pub fn readings(&self) -> impl ExactSizeIterator<Item = (f64, Reading)> + '_ {
        (0..self.ranges_m.len()).map(|i| (self.bearing_rad(i), self.reading(i)))
    }
}
