//! The voxel map and its answers to the map trait.

use std::collections::BTreeMap;

use nalgebra::Point3;
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, IdVec, VertexId};
use sensing::DepthImage;

use super::VoxelParams;
use super::blocks::{BlockKey, Blocks, Cell};
use super::frontier::{Frontier, Opening};
use super::integrate::{Scratch, integrate};
use crate::{
    FlightClearance, FlightRoute, FrontierPatch, Hovering, Known, Look, Map3d, Map3dProbe,
    MapTally, MapWork, Maps3dError,
};

/// A look that was kept.
#[derive(Clone, Debug)]
struct Kept {
    vertex: VertexId,
    vertex_from_camera: Se3,
    image: DepthImage,
}

/// Log-odds occupancy in one global frame, that of the first vertex.
///
/// Vertices are placed by odometry alone: place edges move nothing. Corrected poses are followed only where
/// looks are kept ([`VoxelParams::reintegrate`]); then all cells are forgotten and every look is walked again.
#[derive(Clone, Debug)]
pub struct VoxelMap {
    pub(super) params: VoxelParams,
    pub(super) blocks: Blocks,
    pub(super) frontier: Frontier,
    pub(super) map_from_vertex: IdVec<VertexId, Option<Se3>>,
    pub(super) given_up: Vec<(Point3<f64>, f64)>,
    pub(super) patches: Vec<Opening>,
    pub(super) tally: MapTally,
    kept: Vec<Kept>,
    scratch: Scratch,
    looks: usize,
    corrections: u64,
}

impl VoxelMap {
    /// A map of nothing.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for a parameter out of its range.
    pub fn new(params: VoxelParams) -> Result<Self, Maps3dError> {
        params.check()?;
        Ok(Self {
            params,
            blocks: Blocks::default(),
            frontier: Frontier::default(),
            map_from_vertex: IdVec::new(),
            given_up: Vec::new(),
            patches: Vec::new(),
            tally: MapTally::default(),
            kept: Vec::new(),
            scratch: Scratch::default(),
            looks: 0,
            corrections: 0,
        })
    }

    /// What was chosen for this map.
    pub fn params(&self) -> &VoxelParams {
        &self.params
    }

    /// Where a vertex is; the first that was heard of is the origin.
    pub fn map_from_vertex(&self, vertex: VertexId) -> Option<&Se3> {
        self.map_from_vertex.get(vertex)?.as_ref()
    }

    /// The known cells, block by block, with their log odds in hundredths; above 0 is occupied. The lowest
    /// corner of a cell is its place times the side of a cell, in the frame of the first vertex.
    pub fn cells(&self) -> impl Iterator<Item = (Cell, i8)> + '_ {
        self.blocks.keys().flat_map(|key| self.blocks.cells(key))
    }

    /// What a cell is taken for.
    pub fn known(&self, cell: Cell) -> Known {
        match self.blocks.odds(cell) {
            None => Known::Unknown,
            Some(odds) if odds > 0 => Known::Solid,
            Some(_) => Known::Free,
        }
    }

    /// The cell of a point of the frame `map`.
    pub(super) fn cell_of(&self, point: &Point3<f64>) -> Cell {
        super::walk::cell_of(&(point / self.params.cell_m))
    }

    /// The middle of a cell, in the frame `map`, metres.
    pub(super) fn middle_of(&self, cell: Cell) -> Point3<f64> {
        Point3::from(cell.map(|at| (f64::from(at) + 0.5) * self.params.cell_m))
    }

    pub(super) fn map_from_body(&self, hovering: &Hovering) -> Option<Se3> {
        Some(*self.map_from_vertex(hovering.vertex)? * hovering.vertex_from_body)
    }

    fn place(&mut self, vertex: VertexId, map_from_vertex: Se3) {
        while self.map_from_vertex.next_id() <= vertex {
            self.map_from_vertex.push(None);
        }
        self.map_from_vertex[vertex].get_or_insert(map_from_vertex);
    }

    fn write(&mut self, vertex: VertexId, vertex_from_camera: &Se3, image: &DepthImage) {
        let Some(map_from_vertex) = self.map_from_vertex(vertex).copied() else { return };
        let map_from_camera = map_from_vertex * *vertex_from_camera;
        let turned =
            integrate(&mut self.blocks, &self.params, &map_from_camera, image, &mut self.scratch);
        self.frontier.update(&self.blocks, &turned);
    }

    /// All keys of blocks, for who makes the frontier anew.
    fn all_blocks(&self) -> Vec<BlockKey> {
        self.blocks.keys().collect()
    }
}

impl Map3d for VoxelMap {
    fn kind(&self) -> &'static str {
        "voxels"
    }

    /// A new vertex is placed along the first odometry edge that leads to it from a known one; where there is
    /// none, along the first place edge.
    fn edges_added(&mut self, graph: &PoseGraph<Se3>, edges: &[EdgeId], _: &mut dyn Map3dProbe) {
        for kind in [EdgeKind::Odometry, EdgeKind::Place] {
            for edge in edges.iter().map(|&id| graph.edge(id)).filter(|edge| edge.kind == kind) {
                for (known, new, known_from_new) in
                    [(edge.a, edge.b, edge.a_from_b), (edge.b, edge.a, edge.a_from_b.inverse())]
                {
                    if self.map_from_vertex.is_empty() {
                        self.place(known, Se3::identity());
                    }
                    if let Some(map_from_known) = self.map_from_vertex(known).copied() {
                        self.place(new, map_from_known * known_from_new);
                    }
                }
            }
        }
    }

    /// Nothing relies on place edges.
    fn edge_withdrawn(&mut self, _: &PoseGraph<Se3>, _: EdgeId, _: &mut dyn Map3dProbe) {}

    fn poses_reestimated(&mut self, map_from_vertex: &[Se3], _: &mut dyn Map3dProbe) {
        if !self.params.reintegrate {
            return;
        }
        self.corrections += 1;
        self.map_from_vertex = map_from_vertex.iter().map(|pose| Some(*pose)).collect();
        self.blocks.clear();
        self.frontier = Frontier::default();
        let kept = std::mem::take(&mut self.kept);
        for look in &kept {
            self.write(look.vertex, &look.vertex_from_camera, &look.image);
        }
        self.kept = kept;
        let all = self.all_blocks();
        self.frontier.update(&self.blocks, &all);
        self.measure();
    }

    fn looked(&mut self, look: &Look<'_>, _: &mut dyn Map3dProbe) -> Result<(), Maps3dError> {
        let image = look.image;
        let (columns, depths) = (image.columns, image.depths_m.len());
        if columns == 0 || !depths.is_multiple_of(columns) || depths == 0 {
            return Err(Maps3dError::ImageShape { depths, columns });
        }
        let sensing::Camera { fx, fy, cx, cy } = image.camera;
        if !image.camera.is_usable() {
            return Err(Maps3dError::Camera { fx, fy, cx, cy });
        }
        if !posegraph::RelativePose::is_finite(&look.vertex_from_camera) {
            return Err(Maps3dError::Pose { vertex: look.vertex });
        }
        if self.map_from_vertex.is_empty() {
            self.place(look.vertex, Se3::identity());
        }
        if self.map_from_vertex(look.vertex).is_none() {
            return Err(Maps3dError::Pose { vertex: look.vertex });
        }
        self.looks += 1;
        if self.params.reintegrate {
            let (vertex, vertex_from_camera) = (look.vertex, look.vertex_from_camera);
            self.kept.push(Kept { vertex, vertex_from_camera, image: image.clone() });
        }
        self.write(look.vertex, &look.vertex_from_camera, image);
        self.measure();
        Ok(())
    }

    fn tally(&self) -> MapTally {
        MapTally { volumes: self.blocks.known_count(), ..self.tally }
    }

    fn frontiers(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        self.patches_for(hovering, out);
    }

    fn frontier_at(&self, _: VertexId) -> f64 {
        self.tally.open_m2
    }

    fn route(
        &mut self,
        hovering: &Hovering,
        clearance_m: f64,
        _: &dyn Fn(VertexId) -> bool,
    ) -> Option<FlightRoute> {
        self.way_to_frontier(hovering, clearance_m).map(FlightRoute::Fly)
    }

    fn clearance(
        &mut self,
        hovering: &Hovering,
        to_in_body: &Point3<f64>,
        leaving_m: f64,
    ) -> FlightClearance {
        self.motion_clearance(hovering, to_in_body, leaving_m)
    }

    fn give_up(
        &mut self,
        hovering: &Hovering,
        places_in_body: &[Point3<f64>],
        radius_m: f64,
        _everywhere: bool,
        _: &mut dyn Map3dProbe,
    ) {
        if let Some(map_from_body) = self.map_from_body(hovering) {
            let places = places_in_body.iter().map(|place| map_from_body.transform(place));
            self.given_up.extend(places.map(|place| (place, radius_m)));
            self.measure();
        }
    }

    fn knows(&self, hovering: &Hovering, point_in_body: &Point3<f64>) -> Known {
        match self.map_from_body(hovering) {
            Some(map_from_body) => {
                self.known(self.cell_of(&map_from_body.transform(point_in_body)))
            }
            None => Known::Unknown,
        }
    }

    fn work(&self) -> MapWork {
        MapWork { corrections: self.corrections, ..MapWork::default() }
    }

    fn bytes(&self) -> usize {
        let kept: usize = self.kept.iter().map(|look| 4 * look.image.depths_m.len() + 200).sum();
        self.blocks.heap_bytes()
            + self.frontier.heap_bytes()
            + kept
            + self.map_from_vertex.len() * size_of::<Option<Se3>>()
    }
}

/// Where the blocks of cells lie; for maps of keys.
pub(super) type CellsOf = BTreeMap<BlockKey, Vec<u16>>;
