//! Steps 2 to 5: two operands made one.

use probe::{Off, Probe};

use super::coincide::{Obstacles, relabelled, settle};
use super::tags::Tags;
use super::{
    BooleanEvent, COINCIDENT_M, Combined, CurveEdge, Kernel, ManifoldKernel, Operation, Provenance,
    Refusal,
};
use crate::bvh::Aabb;
use crate::predicates::in_envelope;
use crate::reduce::{Cleaned, clean};
use crate::validity::{check_topology, crossings};
use crate::{Label, Point3, Polyhedron, Solid, SolidError};

/// An intersection with less than this share of the volume of the union is a leaf.
const LEAF_SHARE: f64 = 1e-12;

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
}

impl Default for Options {
    fn default() -> Self {
        Self { provenance: Provenance::Labels, coincident_m: COINCIDENT_M, clean_m: 0.0 }
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
/// operands' faces; frontier that coincides with obstacle is obstacle. O(n log n) for n faces of both.
///
/// # Errors
/// [`SolidError::Operand`] where an operand is no closed 2-manifold, with its first defect.
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
    probe.emit(BooleanEvent::Started { operation, a, b });
    let mut tags = Tags::new(options.provenance);
    let (tags_a, tags_b) = (tags.of(a), tags.of(b));
    let taken_a = kernel.take(a, &tags_a).map_err(|why| refused("first", a, why))?;
    let taken_b = kernel.take(b, &tags_b).map_err(|why| refused("second", b, why))?;
    let failed =
        |Refusal(reason): Refusal| SolidError::Engine { operation: operation.name(), reason };
    let done = |operation| kernel.combine(&taken_a, &taken_b, operation).map_err(failed);
    let mesh = if operation == Operation::SymmetricDifference {
        let other = kernel.combine(&taken_b, &taken_a, Operation::Difference).map_err(failed)?;
        let both = side_by_side(kernel.give(&done(Operation::Difference)?), kernel.give(&other));
        let both = labelled(both, &tags, operation.name())?;
        // Operands that share a part of their surface leave it twice.
        if crossings(&both, 1).is_empty() {
            both
        } else {
            let (all, common) = (done(Operation::Union)?, done(Operation::Intersection)?);
            let rest = kernel.combine(&all, &common, Operation::Difference).map_err(failed)?;
            let mesh = |taken| labelled(kernel.give(taken), &tags, operation.name());
            let (rest, all, common) = (mesh(&rest)?, mesh(&all)?, mesh(&common)?);
            // Operands that only touch have leaves without volume in common, which cut nothing out.
            let touch = common.volume_m3().abs() <= LEAF_SHARE * all.volume_m3();
            if crossings(&rest, 1).is_empty() {
                rest
            } else if touch && crossings(&all, 1).is_empty() {
                all
            } else {
                both
            }
        }
    } else {
        labelled(kernel.give(&done(operation)?), &tags, operation.name())?
    };
    if probe.on() {
        tell_combined(&mesh, a, b, probe);
    }
    // In a difference the faces of the second operand look the other way.
    let mut looking = vec![(a, 1.0)];
    if operation != Operation::Difference {
        looking.push((b, 1.0));
    }
    if matches!(operation, Operation::Difference | Operation::SymmetricDifference) {
        looking.push((b, -1.0));
    }
    if operation == Operation::SymmetricDifference {
        looking.push((a, -1.0));
    }
    let mesh = settled(mesh, &looking, options.coincident_m, probe);
    let mesh = cleaned(mesh, options.clean_m, probe);
    probe.emit(BooleanEvent::Finished { mesh: &mesh });
    Ok(mesh)
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

/// Step 3 of a result; nothing is looked for where there is no frontier, or no obstacle.
pub(super) fn settled(
    mesh: Polyhedron,
    looking: &[(&Polyhedron, f64)],
    eps_m: f64,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Polyhedron {
    let mut changed = Vec::new();
    let obstacle = |(view, _): &(&Polyhedron, f64)| view.labels().contains(&Label::Obstacle);
    let mesh = if mesh.labels().contains(&Label::Frontier) && looking.iter().any(obstacle) {
        let (labels, faces) = settle(&mesh, &Obstacles::of(looking), eps_m);
        changed = faces;
        relabelled(mesh, labels)
    } else {
        mesh
    };
    probe.emit(BooleanEvent::Settled { faces: &changed });
    mesh
}

/// Step 5 of a result.
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

/// What is wrong with an operand that the engine refused.
pub(super) fn refused(which: &str, mesh: &Polyhedron, Refusal(engine): Refusal) -> SolidError {
    let defects = check_topology(mesh).defects;
    let defect = defects.first().map_or(engine, ToString::to_string);
    SolidError::Operand { which: which.to_owned(), defect }
}

/// Step 4: two meshes with nothing in common but their borders.
fn side_by_side(mut a: Combined, b: Combined) -> Combined {
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
            let reason = format!("a vertex of the result at {vertex}");
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
