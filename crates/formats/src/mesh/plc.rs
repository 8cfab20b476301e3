//! TetGen's `.node`, `.poly` and `.smesh`: points, facets, points in holes.
//!
//! Indices count from the number of the first point, 0 or 1. A facet of a `.poly` may have several
//! loops, and points in its holes; a `.smesh` has one loop per facet. Facets inside the volume, and
//! facets that are not oriented outward, come as they are. Markers, attributes and regions are passed
//! over; loops of fewer than three points (single segments) are refused.

use solid::{Label, Point3};

use super::build::Builder;
use super::{MeshFile, MeshFormat};
use crate::FormatError;
use crate::error::Position;
use crate::lexer::Lexer;

/// Which of TetGen's formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlcKind {
    /// Points only.
    Node,
    /// Facets of loops, with holes.
    Poly,
    /// Facets of one loop.
    Smesh,
}

/// Reads the points of a `.node`, or of the first part of a `.poly` or `.smesh`; the number of the
/// first. `None` where the file says that its points stand elsewhere.
fn points(lexer: &mut Lexer<'_>, builder: &mut Builder) -> Result<Option<u64>, FormatError> {
    if !lexer.next_line() {
        return Err(lexer.unexpected("the number of points"));
    }
    let count = lexer.id("the number of points")?;
    if !lexer.at_end_of_line() {
        let at = lexer.position_of(lexer.mark());
        let dimension = lexer.id("the dimension")?;
        if dimension != 3 {
            let found = format!("dimension {dimension}");
            return Err(FormatError::unexpected(at, found, "3"));
        }
    }
    let mut first = None;
    for index in 0..count {
        if !lexer.next_line() {
            return Err(lexer.unexpected(&format!("point {index} of {count}")));
        }
        let at = lexer.position_of(lexer.mark());
        let number = lexer.id("the number of a point")?;
        let start = *first.get_or_insert(number);
        if start > 1 || number != start + index {
            let expected = format!("{}", index + start.min(1));
            return Err(FormatError::unexpected(at, format!("point {number}"), expected));
        }
        let xyz = lexer.floats::<3>("x, y, z")?;
        builder.vertex(xyz, || at)?;
    }
    Ok(first)
}

/// Reads points and facets; `nodes` is the `.node` file of a `.poly` or `.smesh` without points.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column.
pub fn read(bytes: &[u8], kind: PlcKind, nodes: Option<&[u8]>) -> Result<MeshFile, FormatError> {
    let mut lexer = Lexer::new(bytes);
    let mut builder = Builder::default();
    let mut first = points(&mut lexer, &mut builder)?;
    if kind != PlcKind::Node {
        if first.is_none() {
            let Some(nodes) = nodes else {
                let at = lexer.position_of(lexer.mark());
                let expected = "points, or a .node file of the same name beside it";
                return Err(FormatError::unexpected(at, "0 points", expected));
            };
            first = points(&mut Lexer::new(nodes), &mut builder)?;
        }
        facets(&mut lexer, &mut builder, kind, first.unwrap_or(0))?;
        holes(&mut lexer, &mut builder)?;
    }
    let end = lexer.position_of(lexer.mark());
    builder.finish(MeshFormat::Plc(kind), false, end)
}

fn facets(
    lexer: &mut Lexer<'_>,
    builder: &mut Builder,
    kind: PlcKind,
    first: u64,
) -> Result<(), FormatError> {
    if !lexer.next_line() {
        return Err(lexer.unexpected("the number of facets"));
    }
    let count = lexer.id("the number of facets")?;
    for index in 0..count {
        if !lexer.next_line() {
            return Err(lexer.unexpected(&format!("facet {index} of {count}")));
        }
        let at = lexer.position_of(lexer.mark());
        let (mut loops, mut inside) = (Vec::new(), Vec::new());
        if kind == PlcKind::Smesh {
            loops.push(corners(lexer, builder, first)?);
        } else {
            let polygons = lexer.id("the number of polygons")?;
            let holes = if lexer.at_end_of_line() { 0 } else { lexer.id("the number of holes")? };
            for _ in 0..polygons {
                if !lexer.next_line() {
                    return Err(lexer.unexpected("a polygon"));
                }
                loops.push(corners(lexer, builder, first)?);
            }
            for _ in 0..holes {
                if !lexer.next_line() {
                    return Err(lexer.unexpected("a point in a hole"));
                }
                lexer.id("the number of a hole")?;
                inside.push(Point3::from(lexer.floats::<3>("x, y, z")?));
            }
        }
        builder.facet(&loops, &inside, Label::Obstacle, None, || at)?;
    }
    Ok(())
}

/// A count of corners and the corners, which may go on over several lines.
fn corners(lexer: &mut Lexer<'_>, builder: &Builder, first: u64) -> Result<Vec<u32>, FormatError> {
    let at = lexer.position_of(lexer.mark());
    let count = lexer.id("the number of corners")?;
    if count < 3 {
        let found = format!("a polygon of {count} corners");
        return Err(FormatError::unexpected(at, found, "three or more"));
    }
    let mut corners = Vec::new();
    for _ in 0..count {
        if lexer.at_end_of_line() && !lexer.next_line() {
            return Err(lexer.unexpected("a corner"));
        }
        let at: Position = lexer.position_of(lexer.mark());
        let number = lexer.id("a corner")?;
        let known = builder.known(number as f64 - first as f64, || at);
        corners.push(known.map_err(|_| {
            let count = builder.vertices.len();
            let expected = format!("one of the {count} points, from {first}");
            FormatError::unexpected(at, format!("point {number}"), expected)
        })?);
    }
    Ok(corners)
}

fn holes(lexer: &mut Lexer<'_>, builder: &mut Builder) -> Result<(), FormatError> {
    // The parts after the facets may be missing.
    if !lexer.next_line() {
        return Ok(());
    }
    let count = lexer.id("the number of holes")?;
    for index in 0..count {
        if !lexer.next_line() {
            return Err(lexer.unexpected(&format!("hole {index} of {count}")));
        }
        lexer.id("the number of a hole")?;
        let point = Point3::from(lexer.floats::<3>("x, y, z")?);
        builder.hole_points.push(point);
    }
    Ok(())
}
