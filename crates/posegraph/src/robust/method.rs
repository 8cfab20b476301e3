//! Which method deals with wrong loop closures.

/// How wrong loop closures are dealt with; see the [module](crate::robust) for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Robust {
    /// Every factor is believed.
    #[default]
    None,
    /// Huber's loss.
    Huber,
    /// Cauchy's loss.
    Cauchy,
    /// Geman and McClure's loss.
    GemanMcClure,
    /// Truncated least squares from the start as it is.
    Tls,
    /// Graduated non-convexity towards truncated least squares.
    GncTls,
    /// Graduated non-convexity towards Geman and McClure's loss.
    GncGm,
    /// Dynamic covariance scaling.
    Dcs,
    /// Switchable constraints.
    Switchable,
    /// Pairwise consistent measurement set maximisation.
    Pcm,
}

impl Robust {
    /// Every method, in the order of the documentation.
    pub const ALL: [Self; 10] = [
        Self::None,
        Self::Huber,
        Self::Cauchy,
        Self::GemanMcClure,
        Self::Tls,
        Self::GncTls,
        Self::GncGm,
        Self::Dcs,
        Self::Switchable,
        Self::Pcm,
    ];

    /// A name for reports and command lines: `gnc-tls` and so on.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Huber => "huber",
            Self::Cauchy => "cauchy",
            Self::GemanMcClure => "geman-mcclure",
            Self::Tls => "tls",
            Self::GncTls => "gnc-tls",
            Self::GncGm => "gnc-gm",
            Self::Dcs => "dcs",
            Self::Switchable => "switchable",
            Self::Pcm => "pcm",
        }
    }

    /// What the method is, in a line.
    pub fn about(self) -> &'static str {
        match self {
            Self::None => "Every edge is believed",
            Self::Huber => "Huber's loss",
            Self::Cauchy => "Cauchy's loss",
            Self::GemanMcClure => "Geman and McClure's loss",
            Self::Tls => "Truncated least squares",
            Self::GncTls => {
                "Graduated non-convexity towards truncated least squares: finds wrong closures best"
            }
            Self::GncGm => "Graduated non-convexity towards Geman and McClure's loss",
            Self::Dcs => "Dynamic covariance scaling",
            Self::Switchable => "Switchable constraints",
            Self::Pcm => "The largest set of closures that agree in pairs",
        }
    }
}
