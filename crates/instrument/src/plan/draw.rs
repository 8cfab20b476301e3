//! Tetrahedra, graphs and half-spaces as lines.

use maps3d::plan::{DualGraph, Space};
use solid::{Point3, Vector3};

/// Edges of the whole map are drawn up to so many tetrahedra.
const MOST_DRAWN: usize = 20_000;

/// Half of the side of the square that stands for a half-space, metres, at most.
const HALF_M: f64 = 0.25;

/// The corners of all tetrahedra, by number.
pub(crate) fn corners(space: &Space) -> Vec<[Point3; 4]> {
    (0..space.len() as u32).map(|t| space.corners(t).map(|corner| *corner)).collect()
}

/// The edges of some tetrahedra, each once.
pub(crate) fn edges<'a>(tetrahedra: impl IntoIterator<Item = &'a [Point3; 4]>) -> Vec<[Point3; 2]> {
    let of = |tet: &[Point3; 4]| {
        [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)].map(|(i, j)| [tet[i], tet[j]])
    };
    let bits = |p: &Point3| [p.x, p.y, p.z].map(f64::to_bits);
    let key = |[a, b]: &[Point3; 2]| {
        let (a, b) = (bits(a), bits(b));
        if a <= b { [a, b] } else { [b, a] }
    };
    let mut edges: Vec<[Point3; 2]> =
        tetrahedra.into_iter().take(MOST_DRAWN).flat_map(of).collect();
    edges.sort_by_cached_key(key);
    edges.dedup_by_key(|edge| key(edge));
    edges
}

/// The frontier faces, as their sides.
pub(crate) fn frontier(space: &Space) -> Vec<[Point3; 2]> {
    let faces = space.frontier().iter().map(|face| space.points(face.corners));
    faces.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect()
}

/// The legs of the dual graph, straight from node to node.
pub(crate) fn legs(graph: &DualGraph) -> Vec<[Point3; 2]> {
    let points = graph.points();
    graph.edges().take(6 * MOST_DRAWN).map(|pair| pair.map(|node| points[node as usize])).collect()
}

/// The frontier points of the dual graph.
pub(crate) fn goals(graph: &DualGraph) -> Vec<Point3> {
    graph.frontier().iter().map(|node| node.at).collect()
}

/// The segments of a polyline.
pub(crate) fn segments(points: &[Point3]) -> Vec<[Point3; 2]> {
    points.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// A square in the plane that keeps a polyline `radius_m` from an obstacle, and the line to the obstacle.
pub(crate) fn half_space(from: &Point3, obstacle: &Point3, radius_m: f64) -> Vec<[Point3; 2]> {
    let Some(normal) = (from - obstacle).try_normalize(1e-12) else { return Vec::new() };
    let axis = Vector3::ith(normal.iamin(), 1.0);
    let u = normal.cross(&axis).normalize();
    let v = normal.cross(&u);
    let half_m = HALF_M.min(radius_m.max(0.02));
    let middle = obstacle + normal * radius_m;
    let corner = |a: f64, b: f64| middle + (u * a + v * b) * half_m;
    let square = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mut lines: Vec<_> = (0..4).map(|i| [square[i], square[(i + 1) % 4]]).collect();
    lines.push([*obstacle, middle]);
    lines
}
