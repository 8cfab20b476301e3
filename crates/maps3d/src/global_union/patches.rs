//! Step 4: frontier faces that hang together, and points to go to on them.

use probe::VertexId;
use solid::{Label, Point3, Polyhedron, Side, Vector3};

use super::UnionParams;
use super::places::is_in;
use super::surface::Surface;
use crate::{FrontierPatch, FrontierPoint};

/// Parts that one edge of a frontier face is cut into, at most.
const MOST_CUTS: usize = 64;

/// A part of a frontier face.
#[derive(Clone, Copy, Debug)]
struct Piece {
    face: u32,
    at: Point3,
    normal: Vector3,
    area_m2: f64,
}

/// The frontier of a map, sorted.
#[derive(Clone, Debug, Default)]
pub(super) struct Frontier {
    /// Patches that count; points in the frame `map`.
    pub patches: Vec<FrontierPatch>,
    /// Frontier faces of the united map that are in them, ascending.
    pub faces: Vec<u32>,
    pub sliver_m2: f64,
    pub largest_sliver_m2: f64,
    pub given_up_m2: f64,
}

impl Frontier {
    /// Sorts the frontier of some surfaces, the united map first; `given_up` are balls.
    ///
    /// Frontier of one surface that lies inside another is none. O(f log f) for f frontier faces.
    pub fn of(surfaces: &[&Surface], given_up: &[(Point3, f64)], params: &UnionParams) -> Self {
        let mut found = Self::default();
        for (index, surface) in surfaces.iter().enumerate() {
            let others: Vec<&Surface> =
                surfaces.iter().enumerate().filter(|(i, _)| *i != index).map(|(_, s)| *s).collect();
            let hidden = |at: &Point3| others.iter().any(|other| other.side(at) == Side::Inside);
            let mut pieces = Vec::new();
            for face in frontier_faces(&surface.mesh) {
                cut(&surface.mesh, face, params.piece_m, |piece| {
                    if is_in(given_up, &piece.at) && !hidden(&piece.at) {
                        found.given_up_m2 += piece.area_m2;
                    } else if !hidden(&piece.at) {
                        pieces.push(piece);
                    }
                });
            }
            let of_face = connected(&surface.mesh, &pieces);
            // Pieces of one patch follow each other, in the order of faces.
            pieces.sort_by_key(|piece| (of_face[piece.face as usize], piece.face));
            let groups =
                pieces.chunk_by(|a, b| of_face[a.face as usize] == of_face[b.face as usize]);
            for group in groups {
                let area_m2: f64 = group.iter().map(|piece| piece.area_m2).sum();
                if area_m2 < params.sliver_m2 {
                    found.sliver_m2 += area_m2;
                    found.largest_sliver_m2 = found.largest_sliver_m2.max(area_m2);
                    continue;
                }
                if index == 0 {
                    found.faces.extend(group.iter().map(|piece| piece.face));
                }
                let points = points_of(group, params.point_m);
                let tag = found.patches.len() as u64;
                let owner = VertexId(0);
                found.patches.push(FrontierPatch { owner, points, area_m2, tag });
            }
        }
        found.faces.sort_unstable();
        found.faces.dedup();
        found
    }

    /// Area of what counts, square metres.
    pub fn open_m2(&self) -> f64 {
        // The sum of nothing is -0.0 otherwise.
        self.patches.iter().fold(0.0, |sum, patch| sum + patch.area_m2)
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        let points: usize = self.patches.iter().map(|patch| patch.points.len()).sum();
        size_of_val(&self.faces[..])
            + size_of_val(&self.patches[..])
            + points * size_of::<FrontierPoint>()
    }
}

fn frontier_faces(mesh: &Polyhedron) -> impl Iterator<Item = usize> + '_ {
    let labels = mesh.labels().iter().enumerate();
    labels.filter(|(_, label)| **label == Label::Frontier).map(|(face, _)| face)
}

/// Cuts a face into n² equal triangles, none with an edge longer than `piece_m`.
fn cut(mesh: &Polyhedron, face: usize, piece_m: f64, found: impl FnMut(Piece)) {
    let corners = mesh.corners(face);
    let Some(normal) = mesh.scaled_normal(face).try_normalize(0.0) else { return };
    let cuts = cuts_of(corners, piece_m);
    let area_m2 = mesh.face_area_m2(face) / (cuts * cuts) as f64;
    let piece = |at| Piece { face: face as u32, at, normal, area_m2 };
    pieces_of(corners, piece_m).map(piece).for_each(found);
}

/// How many parts each edge is cut into.
fn cuts_of([a, b, c]: [&Point3; 3], piece_m: f64) -> usize {
    let longest = (b - a).norm().max((c - a).norm()).max((c - b).norm());
    (longest / piece_m).ceil().clamp(1.0, MOST_CUTS as f64) as usize
}

/// The middles of the n² equal triangles that a face is cut into, none with an edge longer than `piece_m` unless
/// there were too many.
pub(super) fn pieces_of(corners: [&Point3; 3], piece_m: f64) -> impl Iterator<Item = Point3> {
    let [a, b, c] = corners.map(|corner| *corner);
    let cuts = cuts_of(corners, piece_m);
    let at = move |i: f64, j: f64| a + (b - a) * (i / cuts as f64) + (c - a) * (j / cuts as f64);
    let squares = (0..cuts).flat_map(move |i| (0..cuts - i).map(move |j| (i, j)));
    squares.flat_map(move |(i, j)| {
        let (x, y) = (i as f64, j as f64);
        let beyond = (i + j + 1 < cuts).then(|| at(x + 2.0 / 3.0, y + 2.0 / 3.0));
        std::iter::once(at(x + 1.0 / 3.0, y + 1.0 / 3.0)).chain(beyond)
    })
}

/// For each face that has a piece the least face that it hangs together with over edges; others stand alone.
fn connected(mesh: &Polyhedron, pieces: &[Piece]) -> Vec<u32> {
    let mut root: Vec<u32> = (0..mesh.faces().len() as u32).collect();
    let mut edges: Vec<([u32; 2], u32)> = Vec::new();
    let mut last = None;
    for piece in pieces {
        // Pieces of one face follow each other.
        if last.replace(piece.face) == Some(piece.face) {
            continue;
        }
        let [a, b, c] = mesh.faces()[piece.face as usize];
        edges.extend([(a, b), (b, c), (c, a)].map(|(p, q)| ([p.min(q), p.max(q)], piece.face)));
    }
    edges.sort_unstable();
    for pair in edges.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let (a, b) = (found(&mut root, pair[0].1), found(&mut root, pair[1].1));
        root[a.max(b) as usize] = a.min(b);
    }
    for face in 0..root.len() as u32 {
        root[face as usize] = found(&mut root, face);
    }
    root
}

/// The root of a face, with every second step of the way shortened.
fn found(root: &mut [u32], mut face: u32) -> u32 {
    while root[face as usize] != face {
        let next = root[root[face as usize] as usize];
        root[face as usize] = next;
        face = next;
    }
    face
}

/// One point for each cube that pieces lie in: the piece next to their middle, with the area of all.
fn points_of(pieces: &[Piece], point_m: f64) -> Vec<FrontierPoint> {
    let cube = |at: &Point3| [0, 1, 2].map(|axis| (at[axis] / point_m).floor() as i64);
    let mut sorted: Vec<([i64; 3], &Piece)> = pieces.iter().map(|p| (cube(&p.at), p)).collect();
    sorted.sort_by_key(|(cube, _)| *cube);
    let mut points: Vec<FrontierPoint> = sorted
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(|group| {
            let area_m2: f64 = group.iter().map(|(_, piece)| piece.area_m2).sum();
            let sum = |of: fn(&Piece) -> Vector3| -> Vector3 {
                group.iter().map(|(_, piece)| of(piece) * piece.area_m2).sum()
            };
            let middle = Point3::from(sum(|piece| piece.at.coords) / area_m2);
            let apart = |piece: &Piece| (piece.at - middle).norm_squared();
            let (_, next) = group.iter().min_by(|(_, a), (_, b)| apart(a).total_cmp(&apart(b)))?;
            let normal = sum(|piece| piece.normal).try_normalize(1e-9).unwrap_or(next.normal);
            Some(FrontierPoint { in_body: next.at, normal_in_body: normal, area_m2 })
        })
        .collect();
    points.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
    points
}

/// The centre of gravity of a face.
pub(super) fn middle([a, b, c]: [&Point3; 3]) -> Point3 {
    Point3::from((a.coords + b.coords + c.coords) / 3.0)
}
