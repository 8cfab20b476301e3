//! Keyframes: scans that are kept, as points of surfaces.

use geometry::{Point2, Vector2};
use pose::Se2;
use sensing::{Reading, Scan};

use crate::{KeyframeParams, OdometryNoise};
use pose::nalgebra::{Matrix3, Vector3};

/// A returned point and the direction across the surface that it lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point.
    pub point: Point2,
    /// Unit vector across the surface; zero where the scan does not show one.
    pub normal: Vector2,
}

impl SurfacePoint {
    /// The same in another frame.
    pub fn moved(&self, target_from_source: &Se2) -> Self {
        Self {
            point: target_from_source.transform(&self.point),
            normal: target_from_source.rotation * self.normal,
        }
    }
}

/// A scan that is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// The scan.
    pub scan: Scan,
    /// Its returns within range, in the body's frame, by rising bearing.
    pub surface: Vec<SurfacePoint>,
    /// Distance driven up to it, metres.
    pub travelled_m: f64,
}

impl Keyframe {
    /// The keyframe of a scan; returns from beyond `range_m` are left out, and those within `spacing_m` of
    /// the one kept before.
    pub fn new(scan: Scan, travelled_m: f64, range_m: f64, spacing_m: f64) -> Self {
        let mut surface = surface_of(&scan, range_m);
        let mut last: Option<Point2> = None;
        surface.retain(|kept| {
            let far = last.is_none_or(|last| (kept.point - last).norm() >= spacing_m);
            if far {
                last = Some(kept.point);
            }
            far
        });
        Self { scan, surface, travelled_m }
    }

    /// How far the scan saw beyond a point, in its frame: negative where the point lies behind what was
    /// hit, `None` where no ray went by.
    pub fn free_beyond(&self, point: &Point2) -> Option<f64> {
        let bearing = point.y.atan2(point.x);
        let turns = (bearing - self.scan.first_bearing_rad).rem_euclid(std::f64::consts::TAU);
        let ray = turns / self.scan.bearing_step_rad;
        let (low, high) = (ray.floor() as usize, ray.ceil() as usize);
        if high >= self.scan.len() {
            return None;
        }
        // The nearer of two neighbours: a ray past a corner tells nothing of it.
        let range = |i: usize| match self.scan.reading(i) {
            Reading::Hit(range_m) => Some(range_m),
            Reading::Miss => None,
        };
        Some(range(low)?.min(range(high)?) - point.coords.norm())
    }
}

/// Returns within range with the direction across their surface, from the returns beside them.
fn surface_of(scan: &Scan, range_m: f64) -> Vec<SurfacePoint> {
    let hits: Vec<(usize, f64, Point2)> = scan
        .readings()
        .enumerate()
        .filter_map(|(i, (bearing, reading))| match reading {
            Reading::Hit(range) if range > 0.05 && range <= range_m => {
                Some((i, range, Point2::new(range * bearing.cos(), range * bearing.sin())))
            }
            _ => None,
        })
        .collect();
    let mut surface = Vec::with_capacity(hits.len());
    for (at, &(ray, range, point)) in hits.iter().enumerate() {
        // As far as three rays' spacing, a hand's breadth at least.
        let reach = (4.0 * range * scan.bearing_step_rad).max(0.15);
        let beside = |other: &&(usize, f64, Point2)| {
            other.0.abs_diff(ray) <= 4 && (other.2 - point).norm() <= reach
        };
        let near = hits[at.saturating_sub(4)..(at + 5).min(hits.len())].iter().filter(beside);
        let (mut count, mut sum, mut xx, mut xy, mut yy) = (0.0, Vector2::zeros(), 0.0, 0.0, 0.0);
        for (_, _, other) in near {
            let offset = other - point;
            count += 1.0;
            sum += offset;
            xx += offset.x * offset.x;
            xy += offset.x * offset.y;
            yy += offset.y * offset.y;
        }
        let normal = if count >= 3.0 {
            let mean = sum / count;
            let (xx, xy, yy) = (
                xx / count - mean.x * mean.x,
                xy / count - mean.x * mean.y,
                yy / count - mean.y * mean.y,
            );
            let along = 0.5 * (2.0 * xy).atan2(xx - yy);
            let spread = ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt();
            // Flat: nine tenths of the spread lie along one line.
            let flat = spread > 0.8 * (xx + yy) && xx + yy > 0.0;
            if flat { Vector2::new(-along.sin(), along.cos()) } else { Vector2::zeros() }
        } else {
            Vector2::zeros()
        };
        surface.push(SurfacePoint { point, normal });
    }
    surface
}

impl KeyframeParams {
    /// Whether a scan is far enough from the last keyframe, both as the odometry has them.
    pub fn is_due(&self, keyframe_from_scan: &Se2) -> bool {
        keyframe_from_scan.distance() >= self.distance_m
            || keyframe_from_scan.angle().abs() >= self.angle_rad
    }
}

impl OdometryNoise {
    /// Covariance of a motion over which so far was driven and turned, in the frame after it.
    pub fn covariance(&self, driven_m: f64, turned_rad: f64) -> Matrix3<f64> {
        let squared = |sigma: f64, over: f64| sigma * sigma * over;
        let along = squared(self.sigma_translation, driven_m) + squared(self.least_m, 1.0);
        let heading = squared(self.sigma_rotation_rad, driven_m)
            + squared(self.sigma_turn_rad, turned_rad)
            + squared(self.least_rad, 1.0);
        Matrix3::from_diagonal(&Vector3::new(along, along, heading))
    }
}
