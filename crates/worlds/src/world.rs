//! A planar place: what stands where, and where a robot starts.

use std::sync::Arc;

use geometry::Point2;
use geometry::rays::SegmentCaster;
use pose::Se2;

use crate::{CellMap, Solid, WorldError};

/// Largest coordinate of a place, metres: beyond it a double no longer tells micrometres apart.
const MOST_REACH_M: f64 = 1e9;

/// A simulated place of the plane, in the `world` frame; immutable, and cheap to clone.
///
/// Only simulators and metrics may hold one: it is the truth.
#[derive(Clone, Debug)]
pub struct World2d {
    name: String,
    solid: Arc<Solid>,
    caster: Arc<SegmentCaster>,
    bounds: (Point2, Point2),
    world_from_start: Se2,
}

impl World2d {
    /// A place drawn as cells; everything outside the map is solid.
    ///
    /// Time and memory are linear in the number of cells, the tree of walls aside, which is
    /// O(w log w) in the number of straight walls.
    ///
    /// # Errors
    /// [`WorldError::NoArea`] for a map without cells or with a cell size that is not positive,
    /// [`WorldError::TooFar`] where it reaches beyond 1e9 m from the origin,
    /// [`WorldError::CellCount`] where the cells do not fill the map,
    /// [`WorldError::StartNotFree`] where the start stands on a solid cell.
    pub fn from_cells(
        name: impl Into<String>,
        cells: CellMap,
        world_from_start: Se2,
    ) -> Result<Self, WorldError> {
        let expected = cells.columns.saturating_mul(cells.rows);
        if cells.solid.len() != expected {
            return Err(WorldError::CellCount { found: cells.solid.len(), expected });
        }
        let low = cells.origin_in_world;
        let high = Point2::new(
            low.x + cells.columns as f64 * cells.cell_m,
            low.y + cells.rows as f64 * cells.cell_m,
        );
        Self::new(name.into(), Solid::Cells(cells), (low, high), world_from_start)
    }

    /// A place drawn as closed rings: a point is free inside an odd number of them.
    ///
    /// The first ring is usually the outer wall, the others obstacles in it; an obstacle may hold
    /// a free yard. Rings need not be oriented.
    ///
    /// # Errors
    /// [`WorldError::NoArea`] where the rings span no area or a coordinate is not finite,
    /// [`WorldError::TooFar`] where they reach beyond 1e9 m from the origin,
    /// [`WorldError::StartNotFree`] where the start does not stand in free space.
    pub fn from_polygons(
        name: impl Into<String>,
        rings: Vec<Vec<Point2>>,
        world_from_start: Se2,
    ) -> Result<Self, WorldError> {
        let mut low = Point2::new(f64::INFINITY, f64::INFINITY);
        let mut high = Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
        for point in rings.iter().flatten() {
            if !point.x.is_finite() || !point.y.is_finite() {
                return Err(WorldError::NoArea { width_m: f64::NAN, height_m: f64::NAN });
            }
            low = low.inf(point);
            high = high.sup(point);
        }
        Self::new(name.into(), Solid::Rings(rings), (low, high), world_from_start)
    }

    fn new(
        name: String,
        solid: Solid,
        bounds: (Point2, Point2),
        world_from_start: Se2,
    ) -> Result<Self, WorldError> {
        let (width_m, height_m) = (bounds.1.x - bounds.0.x, bounds.1.y - bounds.0.y);
        let finite = width_m.is_finite() && height_m.is_finite();
        if !finite || width_m <= 0.0 || height_m <= 0.0 {
            return Err(WorldError::NoArea { width_m, height_m });
        }
        let reach_m = bounds.0.coords.amax().max(bounds.1.coords.amax());
        if reach_m > MOST_REACH_M {
            return Err(WorldError::TooFar { reach_m, limit_m: MOST_REACH_M });
        }
        let caster = SegmentCaster::new(&solid.border());
        Self {
            name,
            solid: Arc::new(solid),
            caster: Arc::new(caster),
            bounds,
            world_from_start: Se2::identity(),
        }
        .with_start(world_from_start)
    }

    /// The same place with another start.
    ///
    /// # Errors
    /// [`WorldError::StartNotFree`] where the start does not stand in free space.
    pub fn with_start(&self, world_from_start: Se2) -> Result<Self, WorldError> {
        let at = Point2::from(world_from_start.translation);
        if !self.is_free(&at) {
            return Err(WorldError::StartNotFree { x_m: at.x, y_m: at.y });
        }
        Ok(Self { world_from_start, ..self.clone() })
    }

    /// The place's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What fills the place.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Everything that a ray can hit: the border between solid and free, in the world frame.
    pub fn obstacles(&self) -> &[(Point2, Point2)] {
        self.caster.segments()
    }

    /// Rays, sweeps and distances against the obstacles, in the world frame.
    pub fn caster(&self) -> &SegmentCaster {
        &self.caster
    }

    /// Lower-left and upper-right corner of a box around all free space, in the world frame.
    pub fn bounds(&self) -> (Point2, Point2) {
        self.bounds
    }

    /// Where a robot starts.
    pub fn world_from_start(&self) -> Se2 {
        self.world_from_start
    }

    /// Whether a point is free; on the border itself either answer may come.
    pub fn is_free(&self, point_in_world: &Point2) -> bool {
        self.solid.is_free(point_in_world)
    }
}
