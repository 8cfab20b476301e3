//! The maps of a replay of depth images, with what their kind alone can tell.

use maps3d::reduce::{ReduceOptions, Stop};
use maps3d::relative::RelativeMap;
use maps3d::{
    Map3d, Maps3dError, RelativeParams, UnionMap, UnionParams, ViewOptions, VoxelMap, VoxelParams,
};
use pose::Se3;
use solid::{Label, Polyhedron};

use super::super::ReplayError;
use crate::config::{Config, Replay3d};

/// One of the maps.
pub(super) enum DepthMap {
    Relative(Box<RelativeMap>),
    Union(Box<UnionMap>),
    Voxels(Box<VoxelMap>),
}

impl DepthMap {
    /// The maps of a config, by name, in the order in which they run.
    pub(super) fn all(
        config: &Config,
        settings: &Replay3d,
    ) -> Result<Vec<(&'static str, Self)>, ReplayError> {
        let made = config.map_keys().into_iter().filter_map(|kind| {
            let map = Self::new(config, settings, kind).transpose()?;
            Some(map.map(|map| (kind, map)))
        });
        Ok(made.collect::<Result<_, Maps3dError>>()?)
    }

    fn new(config: &Config, settings: &Replay3d, kind: &str) -> Result<Option<Self>, Maps3dError> {
        let Some(maps) = &config.map3d else { return Ok(None) };
        Ok(match kind {
            "relative" => match &maps.relative {
                Some(map) => {
                    let mut params = RelativeParams::from(map);
                    params.view = prepared(params.view, settings, map.vertices);
                    Some(Self::Relative(Box::new(RelativeMap::new(params)?)))
                }
                None => None,
            },
            "global_union" => match &maps.global_union {
                Some(map) => {
                    let mut params: UnionParams = map.params(&config.odometry);
                    // The poses of the log are taken as they are.
                    params.correction = None;
                    params.view = prepared(params.view, settings, map.vertices);
                    Some(Self::Union(Box::new(UnionMap::new(params)?)))
                }
                None => None,
            },
            "voxels" => match &maps.voxels {
                Some(map) => Some(Self::Voxels(Box::new(VoxelMap::new(VoxelParams::from(map))?))),
                None => None,
            },
            _ => None,
        })
    }

    /// What every map can do.
    pub(super) fn map(&mut self) -> &mut dyn Map3d {
        match self {
            Self::Relative(map) => map.as_mut(),
            Self::Union(map) => map.as_mut(),
            Self::Voxels(map) => map.as_mut(),
        }
    }

    /// The same, to ask only.
    pub(super) fn asked(&self) -> &dyn Map3d {
        match self {
            Self::Relative(map) => map.as_ref(),
            Self::Union(map) => map.as_ref(),
            Self::Voxels(map) => map.as_ref(),
        }
    }

    /// The map as a labelled mesh in the frame of the log; none for cells.
    ///
    /// Of the union its polyhedron. Of the relative map the faces of every view, where the log has it,
    /// without the frontier of which nothing that counts is open: a soup, since nothing is united.
    pub(super) fn mesh(&self, log_from_vertex: &[Se3]) -> Option<Polyhedron> {
        match self {
            Self::Voxels(_) => None,
            Self::Union(map) => {
                let log_from_map = log_from_vertex.first()?;
                let (mut vertices, faces, labels, _) = map.polyhedron().clone().into_parts();
                for vertex in &mut vertices {
                    *vertex = log_from_map.transform(vertex);
                }
                Polyhedron::try_new(vertices, faces, labels).ok()
            }
            Self::Relative(map) => faces_of_views(map, log_from_vertex),
        }
    }
}

/// How a view is made of an image of the log.
fn prepared(view: ViewOptions, settings: &Replay3d, vertices: u32) -> ViewOptions {
    let reduce = Some(ReduceOptions::new(settings.method(), Stop::Vertices(vertices as usize)));
    ViewOptions { prepare: settings.prepare(), occlusion: settings.occlusion(), reduce, ..view }
}

fn faces_of_views(map: &RelativeMap, log_from_vertex: &[Se3]) -> Option<Polyhedron> {
    let (mut vertices, mut faces, mut labels) = (Vec::new(), Vec::new(), Vec::new());
    for view in map.views() {
        let log_from_camera =
            *log_from_vertex.get(view.vertex.0 as usize)? * view.vertex_from_camera;
        let mut take = |face: u16, label: Label| -> Option<()> {
            let first = u32::try_from(vertices.len()).ok()?;
            vertices
                .extend(view.volume.points(face).map(|corner| log_from_camera.transform(&corner)));
            faces.push([first, first + 1, first + 2]);
            labels.push(label);
            Some(())
        };
        for face in view.volume.obstacles() {
            take(face, Label::Obstacle)?;
        }
        let mut open: Vec<u16> =
            view.parts.iter().flat_map(|part| &part.pieces).map(|piece| piece.face).collect();
        open.sort_unstable();
        open.dedup();
        for index in open {
            take(*view.volume.frontier().get(usize::from(index))?, Label::Frontier)?;
        }
    }
    Polyhedron::try_new(vertices, faces, labels).ok()
}
