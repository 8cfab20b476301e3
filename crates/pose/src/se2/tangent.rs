//! Between tangent vectors and motions: exponential, logarithm, perturbation.

use nalgebra::{UnitComplex, Vector2, Vector3};

use crate::Se2;

/// The exponential of a turn as it acts on translations, `V(θ) = [a -b; b a]`.
///
/// `a` is the sine of θ over θ, `b` is one minus the cosine over θ. The second is written with half
/// angles: the plain form loses all digits at small angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning {
    pub a: f64,
    pub b: f64,
}

impl Turning {
    pub(crate) fn new(theta_rad: f64) -> Self {
        let half = 0.5 * theta_rad;
        Self { a: sinc(theta_rad), b: half.sin() * sinc(half) }
    }

    fn apply(self, v: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(self.a * v.x - self.b * v.y, self.b * v.x + self.a * v.y)
    }
}

/// The inverse of [`Turning`], `V(θ)⁻¹ = [a b; -b a]` with `b` half the angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unturning {
    pub a: f64,
    pub b: f64,
}

impl Unturning {
    pub(crate) fn new(theta_rad: f64) -> Self {
        let half = 0.5 * theta_rad;
        Self { a: if half == 0.0 { 1.0 } else { half / half.tan() }, b: half }
    }

    pub(crate) fn apply(self, v: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(self.a * v.x + self.b * v.y, self.a * v.y - self.b * v.x)
    }
}

/// The sine over its argument: full precision for every argument, 1 at 0.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}

impl Se2 {
    /// The motion reached after one second at the constant body velocity `xi`.
    ///
    /// `xi` is `[x_m, y_m, theta_rad]` in the source frame; angles beyond ±π wind round. Precise to
    /// rounding for every angle.
    pub fn exp(xi: &Vector3<f64>) -> Self {
        Self { rotation: UnitComplex::new(xi.z), translation: Turning::new(xi.z).apply(xi.xy()) }
    }

    /// The tangent vector `[x_m, y_m, theta_rad]` whose [`exp`](Self::exp) is this motion, with the
    /// angle in (-π, π].
    ///
    /// Precise to rounding for every angle. At half a turn two vectors have the same exponential;
    /// rounding decides between them.
    pub fn log(&self) -> Vector3<f64> {
        let theta = self.angle();
        let v = Unturning::new(theta).apply(self.translation);
        Vector3::new(v.x, v.y, theta)
    }

    /// This motion perturbed on the right: `self · exp(delta)`, with `delta` in the source frame.
    pub fn boxplus(&self, delta: &Vector3<f64>) -> Self {
        *self * Self::exp(delta)
    }

    /// The perturbation that leads from `base` to this motion: `log(base⁻¹ · self)`.
    ///
    /// `base.boxplus(&self.boxminus(&base))` is `self`.
    pub fn boxminus(&self, base: &Self) -> Vector3<f64> {
        base.inverse_mul(self).log()
    }
}
