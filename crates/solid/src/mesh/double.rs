//! Numbers of twice the digits, for sums that cancel.

use std::ops::{Add, Mul, Neg};

use crate::Point3;

/// A number as the sum of two doubles, the second no more than half a unit in the last place of the first:
/// 32 digits (Dekker 1971).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Double {
    pub(super) high: f64,
    low: f64,
}

impl Double {
    /// The sum of two doubles, exactly (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self { high, low: (a - (high - of_b)) + (b - of_b) }
    }

    /// The product of two doubles, exactly (Veltkamp, Dekker).
    fn product(a: f64, b: f64) -> Self {
        let halves = |x: f64| {
            // 2^27 + 1.
            let big = 134_217_729.0 * x;
            let high = big - (big - x);
            (high, x - high)
        };
        let high = a * b;
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        Self { high, low: a2 * b2 - (((high - a1 * b1) - a2 * b1) - a1 * b2) }
    }

    /// The way from one point to another, exactly.
    pub(super) fn between(to: &Point3, from: &Point3) -> [Self; 3] {
        [0, 1, 2].map(|k| Self::sum(to[k], -from[k]))
    }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let once = Self::sum(high.high, high.low + low.high);
        Self::sum(once.high, once.low + low.low)
    }
}

impl Neg for Double {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Mul for Double {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

/// Six times the volume between three points and the origin.
pub(super) fn six_volumes([a, b, c]: [[Double; 3]; 3]) -> Double {
    let minor = |i: usize, j: usize| b[i] * c[j] + -(b[j] * c[i]);
    a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1)
}

#[cfg(test)]
mod tests {
    use super::Double;

    #[test]
    fn what_doubles_drop_is_kept() {
        let one = Double::sum(1.0, 0.0);
        let little = Double::sum(1e-25, 0.0);
        let left = (one + little) * (one + little) + -one + -(little + little);
        assert!(left.high.abs() < 1e-31, "{left:?}");
        let third = Double { high: 1.0 / 3.0, low: 1.850_371_707_708_594e-17 };
        let off = third * Double::sum(3.0, 0.0) + -one;
        assert!(off.high.abs() < 1e-30, "{off:?}");
    }
}
