//! The map and its answers to the trait.

use std::collections::VecDeque;

use geometry::Point2;
use geometry::planar::overlay::{Region, union_all};
use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, Probe, VertexId};
use sensing::Scan;

use super::corners::corners_of;
use super::grow::Member;
use super::{Corner, CornerState};
use crate::polygons::{PolygonEvent, Tag, region_of};
use crate::volume::{LocalVolume, Options, Samples, VolumeParams, build, tell_of_volume};
use crate::{Candidate, Clearance, ExplorationMap, Frontier, MapProbe, Route, Standing, Vantage};

/// Parameters of [`ExtendedMap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtendedParams {
    /// How scans become polygons.
    pub volume: VolumeParams,
    /// Corners nearer than this to a wall that another polygon saw are settled, metres. Not in
    /// \[Zie18\]: a corner that spans an "occlusion" along one wall lies on it, inside of nothing.
    pub wall_closing_m: f64,
}

impl Default for ExtendedParams {
    fn default() -> Self {
        let options = Options { insert_occlusion_vertex: true, ..Options::default() };
        Self { volume: VolumeParams { options, ..VolumeParams::default() }, wall_closing_m: 0.3 }
    }
}

/// A local polygon with its corners.
#[derive(Clone, Debug)]
pub(super) struct Local {
    pub samples: Samples,
    pub volume: LocalVolume,
    pub corners: Vec<Corner>,
}

impl Local {
    fn open(&self) -> impl Iterator<Item = &Corner> {
        self.corners.iter().filter(|corner| corner.state == CornerState::Open)
    }
}

/// An edge of the graph as seen from one end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub to: VertexId,
    pub from_from_to: Se2,
    pub length_m: f64,
    pub edge: EdgeId,
}

/// Local polygons, and the extended polygon around the robot (\[Zie18\] 2.8).
#[derive(Clone, Debug)]
pub struct ExtendedMap {
    pub(super) params: ExtendedParams,
    pub(super) locals: IdVec<VertexId, Option<Box<Local>>>,
    pub(super) links: IdVec<VertexId, Vec<Link>>,
    members: Vec<Member>,
}

impl ExtendedMap {
    /// A map of nothing.
    pub fn new(params: ExtendedParams) -> Self {
        Self { params, locals: IdVec::new(), links: IdVec::new(), members: Vec::new() }
    }

    pub(super) fn local(&self, vertex: VertexId) -> Option<&Local> {
        self.locals.get(vertex)?.as_deref()
    }

    /// The frontier corners of a vertex, in its frame.
    pub fn corners(&self, vertex: VertexId) -> &[Corner] {
        self.local(vertex).map_or(&[], |local| &local.corners)
    }

    /// The polygons that make up the extended one, each in the frame of the first, that of the robot.
    pub fn members(&self) -> impl Iterator<Item = (VertexId, Se2)> + '_ {
        self.members.iter().map(|member| (member.vertex, member.root_from_vertex))
    }

    /// The extended polygon itself, in the frame of the robot's vertex (eq. 2.13).
    ///
    /// Cost: the union of all members; meant for looking at.
    pub fn extended_polygon(&self) -> Region<Tag> {
        let placed: Vec<Region<Tag>> = self
            .members
            .iter()
            .filter_map(|member| {
                let volume = &self.local(member.vertex)?.volume;
                Some(region_of(member.vertex, volume, &member.root_from_vertex))
            })
            .collect();
        let all: Vec<&Region<Tag>> = placed.iter().collect();
        union_all(&all).map(|united| united.region).unwrap_or_default()
    }

    /// Grows the extended polygon of a vertex and marks what lies in it.
    fn extend(&mut self, root: VertexId, probe: &mut dyn MapProbe) {
        self.members = self.grow(root);
        let members = std::mem::take(&mut self.members);
        let marked = self.mark_free(&members);
        self.members = members;
        if Probe::<PolygonEvent<'_>>::on(probe) {
            let region = self.extended_polygon();
            let members: Vec<VertexId> = self.members().map(|(vertex, _)| vertex).collect();
            probe.emit(PolygonEvent::Extended { root, members: &members, region: &region });
            for (vertex, count) in marked {
                probe.emit(PolygonEvent::MarkedFree { vertex, count });
            }
        }
    }

    fn cover(&mut self, vertex: VertexId) {
        while self.locals.next_id() <= vertex {
            self.locals.push(None);
            self.links.push(Vec::new());
        }
    }

    fn candidate(standing: &Standing, corner: &Corner, tag: u64) -> Candidate {
        let body_from_vertex = standing.vertex_from_body.inverse();
        Candidate {
            goals_in_body: [body_from_vertex.transform(&corner.at); 3],
            normal_in_body: body_from_vertex.rotation * corner.normal,
            length_m: corner.length_m,
            turn_only: corner.spoke,
            tag,
        }
    }
}

impl ExplorationMap for ExtendedMap {
    fn kind(&self) -> &'static str {
        "extended"
    }

    fn edges_added(&mut self, graph: &PoseGraph, edges: &[EdgeId], _probe: &mut dyn MapProbe) {
        for &id in edges {
            let edge = *graph.edge(id);
            self.cover(edge.a.max(edge.b));
            let (length_m, a_from_b) = (edge.length_m, edge.a_from_b);
            let link = |to, from_from_to| Link { to, from_from_to, length_m, edge: id };
            self.links[edge.a].push(link(edge.b, a_from_b));
            self.links[edge.b].push(link(edge.a, a_from_b.inverse()));
        }
    }

    /// Nothing remembers what relied on an edge: everything is marked anew, from every vertex.
    fn edge_withdrawn(&mut self, _graph: &PoseGraph, edge: EdgeId, probe: &mut dyn MapProbe) {
        for vertex in self.links.ids() {
            self.links[vertex].retain(|link| link.edge != edge);
            if let Some(local) = self.locals[vertex].as_deref_mut() {
                for corner in &mut local.corners {
                    if corner.state == CornerState::Free {
                        corner.state = CornerState::Open;
                    }
                }
            }
        }
        let here = self.members.first().map(|member| member.vertex);
        for vertex in self.locals.ids() {
            self.extend(vertex, probe);
        }
        if let Some(here) = here {
            self.extend(here, probe);
        }
    }

    /// Local polygons do not look at global estimates: nothing changes.
    fn poses_reestimated(&mut self, _map_from_vertex: &[Se2], _probe: &mut dyn MapProbe) {}

    fn scanned(&mut self, standing: &Standing, scan: &Scan, probe: &mut dyn MapProbe) {
        let vertex = standing.vertex;
        self.cover(vertex);
        let before = self.locals[vertex].take();
        let merged = before.is_some();
        let mut local = before.unwrap_or_else(|| {
            let (samples, volume) = (Samples::new(), LocalVolume::empty());
            Box::new(Local { samples, volume, corners: Vec::new() })
        });
        local.samples.add(scan, &standing.vertex_from_body);
        local.volume =
            build(&local.samples, &self.params.volume).unwrap_or_else(|_| LocalVolume::empty());
        let known = std::mem::replace(&mut local.corners, corners_of(&local.volume));
        for corner in &mut local.corners {
            // What was settled stays so where the corner is the same.
            if let Some(same) = known.iter().find(|old| old.at == corner.at) {
                corner.state = same.state;
            }
        }
        tell_of_volume(standing, scan, (&local.samples, &local.volume), merged, probe);
        self.locals[vertex] = Some(local);
        self.extend(vertex, probe);
    }

    fn frontier(&self) -> Frontier {
        let mut left = Frontier::default();
        for local in self.locals.iter().filter_map(Option::as_deref) {
            left.places += usize::from(local.open().next().is_some());
            left.open_m += local.open().map(|corner| corner.length_m).sum::<f64>();
            let given_up = local.corners.iter().filter(|c| c.state == CornerState::GivenUp);
            left.ignored_m += given_up.map(|corner| corner.length_m).sum::<f64>();
        }
        left
    }

    fn in_view(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        out.clear();
        let Some(local) = self.local(standing.vertex) else { return };
        let corners = local.corners.iter().enumerate();
        let open = corners.filter(|(_, corner)| corner.state == CornerState::Open);
        out.extend(open.map(|(i, corner)| Self::candidate(standing, corner, i as u64)));
    }

    fn around(&mut self, standing: &Standing, out: &mut Vec<Candidate>) {
        out.clear();
        let Some(here) = self.local(standing.vertex) else { return };
        if self.members.first().map(|member| member.vertex) != Some(standing.vertex) {
            return;
        }
        for member in self.members.iter().skip(1) {
            let Some(local) = self.local(member.vertex) else { continue };
            for (i, corner) in local.corners.iter().enumerate() {
                let at = member.root_from_vertex.transform(&corner.at);
                let open = corner.state == CornerState::Open;
                if open && here.volume.is_unseen_towards(&at) {
                    let placed = Corner {
                        at,
                        normal: member.root_from_vertex.rotation * corner.normal,
                        spoke: true,
                        ..*corner
                    };
                    let tag = (u64::from(member.vertex.0) << 32) | i as u64;
                    out.push(Self::candidate(standing, &placed, tag));
                }
            }
        }
    }

    fn clearance(&mut self, standing: &Standing, to_in_body: &Point2) -> Clearance {
        match self.local(standing.vertex) {
            Some(local) => {
                local.volume.motion_clearance(&standing.vertex_from_body.transform(to_in_body))
            }
            None => Clearance::NONE,
        }
    }

    /// Back along the graph, breadth first, to the nearest vertex with an open corner (2.9.3).
    fn route(&mut self, standing: &Standing, _clearance_m: f64) -> Option<Route> {
        let start = standing.vertex;
        let mut parent: Vec<Option<(VertexId, f64)>> = vec![None; self.links.len()];
        let mut met = vec![false; self.links.len()];
        *met.get_mut(start.0 as usize)? = true;
        let mut queue = VecDeque::from([start]);
        while let Some(vertex) = queue.pop_front() {
            if self.frontier_at(vertex) > 0.0 {
                let mut legs = Vec::new();
                let mut at = vertex;
                while let Some((before, length_m)) = parent[at.0 as usize] {
                    legs.push((at, length_m));
                    at = before;
                }
                legs.reverse();
                return Some(Route::Repeat(legs));
            }
            for link in &self.links[vertex] {
                if !std::mem::replace(&mut met[link.to.0 as usize], true) {
                    parent[link.to.0 as usize] = Some((vertex, link.length_m));
                    queue.push_back(link.to);
                }
            }
        }
        None
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.local(vertex).map_or(0.0, |local| local.open().map(|corner| corner.length_m).sum())
    }

    fn detour(
        &self,
        standing: &Standing,
        goal_in_body: &Point2,
        clearance_m: f64,
    ) -> Option<Point2> {
        let goal = standing.vertex_from_body.transform(goal_in_body);
        let stop = self.local(standing.vertex)?.volume.detour(&goal, clearance_m)?;
        Some(standing.vertex_from_body.inverse_transform(&stop))
    }

    /// The thesis has only the "normal point" (2.9.3), which is the policy's.
    fn vantage(&mut self, _: &Standing, _: &Point2, _: f64) -> Option<Vantage> {
        None
    }

    fn give_up(
        &mut self,
        standing: &Standing,
        goal_in_body: &Point2,
        radius_m: f64,
        everywhere: bool,
        _probe: &mut dyn MapProbe,
    ) {
        let goal = standing.vertex_from_body.transform(goal_in_body);
        for member in &self.members {
            if member.vertex != standing.vertex && !everywhere {
                continue;
            }
            let Some(local) = self.locals[member.vertex].as_deref_mut() else { continue };
            for corner in &mut local.corners {
                let at = member.root_from_vertex.transform(&corner.at);
                if corner.state == CornerState::Open && (at - goal).norm() <= radius_m {
                    corner.state = CornerState::GivenUp;
                }
            }
        }
    }

    fn knows(&self, standing: &Standing, point_in_body: &Point2) -> bool {
        let root = self.members.first().map(|member| member.vertex);
        let point = standing.vertex_from_body.transform(point_in_body);
        root == Some(standing.vertex)
            && self.members.iter().any(|member| {
                let at = member.root_from_vertex.inverse_transform(&point);
                self.local(member.vertex).is_some_and(|local| local.volume.polygon.contains(&at))
            })
    }

    fn bytes(&self) -> usize {
        let locals: usize = self
            .locals
            .iter()
            .filter_map(Option::as_deref)
            .map(|local| {
                size_of::<Local>()
                    + local.samples.len() * size_of::<crate::volume::Sample>()
                    + local.volume.heap_bytes()
                    + local.corners.len() * size_of::<Corner>()
            })
            .sum();
        let links: usize = self.links.iter().map(|links| links.len() * size_of::<Link>()).sum();
        locals + links
    }
}
