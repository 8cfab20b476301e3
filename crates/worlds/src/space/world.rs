//! A place of space: its surfaces, and where a robot starts.

use std::sync::Arc;

use geometry::rays::MeshCaster;
use geometry::{Point3, Vector3};
use pose::Se3;
use pose::nalgebra::UnitQuaternion;

use super::open_place::open_place;
use crate::WorldError;

/// Largest coordinate of a place, metres: beyond it a double no longer tells nanometres apart.
const MOST_REACH_M: f64 = 1e6;

/// A simulated place of space, in the `world` frame, z up; immutable, and cheap to clone.
///
/// Its surfaces are any soup of triangles: both sides stop rays and robots, and nothing is asked of their
/// order or of whether they close. Only simulators and metrics may hold one: it is the truth.
#[derive(Clone, Debug)]
pub struct World3d {
    name: String,
    vertices: Arc<Vec<Point3>>,
    triangles: Arc<Vec<[u32; 3]>>,
    caster: Arc<MeshCaster>,
    bounds: (Point3, Point3),
    world_from_start: Se3,
}

impl World3d {
    /// A place from its triangles, as three vertices each; a robot starts at the given place, heading
    /// along the given yaw (radians, counter-clockwise from +x, seen from above).
    ///
    /// Without a start it is the most open place of a lattice that is closed in on all sides. O(n log n).
    ///
    /// # Errors
    /// [`WorldError::NoTriangles`] for none; [`WorldError::Corner`] where a triangle names a vertex that
    /// does not exist or is not finite; [`WorldError::FarVertex`] beyond 1e6 m from the origin;
    /// [`WorldError::StartInSpace`] where the start is not finite, outside of the bounds, or on a triangle;
    /// [`WorldError::NotClosedIn`] where no start is given and none can be found.
    pub fn from_mesh(
        name: impl Into<String>,
        vertices: Vec<Point3>,
        triangles: Vec<[u32; 3]>,
        start: Option<(Point3, f64)>,
    ) -> Result<Self, WorldError> {
        if triangles.is_empty() {
            return Err(WorldError::NoTriangles);
        }
        let mut bounds = (Point3::from([f64::INFINITY; 3]), Point3::from([f64::NEG_INFINITY; 3]));
        for (triangle, corners) in triangles.iter().enumerate() {
            for &vertex in corners {
                let found = vertices.get(vertex as usize);
                let Some(point) = found.filter(|p| p.iter().all(|x| x.is_finite())) else {
                    return Err(WorldError::Corner { triangle, vertex, vertices: vertices.len() });
                };
                let reach_m = point.coords.amax();
                if reach_m > MOST_REACH_M {
                    return Err(WorldError::FarVertex { vertex, reach_m, limit_m: MOST_REACH_M });
                }
                bounds = (bounds.0.inf(point), bounds.1.sup(point));
            }
        }
        let caster = MeshCaster::new(&vertices, &triangles);
        let (at, yaw_rad) = match start {
            Some(start) => start,
            None => (open_place(&caster, bounds).ok_or(WorldError::NotClosedIn)?, 0.0),
        };
        Self {
            name: name.into(),
            vertices: Arc::new(vertices),
            triangles: Arc::new(triangles),
            caster: Arc::new(caster),
            bounds,
            world_from_start: Se3::identity(),
        }
        .with_start(at, yaw_rad)
    }

    /// The same place with another start.
    ///
    /// # Errors
    /// [`WorldError::StartInSpace`] where the start is not finite, outside of the bounds, or on a triangle.
    pub fn with_start(&self, start_in_world: Point3, yaw_rad: f64) -> Result<Self, WorldError> {
        let (low, high) = self.bounds;
        let within = (0..3).all(|i| (low[i]..=high[i]).contains(&start_in_world[i]));
        if !within || !yaw_rad.is_finite() || self.caster.distance_to(&start_in_world) <= 0.0 {
            let [x_m, y_m, z_m] = start_in_world.coords.into();
            return Err(WorldError::StartInSpace { x_m, y_m, z_m });
        }
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rad);
        Ok(Self { world_from_start: Se3::new(start_in_world.coords, turn), ..self.clone() })
    }

    /// The place's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The corners of the triangles, in the world frame.
    pub fn vertices(&self) -> &[Point3] {
        &self.vertices
    }

    /// Everything that stops a ray, as three vertices each.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Rays, sweeps and distances against the triangles, in the world frame.
    pub fn caster(&self) -> &MeshCaster {
        &self.caster
    }

    /// Lowest and highest corner of a box around all triangles, in the world frame.
    pub fn bounds(&self) -> (Point3, Point3) {
        self.bounds
    }

    /// Where a robot starts; upright.
    pub fn world_from_start(&self) -> Se3 {
        self.world_from_start
    }
}
