//! Time stamps.

use std::fmt;

/// A point in time: nanoseconds since the epoch of the log, mostly 1970.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stamp {
    nanos: i64,
}

impl Stamp {
    /// A stamp from nanoseconds.
    pub const fn from_nanos(nanos: i64) -> Self {
        Self { nanos }
    }

    /// A stamp from whole seconds and nanoseconds, as in ROS; what does not fit ends at the ends of time.
    pub fn from_parts(secs: i64, nanos: u32) -> Self {
        Self { nanos: secs.saturating_mul(1_000_000_000).saturating_add(i64::from(nanos)) }
    }

    /// A stamp from seconds, to the nearest microsecond where the number is that of a date: a float has
    /// no more digits there. NaN is 0, what does not fit ends at the ends of
    /// time.
    pub fn from_secs(secs: f64) -> Self {
        let whole = secs.floor();
        if secs.abs() < 1e6 || !whole.is_finite() {
            return Self { nanos: (secs * 1e9).round() as i64 };
        }
        let micros = ((secs - whole) * 1e6).round() as i64;
        Self { nanos: (whole as i64).saturating_mul(1_000_000_000).saturating_add(micros * 1000) }
    }

    /// Nanoseconds.
    pub const fn nanos(self) -> i64 {
        self.nanos
    }

    /// Seconds; of a date a float keeps about a tenth of a microsecond.
    pub fn secs(self) -> f64 {
        let whole = self.nanos.div_euclid(1_000_000_000);
        whole as f64 + self.nanos.rem_euclid(1_000_000_000) as f64 * 1e-9
    }

    /// Whole seconds and the nanoseconds above them, as in ROS.
    pub fn parts(self) -> (i64, u32) {
        (self.nanos.div_euclid(1_000_000_000), self.nanos.rem_euclid(1_000_000_000) as u32)
    }

    /// Seconds from `earlier` to this stamp; negative where it is the later one.
    pub fn secs_since(self, earlier: Self) -> f64 {
        (i128::from(self.nanos) - i128::from(earlier.nanos)) as f64 * 1e-9
    }
}

impl fmt::Display for Stamp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.nanos < 0 { "-" } else { "" };
        let nanos = self.nanos.unsigned_abs();
        write!(f, "{sign}{}.{:09}", nanos / 1_000_000_000, nanos % 1_000_000_000)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_of_logs_keep_their_digits() {
        let stamp = Stamp::from_secs(976_052_890.244_111);
        assert_eq!(stamp.to_string(), "976052890.244111000");
        assert_eq!(stamp.secs(), 976_052_890.244_111);
        assert_eq!(Stamp::from_secs(1.5e-9).nanos(), 2);
        assert_eq!(Stamp::from_secs(-0.25).to_string(), "-0.250000000");
        assert_eq!(Stamp::from_secs(-0.25).parts(), (-1, 750_000_000));
        assert_eq!(Stamp::from_parts(-1, 750_000_000), Stamp::from_secs(-0.25));
        assert_eq!(Stamp::from_secs(f64::NAN).nanos(), 0);
        assert_eq!(Stamp::from_secs(f64::INFINITY).nanos(), i64::MAX);
        assert_eq!(Stamp::from_secs(-1e300).nanos(), i64::MIN);
        let (first, last) = (Stamp::from_nanos(i64::MIN), Stamp::from_nanos(i64::MAX));
        assert!(last.secs_since(first) > 1.8e10 && first.secs_since(last) < -1.8e10);
    }
}
