//! SE(2) and SE(3) against oracles that share nothing with it: matrix exponential, matrix products,
//! central differences, sampled errors.

mod covariance;
mod group;
mod jacobians;
mod oracle;
mod space;
mod tangent;
