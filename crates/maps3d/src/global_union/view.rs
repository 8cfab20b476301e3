//! Step 1: a look as an operand of the union.

use pose::Se3;
use probe::VertexId;
use solid::predicates::in_envelope;
use solid::{Label, Point3, Polyhedron, SolidError, Tetrahedra, Vector3, jittered};

use crate::relative::LocalVolume;
use crate::view::placed_fan;

/// The look that is drawn in by half of the most.
const HALFWAY: f64 = 50.0;

/// Next to the border of an image is nearer to it than this, pixels.
const BORDER_PX: f64 = 3.0;

/// How far behind the surface of a view walls may be that are asked about, metres.
const NEAR_M: f64 = 1.0;

/// One look: its polyhedron, and where it is in the map.
#[derive(Clone, Debug)]
pub(super) struct View {
    pub vertex: VertexId,
    pub vertex_from_camera: Se3,
    pub in_camera: Polyhedron,
    /// The same as it is asked about; `None` where it has too many vertices for that.
    pub volume: Option<LocalVolume>,
    /// The pose with which it was united.
    pub map_from_camera: Se3,
    /// Whether it stands beside the union, which refused it.
    pub aside: bool,
}

impl View {
    /// The view in the frame `map`, its surface drawn towards the camera, then each vertex moved by a hash of
    /// the look and of itself.
    ///
    /// The later the look, the more its surface is drawn in, up to `step_in_m` of depth: so a wall that is
    /// seen again lies inside of what is free already, instead of crossing it all over.
    pub fn placed(&self, number: u32, step_in_m: f64, jitter_m: f64) -> Polyhedron {
        let by_m = step_in_m * f64::from(number) / (f64::from(number) + HALFWAY);
        let placed = self.drawn_in(by_m).transformed(&self.map_from_camera);
        if jitter_m > 0.0 { jittered(&placed, number.into(), jitter_m) } else { placed }
    }

    /// The view with less depth; its sides stay in their planes.
    fn drawn_in(&self, by_m: f64) -> Polyhedron {
        if by_m <= 0.0 {
            return self.in_camera.clone();
        }
        let (vertices, faces, labels, _) = self.in_camera.clone().into_parts();
        let nearer = |p: &Point3| if p.z > 0.0 { p * (1.0 - by_m / p.z).max(0.5) } else { *p };
        let vertices = vertices.iter().map(nearer).collect();
        // Faces and labels are as many as before.
        Polyhedron::try_new(vertices, faces, labels).unwrap_or_else(|_| self.in_camera.clone())
    }

    /// The box round the view in the frame `map`; `None` for a view of nothing.
    pub fn bounds_in_map(&self) -> Option<(Point3, Point3)> {
        self.in_camera.transformed(&self.map_from_camera).bounds()
    }

    /// Whether the ball round the camera that holds the view touches a box of the frame `map`.
    pub fn comes_near(&self, low: &Point3, high: &Point3) -> bool {
        let Some(volume) = &self.volume else { return false };
        let camera = self.map_from_camera.translation;
        let apart = Vector3::from_fn(|axis, _| {
            (low[axis] - camera[axis]).max(camera[axis] - high[axis]).max(0.0)
        });
        apart.norm() <= volume.reach_m() + NEAR_M
    }

    /// Whether a ray of the view that ends at an obstacle face passes a point of the frame `map`, or would if
    /// it went on for `behind_m` of depth.
    pub fn is_wall(&self, in_map: &Point3, behind_m: f64) -> bool {
        let Some(volume) = &self.volume else { return false };
        volume.accounts_for(&self.map_from_camera.inverse_transform(in_map), behind_m)
    }

    /// Whether the view is still what it was once it is placed: very far away coordinates round it to nothing.
    pub fn stays_itself(&self) -> bool {
        let placed = self.in_camera.transformed(&self.map_from_camera);
        let (was_m3, is_m3) = (self.in_camera.volume_m3(), placed.volume_m3());
        placed.vertices().iter().all(in_envelope) && (is_m3 - was_m3).abs() <= 1e-3 * was_m3
    }

    /// Whether a point of the frame `map` lies in the image, not next to its border.
    pub fn shows(&self, in_map: &Point3) -> bool {
        let in_camera = self.map_from_camera.inverse_transform(in_map);
        self.volume.as_ref().is_some_and(|volume| volume.shows(&in_camera, BORDER_PX))
    }

    /// The fan of the view in the frame `map`. Tetrahedra that rounding turned over are left out.
    ///
    /// # Errors
    /// As [`placed_fan`].
    pub fn fan(&self) -> Result<Tetrahedra, SolidError> {
        placed_fan(&self.in_camera, &self.map_from_camera)
    }

    /// The farthest that a point of the view moves when it goes to another pose, metres; bounded by way of the
    /// corners of its box.
    pub fn moves_by(&self, map_from_camera: &Se3) -> f64 {
        let Some((low, high)) = self.in_camera.bounds() else { return 0.0 };
        let moved = |corner: usize| {
            let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            let at = Point3::new(pick(0), pick(1), pick(2));
            (map_from_camera.transform(&at) - self.map_from_camera.transform(&at)).norm()
        };
        // What moves is affine in the point: its length is greatest at a corner.
        (0..8).map(moved).fold(0.0, f64::max)
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        mesh_bytes(&self.in_camera) + self.volume.as_ref().map_or(0, LocalVolume::heap_bytes)
    }
}

/// Memory of a mesh on the heap, bytes.
pub(super) fn mesh_bytes(mesh: &Polyhedron) -> usize {
    size_of_val(mesh.vertices()) + size_of_val(mesh.faces()) + size_of_val(mesh.labels())
}

/// The octahedron round a point that the robot fills, all frontier.
pub(super) fn body_at(centre: &Point3, radius_m: f64) -> Option<Polyhedron> {
    if radius_m <= 0.0 {
        return None;
    }
    let vertices = (0..6)
        .map(|i| {
            let mut at = *centre;
            at[i / 2] += if i % 2 == 0 { radius_m } else { -radius_m };
            at
        })
        .collect();
    let faces: Vec<[u32; 3]> = (0..8_u32)
        .map(|octant| {
            let [x, y, z] = [octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2 & 1)];
            // Each axis that is reflected turns the face round.
            if octant.count_ones() % 2 == 0 { [x, y, z] } else { [x, z, y] }
        })
        .collect();
    let labels = vec![Label::Frontier; faces.len()];
    Polyhedron::try_new(vertices, faces, labels).ok()
}
