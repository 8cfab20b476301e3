//! What the laws are held against: brute force over boundaries, points and pairs of vertices.

use geometry::Point2;
use geometry::planar::{StarPolygon, point_segment_distance};
use maps2d::relative::{Cause, RelativeMap};
use maps2d::volume::LocalVolume;
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, VertexId};

/// Points this near to a deciding line are not judged, metres.
pub const SLACK_M: f64 = 1e-6;

/// Whether a point lies inside, by counting crossings of the boundary; none near the boundary.
pub fn inside(star: &StarPolygon, p: &Point2) -> Option<bool> {
    let mut odd = false;
    for edge in star.boundary() {
        let (a, b) = (edge.from, edge.to);
        if point_segment_distance(p, &a, &b) < SLACK_M {
            return None;
        }
        if (a.y > p.y) != (b.y > p.y) {
            let x = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
            odd ^= x > p.x;
        }
    }
    Some(odd)
}

/// Distance to the nearest obstacle edge or lone hit.
pub fn to_solid_m(volume: &LocalVolume, p: &Point2) -> f64 {
    let walls = volume.obstacles.iter().map(|wall| (wall.from, wall.to));
    let posts = volume.posts.iter().map(|&post| (post, post));
    walls.chain(posts).map(|(a, b)| point_segment_distance(p, &a, &b)).fold(f64::INFINITY, f64::min)
}

/// Shortest distances over the edges that are not withdrawn, by Floyd and Warshall; a metre of a
/// place edge counts as so many.
pub fn distances_m(graph: &PoseGraph, place_weight: f64) -> Vec<Vec<f64>> {
    let n = graph.vertex_count();
    let mut distance = vec![vec![f64::INFINITY; n]; n];
    for (i, row) in distance.iter_mut().enumerate() {
        row[i] = 0.0;
    }
    for (_, edge) in graph.edges().filter(|(_, edge)| !edge.withdrawn) {
        let (a, b) = (edge.a.0 as usize, edge.b.0 as usize);
        let weight = if edge.kind == EdgeKind::Place { place_weight } else { 1.0 };
        let length = weight * edge.a_from_b.translation.norm();
        distance[a][b] = distance[a][b].min(length);
        distance[b][a] = distance[b][a].min(length);
    }
    for k in 0..n {
        for i in 0..n {
            for j in 0..n {
                let through = distance[i][k] + distance[k][j];
                distance[i][j] = distance[i][j].min(through);
            }
        }
    }
    distance
}

/// Frame of the last vertex in the frame of `start`, by walking the edges one after the other;
/// none if they are no way.
pub fn walk(graph: &PoseGraph, start: VertexId, edges: &[EdgeId]) -> Option<(VertexId, Se2)> {
    let mut at = start;
    let mut start_from_at = Se2::identity();
    for &id in edges {
        let edge = graph.edge(id);
        if edge.withdrawn || (at != edge.a && at != edge.b) {
            return None;
        }
        let step = if at == edge.a { edge.a_from_b } else { edge.a_from_b.inverse() };
        start_from_at = start_from_at * step;
        at = if at == edge.a { edge.b } else { edge.a };
    }
    Some((at, start_from_at))
}

/// Parameters at which edges are sampled.
pub const SAMPLES: [f64; 12] =
    [0.004, 0.05, 0.13, 0.21, 0.34, 0.45, 0.52, 0.63, 0.77, 0.86, 0.93, 0.995];

/// What becomes of one point of one frontier edge if everything within `limit_m` along the graph is
/// compared: whether it lies inside another volume, and whether along a wall that another saw. None
/// where a rounding could decide.
pub fn expected_at(
    map: &RelativeMap,
    world_from_vertex: &[Se2],
    distance_m: &[Vec<f64>],
    limit_m: f64,
    (vertex, point): (VertexId, &Point2),
) -> Option<(bool, bool)> {
    let in_world = world_from_vertex[vertex.0 as usize].transform(point);
    let wall_m = map.params().wall_closing_m;
    let (mut is_inside, mut along_wall) = (false, false);
    for (other, state) in map.volumes().filter(|(other, _)| *other != vertex) {
        if distance_m[vertex.0 as usize][other.0 as usize] > limit_m {
            continue;
        }
        let there = world_from_vertex[other.0 as usize].inverse_transform(&in_world);
        is_inside |= inside(&state.volume.inner, &there)?;
        if wall_m > 0.0 {
            let apart_m = to_solid_m(&state.volume, &there);
            if (apart_m - wall_m).abs() < SLACK_M {
                return None;
            }
            along_wall |= apart_m < wall_m;
        }
    }
    Some((is_inside, along_wall))
}

/// Why a point of a frontier edge is closed, as the ledger says.
pub fn cause_at(map: &RelativeMap, vertex: VertexId, edge: usize, t: f64) -> Option<Cause> {
    map.volume(vertex)?.ledgers[edge].reason_at(t).map(|closing| closing.cause)
}
