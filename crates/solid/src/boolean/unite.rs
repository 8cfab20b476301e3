//! Step 7: a map out of many views.

use probe::{Off, Probe};

use super::combine::{cleaned, labelled, looking, refused, settled};
use super::leaves::tidied;
use super::tags::Tags;
use super::trials::{Trials, all_crossed, is_inherited};
use super::{BooleanEvent, Kernel, ManifoldKernel, Operation, Options, Provenance, Refusal};
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
/// Where the map meets itself and no view does there, all is done once more by [`boolean`](super::boolean), two
/// operands at a time, which costs several times as much.
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
    let combined = tidied(labelled(combined, &tags, operation.name())?);
    let all: Vec<_> = views.iter().map(|view| (view, 1.0)).collect();
    let mut before = probe.on().then(|| combined.clone());
    let mut mesh = settled(combined, &all, options.coincident_m, &mut Off);
    let crossed = all_crossed(&mesh, 1);
    if !crossed.is_empty() && !is_inherited(&mesh, &crossed, &views.iter().collect::<Vec<_>>(), 0.0)
    {
        let by_trials = one_by_one(views, options)?;
        let settled = settled(by_trials.clone(), &all, options.coincident_m, &mut Off);
        if all_crossed(&settled, 1).is_empty() {
            before = probe.on().then_some(by_trials);
            mesh = settled;
        }
    }
    if let Some(before) = before {
        // What was settled without a witness is settled the same way once more.
        settled(before, &all, options.coincident_m, probe);
    }
    let mesh = cleaned(mesh, options.clean_m, probe);
    probe.emit(BooleanEvent::Finished { mesh: &mesh });
    Ok(mesh)
}

/// The same union as booleans of two operands at a time, each looked at and made again where it is not sound.
fn one_by_one(views: &[Polyhedron], options: &Options) -> Result<Polyhedron, SolidError> {
    let options = Options { jitter_m: 0.0, ..*options };
    let mut map = Polyhedron::empty();
    for (number, view) in (0..).zip(views) {
        let mut view = view.clone();
        if options.provenance == Provenance::Origins && view.origins().is_none() {
            view = view.as_view(number);
        }
        if number == 0 {
            map = view;
            continue;
        }
        let looking = looking(&map, &view, Operation::Union);
        let pair = [&map, &view];
        let trials =
            Trials::new(&ManifoldKernel, pair, Operation::Union, &options, &looking, false);
        map = trials.taken()?.trial.mesh;
    }
    Ok(map)
}
