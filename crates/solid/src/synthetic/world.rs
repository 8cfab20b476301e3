//! A room with boxes and columns.

use crate::{Point3, Vector3};

/// A room, and what stands in it.
#[derive(Clone, Debug)]
pub struct World {
    /// Lowest and highest corner of the room, metres.
    pub room: [Point3; 2],
    /// Lowest and highest corner of each box, metres.
    pub boxes: Vec<[Point3; 2]>,
    /// Axis, radius and height of each column, metres.
    pub columns: Vec<([f64; 2], f64, f64)>,
}

impl World {
    /// A hall of 12 m by 9 m with shelves, blocks and two columns.
    pub fn hall() -> Self {
        let p = Point3::new;
        let boxes = [
            [1.5, 2.0, 0.0, 3.0, 2.8, 1.0],
            [4.5, 5.5, 0.0, 5.7, 6.5, 2.4],
            [8.2, 1.2, 0.0, 9.4, 3.4, 0.9],
            [1.0, 6.2, 0.0, 2.2, 7.8, 1.6],
            [5.6, 2.6, 0.0, 6.2, 3.3, 3.0],
            [9.6, 6.4, 1.1, 10.8, 7.4, 2.1],
        ];
        Self {
            room: [p(0.0, 0.0, 0.0), p(12.0, 9.0, 3.0)],
            boxes: boxes.map(|[a, b, c, d, e, f]| [p(a, b, c), p(d, e, f)]).to_vec(),
            columns: vec![([7.4, 4.9], 0.4, 2.1), ([3.7, 7.2], 0.3, 3.0)],
        }
    }

    /// How many times `direction` it is from `from`, inside the room, to the first surface.
    pub fn cast(&self, from: &Point3, direction: &Vector3) -> f64 {
        let slabs = |[low, high]: &[Point3; 2]| {
            let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
            for i in 0..3 {
                if direction[i] == 0.0 {
                    if from[i] < low[i] || from[i] > high[i] {
                        enter = f64::INFINITY;
                    }
                    continue;
                }
                let a = (low[i] - from[i]) / direction[i];
                let b = (high[i] - from[i]) / direction[i];
                enter = enter.max(a.min(b));
                leave = leave.min(a.max(b));
            }
            (enter, leave)
        };
        let mut nearest = slabs(&self.room).1;
        for solid in &self.boxes {
            let (enter, leave) = slabs(solid);
            if enter <= leave && enter > 1e-9 {
                nearest = nearest.min(enter);
            }
        }
        for &([x, y], radius, height) in &self.columns {
            let (ox, oy) = (from.x - x, from.y - y);
            let a = direction.x * direction.x + direction.y * direction.y;
            let b = ox * direction.x + oy * direction.y;
            let inside = b * b - a * (ox * ox + oy * oy - radius * radius);
            if inside > 0.0 && a > 0.0 {
                let t = (-b - inside.sqrt()) / a;
                let z = from.z + t * direction.z;
                if t > 1e-9 && (0.0..height).contains(&z) {
                    nearest = nearest.min(t);
                }
            }
            let t = (height - from.z) / direction.z;
            let (px, py) = (ox + t * direction.x, oy + t * direction.y);
            if t > 1e-9 && px * px + py * py < radius * radius {
                nearest = nearest.min(t);
            }
        }
        nearest
    }

    /// Whether a point is farther than `clearance_m` from everything.
    pub fn is_free(&self, p: &Point3, clearance_m: f64) -> bool {
        let [low, high] = &self.room;
        let within = |low: &Point3, high: &Point3, margin: f64| {
            (0..3).all(|i| low[i] - margin < p[i] && p[i] < high[i] + margin)
        };
        within(low, high, -clearance_m)
            && !self.boxes.iter().any(|[low, high]| within(low, high, clearance_m))
            && !self
                .columns
                .iter()
                .any(|&([x, y], radius, _)| (p.x - x).hypot(p.y - y) < radius + clearance_m)
    }
}
