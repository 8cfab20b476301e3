//! Losses that let a factor disagree.

/// How the cost of a factor grows with its `s = eᵀ Ω e`.
///
/// Widths are in units of `√s`: standard deviations where the information matrix is right. All
/// losses are `s` to first order at 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Loss {
    /// Least squares: `s`.
    #[default]
    None,
    /// Linear in `√s` beyond the width (Huber 1964).
    Huber {
        /// Where the loss turns linear.
        width: f64,
    },
    /// `k² ln(1 + s/k²)`.
    Cauchy {
        /// Where the weight is one half.
        width: f64,
    },
    /// `k² s / (k² + s)` (Geman and McClure 1985).
    GemanMcClure {
        /// Where the weight is one quarter.
        width: f64,
    },
    /// `min(s, k²)`: beyond the width a factor has no say.
    Tls {
        /// Where the loss ends.
        width: f64,
    },
    /// Dynamic covariance scaling (Agarwal et al. 2013) with `Φ = k²`: the loss whose weight is the
    /// square of its scale `min(1, 2Φ/(Φ + s))`.
    Dcs {
        /// Where scaling begins.
        width: f64,
    },
}

impl Loss {
    /// The cost of a factor with this `s = eᵀ Ω e`.
    #[inline]
    pub fn cost(self, s: f64) -> f64 {
        match self {
            Self::None => s,
            Self::Huber { width: k } if s <= k * k => s,
            Self::Huber { width: k } => 2.0 * k * s.sqrt() - k * k,
            Self::Cauchy { width: k } => k * k * (s / (k * k)).ln_1p(),
            Self::GemanMcClure { width: k } => k * k * s / (k * k + s),
            Self::Tls { width: k } => s.min(k * k),
            Self::Dcs { width: k } if s <= k * k => s,
            Self::Dcs { width: k } => k * k * (3.0 - 4.0 * k * k / (k * k + s)),
        }
    }

    /// The derivative of [`cost`](Self::cost): the weight of the factor in the next iteration of
    /// reweighted least squares.
    #[inline]
    pub fn weight(self, s: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Huber { width: k } if s <= k * k => 1.0,
            Self::Huber { width: k } => k / s.sqrt(),
            Self::Cauchy { width: k } => 1.0 / (1.0 + s / (k * k)),
            Self::GemanMcClure { width: k } => {
                let share = k * k / (k * k + s);
                share * share
            }
            Self::Tls { width: k } => f64::from(u8::from(s <= k * k)),
            Self::Dcs { width: k } => (2.0 * k * k / (k * k + s)).min(1.0).powi(2),
        }
    }
}

/// Which factors a loss is applied to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LossOn {
    /// Those that do not join neighbours in the order of vertices: loop closures.
    #[default]
    Closures,
    /// Every factor.
    All,
}
