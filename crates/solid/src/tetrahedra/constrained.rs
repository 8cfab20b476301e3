//! The tetrahedra of a polyhedron, from the gate to the result.

use probe::{Off, Probe};

use super::delaunay::delaunay_of;
use super::events::TetrahedraEvent;
use super::filled::{Filled, filled};
use super::flips::Work;
use super::gate::{Inside, Sound, admit};
use super::mesh::NONE;
use super::order::{Growth, brio};
use super::result::{BoundaryFace, Tetrahedra};
use crate::{Point3, Polyhedron, SolidError};

/// Corners of the box round the input.
pub(super) const BOX: usize = 8;

/// The tetrahedra of a closed polyhedron; see [`Tetrahedra`] for what holds.
///
/// Deterministic. Expected O(n log n) where most faces are Delaunay; each missing one is searched for
/// with bounds on every loop.
///
/// # Errors
///
/// [`SolidError::NoVolume`] names open edges, flat faces, and faces that meet where they should not;
/// [`SolidError::NoRoom`] names the faces that could not be brought in.
pub fn tetrahedralize(mesh: &Polyhedron) -> Result<Tetrahedra, SolidError> {
    tetrahedralize_with(mesh, &mut Off)
}

/// [`tetrahedralize`], telling a probe of every step.
///
/// # Errors
///
/// As of [`tetrahedralize`].
pub fn tetrahedralize_with(
    mesh: &Polyhedron,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Result<Tetrahedra, SolidError> {
    tetrahedralize_in(mesh, &Inside::Odd, probe)
}

/// [`tetrahedralize_with`] of what `inside` says.
///
/// # Errors
///
/// As of [`tetrahedralize`].
pub fn tetrahedralize_in(
    mesh: &Polyhedron,
    inside: &Inside,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Result<Tetrahedra, SolidError> {
    let sound = admit(mesh, inside)?;
    if sound.faces.is_empty() {
        return Ok(Tetrahedra { vertices: mesh.vertices().to_vec(), ..Tetrahedra::default() });
    }
    let (start, rank_of) = triangulate(&sound, probe)?;
    let Filled { mut work, is_inside, .. } = filled(&start, sound.points.len(), inside, probe)?;
    if probe.on() {
        let all: Vec<[u32; 4]> = work.mesh.finite().map(|t| work.mesh.tet(t).v).collect();
        let within: Vec<[u32; 4]> = work
            .mesh
            .finite()
            .filter(|&t| is_inside[t as usize])
            .map(|t| work.mesh.tet(t).v)
            .collect();
        probe.emit(TetrahedraEvent::Classified {
            inside: &within,
            outside: all.len() - within.len(),
            points: &work.mesh.points,
        });
    }
    let result = collect(mesh, &sound, &mut work, &rank_of, &is_inside)?;
    probe.emit(TetrahedraEvent::Finished { result: &result });
    Ok(result)
}

/// The Delaunay tetrahedra of the places in a box around them, with the faces that must appear; and for
/// each place its vertex.
pub(super) fn triangulate(
    sound: &Sound,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Result<(Work, Vec<u32>), SolidError> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in &sound.points {
        for k in 0..3 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    let extent = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let mut points: Vec<[f64; 3]> = (0..BOX)
        .map(|corner| {
            [0, 1, 2].map(|k| if corner >> k & 1 == 0 { low[k] - extent } else { high[k] + extent })
        })
        .collect();
    let order = brio(&sound.points, Growth::Double);
    points.extend(order.iter().map(|&i| sound.points[i as usize]));
    let mut rank_of = vec![0; sound.points.len()];
    for (rank, &place) in order.iter().enumerate() {
        rank_of[place as usize] = (rank + BOX) as u32;
    }
    let count = points.len();
    let (mesh, _) = delaunay_of(points, probe).ok_or(SolidError::Coplanar { points: count })?;
    let mut start = Work { mesh, ..Work::default() };
    for &(corners, face) in &sound.faces {
        start.must.add(corners.map(|place| rank_of[place as usize]), face);
    }
    Ok((start, rank_of))
}

/// The result, over the vertices of the input.
fn collect(
    mesh: &Polyhedron,
    sound: &Sound,
    work: &mut Work,
    rank_of: &[u32],
    is_inside: &[bool],
) -> Result<Tetrahedra, SolidError> {
    let mut vertices: Vec<Point3> = mesh.vertices().to_vec();
    let mut number = vec![NONE; work.mesh.points.len()];
    for (v, &place) in sound.place_of.iter().enumerate().rev() {
        // Of several vertices at one place the first stands for all.
        if place != u32::MAX {
            number[rank_of[place as usize] as usize] = v as u32;
        }
    }
    let mut steiner_points = 0;
    let mut slot_number = vec![NONE; work.mesh.tets.len()];
    let mut slots = Vec::new();
    let mut tetrahedra = Vec::new();
    for t in work.mesh.finite().filter(|&t| is_inside[t as usize]) {
        slot_number[t as usize] = tetrahedra.len() as u32;
        slots.push(t);
        tetrahedra.push(work.mesh.tet(t).v.map(|v| {
            if number[v as usize] == NONE {
                number[v as usize] = vertices.len() as u32;
                vertices.push(Point3::from(*work.mesh.point(v)));
                steiner_points += 1;
            }
            number[v as usize]
        }));
    }
    let numbered = |code: u32| Some(slot_number[(code >> 2) as usize]).filter(|&t| t != NONE);
    let neighbours = slots.iter().map(|&t| work.mesh.tet(t).n.map(numbered)).collect();
    let mut boundary = Vec::with_capacity(sound.faces.len());
    for &(places, face) in &sound.faces {
        let [a, b, c] = places.map(|place| rank_of[place as usize]);
        let Some((t, f)) = work.mesh.find_face(a, b, c) else {
            return Err(SolidError::Broken { rule: format!("face {face} is there") });
        };
        let sides =
            [Some(slot_number[t as usize]).filter(|&t| t != NONE), numbered(work.mesh.tet(t).n[f])];
        let mut sides: [Option<u32>; 2] = sides;
        if sides[0].is_none() {
            sides.swap(0, 1);
        }
        boundary.push(BoundaryFace {
            corners: [a, b, c].map(|v| number[v as usize]),
            face,
            label: mesh.labels()[face as usize],
            tetrahedra: sides,
        });
    }
    Ok(Tetrahedra { vertices, tetrahedra, neighbours, boundary, steiner_points })
}
