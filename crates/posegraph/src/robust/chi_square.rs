//! Quantiles of the chi-square distribution.

/// The value that a sum of `degrees` squared standard normal numbers stays below with this
/// probability.
///
/// `degrees` is at least 1 and `probability` in 0..1; found by bisection of the series of the lower
/// incomplete gamma function (Abramowitz and Stegun 1964, 6.5.29), to rounding.
pub fn chi_square_quantile(probability: f64, degrees: usize) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while below(high, degrees) < probability && high < 1e6 {
        high *= 2.0;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if below(middle, degrees) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Probability of a smaller value.
fn below(value: f64, degrees: usize) -> f64 {
    if value <= 0.0 {
        return 0.0;
    }
    let (a, x) = (0.5 * degrees as f64, 0.5 * value);
    // x^a e^-x / Γ(a + 1), by the recursion of Γ from 1 or from ½.
    let mut term = (-x).exp();
    let mut step = if degrees.is_multiple_of(2) { 0.0 } else { 0.5 };
    if step > 0.0 {
        term *= x.sqrt() / (std::f64::consts::PI.sqrt() * 0.5);
    }
    while step < a {
        step += 1.0;
        if step <= a {
            term *= x / step;
        }
    }
    let (mut sum, mut index) = (0.0, a);
    while term > 1e-18 * sum || index < x {
        sum += term;
        index += 1.0;
        term *= x / index;
        if term == 0.0 {
            break;
        }
    }
    sum.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        let table = [
            (0.5, 1, 0.454_936),
            (0.95, 1, 3.841_459),
            (0.99, 2, 9.210_340),
            (0.5, 3, 2.365_974),
            (0.99, 3, 11.344_867),
            (0.999, 3, 16.266_236),
            (0.05, 6, 1.635_383),
            (0.99, 6, 16.811_894),
            (0.999, 6, 22.457_744),
        ];
        for (probability, degrees, expected) in table {
            let found = chi_square_quantile(probability, degrees);
            assert!((found - expected).abs() < 1e-5, "{probability} {degrees}: {found}");
        }
        // Two degrees have a closed form, far into the tail.
        let far = chi_square_quantile(1.0 - 1e-6, 2);
        assert!((far + 2.0 * 1e-6_f64.ln()).abs() < 1e-6, "{far}");
    }
}
