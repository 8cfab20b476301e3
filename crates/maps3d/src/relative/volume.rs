//! The local volume of one look: a star-shaped polyhedron, kept small, never changed.

use nalgebra::Point3;
use sensing::Camera;
use solid::{Label, Polyhedron};

use super::cells::Cells;
use crate::image::Pixel;
use crate::triangulate::ImageMesh;
use crate::view::{join, outward};
use crate::{Made, Maps3dError};

/// The most vertices of a view: faces then have numbers of 16 bits.
pub(super) const MOST_VERTICES: usize = 16_384;

/// How a volume differs from its polyhedron where it is held against others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    /// By how much the sides of the image move inwards, pixels.
    pub inset_px: f64,
    /// By how much the surface moves away from the camera, metres of depth.
    pub shift_m: f64,
}

impl Shape {
    /// The polyhedron as it is.
    pub const PLAIN: Self = Self { inset_px: 0.0, shift_m: 0.0 };
}

/// A closed polyhedron in the frame `camera`: a triangulation of the image, lifted, and joined to the camera.
///
/// Faces are numbered as those of [`polyhedron`](Self::polyhedron): first the surface, then those that lead
/// to the camera, one per edge of the border, all frontier. Corners are numbered alike; the camera is the
/// last.
#[derive(Clone, Debug)]
pub struct LocalVolume {
    camera: Camera,
    /// The last column and the last row of the image.
    extent: [u16; 2],
    pixels: Box<[Pixel]>,
    depths_m: Box<[f32]>,
    triangles: Box<[[u16; 3]]>,
    border: Box<[u16]>,
    /// Faces with the label frontier, ascending.
    frontier: Box<[u16]>,
    cells: Cells,
    reach_m: f64,
    deepest_m: f64,
}

impl LocalVolume {
    /// The volume of a polyhedron that was made from a depth image; depths are rounded to 32 bits.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for more than 16,384 vertices.
    pub fn new(made: &Made) -> Result<Self, Maps3dError> {
        let mesh = &made.mesh;
        if mesh.pixels.len() > MOST_VERTICES {
            let (option, found) = ("vertices", mesh.pixels.len() as f64);
            return Err(Maps3dError::Option {
                option,
                found,
                expected: "at most 16,384 in a view",
            });
        }
        #[expect(clippy::cast_possible_truncation, reason = "far below what sensors resolve")]
        let depths_m: Box<[f32]> = mesh.depths_m.iter().map(|&depth_m| depth_m as f32).collect();
        let triangles: Box<[[u16; 3]]> =
            mesh.triangles.iter().map(|t| t.map(|corner| corner as u16)).collect();
        let border: Box<[u16]> = mesh.border().iter().map(|&corner| corner as u16).collect();
        let extent = mesh.pixels.iter().fold([0_u16; 2], |[c, r], p| [c.max(p[0]), r.max(p[1])]);
        let surface = made.labels.iter().enumerate().filter(|(_, l)| **l == Label::Frontier);
        let sides = triangles.len()..triangles.len() + border.len();
        let frontier = surface.map(|(face, _)| face).chain(sides).map(|face| face as u16).collect();
        let cells = Cells::new(extent, &mesh.pixels, &depths_m, &triangles);
        let mut volume = Self {
            camera: *made.image.camera(),
            extent,
            pixels: mesh.pixels.clone().into(),
            depths_m,
            triangles,
            border,
            frontier,
            cells,
            reach_m: 0.0,
            deepest_m: 0.0,
        };
        for corner in 0..volume.pixels.len() as u16 {
            let point = volume.corner(corner);
            volume.reach_m = volume.reach_m.max(point.coords.norm());
            volume.deepest_m = volume.deepest_m.max(point.z);
        }
        Ok(volume)
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Number of vertices, the camera included.
    pub fn corner_count(&self) -> usize {
        self.pixels.len() + 1
    }

    /// Number of faces of the surface.
    pub fn surface_count(&self) -> usize {
        self.triangles.len()
    }

    /// Number of faces, those that lead to the camera included.
    pub fn face_count(&self) -> usize {
        self.triangles.len() + self.border.len()
    }

    /// The frontier faces, ascending.
    pub fn frontier(&self) -> &[u16] {
        &self.frontier
    }

    /// The obstacle faces, ascending.
    pub fn obstacles(&self) -> impl Iterator<Item = u16> + '_ {
        let mut frontier = self.frontier.iter().peekable();
        (0..self.triangles.len() as u16)
            .filter(move |face| frontier.next_if(|next| *next == face).is_none())
    }

    /// Distance of the farthest vertex from the camera, metres.
    pub fn reach_m(&self) -> f64 {
        self.reach_m
    }

    /// The corners of a face, counter-clockwise seen from outside.
    pub fn face(&self, face: u16) -> [u16; 3] {
        let face = face as usize;
        let corners = match self.triangles.get(face) {
            Some(&corners) => corners,
            None => {
                let at = face - self.triangles.len();
                let next = if at + 1 == self.border.len() { 0 } else { at + 1 };
                [self.border[next], self.border[at], self.pixels.len() as u16]
            }
        };
        outward(&self.camera, corners.map(u32::from)).map(|corner| corner as u16)
    }

    /// A vertex in the frame `camera`, metres.
    pub fn corner(&self, corner: u16) -> Point3<f64> {
        self.shaped(corner, Shape::PLAIN)
    }

    /// The corners of a face in the frame `camera`, metres.
    pub fn points(&self, face: u16) -> [Point3<f64>; 3] {
        self.face(face).map(|corner| self.corner(corner))
    }

    /// The polyhedron in the frame `camera`, with its labels.
    ///
    /// # Errors
    /// None for a volume that was made; the type is that of [`join`](crate::view::join).
    pub fn polyhedron(&self) -> Result<Polyhedron, Maps3dError> {
        let mesh = ImageMesh {
            pixels: self.pixels.to_vec(),
            depths_m: self.depths_m.iter().map(|&depth_m| depth_m.into()).collect(),
            triangles: self.triangles.iter().map(|t| t.map(u32::from)).collect(),
        };
        let mut labels = vec![Label::Obstacle; mesh.triangles.len()];
        for &face in &self.frontier {
            if let Some(label) = labels.get_mut(face as usize) {
                *label = Label::Frontier;
            }
        }
        join(&mesh, &labels, &self.camera, false)
    }

    /// Whether a point of the frame `camera` lies inside or on the surface. Expected O(1).
    pub fn contains(&self, point_in_camera: &Point3<f64>) -> bool {
        self.holds(point_in_camera, Shape::PLAIN).is_some()
    }

    /// Whether a point of the frame `camera` lies in the image, by at least `inset_px`.
    pub(crate) fn shows(&self, point_in_camera: &Point3<f64>, inset_px: f64) -> bool {
        let [columns, rows] = self.extent.map(|last| f64::from(last) - inset_px);
        let place = self.camera.pixel_of(point_in_camera);
        place.is_some_and(|[column, row]| {
            (inset_px..=columns).contains(&column) && (inset_px..=rows).contains(&row)
        })
    }

    /// Whether a ray that ends at an obstacle face passes a point of the frame `camera`, or would if it went on for
    /// `behind_m` of depth. Expected O(1).
    pub(crate) fn accounts_for(&self, point_in_camera: &Point3<f64>, behind_m: f64) -> bool {
        let shape = Shape { inset_px: 0.3, shift_m: behind_m };
        let beyond = self.holds(point_in_camera, shape);
        beyond.is_some_and(|face| self.frontier.binary_search(&face).is_err())
    }

    /// The face of the surface beyond a point of a shape of the volume; `None` for a point outside.
    pub(super) fn holds(&self, point: &Point3<f64>, shape: Shape) -> Option<u16> {
        let place = self.camera.pixel_of(point)?;
        let [column, row] = place;
        let within =
            |x: f64, last: u16| x >= shape.inset_px && x <= f64::from(last) - shape.inset_px;
        if !within(column, self.extent[0]) || !within(row, self.extent[1]) {
            return None;
        }
        let cell = self.cells.cell_of(place);
        if point.z > self.cells.depths_m(cell)[1] + shape.shift_m {
            return None;
        }
        // Rounding may put a place on a side beyond both faces by a hair: the nearest then.
        let mut best = (f64::NEG_INFINITY, None);
        for &face in self.cells.faces(cell) {
            let corners = self.triangles[face as usize];
            let shares = shares(corners.map(|corner| self.place(corner)), place);
            let least = shares[0].min(shares[1]).min(shares[2]);
            if least > best.0 {
                let depths = corners.map(|corner| 1.0 / self.depth_m(corner, shape));
                let inverse: f64 = (0..3).map(|i| shares[i] * depths[i]).sum();
                best = (least, (point.z * inverse <= 1.0).then_some(face));
                if least >= 0.0 {
                    break;
                }
            }
        }
        best.1
    }

    /// The point of the surface at a place of the image, in the frame `camera`, where it is an obstacle.
    pub(super) fn obstacle_at(&self, place: [f64; 2]) -> Option<Point3<f64>> {
        let cell = self.cells.cell_of(place);
        for &face in self.cells.faces(cell) {
            let corners = self.triangles[face as usize];
            let shares = shares(corners.map(|corner| self.place(corner)), place);
            if shares.iter().all(|share| *share >= 0.0) {
                let is_frontier = self.frontier.binary_search(&face).is_ok();
                let inverse = |i: usize| shares[i] / self.depth_m(corners[i], Shape::PLAIN);
                let depth_m = 1.0 / (inverse(0) + inverse(1) + inverse(2));
                let point = || self.camera.point_in_camera(place[0], place[1], depth_m);
                return (!is_frontier && depth_m.is_finite()).then(point);
            }
        }
        None
    }

    /// A vertex of a shape of the volume, before its sides move inwards, in the frame `camera`, metres.
    pub(super) fn shaped(&self, corner: u16, shape: Shape) -> Point3<f64> {
        if corner as usize == self.pixels.len() {
            return Point3::origin();
        }
        let [column, row] = self.place(corner);
        self.camera.point_in_camera(column, row, self.depth_m(corner, shape))
    }

    /// The largest depth, metres.
    pub(super) fn deepest_m(&self) -> f64 {
        self.deepest_m
    }

    pub(super) fn cells(&self) -> &Cells {
        &self.cells
    }

    pub(super) fn extent(&self) -> [u16; 2] {
        self.extent
    }

    /// The corners of a face of the surface, in the order of the image.
    pub(super) fn triangle(&self, face: u16) -> [u16; 3] {
        self.triangles[face as usize]
    }

    fn place(&self, corner: u16) -> [f64; 2] {
        self.pixels[corner as usize].map(f64::from)
    }

    fn depth_m(&self, corner: u16, shape: Shape) -> f64 {
        let depth_m = f64::from(self.depths_m[corner as usize]);
        (depth_m + shape.shift_m).max(0.5 * depth_m)
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        self.pixels.len() * (4 + 4)
            + self.triangles.len() * 6
            + (self.border.len() + self.frontier.len()) * 2
            + self.cells.heap_bytes()
    }
}

/// The shares (barycentric coordinates) of a place in a triangle.
fn shares([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> [f64; 3] {
    let cross = |o: [f64; 2], p: [f64; 2], q: [f64; 2]| {
        (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])
    };
    let (of_a, of_b, of_c) = (cross(p, b, c), cross(p, c, a), cross(p, a, b));
    let sum = of_a + of_b + of_c;
    [of_a / sum, of_b / sum, of_c / sum]
}
