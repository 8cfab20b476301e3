//! Membership by direction.

use nalgebra::Point3;
use sensing::Camera;
use solid::Label;

use crate::triangulate::{ImageMesh, orient, rows_of};

/// A reduced view that knows which face a direction meets.
///
/// The image is cut into square cells, about as many as there are faces, and each cell keeps the faces
/// that reach into it: a direction is found by looking at a few faces, however many there are.
#[derive(Clone, Debug)]
pub struct StarView {
    mesh: ImageMesh,
    labels: Vec<Label>,
    camera: Camera,
    /// Inverse depth of each face as an affine function of pixels.
    planes: Vec<[f64; 3]>,
    /// Columns and rows of the image less one: its extent in pixels.
    extent: [f64; 2],
    cell_px: f64,
    cells: [usize; 2],
    /// Faces of cell `i` are `faces[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl StarView {
    /// Sorts the faces of a planar mesh into cells. O(faces + cells).
    pub fn new(mesh: ImageMesh, labels: Vec<Label>, camera: Camera) -> Self {
        let extent = mesh.pixels.iter().fold([0_u16; 2], |[c, r], p| [c.max(p[0]), r.max(p[1])]);
        let extent = extent.map(f64::from);
        let cell_px = (extent[0] * extent[1] / mesh.triangles.len().max(1) as f64).sqrt().max(1.0);
        let cells = extent.map(|side| (side / cell_px) as usize + 1);
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (face, &triangle) in mesh.triangles.iter().enumerate() {
            let corners = mesh.corner_pixels(triangle);
            let mut put = |column: f64, row: f64| {
                let [x, y] = [column, row].map(|at| (at.max(0.0) / cell_px) as usize);
                let cell = y.min(cells[1] - 1) * cells[0] + x.min(cells[0] - 1);
                pairs.push((cell as u32, face as u32));
            };
            // Every cell that the triangle reaches holds a point within a pixel of one of its pixels,
            // or of its sides.
            for span in rows_of(corners) {
                for row in [-1.0, 0.0, 1.0] {
                    let mut column = span.first as f64 - 1.0;
                    while column < span.last as f64 + 1.0 {
                        put(column, span.row as f64 + row);
                        column += cell_px;
                    }
                    put(span.last as f64 + 1.0, span.row as f64 + row);
                }
            }
            for side in 0..3 {
                let [p, q] = [corners[side], corners[(side + 1) % 3]].map(|p| p.map(f64::from));
                let steps = (p[0] - q[0]).abs().max((p[1] - q[1]).abs()).max(1.0);
                for step in 0..=steps as usize {
                    let along = step as f64 / steps;
                    let at = [p[0] + along * (q[0] - p[0]), p[1] + along * (q[1] - p[1])];
                    for place in 0..9 {
                        let (dc, dr) = (f64::from(place % 3 - 1), f64::from(place / 3 - 1));
                        put(at[0] + dc, at[1] + dr);
                    }
                }
            }
            pairs.dedup();
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0; cells[0] * cells[1] + 1];
        for &(cell, _) in &pairs {
            starts[cell as usize + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let planes = mesh.triangles.iter().map(|&t| mesh.inverse_depth_plane(t)).collect();
        let faces = pairs.into_iter().map(|(_, face)| face).collect();
        Self { mesh, labels, camera, planes, extent, cell_px, cells, starts, faces }
    }

    /// The mesh over the image.
    pub fn mesh(&self) -> &ImageMesh {
        &self.mesh
    }

    /// The label of each face of the mesh.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The face that the ray of a place of the image meets; the first of those that share it.
    ///
    /// `None` outside of the image. Expected O(1).
    pub fn face_at(&self, [column, row]: [f64; 2]) -> Option<usize> {
        let inside =
            (0.0..=self.extent[0]).contains(&column) && (0.0..=self.extent[1]).contains(&row);
        if !inside {
            return None;
        }
        let x = ((column / self.cell_px) as usize).min(self.cells[0] - 1);
        let y = ((row / self.cell_px) as usize).min(self.cells[1] - 1);
        let cell = y * self.cells[0] + x;
        let faces = &self.faces[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        // Rounding may put a place on a side beyond both faces by a hair: the nearest then.
        let mut best = (f64::NEG_INFINITY, None);
        for &face in faces {
            let pixels = self.mesh.corner_pixels(self.mesh.triangles[face as usize]);
            let within = least_share(pixels, [column, row]);
            if within >= 0.0 {
                return Some(face as usize);
            }
            if within > best.0 {
                best = (within, Some(face as usize));
            }
        }
        best.1
    }

    /// Depth of the surface on the ray of a place of the image, metres. Expected O(1).
    pub fn depth_at(&self, place: [f64; 2]) -> Option<f64> {
        let [base, per_column, per_row] = self.planes[self.face_at(place)?];
        Some(1.0 / (base + place[0] * per_column + place[1] * per_row))
    }

    /// Whether a point of the frame `camera` lies inside of the view or on its surface.
    ///
    /// It does when it is ahead, its ray lies within the image, and it is no farther than the surface
    /// on that ray. Expected O(1).
    pub fn contains(&self, point_in_camera: &Point3<f64>) -> bool {
        self.camera
            .pixel_of(point_in_camera)
            .and_then(|place| self.depth_at(place))
            .is_some_and(|depth_m| point_in_camera.z <= depth_m)
    }
}

/// The least of the three shares (barycentric coordinates) of a place in a triangle.
fn least_share([a, b, c]: [[u16; 2]; 3], [x, y]: [f64; 2]) -> f64 {
    let area = orient(a, b, c) as f64;
    let share = |p: [u16; 2], q: [u16; 2]| {
        let ([px, py], [qx, qy]) = (p.map(f64::from), q.map(f64::from));
        ((qx - px) * (y - py) - (qy - py) * (x - px)) / area
    };
    share(a, b).min(share(b, c)).min(share(c, a))
}
