//! A walled room with pillars, and scans of it by brute force over its walls.

use std::f64::consts::TAU;

use geometry::Point2;
use geometry::planar::point_segment_distance;
use pose::Se2;
use proptest::prelude::*;
use sensing::Scan;

/// Walls of a room; everything stands in the `world` frame, metres.
#[derive(Clone, Debug)]
pub struct Room {
    pub width_m: f64,
    pub height_m: f64,
    /// Lower-left corner, width and height.
    pub pillars: Vec<[f64; 4]>,
}

impl Room {
    pub fn walls(&self) -> Vec<(Point2, Point2)> {
        let outer = [0.0, 0.0, self.width_m, self.height_m];
        std::iter::once(&outer)
            .chain(&self.pillars)
            .flat_map(|&[x, y, w, h]| {
                let corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
                    .map(|(x, y)| Point2::new(x, y));
                (0..4).map(move |i| (corners[i], corners[(i + 1) % 4]))
            })
            .collect()
    }

    /// Whether a robot may stand here: 0.2 m from everything.
    pub fn is_free(&self, p: &Point2) -> bool {
        let within = |[x, y, w, h]: [f64; 4]| p.x > x && p.x < x + w && p.y > y && p.y < y + h;
        within([0.0, 0.0, self.width_m, self.height_m])
            && !self.pillars.iter().any(|&pillar| within(pillar))
            && self.walls().iter().all(|(a, b)| point_segment_distance(p, a, b) > 0.2)
    }

    /// Distance to the first wall on a ray, by all its intersections with walls.
    pub fn cast(&self, from: &Point2, bearing_rad: f64) -> f64 {
        let (sin, cos) = bearing_rad.sin_cos();
        let mut nearest = f64::INFINITY;
        for (a, b) in self.walls() {
            let (ex, ey) = (b.x - a.x, b.y - a.y);
            let (dx, dy) = (a.x - from.x, a.y - from.y);
            let turn = cos * ey - sin * ex;
            if turn.abs() < 1e-12 {
                continue;
            }
            let along = (dx * ey - dy * ex) / turn;
            let across = (dx * sin - dy * cos) / turn;
            if along >= 0.0 && (-1e-9..=1.0 + 1e-9).contains(&across) {
                nearest = nearest.min(along);
            }
        }
        nearest
    }

    pub fn scan(&self, world_from_body: &Se2, sensor: &Sensor) -> Scan {
        let from = Point2::from(world_from_body.translation);
        let ranges = (0..sensor.rays)
            .map(|i| {
                let bearing = sensor.first_rad() + sensor.step_rad() * i as f64;
                self.cast(&from, bearing + world_from_body.angle())
            })
            .collect();
        Scan::new(sensor.first_rad(), sensor.step_rad(), ranges, sensor.range_m)
    }
}

/// A range sensor that looks ahead, or all round.
#[derive(Clone, Debug)]
pub struct Sensor {
    pub fov_rad: f64,
    pub rays: usize,
    pub range_m: f64,
}

impl Sensor {
    fn first_rad(&self) -> f64 {
        -0.5 * self.fov_rad
    }

    fn step_rad(&self) -> f64 {
        let steps = if self.fov_rad >= TAU { self.rays } else { self.rays - 1 };
        self.fov_rad / steps as f64
    }
}

pub fn rooms() -> impl Strategy<Value = Room> {
    let pillar = (0.1..0.8_f64, 0.1..0.8_f64, 0.3..2.5_f64, 0.2..2.5_f64);
    (6.0..16.0_f64, 5.0..12.0_f64, prop::collection::vec(pillar, 0..5)).prop_map(
        |(width_m, height_m, pillars)| Room {
            width_m,
            height_m,
            pillars: pillars
                .into_iter()
                .map(|(x, y, w, h)| {
                    let (x, y) = (x * width_m, y * height_m);
                    // No pillar touches the outer wall.
                    [x, y, w.min(0.9 * (width_m - x)), h.min(0.9 * (height_m - y))]
                })
                .collect(),
        },
    )
}

pub fn sensors() -> impl Strategy<Value = Sensor> {
    let fov = prop_oneof![
        2 => Just(115.0_f64.to_radians()),
        1 => Just(200.0_f64.to_radians()),
        1 => Just(TAU),
    ];
    (fov, 9_usize..30, 2.5..6.0_f64).prop_map(|(fov_rad, rays, range_m)| Sensor {
        fov_rad,
        rays,
        range_m,
    })
}
