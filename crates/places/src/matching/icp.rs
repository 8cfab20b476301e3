//! The pose that brings points onto surfaces: point to line, reweighted (Censi 2008 for the idea of the
//! metric; plain Gauss-Newton here).

use pose::Se2;
use pose::nalgebra::{Matrix3, Vector3};

use super::Surfaces;
use crate::SurfacePoint;

/// What is believed before a look at the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// The scan in the frame of the place.
    pub place_from_scan: Se2,
    /// Inverse covariance of that, in the scan's frame.
    pub information: Matrix3<f64>,
}

/// How noise becomes a covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Standard deviation of a range, metres, at least.
    pub range_sigma_m: f64,
    /// So many points err as one.
    pub correlated_points: f64,
}

/// Where points were brought to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aligned {
    /// The scan in the frame of the place.
    pub place_from_scan: Se2,
    /// Covariance of that, in the scan's frame, with the prior where there was one.
    pub covariance: Matrix3<f64>,
    /// Root of the mean square distance across surfaces of the points that found one, metres.
    pub residual_m: f64,
    /// Points that found a surface.
    pub matched: usize,
}

/// Distances within which a point looks for its surface, one after the other, metres.
const REACHES_M: [f64; 4] = [0.4, 0.3, 0.2, 0.15];

/// Steps for each of them, at most.
const STEPS: usize = 6;

/// Brings points onto surfaces from a start; `None` where fewer than ten find one.
///
/// Minimises the distances across surfaces, weighed down by Cauchy's loss, and the deviation from the
/// prior. The covariance is that of the last step, with the points' noise as it was measured, and no
/// less than asked for; without a prior it is near infinite along a direction that no surface bounds.
pub fn align(
    surfaces: &Surfaces,
    points: &[SurfacePoint],
    start: &Se2,
    prior: Option<&Prior>,
    noise: &Noise,
) -> Option<Aligned> {
    let mut pose = *start;
    let mut last = None;
    for reach_m in REACHES_M {
        for _ in 0..STEPS {
            let sums = Sums::of(surfaces, points, &pose, reach_m);
            if sums.matched < 10 {
                return None;
            }
            let sigma = sums.residual_m().max(noise.range_sigma_m);
            let scale = 1.0 / (sigma * sigma * noise.correlated_points);
            let mut hessian = sums.hessian * scale;
            let mut gradient = sums.gradient * scale;
            if let Some(prior) = prior {
                let (of_prior, pull) = pull(prior, &pose);
                hessian += of_prior;
                gradient += pull;
            }
            // A trace of damping: nothing moves along what no surface bounds.
            let damped = hessian + Matrix3::identity() * 1e-6 * hessian.trace().max(1e-9);
            let step = damped.cholesky()?.solve(&-gradient);
            pose = pose.boxplus(&step);
            last = Some((sums, hessian));
            if step.norm() < 1e-5 {
                break;
            }
        }
    }
    let (sums, hessian) = last?;
    // A thousand metres is as good as unbounded.
    let covariance = (hessian + Matrix3::identity() * 1e-6).try_inverse()?;
    let covariance = (covariance + covariance.transpose()) * 0.5;
    Some(Aligned {
        place_from_scan: pose,
        covariance,
        residual_m: sums.residual_m(),
        matched: sums.matched,
    })
}

/// What the prior adds to the equations.
fn pull(prior: &Prior, pose: &Se2) -> (Matrix3<f64>, Vector3<f64>) {
    let (error, jacobian) =
        (pose.boxminus(&prior.place_from_scan), pose.boxminus_jacobians(&prior.place_from_scan).0);
    let weighed = jacobian.transpose() * prior.information;
    (weighed * jacobian, weighed * error)
}

struct Sums {
    hessian: Matrix3<f64>,
    gradient: Vector3<f64>,
    squares: f64,
    matched: usize,
}

impl Sums {
    fn of(surfaces: &Surfaces, points: &[SurfacePoint], pose: &Se2, reach_m: f64) -> Self {
        let mut sums = Self {
            hessian: Matrix3::zeros(),
            gradient: Vector3::zeros(),
            squares: 0.0,
            matched: 0,
        };
        let width = 0.5 * reach_m;
        for source in points {
            let moved = source.moved(pose);
            let Some(target) = surfaces.nearest(&moved.point, reach_m) else { continue };
            if target.normal == geometry::Vector2::zeros() {
                continue;
            }
            // Two sides of a wall, or a wall and what stands before it, are not one surface.
            let known = moved.normal != geometry::Vector2::zeros();
            if known && moved.normal.dot(&target.normal).abs() < 0.7 {
                continue;
            }
            let distance = target.normal.dot(&(moved.point - target.point));
            let in_scan = pose.rotation.inverse() * target.normal;
            let lever = in_scan.y * source.point.x - in_scan.x * source.point.y;
            let row = Vector3::new(in_scan.x, in_scan.y, lever);
            let weight = 1.0 / (1.0 + (distance / width).powi(2));
            sums.hessian += row * row.transpose() * weight;
            sums.gradient += row * (distance * weight);
            sums.squares += distance * distance;
            sums.matched += 1;
        }
        sums
    }

    fn residual_m(&self) -> f64 {
        (self.squares / self.matched.max(1) as f64).sqrt()
    }
}
