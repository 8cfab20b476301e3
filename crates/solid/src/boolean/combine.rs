//! Steps 2 to 6: two operands made one.

use probe::{Off, Probe};

use super::coincide::{Obstacles, settle};
use super::covered::cut;
use super::tags::Tags;
use super::touching::conforming;
use super::trials::{Taken, Trials};
use super::{
    BooleanEvent, COINCIDENT_M, Combined, CurveEdge, Kernel, ManifoldKernel, Operation, Provenance,
    Refusal,
};
use crate::bvh::Aabb;
use crate::predicates::in_envelope;
use crate::reduce::{Cleaned, clean};
use crate::validity::check_topology;
use crate::{Label, Point3, Polyhedron, Solid, SolidError};

/// How booleans are done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What is known of each face of the result.
    pub provenance: Provenance,
    /// Faces nearer than this coincide, metres; the obstacle wins.
    pub coincident_m: f64,
    /// Edges no longer than this are drawn together in the end, metres; 0 leaves all as they are. What
    /// is cleaned has no origins.
    pub clean_m: f64,
    /// How far the faces of the second operand are moved first, metres, so that none is coplanar with one
    /// of the first: outwards, for an intersection inwards. Where the result still meets itself, by other
    /// distances, at last a thousand times as far. 0 moves nothing unless rounding spoils the result.
    pub jitter_m: f64,
    /// What part of the jitter is by chance depends on this.
    pub seed: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            provenance: Provenance::Labels,
            coincident_m: COINCIDENT_M,
            clean_m: 0.0,
            jitter_m: 0.0,
            seed: 1,
        }
    }
}

/// Combines two closed 2-manifolds; see [`boolean_with`].
///
/// # Errors
/// As [`boolean_with`].
pub fn boolean(
    a: &Polyhedron,
    b: &Polyhedron,
    operation: Operation,
    options: &Options,
) -> Result<Polyhedron, SolidError> {
    boolean_with(a, b, operation, options, &mut Off)
}

/// Combines two closed 2-manifolds, oriented outward, in one frame, and tells `probe` about it.
///
/// The result is a closed 2-manifold by index, perhaps empty. Labels and origins are those of the
/// operands' faces; frontier that coincides with obstacle is obstacle, where it does. O(n log n) for n
/// faces of both.
///
/// # Errors
/// [`SolidError::Operand`] where an operand is no closed 2-manifold, with its first defect, or looks inwards.
pub fn boolean_with(
    a: &Polyhedron,
    b: &Polyhedron,
    operation: Operation,
    options: &Options,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Result<Polyhedron, SolidError> {
    boolean_by(&ManifoldKernel, a, b, operation, options, probe)
}

/// As [`boolean_with`], by an engine of one's choice.
///
/// # Errors
/// As [`boolean_with`].
pub fn boolean_by<K: Kernel>(
    kernel: &K,
    a: &Polyhedron,
    b: &Polyhedron,
    operation: Operation,
    options: &Options,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Result<Polyhedron, SolidError> {
    boolean_told(kernel, a, b, operation, options, probe).map(|result| result.mesh)
}

/// A result, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct BooleanResult {
    /// What was asked for.
    pub mesh: Polyhedron,
    /// How far the faces of the second operand were moved for it, metres; 0 where they stayed.
    pub jitter_m: f64,
    /// How often the engine's result was not taken, because it met itself or was of another volume or area
    /// than others.
    pub again: usize,
}

/// As [`boolean_by`], telling what it took.
///
/// # Errors
/// As [`boolean_with`].
pub fn boolean_told<K: Kernel>(
    kernel: &K,
    a: &Polyhedron,
    b: &Polyhedron,
    operation: Operation,
    options: &Options,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Result<BooleanResult, SolidError> {
    looks_outwards("first", a)?;
    looks_outwards("second", b)?;
    probe.emit(BooleanEvent::Started { operation, a, b });
    let looking = looking(a, b, operation);
    let trials = Trials::new(kernel, [a, b], operation, options, &looking, probe.on());
    let Taken { trial, again } = trials.taken()?;
    if let Some(combined) = trial.combined {
        tell_combined(&combined, a, b, probe);
        // What was settled without a witness is settled the same way once more.
        trials.settled(combined, trial.jitter_m, trial.contact, probe);
    }
    let mesh = cleaned(trial.mesh, options.clean_m, probe);
    probe.emit(BooleanEvent::Finished { mesh: &mesh });
    Ok(BooleanResult { mesh, jitter_m: trial.jitter_m, again })
}

/// The operands, and which way their faces look in the result.
pub(super) fn looking<'a>(
    a: &'a Polyhedron,
    b: &'a Polyhedron,
    operation: Operation,
) -> Vec<(&'a Polyhedron, f64)> {
    // In a difference the faces of the second operand look the other way.
    match operation {
        Operation::Union | Operation::Intersection => vec![(a, 1.0), (b, 1.0)],
        Operation::Difference => vec![(a, 1.0), (b, -1.0)],
        Operation::SymmetricDifference => vec![(a, 1.0), (b, 1.0), (b, -1.0), (a, -1.0)],
    }
}

/// Tells where each face of a result comes from, and where the operands meet.
pub(super) fn tell_combined(
    mesh: &Polyhedron,
    a: &Polyhedron,
    b: &Polyhedron,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) {
    let operand_of = operands(mesh, a, b);
    let curve = curve(mesh, &operand_of);
    probe.emit(BooleanEvent::Combined { mesh, operand_of: &operand_of, curve: &curve });
}

/// Step 5 of a result; what coincides is not looked for where there is no frontier, or no obstacle.
pub(super) fn settled(
    mesh: Polyhedron,
    looking: &[(&Polyhedron, f64)],
    eps_m: f64,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Polyhedron {
    let obstacle = |(view, _): &(&Polyhedron, f64)| view.labels().contains(&Label::Obstacle);
    let (mesh, changed) =
        if mesh.labels().contains(&Label::Frontier) && looking.iter().any(obstacle) {
            let obstacles = Obstacles::of(looking);
            settle(conforming(cut(mesh, &obstacles, eps_m)), &obstacles, eps_m)
        } else {
            (conforming(mesh), Vec::new())
        };
    probe.emit(BooleanEvent::Settled { mesh: &mesh, faces: &changed });
    mesh
}

/// Step 6 of a result.
pub(super) fn cleaned(
    mesh: Polyhedron,
    length_m: f64,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Polyhedron {
    if length_m <= 0.0 {
        return mesh;
    }
    let Cleaned { mesh, removed, undone } = clean(&mesh, length_m);
    probe.emit(BooleanEvent::Cleaned { mesh: &mesh, removed: &removed, undone });
    mesh
}

/// A volume below minus this share of the cube over the diagonal of the bounds is not one by rounding.
const INWARDS_SHARE: f64 = 1e-12;

/// Refuses what is inside out: the engine would take all of space but the operand.
fn looks_outwards(which: &str, mesh: &Polyhedron) -> Result<(), SolidError> {
    let volume_m3 = mesh.volume_m3();
    let diagonal_m = mesh.bounds().map_or(0.0, |(low, high)| (high - low).norm());
    if volume_m3 >= -INWARDS_SHARE * diagonal_m.powi(3) {
        return Ok(());
    }
    // Of an open mesh the volume tells nothing.
    let defect = match check_topology(mesh).defects.first() {
        Some(defect) => defect.to_string(),
        None => format!("its faces look inwards, the volume is {volume_m3:.3e} m3"),
    };
    Err(SolidError::Operand { which: which.to_owned(), defect })
}

/// What is wrong with an operand that the engine refused.
pub(super) fn refused(which: &str, mesh: &Polyhedron, Refusal(engine): Refusal) -> SolidError {
    let defect = match check_topology(mesh).defects.first() {
        _ if mesh.is_empty() => "it has no faces".to_owned(),
        Some(defect) => defect.to_string(),
        None => format!("the engine takes it for none ({engine})"),
    };
    SolidError::Operand { which: which.to_owned(), defect }
}

/// Two meshes with nothing in common but their borders.
pub(super) fn side_by_side(mut a: Combined, b: Combined) -> Combined {
    let first = a.vertices.len() as u32;
    a.vertices.extend(b.vertices);
    a.faces.extend(b.faces.into_iter().map(|face| face.map(|vertex| vertex + first)));
    a.tags.extend(b.tags);
    a
}

/// The engine's mesh with labels and origins.
pub(super) fn labelled(
    combined: Combined,
    tags: &Tags,
    operation: &'static str,
) -> Result<Polyhedron, SolidError> {
    let Combined { mut vertices, faces, tags: of_faces } = combined;
    for vertex in &mut vertices {
        // A coordinate that cancelled to less than the envelope holds is zero to all its digits.
        for coordinate in vertex.iter_mut().filter(|c| c.abs() < crate::predicates::SMALLEST) {
            *coordinate = 0.0;
        }
        if !in_envelope(vertex) {
            let [x, y, z] = [vertex.x, vertex.y, vertex.z].map(crate::error::shown);
            let reason = format!("a vertex of the result at ({x}, {y}, {z})");
            return Err(SolidError::Engine { operation, reason });
        }
    }
    let labels = of_faces.iter().map(|&tag| tags.label(tag)).collect();
    let origins = of_faces.iter().map(|&tag| tags.origin(tag)).collect();
    Ok(Polyhedron::from_sound_parts(vertices, faces, labels, origins))
}

/// For each face whether its middle is nearer to the surface of the first operand or of the second.
fn operands(mesh: &Polyhedron, a: &Polyhedron, b: &Polyhedron) -> Vec<u8> {
    let reach = mesh.bounds().map_or(0.0, |(low, high)| (high - low).norm()) * 1e-9 + COINCIDENT_M;
    let (a, b) = (Solid::new(a), Solid::new(b));
    let distance = |solid: &Solid<'_>, middle: &Point3| {
        let mut nearest = f64::INFINITY;
        solid.tree().each_touching(&Aabb::around([middle]).grown(reach), |face| {
            let [p, q, r] = solid.mesh().corners(face as usize);
            nearest = nearest.min(crate::query::distance_to_triangle(middle, [p, q, r]));
        });
        nearest
    };
    let of = |face: usize| {
        let [p, q, r] = mesh.corners(face);
        let middle = Point3::from((p.coords + q.coords + r.coords) / 3.0);
        u8::from(distance(&b, &middle) < distance(&a, &middle))
    };
    (0..mesh.faces().len()).map(of).collect()
}

/// The edges between faces of different operands.
fn curve(mesh: &Polyhedron, operand_of: &[u8]) -> Vec<CurveEdge> {
    let mut uses: Vec<([u32; 2], u32)> = (mesh.faces().iter().enumerate())
        .flat_map(|(face, &[a, b, c])| {
            [(a, b), (b, c), (c, a)].map(|(s, t)| ([s.min(t), s.max(t)], face as u32))
        })
        .collect();
    uses.sort_unstable();
    let pairs = uses.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let differ =
        pairs.filter(|pair| operand_of[pair[0].1 as usize] != operand_of[pair[1].1 as usize]);
    differ
        .map(|pair| {
            let mut faces = [pair[0].1, pair[1].1];
            faces.sort_by_key(|&face| operand_of[face as usize]);
            CurveEdge { ends: pair[0].0.map(|vertex| mesh.vertices()[vertex as usize]), faces }
        })
        .collect()
}
