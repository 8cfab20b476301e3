//! Random polygons and query points on a small grid, most of them degenerate.
//!
//! Vertices have coordinates that are multiples of eight, so that eighths of chords and spokes are
//! grid points too.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::Float;
use proptest::prelude::*;

use super::oracle::{At, Outline};
use geometry::Point2;
use geometry::planar::StarPolygon;

pub type Grid = (i64, i64);

/// A star polygon on the grid.
#[derive(Clone, Debug)]
pub struct GridStar {
    pub vertices: Vec<Grid>,
    pub gap_after: Vec<bool>,
}

fn cross(a: Grid, b: Grid) -> i64 {
    a.0 * b.1 - a.1 * b.0
}

/// Compares bearings counted from the x axis by quadrant and cross product, in integers.
pub fn by_bearing(a: &Grid, b: &Grid) -> Ordering {
    let lower = |p: &Grid| p.1 < 0 || (p.1 == 0 && p.0 < 0);
    lower(a).cmp(&lower(b)).then_with(|| 0.cmp(&cross(*a, *b)))
}

impl GridStar {
    /// The valid polygon nearest to what was drawn: sorted, one vertex per bearing, gaps where a
    /// chord would be too wide; starting at any vertex.
    fn from_drawn(mut drawn: Vec<(Grid, bool)>, first: usize) -> Self {
        drawn.retain(|(p, _)| *p != (0, 0));
        drawn.sort_by(|a, b| by_bearing(&a.0, &b.0));
        drawn.dedup_by(|a, b| by_bearing(&a.0, &b.0).is_eq());
        let n = drawn.len();
        if n > 0 {
            drawn.rotate_left(first % n);
        }
        let vertices: Vec<Grid> = drawn.iter().map(|(p, _)| (8 * p.0, 8 * p.1)).collect();
        let gap_after =
            (0..n).map(|i| drawn[i].1 || cross(vertices[i], vertices[(i + 1) % n]) <= 0).collect();
        Self { vertices, gap_after }
    }

    pub fn star(&self, place: impl Fn(Grid) -> Point2) -> StarPolygon {
        let vertices = self.vertices.iter().map(|&p| place(p)).collect();
        StarPolygon::try_new(vertices, self.gap_after.clone()).unwrap()
    }

    pub fn outline(&self) -> Outline<i128> {
        let vertices: Vec<_> = self.vertices.iter().map(|&p| whole(p)).collect();
        Outline::new(&vertices, &self.gap_after)
    }
}

/// A polygon: points anywhere, on few lines, or alternately near and far; with no, few or many
/// gaps; up to a full circle.
pub fn stars() -> impl Strategy<Value = GridStar> {
    let anywhere = |r: i64| (-r..=r, -r..=r);
    let on_lines = (prop::sample::select(vec![-3_i64, 2, 5]), -7_i64..=7, any::<bool>())
        .prop_map(|(c, t, upright)| if upright { (c, t) } else { (t, c) });
    let needles = (anywhere(5), prop::sample::select(vec![1_i64, 1, 9]))
        .prop_map(|((x, y), k)| (k * x, k * y));
    let point = prop_oneof![
        2 => anywhere(2).boxed(),
        2 => anywhere(6).boxed(),
        1 => anywhere(60).boxed(),
        2 => on_lines.boxed(),
        2 => needles.boxed(),
    ];
    let gap = |share: f64| prop::bool::weighted(share);
    prop_oneof![
        3 => prop::collection::vec((point.clone(), gap(0.0)), 0..28),
        2 => prop::collection::vec((point.clone(), gap(0.2)), 0..28),
        1 => prop::collection::vec((point, gap(0.7)), 0..10),
    ]
    .prop_flat_map(|drawn| (Just(drawn), any::<prop::sample::Index>()))
    .prop_map(|(drawn, first)| {
        let first = if drawn.is_empty() { 0 } else { first.index(drawn.len()) };
        GridStar::from_drawn(drawn, first)
    })
}

/// A query point, often exactly on something.
#[derive(Clone, Debug)]
pub enum Spot {
    Anywhere(i64, i64),
    Origin,
    /// Eighths from vertex `i` to the next, also beyond both.
    OnChordLine(prop::sample::Index, i64),
    /// Eighths of vertex `i`, also beyond it and on the other side of the origin.
    OnRay(prop::sample::Index, i64),
}

impl Spot {
    pub fn on(&self, star: &GridStar) -> Grid {
        let n = star.vertices.len();
        match self {
            Self::Anywhere(x, y) => (*x, *y),
            Self::OnChordLine(i, t) if n > 0 => {
                let i = i.index(n);
                let (v, w) = (star.vertices[i], star.vertices[(i + 1) % n]);
                (v.0 + (w.0 - v.0) / 8 * t, v.1 + (w.1 - v.1) / 8 * t)
            }
            Self::OnRay(i, t) if n > 0 => {
                let v = star.vertices[i.index(n)];
                (v.0 / 8 * t, v.1 / 8 * t)
            }
            _ => (0, 0),
        }
    }
}

pub fn spots() -> impl Strategy<Value = Spot> {
    let index = any::<prop::sample::Index>;
    prop_oneof![
        3 => (-56_i64..=56, -56_i64..=56).prop_map(|(x, y)| Spot::Anywhere(x, y)),
        1 => (-6_i64..=6, -6_i64..=6).prop_map(|(x, y)| Spot::Anywhere(8 * x, 8 * y)),
        1 => Just(Spot::Origin),
        3 => (index(), -8_i64..=16).prop_map(|(i, t)| Spot::OnChordLine(i, t)),
        3 => (index(), -10_i64..=10).prop_map(|(i, t)| Spot::OnRay(i, t)),
    ]
}

/// How grid points become floats.
#[derive(Clone, Debug)]
pub struct Rounding {
    pub scale: f64,
    pub turn: f64,
}

impl Rounding {
    pub fn place(&self, p: Grid) -> Point2 {
        let (sin, cos) = self.turn.sin_cos();
        let (x, y) = (p.0 as f64, p.1 as f64);
        Point2::new(self.scale * (cos * x - sin * y), self.scale * (sin * x + cos * y))
    }
}

/// Scales and turns that round, so that what was collinear is so but for the last bit.
pub fn roundings() -> impl Strategy<Value = Rounding> {
    let scale = prop_oneof![Just(0.1), Just(1.0 / 3.0), Just(1e-90), Just(1.7e90), 0.01..0.5_f64];
    let turn = prop_oneof![Just(0.0), Just(1e-9), Just(0.7), -3.2..3.2_f64];
    (scale, turn).prop_map(|(scale, turn)| Rounding { scale, turn })
}

pub fn exact(p: Grid) -> Point2 {
    Point2::new(p.0 as f64, p.1 as f64)
}

pub fn whole(p: Grid) -> At<i128> {
    At { x: p.0.into(), y: p.1.into() }
}

/// The points times one power of two that makes all their coordinates integers.
pub fn scaled_up(points: &[Point2]) -> Vec<At<BigInt>> {
    let unit = |c: f64| (c != 0.0).then(|| Float::integer_decode(c).1);
    let shift = points.iter().flat_map(|p| [p.x, p.y]).filter_map(unit).min().unwrap_or(0);
    let up = |c: f64| {
        let (mantissa, exponent, sign) = Float::integer_decode(c);
        let bits = if c == 0.0 { 0 } else { exponent - shift };
        (BigInt::from(mantissa) << usize::try_from(bits).unwrap()) * sign
    };
    points.iter().map(|p| At { x: up(p.x), y: up(p.y) }).collect()
}
