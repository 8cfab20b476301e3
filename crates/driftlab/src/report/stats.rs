//! Means, spreads and intervals of few samples.

/// Mean and spread of some samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mean {
    /// How many samples.
    pub(crate) count: usize,
    /// Their mean.
    pub(crate) mean: f64,
    /// Their standard deviation, by one less than their number; 0 for one sample.
    pub(crate) deviation: f64,
}

impl Mean {
    /// Of the samples that are there; `None` where none is.
    pub(crate) fn of(samples: impl IntoIterator<Item = f64>) -> Option<Self> {
        let samples: Vec<f64> = samples.into_iter().collect();
        let count = samples.len();
        if count == 0 {
            return None;
        }
        let mean = samples.iter().sum::<f64>() / count as f64;
        let squares: f64 = samples.iter().map(|sample| (sample - mean).powi(2)).sum();
        let deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { 0.0 };
        Some(Self { count, mean, deviation })
    }
}

/// A share of successes with its 95 % interval after Wilson (1927), which is sound for few samples
/// and for shares of 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    /// Successes.
    pub(crate) hits: usize,
    /// Trials, above 0.
    pub(crate) of: usize,
    /// Lower end of the interval.
    pub(crate) low: f64,
    /// Upper end.
    pub(crate) high: f64,
}

/// The 97.5 % quantile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

impl Share {
    /// So many successes in so many trials; `None` without a trial.
    pub(crate) fn of(hits: usize, of: usize) -> Option<Self> {
        if of == 0 {
            return None;
        }
        let (n, p) = (of as f64, hits as f64 / of as f64);
        let z2n = Z * Z / n;
        let centre = (p + z2n / 2.0) / (1.0 + z2n);
        let half = Z / (1.0 + z2n) * (p * (1.0 - p) / n + z2n / (4.0 * n)).sqrt();
        // The ends are exactly 0 and 1 there, where rounding would miss them.
        let low = if hits == 0 { 0.0 } else { (centre - half).max(0.0) };
        let high = if hits == of { 1.0 } else { (centre + half).min(1.0) };
        Some(Self { hits, of, low, high })
    }

    /// The share itself.
    pub(crate) fn share(&self) -> f64 {
        self.hits as f64 / self.of as f64
    }
}

/// The middle of some samples; the upper of two.
pub(crate) fn median(mut samples: Vec<f64>) -> Option<f64> {
    samples.sort_by(f64::total_cmp);
    samples.get(samples.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_deviations() {
        let mean = Mean::of([2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]).expect("samples");
        assert_eq!((mean.count, mean.mean), (8, 5.0));
        assert!((mean.deviation - (32.0_f64 / 7.0).sqrt()).abs() < 1e-12);
        assert_eq!(Mean::of([3.0]).map(|mean| mean.deviation), Some(0.0));
        assert_eq!(Mean::of([]), None);
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(Vec::new()), None);
    }

    #[test]
    fn intervals_are_wilsons() {
        // Newcombe (1998), Statistics in Medicine 17, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
        for (hits, of, low, high) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
        ] {
            let share = Share::of(hits, of).expect("trials");
            assert!((share.low - low).abs() < 5e-5, "{hits} of {of}: {}", share.low);
            assert!((share.high - high).abs() < 5e-5, "{hits} of {of}: {}", share.high);
            assert!(share.low <= share.share() && share.share() <= share.high);
        }
        assert_eq!(Share::of(10, 10).map(|share| share.high), Some(1.0));
        assert_eq!(Share::of(0, 0), None);
    }
}
