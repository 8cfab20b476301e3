//! Step 3: what the engine makes of two operands, by the first way that leaves no fold.

use super::combine::{labelled, side_by_side};
use super::leaves::tidied;
use super::tags::Tags;
use super::touching::conforming;
use super::{Kernel, Operation, Refusal};
use crate::predicates::{is_collinear, orient3, sign};
use crate::validity::flat_faces;
use crate::{Polyhedron, SolidError, crossings};

/// A way to make what an operation asks for.
type Way<K> =
    fn(&K, &<K as Kernel>::Solid, &<K as Kernel>::Solid) -> Result<<K as Kernel>::Solid, Refusal>;

/// The ways to make a union, an intersection or a difference; the plain one first.
///
/// In exact arithmetic all give the same. Where faces of the operands lie in one plane the engine
/// decides which is in front, and by one way or the other may leave a fold: two sheets on each other.
fn ways<K: Kernel>(operation: Operation) -> Vec<Way<K>> {
    use Operation::{Difference, Intersection, SymmetricDifference, Union};
    match operation {
        Union => vec![|k, a, b| k.combine(a, b, Union), |k, a, b| k.combine(b, a, Union)],
        Intersection => vec![
            |k, a, b| k.combine(a, b, Intersection),
            |k, a, b| k.combine(b, a, Intersection),
            |k, a, b| k.combine(a, &k.combine(a, b, Difference)?, Difference),
            |k, a, b| k.combine(b, &k.combine(b, a, Difference)?, Difference),
        ],
        Difference => vec![|k, a, b| k.combine(a, b, Difference), |k, a, b| {
            k.combine(a, &k.combine(a, b, Intersection)?, Difference)
        }],
        SymmetricDifference => vec![
            |k, a, b| {
                let (first, second) = (k.combine(a, b, Difference)?, k.combine(b, a, Difference)?);
                k.combine(&first, &second, Union)
            },
            |k, a, b| {
                let (all, both) = (k.combine(a, b, Union)?, k.combine(a, b, Intersection)?);
                k.combine(&all, &both, Difference)
            },
            // Operands that only touch.
            |k, a, b| k.combine(a, b, Union),
        ],
    }
}

/// What an operation makes of two operands, with labels and origins; by the plain way where they are in
/// no contact.
pub(super) fn attempt<K: Kernel>(
    kernel: &K,
    a: &K::Solid,
    b: &K::Solid,
    operation: Operation,
    tags: &Tags,
    contact: bool,
) -> Result<Polyhedron, SolidError> {
    let by = |way: Way<K>| {
        let given = kernel.give(&way(kernel, a, b).map_err(failed(operation))?);
        labelled(given, tags, operation.name())
            .map(|mesh| if contact { tidied(mesh) } else { mesh })
    };
    if operation != Operation::SymmetricDifference {
        let ways = ways(operation);
        let plain = by(ways[0])?;
        if !contact || !is_folded(&plain) {
            return Ok(plain);
        }
        for &way in &ways[1..] {
            let other = by(way)?;
            if is_whole(&other) {
                return Ok(other);
            }
        }
        return Ok(plain);
    }
    apart(kernel, [(a, b), (b, a)], tags, operation).and_then(|plain| {
        if !contact {
            return Ok(plain);
        }
        let plain = tidied(plain);
        // Operands that share a part of their surface leave it twice.
        if is_whole(&plain) {
            return Ok(plain);
        }
        let volume_m3 = plain.volume_m3();
        for way in ways(operation) {
            let other = by(way)?;
            let same = (other.volume_m3() - volume_m3).abs() <= SAME_SHARE * volume_m3.abs();
            if same && is_whole(&other) {
                return Ok(other);
            }
        }
        Ok(plain)
    })
}

/// Two ways to one solid differ in volume by no more than this share.
const SAME_SHARE: f64 = 1e-9;

/// What an engine's refusal is told as.
pub(super) fn failed(operation: Operation) -> impl Fn(Refusal) -> SolidError {
    move |Refusal(reason)| SolidError::Engine { operation: operation.name(), reason }
}

/// Differences laid side by side: what is left of the first of each pair without the second.
pub(super) fn apart<K: Kernel>(
    kernel: &K,
    pairs: [(&K::Solid, &K::Solid); 2],
    tags: &Tags,
    operation: Operation,
) -> Result<Polyhedron, SolidError> {
    let [first, second] = pairs.map(|(a, b)| {
        let left = kernel.combine(a, b, Operation::Difference).map_err(failed(operation))?;
        Ok(kernel.give(&left))
    });
    labelled(side_by_side(first?, second?), tags, operation.name())
}

/// Whether no face is flat, and nothing meets that should not once edges that touch are made to match.
fn is_whole(mesh: &Polyhedron) -> bool {
    flat_faces(mesh).is_empty() && crossings(&conforming(mesh.clone()), 1).is_empty()
}

/// Whether two faces beside an edge lie on each other, or one is flat; exact. O(f log f).
fn is_folded(mesh: &Polyhedron) -> bool {
    let mut sides: Vec<([u32; 2], u32, u32)> = (mesh.faces().iter().enumerate())
        .flat_map(|(face, &[a, b, c])| {
            [(a, b, c), (b, c, a), (c, a, b)]
                .map(|(s, t, apex)| ([s.min(t), s.max(t)], apex, face as u32))
        })
        .collect();
    sides.sort_unstable();
    sides.chunk_by(|a, b| a.0 == b.0).any(|edge| {
        let [(_, apex, face), (_, other, over)] = *edge else { return false };
        let [a, b, c] = mesh.corners(face as usize);
        apex != other
            && sign(orient3(a, b, c, &mesh.vertices()[other as usize])) == 0
            && (is_collinear(a, b, c)
                || mesh.scaled_normal(face as usize).dot(&mesh.scaled_normal(over as usize)) < 0.0)
    })
}
