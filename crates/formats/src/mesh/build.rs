//! A mesh out of what a file says, vertex by vertex and polygon by polygon.

use solid::mesh::triangulate_facet;
use solid::predicates::in_envelope;
use solid::{Face, Label, Origin, Point3, Polyhedron};

use super::{MeshFile, MeshFormat};
use crate::FormatError;
use crate::error::Position;

#[derive(Debug, Default)]
pub(super) struct Builder {
    pub(super) vertices: Vec<Point3>,
    faces: Vec<Face>,
    labels: Vec<Label>,
    facet_of: Vec<u32>,
    pub(super) origins: Vec<Origin>,
    pub(super) hole_points: Vec<Point3>,
    polygons: usize,
    left_out: usize,
}

impl Builder {
    /// Adds a vertex; its coordinates must be zero or of magnitude 1e-45 to 1e50.
    pub(super) fn vertex(
        &mut self,
        xyz: [f64; 3],
        at: impl FnOnce() -> Position,
    ) -> Result<(), FormatError> {
        let point = Point3::from(xyz);
        if !in_envelope(&point) {
            // Not as a row of three hundred zeros.
            let [x, y, z] = xyz.map(|c| match c.abs() {
                0.0 | 1e-5..1e16 => c.to_string(),
                _ => format!("{c:e}"),
            });
            let expected = "coordinates that are 0 or of magnitude 1e-45 to 1e50";
            return Err(FormatError::unexpected(at(), format!("({x}, {y}, {z})"), expected));
        }
        self.vertices.push(point);
        Ok(())
    }

    /// Whether an index is that of a vertex.
    pub(super) fn known(
        &self,
        index: f64,
        at: impl FnOnce() -> Position,
    ) -> Result<u32, FormatError> {
        let count = self.vertices.len();
        if index >= 0.0 && index < count as f64 && index.fract() == 0.0 {
            return Ok(index as u32);
        }
        let found = format!("vertex {index}");
        Err(FormatError::unexpected(at(), found, format!("one of the {count} vertices from 0")))
    }

    /// Adds a polygon of known corners.
    pub(super) fn polygon(
        &mut self,
        corners: &[u32],
        label: Label,
        at: impl FnOnce() -> Position,
    ) -> Result<(), FormatError> {
        self.facet(&[corners.to_vec()], &[], label, None, at)
    }

    /// Adds a facet of loops of known corners, with points in its holes.
    pub(super) fn facet(
        &mut self,
        loops: &[Vec<u32>],
        holes: &[Point3],
        label: Label,
        origin: Option<Origin>,
        at: impl FnOnce() -> Position,
    ) -> Result<(), FormatError> {
        let facet = self.polygons as u32;
        self.polygons += 1;
        let mut clean: Vec<Vec<u32>> = loops.to_vec();
        for corners in &mut clean {
            corners.dedup();
            while corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
        }
        clean.retain(|corners| corners.len() >= 3);
        let Some(outer) = clean.first() else {
            self.left_out += 1;
            return Ok(());
        };
        let faces = match triangulate_facet(&self.vertices, &clean, holes) {
            Some(faces) => faces,
            // Not plane enough or flat: what other programs make of a polygon is a fan.
            None if clean.len() == 1 => {
                (1..outer.len() - 1).map(|i| [outer[0], outer[i], outer[i + 1]]).collect()
            }
            None => {
                let found = "a facet whose sides cross";
                return Err(FormatError::unexpected(at(), found, "loops that do not cross"));
            }
        };
        let sound: Vec<Face> =
            faces.into_iter().filter(|[a, b, c]| a != b && b != c && c != a).collect();
        self.labels.resize(self.labels.len() + sound.len(), label);
        self.facet_of.resize(self.facet_of.len() + sound.len(), facet);
        if let Some(origin) = origin {
            self.origins.resize(self.origins.len() + sound.len(), origin);
        }
        self.faces.extend(sound);
        Ok(())
    }

    /// The mesh; `end` is where the file ends.
    pub(super) fn finish(
        self,
        format: MeshFormat,
        labelled: bool,
        end: Position,
    ) -> Result<MeshFile, FormatError> {
        let refused = |error: solid::SolidError| {
            FormatError::unexpected(end, error.to_string(), "a mesh that fits in memory")
        };
        let mut mesh =
            Polyhedron::try_new(self.vertices, self.faces, self.labels).map_err(refused)?;
        if !self.origins.is_empty() {
            mesh = mesh.with_origins(self.origins).map_err(refused)?;
        }
        Ok(MeshFile {
            format,
            mesh,
            labelled,
            polygons: self.polygons,
            facet_of: self.facet_of,
            left_out: self.left_out,
            hole_points: self.hole_points,
        })
    }
}
