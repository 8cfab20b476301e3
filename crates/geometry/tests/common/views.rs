//! Pairs of views that lie as badly to each other as views do.

use geometry::Point2;
use geometry::planar::StarPolygon;
use geometry::planar::overlay::{EdgeLabel, Region, RingEdge};

/// Seeded draws.
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }
}

/// A view from `at` in a room of 6 by 4 m with its lower-left corner at the origin, 5 m far.
fn in_room(draw: &mut Draw, at: Point2, wide: bool) -> StarPolygon {
    let rays = 3 + draw.below(22);
    let span = if wide { std::f64::consts::TAU } else { draw.between(0.3, 3.0) };
    let first = draw.between(-3.0, 3.0);
    let steps = if wide { rays } else { rays - 1 };
    let vertices = (0..rays).map(|i| {
        let bearing = first + span * i as f64 / steps as f64;
        let (sin, cos) = bearing.sin_cos();
        let to = |at: f64, low: f64, high: f64, slope: f64| {
            if slope > 0.0 {
                (high - at) / slope
            } else if slope < 0.0 {
                (low - at) / slope
            } else {
                f64::INFINITY
            }
        };
        let range = to(at.x, 0.0, 6.0, cos).min(to(at.y, 0.0, 4.0, sin)).min(5.0);
        Point2::new(range * cos, range * sin)
    });
    let vertices: Vec<Point2> = vertices.collect();
    let gap_after = (0..rays).map(|i| !wide && i + 1 == rays).collect();
    StarPolygon::try_new(vertices, gap_after).unwrap_or_else(|_| StarPolygon::empty())
}

/// A view with ranges of any length around the origin.
fn ragged(draw: &mut Draw) -> StarPolygon {
    let rays = 4 + draw.below(56);
    let open = draw.below(2) == 0;
    let vertices = (0..rays).map(|i| {
        let bearing = std::f64::consts::TAU * i as f64 / rays as f64;
        let range = draw.between(0.5, 4.0);
        Point2::new(range * bearing.cos(), range * bearing.sin())
    });
    let vertices: Vec<Point2> = vertices.collect();
    let gap_after = (0..rays).map(|i| open && (i + 1 == rays || i == rays / 2)).collect();
    StarPolygon::try_new(vertices, gap_after).unwrap_or_else(|_| StarPolygon::empty())
}

fn region(draw: &mut Draw, view: &StarPolygon, by: (f64, f64)) -> Region<u32> {
    let labels = [EdgeLabel::Free, EdgeLabel::Frontier, EdgeLabel::Obstacle];
    let shift = draw.below(3);
    let mut count = 0;
    let edges: Vec<RingEdge<u32>> = view
        .boundary()
        .map(|_| {
            count += 1;
            RingEdge { label: labels[(count as usize + shift) % 3], data: count }
        })
        .collect();
    let points = view.boundary().map(|side| Point2::new(side.from.x + by.0, side.from.y + by.1));
    if edges.is_empty() { Region::default() } else { Region::from_ring(points.zip(edges)) }
}

/// How many kinds of pairs there are.
pub const KINDS: usize = 7;

/// A pair of views and its kind: ragged anyhow; in one room, with walls in common; from one place,
/// with corners in common; touching along a side; identical; apart by 1e-12 m; touching in a corner.
pub fn pair(draw: &mut Draw, case: usize) -> (Region<u32>, Region<u32>, usize) {
    let kind = case % KINDS;
    let place = |draw: &mut Draw| Point2::new(draw.between(0.5, 5.5), draw.between(0.5, 3.5));
    let wide = draw.below(2) == 0;
    let (a, b, by_a, by_b) = match kind {
        0 => {
            let by = (draw.between(-5.0, 5.0), draw.between(-5.0, 5.0));
            (ragged(draw), ragged(draw), (0.0, 0.0), by)
        }
        1 => {
            let (p, q) = (place(draw), place(draw));
            (in_room(draw, p, wide), in_room(draw, q, !wide), (p.x, p.y), (q.x, q.y))
        }
        2 => {
            let a = ragged(draw);
            let kept = draw.below(3);
            let changed = a
                .vertices()
                .iter()
                .enumerate()
                .map(|(i, v)| if i % 3 == kept { *v * draw.between(0.4, 1.4) } else { *v });
            let changed: Vec<Point2> = changed.collect();
            let gaps = (0..a.len()).map(|i| a.is_gap(i)).collect();
            let b = StarPolygon::try_new(changed, gaps).unwrap_or_else(|_| StarPolygon::empty());
            (a, b, (0.0, 0.0), (0.0, 0.0))
        }
        3 => {
            let p = place(draw);
            let a = in_room(draw, p, true);
            // The room next door, mirrored by a shift: its left wall is this one's right wall.
            let q = place(draw);
            (a, in_room(draw, q, true), (p.x, p.y), (q.x + 6.0, q.y + draw.between(-2.0, 2.0)))
        }
        4 => {
            let a = ragged(draw);
            (a.clone(), a, (1.5, -2.5), (1.5, -2.5))
        }
        5 => {
            let p = place(draw);
            let a = in_room(draw, p, wide);
            let (dx, dy) = (draw.between(-1e-12, 1e-12), draw.between(-1e-12, 1e-12));
            (a.clone(), a, (p.x, p.y), (p.x + dx, p.y + dy))
        }
        _ => {
            let (a, b) = (ragged(draw), ragged(draw));
            let by = if a.is_empty() || b.is_empty() {
                (0.0, 0.0)
            } else {
                let (v, w) = (a.vertex(draw.below(a.len())), b.vertex(draw.below(b.len())));
                (v.x - w.x, v.y - w.y)
            };
            (a, b, (0.0, 0.0), by)
        }
    };
    let (a, b) = (region(draw, &a, by_a), region(draw, &b, by_b));
    (a, b, kind)
}
