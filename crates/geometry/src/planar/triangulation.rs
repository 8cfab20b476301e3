//! Constrained Delaunay triangulation of a region (\[Mos15\] 3.6.4, 4.3.1).
//!
//! 1. Corners, on the lattice of overlays, become points, edges become constraints. One that another forbids, because they cross
//!    in an input that is no result of an overlay, is left out.
//! 2. Triangles that hang together without crossing a constraint are one patch; a patch is inside if
//!    the centre of its largest triangle is. So one test of membership decides for many triangles.
//! 3. The triangles inside are numbered; each knows its neighbours over sides that are no constraint.
//!
//! The triangulation itself is the library `spade`'s, which decides exactly. Cost: O(n log n).

use std::collections::{BTreeMap, BTreeSet};

use spade::handles::FixedFaceHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2 as SpadePoint, Triangulation as _};

use super::PlanarError;
use super::overlay::{REACH_M, Region};
use super::segments::point_segment_distance;
use crate::Point2;
use crate::predicates::orient;

/// A triangle of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Its corners, counter-clockwise, as indices into the points.
    pub corners: [u32; 3],
    /// The triangle over the side that starts at each corner; `None` where the region ends.
    pub neighbours: [Option<u32>; 3],
}

/// The inside of a region, cut into triangles along its edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    /// The points, in the frame of the region, metres.
    pub points: Vec<Point2>,
    /// The triangles inside.
    pub triangles: Vec<Triangle>,
}

type Cdt = ConstrainedDelaunayTriangulation<SpadePoint<f64>>;

/// Corners are taken to the lattice of overlays, in whole steps: their results cross nowhere there,
/// while rounding to metres could make a corner cross an edge that it lies on.
const STEPS_PER_M: f64 = 1e6;

/// Beyond this floats skip whole steps.
const MOST_STEPS: f64 = 4e15;

fn unsnappable(point: &Point2) -> PlanarError {
    PlanarError::Unsnappable { x: point.x, y: point.y, reach_m: REACH_M }
}

fn metres(point: &SpadePoint<f64>) -> Point2 {
    Point2::new(point.x / STEPS_PER_M, point.y / STEPS_PER_M)
}

impl Triangulation {
    /// Triangulates the inside of a region; one without an inside has no triangle.
    ///
    /// # Errors
    /// [`PlanarError::Unsnappable`] for a corner that is not finite, or too large or too small to
    /// decide exactly.
    pub fn of<T: Copy>(region: &Region<T>) -> Result<Self, PlanarError> {
        let mut points: Vec<SpadePoint<f64>> = Vec::with_capacity(region.edge_count());
        let mut edges: BTreeSet<[usize; 2]> = BTreeSet::new();
        // Corners that rings share are one point.
        let mut known: BTreeMap<[i64; 2], usize> = BTreeMap::new();
        for ring in &region.rings {
            let mut numbers = Vec::with_capacity(ring.points.len());
            for point in &ring.points {
                let (x, y) = ((point.x * STEPS_PER_M).round(), (point.y * STEPS_PER_M).round());
                // Whole steps that a float holds.
                if !(x.abs() < MOST_STEPS && y.abs() < MOST_STEPS) {
                    return Err(unsnappable(point));
                }
                let number = *known.entry([x as i64, y as i64]).or_insert_with(|| {
                    points.push(SpadePoint::new(x, y));
                    points.len() - 1
                });
                numbers.push(number);
            }
            for (i, &from) in numbers.iter().enumerate() {
                let to = numbers[ring.next(i)];
                if from != to {
                    edges.insert([from.min(to), from.max(to)]);
                }
            }
        }
        let mut refused_edges = 0;
        let somewhere = points.first().copied().unwrap_or(SpadePoint::new(0.0, 0.0));
        let cdt =
            Cdt::try_bulk_load_cdt(points, edges.into_iter().collect(), |_| refused_edges += 1)
                .map_err(|_| unsnappable(&metres(&somewhere)))?;
        Ok(Self::inside(&cdt, region, refused_edges > 0))
    }

    /// The triangles inside; one by one where patches may leak.
    fn inside<T: Copy>(cdt: &Cdt, region: &Region<T>, leaks: bool) -> Self {
        let faces: Vec<FixedFaceHandle<spade::handles::InnerTag>> =
            cdt.inner_faces().map(|face| face.fix()).collect();
        let bound = faces.iter().map(|face| face.index() + 1).max().unwrap_or(0);
        let mut number: Vec<Option<u32>> = vec![None; bound];
        let mut visited = vec![false; bound];
        let mut kept: Vec<FixedFaceHandle<spade::handles::InnerTag>> = Vec::new();
        let mut patch = Vec::new();
        for &first in &faces {
            if std::mem::replace(&mut visited[first.index()], true) {
                continue;
            }
            patch.clear();
            patch.push(first);
            let mut next = 0;
            while let Some(&face) = patch.get(next) {
                next += 1;
                for edge in cdt.face(face).adjacent_edges() {
                    if leaks || edge.is_constraint_edge() {
                        continue;
                    }
                    let Some(over) = edge.rev().face().as_inner() else { continue };
                    let over = over.fix();
                    if !std::mem::replace(&mut visited[over.index()], true) {
                        patch.push(over);
                    }
                }
            }
            let largest =
                patch.iter().max_by(|a, b| cdt.face(**a).area().total_cmp(&cdt.face(**b).area()));
            let Some(&largest) = largest else { continue };
            let centre = cdt.face(largest).center();
            if region.contains(&metres(&centre)) {
                for &face in &patch {
                    number[face.index()] = Some(kept.len() as u32);
                    kept.push(face);
                }
            }
        }
        let points = cdt.vertices().map(|v| metres(&v.position())).collect();
        let triangles = kept
            .iter()
            .map(|&face| {
                let face = cdt.face(face);
                let edges = face.adjacent_edges();
                Triangle {
                    corners: edges.map(|edge| edge.from().fix().index() as u32),
                    neighbours: edges.map(|edge| {
                        let over = edge.rev().face().as_inner()?;
                        if edge.is_constraint_edge() { None } else { number[over.fix().index()] }
                    }),
                }
            })
            .collect();
        Self { points, triangles }
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [Point2; 3] {
        self.triangles[triangle as usize].corners.map(|corner| self.points[corner as usize])
    }

    /// The centre of gravity of a triangle (\[Mos15\] 4.3.1).
    pub fn centroid(&self, triangle: u32) -> Point2 {
        let [a, b, c] = self.corners(triangle);
        Point2::from((a.coords + b.coords + c.coords) / 3.0)
    }

    /// The area of all triangles, square metres.
    pub fn area_m2(&self) -> f64 {
        (0..self.triangles.len() as u32)
            .map(|triangle| {
                let [a, b, c] = self.corners(triangle);
                0.5 * (b - a).perp(&(c - a))
            })
            .sum()
    }

    /// The triangle that holds a point, or the nearest one within `slack_m` of it. Cost: linear.
    pub fn locate(&self, point: &Point2, slack_m: f64) -> Option<u32> {
        let mut nearest: Option<(f64, u32)> = None;
        for index in 0..self.triangles.len() as u32 {
            let [a, b, c] = self.corners(index);
            let inside = orient(&a, &b, point) >= 0.0
                && orient(&b, &c, point) >= 0.0
                && orient(&c, &a, point) >= 0.0;
            if inside {
                return Some(index);
            }
            let distance_m = point_segment_distance(point, &a, &b)
                .min(point_segment_distance(point, &b, &c))
                .min(point_segment_distance(point, &c, &a));
            if distance_m <= slack_m && nearest.is_none_or(|(best_m, _)| distance_m < best_m) {
                nearest = Some((distance_m, index));
            }
        }
        nearest.map(|(_, index)| index)
    }
}
