//! Step 7: a map out of many views.

use probe::{Off, Probe};

use super::combine::{cleaned, labelled, refused, settled};
use super::leaves::tidied;
use super::tags::Tags;
use super::{BooleanEvent, Kernel, ManifoldKernel, Operation, Options, Refusal};
use crate::{Polyhedron, SolidError};

/// Unites views one by one; see [`unite_with`].
///
/// # Errors
/// As [`unite_with`].
pub fn unite(views: &[Polyhedron], options: &Options) -> Result<Polyhedron, SolidError> {
    unite_with(views, options, &mut Off)
}

/// Unites views, in one frame, one by one in their order, and tells `probe` about it.
///
/// The map stays with the engine between unions, so that nothing is converted twice; the rule for
/// coincident faces is applied once, in the end, against all views. Without a view the result is
/// empty. `options.jitter_m` has no effect here: give [`jittered`](super::jittered) views. Each union costs
/// O(n log n) for n faces of the map so far and the view. A probe that is on makes it costlier: each
/// intermediate map is given back and looked at.
///
/// # Errors
/// [`SolidError::Operand`] for a view that is no closed 2-manifold, with its first defect.
pub fn unite_with(
    views: &[Polyhedron],
    options: &Options,
    probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
) -> Result<Polyhedron, SolidError> {
    let kernel = ManifoldKernel;
    let operation = Operation::Union;
    let failed =
        |Refusal(reason): Refusal| SolidError::Engine { operation: operation.name(), reason };
    let mut tags = Tags::new(options.provenance);
    let mut map = None;
    for (index, view) in views.iter().enumerate() {
        let numbers = tags.of(view);
        let taken = kernel
            .take(view, &numbers)
            .map_err(|why| refused(&format!("view {index}"), view, why))?;
        map = Some(match map {
            None => taken,
            Some(so_far) => {
                let united = kernel.combine(&so_far, &taken, operation).map_err(failed)?;
                if probe.on() {
                    let before = labelled(kernel.give(&so_far), &tags, operation.name())?;
                    probe.emit(BooleanEvent::Started { operation, a: &before, b: view });
                    let after = labelled(kernel.give(&united), &tags, operation.name())?;
                    super::combine::tell_combined(&after, &before, view, probe);
                }
                united
            }
        });
    }
    let combined = map.map(|map| kernel.give(&map)).unwrap_or_default();
    let mesh = tidied(labelled(combined, &tags, operation.name())?);
    let looking: Vec<_> = views.iter().map(|view| (view, 1.0)).collect();
    let mesh = settled(mesh, &looking, options.coincident_m, probe);
    let mesh = cleaned(mesh, options.clean_m, probe);
    probe.emit(BooleanEvent::Finished { mesh: &mesh });
    Ok(mesh)
}
