//! The operations themselves, on the edges of all inputs at once.

use i_overlay::core::edge_data::{EdgeDataMerge, OverlayEdgeData};
use i_overlay::core::edge_overlay::{EdgeOverlay, InputEdge};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::segm::boolean::ShapeCountBoolean;
use probe::{Off, Probe};

use super::events::{OverlayEvent, tell};
use super::lattice::Lattice;
use super::{EdgeLabel, Region, Ring, RingEdge};
use crate::planar::PlanarError;

/// Which parts belong to the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// What is in either.
    Union,
    /// What is in both.
    Intersection,
    /// What is in the first and not in the second.
    Difference,
}

/// An input edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source {
    /// Which input: 0 is the first.
    pub input: u32,
    /// Which ring of it.
    pub ring: u32,
    /// Which edge of the ring.
    pub edge: u32,
}

/// A region, and where its edges come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay<T> {
    /// The result; its edges carry the labels and the data of their sources.
    pub region: Region<T>,
    /// For each ring, the input edge of each of its edges.
    pub sources: Vec<Vec<Source>>,
}

impl<T> Default for Overlay<T> {
    fn default() -> Self {
        Self { region: Region::default(), sources: Vec::new() }
    }
}

/// What the engine carries along an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Payload {
    label: EdgeLabel,
    /// Counts all input edges.
    number: u32,
}

impl OverlayEdgeData for Payload {
    type Store = ();

    fn merge(ctx: EdgeDataMerge<ShapeCountBoolean, Self>, (): &mut ()) -> Self {
        let (a, b) = (ctx.lhs_data, ctx.rhs_data);
        let a_wins = (a.label, b.number) > (b.label, a.number);
        if a_wins { a } else { b }
    }
}

/// What is in either of two regions; see [`overlay`].
pub fn union<T: Copy>(a: &Region<T>, b: &Region<T>) -> Result<Overlay<T>, PlanarError> {
    overlay(a, b, Operation::Union)
}

/// What is in both of two regions; see [`overlay`].
pub fn intersection<T: Copy>(a: &Region<T>, b: &Region<T>) -> Result<Overlay<T>, PlanarError> {
    overlay(a, b, Operation::Intersection)
}

/// What is in `a` and not in `b`; see [`overlay`].
pub fn difference<T: Copy>(a: &Region<T>, b: &Region<T>) -> Result<Overlay<T>, PlanarError> {
    overlay(a, b, Operation::Difference)
}

/// Overlays two regions: the labels and sources of the result's edges are those of the input.
///
/// # Errors
/// [`PlanarError::Unsnappable`] for a corner that is not finite or too far from the others.
pub fn overlay<T: Copy>(
    a: &Region<T>,
    b: &Region<T>,
    operation: Operation,
) -> Result<Overlay<T>, PlanarError> {
    overlay_with(a, b, operation, &mut Off)
}

/// [`overlay`], observed.
pub fn overlay_with<T: Copy>(
    a: &Region<T>,
    b: &Region<T>,
    operation: Operation,
    probe: &mut impl Probe<OverlayEvent>,
) -> Result<Overlay<T>, PlanarError> {
    let rule = match operation {
        Operation::Union => OverlayRule::Union,
        Operation::Intersection => OverlayRule::Intersect,
        Operation::Difference => OverlayRule::Difference,
    };
    let result = run(&[a, b], |input| input > 0, rule)?;
    if probe.on() {
        tell(&result, probe);
    }
    Ok(result)
}

/// What is in any of these regions: one operation over all, whatever their number.
///
/// # Errors
/// As [`overlay`].
pub fn union_all<T: Copy>(regions: &[&Region<T>]) -> Result<Overlay<T>, PlanarError> {
    run(regions, |_| false, OverlayRule::Subject)
}

/// The engine's run over all edges; `is_clip` says which inputs are on the other side of the rule.
fn run<T: Copy>(
    inputs: &[&Region<T>],
    is_clip: impl Fn(usize) -> bool,
    rule: OverlayRule,
) -> Result<Overlay<T>, PlanarError> {
    let points = inputs.iter().flat_map(|region| &region.rings).flat_map(|ring| &ring.points);
    let lattice = Lattice::around(points)?;
    let count: usize = inputs.iter().map(|region| region.edge_count()).sum();
    let mut engine = EdgeOverlay::<i32, Payload>::new(count);
    let mut table: Vec<(Source, RingEdge<T>)> = Vec::with_capacity(count);
    for (input, region) in inputs.iter().enumerate() {
        let kind = if is_clip(input) { ShapeType::Clip } else { ShapeType::Subject };
        for (index, ring) in region.rings.iter().enumerate() {
            let Some(last) = ring.points.last() else { continue };
            let mut edge = ring.points.len() - 1;
            let mut a = lattice.snap(last);
            for (i, point) in ring.points.iter().enumerate() {
                let b = lattice.snap(point);
                let source = Source { input: input as u32, ring: index as u32, edge: edge as u32 };
                let data = Payload { label: ring.edges[edge].label, number: table.len() as u32 };
                table.push((source, ring.edges[edge]));
                let (from, to) = (IntPoint::new(a.0, a.1), IntPoint::new(b.0, b.1));
                engine.add_edge(InputEdge { a: from, b: to, data }, kind);
                (a, edge) = (b, i);
            }
        }
    }
    let mut result = Overlay::default();
    for shape in engine.build_vector_shapes(rule, FillRule::NonZero) {
        for (i, contour) in shape.into_iter().enumerate() {
            let mut points = Vec::with_capacity(contour.len());
            let mut edges = Vec::with_capacity(contour.len());
            let mut sources = Vec::with_capacity(contour.len());
            for piece in &contour {
                let (source, edge) = table[piece.data.number as usize];
                points.push(lattice.place((piece.a.x, piece.a.y)));
                edges.push(edge);
                sources.push(source);
            }
            let ring = Ring { points, edges };
            let (ring, sources) = turned(ring, sources, i > 0);
            result.region.rings.push(ring);
            result.sources.push(sources);
        }
    }
    Ok(result)
}

/// The ring with its inside to the left, whichever way the engine walked it.
fn turned<T>(mut ring: Ring<T>, mut sources: Vec<Source>, hole: bool) -> (Ring<T>, Vec<Source>) {
    if (ring.twice_area_m2() < 0.0) != hole {
        // The edge of corner i runs to the corner before it now.
        ring.points.reverse();
        ring.edges.reverse();
        sources.reverse();
        ring.edges.rotate_left(1);
        sources.rotate_left(1);
    }
    (ring, sources)
}
