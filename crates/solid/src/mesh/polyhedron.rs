//! Vertices, faces, labels, origins.

use pose::Se3;

use super::{Label, Origin};
use crate::predicates::in_envelope;
use crate::{Point3, SolidError};

/// Three vertices, counter-clockwise seen from outside.
pub type Face = [u32; 3];

/// A mesh of labelled triangles.
///
/// What holds: every face names three different vertices that exist, every coordinate is finite and
/// inside the envelope of the predicates, there is one label per face, and one origin per face or
/// none at all. Whether it is closed, oriented, a 2-manifold and free of self-intersections is for
/// [`check`](crate::check) to say. It never changes; what alters a mesh makes a new one.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    vertices: Vec<Point3>,
    faces: Vec<Face>,
    labels: Vec<Label>,
    origins: Option<Vec<Origin>>,
}

impl Polyhedron {
    /// A mesh from its parts, without origins.
    ///
    /// # Errors
    ///
    /// A [`SolidError`] that names the first vertex or face that breaks what a polyhedron holds.
    pub fn try_new(
        vertices: Vec<Point3>,
        faces: Vec<Face>,
        labels: Vec<Label>,
    ) -> Result<Self, SolidError> {
        if labels.len() != faces.len() {
            return Err(SolidError::LabelCount { faces: faces.len(), labels: labels.len() });
        }
        let limit = (u32::MAX / 4) as usize;
        for (what, found) in [("vertices", vertices.len()), ("faces", faces.len())] {
            if found > limit {
                return Err(SolidError::TooMany { what, found, limit });
            }
        }
        if let Some(vertex) = vertices.iter().position(|point| !in_envelope(point)) {
            let Point3 { coords } = vertices[vertex];
            let [x, y, z] = coords.into();
            return Err(SolidError::OutsideEnvelope { vertex, x, y, z });
        }
        for (face, corners) in faces.iter().enumerate() {
            let vertices = vertices.len();
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
                return Err(SolidError::UnknownVertex { face, vertex, vertices });
            }
            let [a, b, c] = *corners;
            if a == b || c == a {
                return Err(SolidError::RepeatedCorner { face, vertex: a });
            }
            if b == c {
                return Err(SolidError::RepeatedCorner { face, vertex: b });
            }
        }
        Ok(Self { vertices, faces, labels, origins: None })
    }

    /// The mesh without faces.
    pub fn empty() -> Self {
        Self { vertices: Vec::new(), faces: Vec::new(), labels: Vec::new(), origins: None }
    }

    /// The same mesh with the view and face from which each of its faces came.
    ///
    /// # Errors
    ///
    /// [`SolidError::OriginCount`] unless there is one origin per face.
    pub fn with_origins(self, origins: Vec<Origin>) -> Result<Self, SolidError> {
        if origins.len() != self.faces.len() {
            let (faces, origins) = (self.faces.len(), origins.len());
            return Err(SolidError::OriginCount { faces, origins });
        }
        Ok(Self { origins: Some(origins), ..self })
    }

    /// The same mesh, each face coming from the face of the same number of view `view`.
    pub fn as_view(self, view: u32) -> Self {
        let origins = (0..self.faces.len() as u32).map(|face| Origin { view, face }).collect();
        Self { origins: Some(origins), ..self }
    }

    /// The same mesh without origins.
    pub fn without_origins(self) -> Self {
        Self { origins: None, ..self }
    }

    /// The same faces with other labels.
    ///
    /// # Errors
    ///
    /// [`SolidError::LabelCount`] unless there is one label per face.
    pub fn with_labels(self, labels: Vec<Label>) -> Result<Self, SolidError> {
        if labels.len() != self.faces.len() {
            let (faces, labels) = (self.faces.len(), labels.len());
            return Err(SolidError::LabelCount { faces, labels });
        }
        Ok(Self { labels, ..self })
    }

    /// The vertices, metres.
    pub fn vertices(&self) -> &[Point3] {
        &self.vertices
    }

    /// The faces, counter-clockwise seen from outside.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The label of each face.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// Where each face came from, if that is known.
    pub fn origins(&self) -> Option<&[Origin]> {
        self.origins.as_deref()
    }

    /// Whether there is no face.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// The corners of face `face`. Panics on a face that does not exist, as indexing does.
    #[inline]
    pub fn corners(&self, face: usize) -> [&Point3; 3] {
        self.faces[face].map(|vertex| &self.vertices[vertex as usize])
    }

    /// The mesh in another frame.
    ///
    /// Rounding moves each vertex by up to a few units in the last place: faces that were exactly
    /// coplanar, or just not touching, need not stay so.
    pub fn transformed(&self, target_from_source: &Se3) -> Self {
        let vertices = self.vertices.iter().map(|p| target_from_source.transform(p)).collect();
        Self { vertices, ..self.clone() }
    }

    /// The same surface seen from the other side: every face turned round.
    pub fn turned_inside_out(&self) -> Self {
        let faces = self.faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
        Self { faces, ..self.clone() }
    }

    /// Vertices, faces, labels and origins, for whoever makes a new mesh of them.
    pub fn into_parts(self) -> (Vec<Point3>, Vec<Face>, Vec<Label>, Option<Vec<Origin>>) {
        (self.vertices, self.faces, self.labels, self.origins)
    }

    /// A mesh from parts that hold already what a polyhedron holds.
    pub(crate) fn from_sound_parts(
        vertices: Vec<Point3>,
        faces: Vec<Face>,
        labels: Vec<Label>,
        origins: Option<Vec<Origin>>,
    ) -> Self {
        debug_assert_eq!(labels.len(), faces.len());
        debug_assert!(origins.as_ref().is_none_or(|origins| origins.len() == faces.len()));
        debug_assert!(faces.iter().flatten().all(|&v| (v as usize) < vertices.len()));
        Self { vertices, faces, labels, origins }
    }
}
