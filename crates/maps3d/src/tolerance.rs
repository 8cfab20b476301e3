//! The numbers that decide when something is nothing; all are shares, without a unit.

/// A determinant below this share of its largest possible value is that of points on one line.
pub(crate) const LINE_SHARE: f64 = 1e-12;

/// Newton's method for an eigenvalue ends at a step of this share of the trace.
pub(crate) const EIGENVALUE_STEP: f64 = 1e-13;

/// Two eigenvalues meet where the characteristic polynomial rises no more than this; the trace is 1.
pub(crate) const EIGENVALUE_SLOPE: f64 = 1e-14;

/// Depths are fitted when the square of what is left, preconditioned, is this share of what it was.
pub(crate) const FITTED_SHARE: f64 = 1e-12;

/// A corner that comes nearer does so by this share more than it must, for rounding.
pub(crate) const ROUNDING_SHARE: f64 = 1e-12;
