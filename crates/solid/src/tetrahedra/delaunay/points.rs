//! The entry for plain points.

use probe::{Off, Probe};

use super::insert::delaunay_of;
use crate::tetrahedra::events::TetrahedraEvent;
use crate::tetrahedra::mesh::NONE;
use crate::tetrahedra::order::{Growth, brio};
use crate::tetrahedra::predicates::P3;
use crate::{Point3, SolidError, Tetrahedra};

/// The Delaunay tetrahedralisation of points.
///
/// What holds: every tetrahedron is positively oriented (its fourth corner sees the other three
/// counter-clockwise), no point lies inside the circumsphere of a tetrahedron, and together they fill
/// the convex hull. Where more than four points lie on one sphere, the choice is made by symbolic
/// perturbation, the same for the same input.
#[derive(Clone, Debug, PartialEq)]
pub struct Delaunay {
    /// Four points each.
    pub tetrahedra: Vec<[u32; 4]>,
    /// The tetrahedron across the face opposite each corner; `None` on the hull.
    pub neighbours: Vec<[Option<u32>; 4]>,
    /// For each point the one that stands for it: itself, or another at the same place.
    pub representative: Vec<u32>,
}

impl Delaunay {
    /// The same as tetrahedra of `points`, those that it was made of; no face is a boundary that was asked for.
    pub fn into_tetrahedra(self, points: Vec<Point3>) -> Tetrahedra {
        Tetrahedra {
            vertices: points,
            tetrahedra: self.tetrahedra,
            neighbours: self.neighbours,
            boundary: Vec::new(),
            steiner_points: 0,
        }
    }
}

/// The Delaunay tetrahedralisation of `points`, metres, any frame. Expected O(n log n).
///
/// # Errors
///
/// [`SolidError::OutsideEnvelope`] for a coordinate that cannot be decided on exactly, and
/// [`SolidError::Coplanar`] where no four points span a volume.
pub fn delaunay(points: &[Point3]) -> Result<Delaunay, SolidError> {
    delaunay_with(points, &mut Off)
}

/// [`delaunay`], telling a probe of every insertion.
///
/// # Errors
///
/// As of [`delaunay`].
pub fn delaunay_with(
    points: &[Point3],
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Result<Delaunay, SolidError> {
    crate::tetrahedra::gate::check_points(points)?;
    let given: Vec<P3> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
    let order = brio(&given, Growth::Eightfold);
    let sorted = order.iter().map(|&i| given[i as usize]).collect();
    let (mesh, same) =
        delaunay_of(sorted, probe).ok_or(SolidError::Coplanar { points: points.len() })?;
    let mut representative = vec![0; given.len()];
    for (rank, &i) in order.iter().enumerate() {
        representative[i as usize] = order[same[rank] as usize];
    }
    let mut number = vec![NONE; mesh.tets.len()];
    let mut tetrahedra = Vec::new();
    for t in mesh.finite() {
        number[t as usize] = tetrahedra.len() as u32;
        tetrahedra.push(mesh.tet(t).v.map(|v| order[v as usize]));
    }
    let neighbours = mesh
        .finite()
        .map(|t| {
            mesh.tet(t)
                .n
                .map(|code| Some(number[(code >> 2) as usize]).filter(|&number| number != NONE))
        })
        .collect();
    Ok(Delaunay { tetrahedra, neighbours, representative })
}
