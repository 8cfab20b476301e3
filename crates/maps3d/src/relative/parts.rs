//! Frontier that hangs together: open parts of neighbouring faces of one view, measured as one.

use geometry::planar::overlay::{StepRings, twice_area};

use super::grid::STEPS;
use super::ledger::OpenPart;
use super::volume::LocalVolume;

/// One ring-bounded piece of the open part of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Piece {
    /// Index into [`LocalVolume::frontier`].
    pub face: u16,
    /// The outer ring among those of the open part of the face; the holes that follow belong to it.
    pub ring: u16,
}

/// Open pieces that hang together across the sides of faces.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontierPart {
    /// The pieces, ascending.
    pub pieces: Box<[Piece]>,
    /// Their area, square metres.
    pub area_m2: f64,
}

/// A stretch of a side of a face that is open, in steps from the corner with the lesser number.
struct Stretch {
    side: [u16; 2],
    from: i32,
    to: i32,
    piece: u32,
}

/// The parts of a view, from the open parts of its frontier faces, in order of their first pieces.
///
/// Two pieces hang together where a stretch of the side between their faces is open on both. O(n log n) in
/// the corners of what is open.
pub(super) fn parts(
    volume: &LocalVolume,
    open: &[OpenPart],
    areas_m2: &[f64],
) -> Vec<FrontierPart> {
    let mut pieces: Vec<(Piece, f64)> = Vec::new();
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut rings = StepRings::new();
    for (index, part) in open.iter().enumerate().filter(|(_, part)| !part.is_closed()) {
        part.rings_into(&mut rings);
        let corners = volume.face(volume.frontier()[index]);
        let step_m2 = areas_m2[index] / (f64::from(STEPS) * f64::from(STEPS));
        for (ring, places) in rings.rings().enumerate() {
            let area_m2 = twice_area(places) as f64 * step_m2;
            match pieces.last_mut() {
                Some((outer, sum_m2)) if area_m2 < 0.0 && outer.face == index as u16 => {
                    *sum_m2 += area_m2;
                }
                _ => pieces.push((Piece { face: index as u16, ring: ring as u16 }, area_m2)),
            }
            put_stretches(places, corners, pieces.len() as u32 - 1, &mut stretches);
        }
    }
    stretches.sort_unstable_by_key(|s| (s.side, s.from, s.to, s.piece));
    let mut roots: Vec<u32> = (0..pieces.len() as u32).collect();
    for i in 0..stretches.len() {
        let one = &stretches[i];
        let rest = stretches[i + 1..].iter();
        for other in rest.take_while(|other| other.side == one.side && other.from < one.to) {
            join(&mut roots, one.piece, other.piece);
        }
    }
    let mut numbers: Vec<u32> = vec![u32::MAX; pieces.len()];
    let mut parts: Vec<(Vec<Piece>, f64)> = Vec::new();
    for (at, &(piece, area_m2)) in pieces.iter().enumerate() {
        let root = root_of(&mut roots, at as u32) as usize;
        if numbers[root] == u32::MAX {
            numbers[root] = parts.len() as u32;
            parts.push((Vec::new(), 0.0));
        }
        let part = &mut parts[numbers[root] as usize];
        part.0.push(piece);
        part.1 += area_m2;
    }
    let done =
        |(pieces, area_m2): (Vec<Piece>, f64)| FrontierPart { pieces: pieces.into(), area_m2 };
    parts.into_iter().map(done).collect()
}

/// The edges of a ring that lie on sides of the face.
fn put_stretches(ring: &[[i32; 2]], corners: [u16; 3], piece: u32, out: &mut Vec<Stretch>) {
    let mut a = ring[ring.len() - 1];
    for &b in ring {
        let on = |f: fn([i32; 2]) -> i32| f(a) == 0 && f(b) == 0;
        // The side, and how far along it the two ends are.
        let found = if on(|p| p[1]) {
            Some((0, a[0], b[0]))
        } else if on(|p| STEPS - p[0] - p[1]) {
            Some((1, a[1], b[1]))
        } else if on(|p| p[0]) {
            Some((2, STEPS - a[1], STEPS - b[1]))
        } else {
            None
        };
        if let Some((side, from, to)) = found {
            let (start, end) = (corners[side], corners[(side + 1) % 3]);
            let (from, to) = (from.min(to), from.max(to));
            out.push(if start < end {
                Stretch { side: [start, end], from, to, piece }
            } else {
                Stretch { side: [end, start], from: STEPS - to, to: STEPS - from, piece }
            });
        }
        a = b;
    }
}

fn root_of(roots: &mut [u32], mut at: u32) -> u32 {
    while roots[at as usize] != at {
        let above = roots[roots[at as usize] as usize];
        roots[at as usize] = above;
        at = above;
    }
    at
}

fn join(roots: &mut [u32], a: u32, b: u32) {
    let (a, b) = (root_of(roots, a), root_of(roots, b));
    roots[a.max(b) as usize] = a.min(b);
}

/// The rings of one piece: the outer one and its holes.
pub(super) fn rings_of(open: &OpenPart, piece: Piece, all: &mut StepRings, out: &mut StepRings) {
    open.rings_into(all);
    out.clear();
    for (i, ring) in all.rings().enumerate().skip(piece.ring.into()) {
        if i > usize::from(piece.ring) && twice_area(ring) > 0 {
            break;
        }
        out.push(ring.iter().copied());
    }
}
