//! A second map for tests: frontier as points, closed where another look's volume holds them.
//!
//! What the relative map does with faces, areas and exact predicates, by samples alone and slowly. An
//! exploration that ends well with both leans on neither's details.

use std::collections::BTreeMap;

use geometry::{Point3, Vector3};
use maps3d::{
    FlightClearance, FlightRoute, FrontierPatch, FrontierPoint, Hovering, Known, Look, Map3d,
    Map3dProbe, MapTally, Maps3dError,
};
use pose::Se3;
use posegraph::PoseGraph;
use probe::{EdgeId, VertexId};
use sensing::Camera;

const FAR_M: f64 = 8.0;
const SCOPE_M: f64 = 12.0;
const WALL_M: f64 = 0.3;
const SHRINK_M: f64 = 0.01;
const SLIVER_M2: f64 = 0.05;
const STEP_M: f64 = 0.25;

struct Volume {
    vertex: VertexId,
    vertex_from_camera: Se3,
    camera: Camera,
    columns: usize,
    rows: usize,
    depths_m: Vec<f64>,
    hit: Vec<bool>,
}

impl Volume {
    fn holds(&self, in_vertex: &Point3, beyond_m: f64) -> bool {
        let p = self.vertex_from_camera.inverse_transform(in_vertex);
        let Some([column, row]) = self.camera.pixel_of(&p) else { return false };
        let inside = column >= 0.3
            && row >= 0.3
            && column <= self.columns as f64 - 1.3
            && row <= self.rows as f64 - 1.3;
        if !inside {
            return false;
        }
        let at = row as usize * self.columns + column as usize;
        let quad = [at, at + 1, at + self.columns, at + self.columns + 1];
        let least = quad.iter().map(|&i| self.depths_m[i]).fold(f64::MAX, f64::min);
        let most = quad.iter().map(|&i| self.depths_m[i]).fold(0.0, f64::max);
        let wall = quad.iter().all(|&i| self.hit[i]) && most - least < 0.1_f64.max(0.05 * least);
        p.z <= if wall { least + beyond_m } else { least } - SHRINK_M
    }
}

struct Sample {
    vertex: VertexId,
    in_vertex: Point3,
    normal: Vector3,
    area_m2: f64,
    open: bool,
    given_up: bool,
}

/// The map.
#[derive(Default)]
pub struct PointsMap {
    graph: PoseGraph<Se3>,
    volumes: Vec<Volume>,
    samples: Vec<Sample>,
    /// Patches of each vertex, and slivers: rebuilt after each look.
    patches: BTreeMap<VertexId, Vec<FrontierPatch>>,
    sliver_m2: f64,
    largest_m2: f64,
    fresh: bool,
}

impl PointsMap {
    fn near(&self, root: VertexId) -> BTreeMap<VertexId, (f64, Se3, VertexId)> {
        let mut found: BTreeMap<VertexId, (f64, Se3, VertexId)> = BTreeMap::new();
        let mut open = vec![(0.0_f64, root, Se3::identity(), root)];
        while let Some(at) = (0..open.len()).min_by(|&a, &b| open[a].0.total_cmp(&open[b].0)) {
            let (distance_m, vertex, root_from, before) = open.swap_remove(at);
            if found.contains_key(&vertex) {
                continue;
            }
            found.insert(vertex, (distance_m, root_from, before));
            if vertex.0 as usize >= self.graph.vertex_count() {
                continue;
            }
            for (_, edge) in self.graph.edges_of(vertex) {
                let (next, from) = edge.from_end(vertex);
                if !found.contains_key(&next) {
                    open.push((distance_m + edge.length_m, next, root_from * from, vertex));
                }
            }
        }
        found
    }

    fn rebuild(&mut self) {
        self.patches.clear();
        (self.sliver_m2, self.largest_m2) = (0.0, 0.0);
        let mut by_cell: BTreeMap<(VertexId, [i64; 3]), Vec<usize>> = BTreeMap::new();
        for (i, s) in self.samples.iter().enumerate().filter(|(_, s)| s.open && !s.given_up) {
            let cell = [0, 1, 2].map(|k| (s.in_vertex[k] / 0.8).floor() as i64);
            by_cell.entry((s.vertex, cell)).or_default().push(i);
        }
        for ((vertex, _), members) in by_cell {
            let area_m2: f64 = members.iter().map(|&i| self.samples[i].area_m2).sum();
            if area_m2 < SLIVER_M2 {
                self.sliver_m2 += area_m2;
                self.largest_m2 = self.largest_m2.max(area_m2);
                continue;
            }
            let stride = members.len().div_ceil(4);
            let points: Vec<FrontierPoint> = members
                .iter()
                .step_by(stride)
                .map(|&i| FrontierPoint {
                    in_body: self.samples[i].in_vertex,
                    normal_in_body: self.samples[i].normal,
                    area_m2: area_m2 / members.len().div_ceil(stride) as f64,
                })
                .collect();
            let tag = members[0] as u64;
            self.patches.entry(vertex).or_default().push(FrontierPatch {
                owner: vertex,
                points,
                area_m2,
                tag,
            });
        }
        self.fresh = true;
    }

    fn update(&mut self) {
        if !self.fresh {
            self.rebuild();
        }
    }

    fn frontier_samples(volume: &Volume) -> Vec<(Point3, Vector3, f64)> {
        let mut out = Vec::new();
        let (columns, rows, camera) = (volume.columns, volume.rows, &volume.camera);
        let point = |c: f64, r: f64, z: f64| camera.point_in_camera(c, r, z);
        let depth = |c: usize, r: usize| volume.depths_m[r * columns + c];
        let mut put = |p: Point3, n: Vector3, a: f64| out.push((p, n, a));
        let stride = 5;
        let mut side = |c: usize, r: usize, n: Vector3, px_m: f64| {
            let mut z = 0.2;
            while z < depth(c, r) {
                put(point(c as f64, r as f64, z), n, px_m * z * stride as f64 * STEP_M);
                z += STEP_M;
            }
        };
        let end = |x: f64| x;
        for r in (0..rows).step_by(stride) {
            let [x0, _] = camera.slope_of(0.0, 0.0);
            let [x1, _] = camera.slope_of(end(columns as f64 - 1.0), 0.0);
            side(0, r, Vector3::new(-1.0, 0.0, x0).normalize(), 1.0 / camera.fy);
            side(columns - 1, r, Vector3::new(1.0, 0.0, -x1).normalize(), 1.0 / camera.fy);
        }
        for c in (0..columns).step_by(stride) {
            let [_, y0] = camera.slope_of(0.0, 0.0);
            let [_, y1] = camera.slope_of(0.0, rows as f64 - 1.0);
            side(c, 0, Vector3::new(0.0, -1.0, y0).normalize(), 1.0 / camera.fx);
            side(c, rows - 1, Vector3::new(0.0, 1.0, -y1).normalize(), 1.0 / camera.fx);
        }
        for r in (2..rows - 2).step_by(stride) {
            for c in (2..columns - 2).step_by(stride) {
                if !volume.hit[r * columns + c] {
                    let p = point(c as f64, r as f64, depth(c, r));
                    let a = (stride as f64 * depth(c, r) / camera.fx).powi(2);
                    put(p, p.coords.normalize(), a);
                }
            }
        }
        for r in 0..rows - 1 {
            for c in 0..columns - 1 {
                if (r + c) % 3 != 0 {
                    continue;
                }
                for (dc, dr) in [(1, 0), (0, 1)] {
                    let (a, b) = (depth(c, r), depth(c + dc, r + dr));
                    if (a - b).abs() <= 0.1_f64.max(0.05 * a.min(b)) {
                        continue;
                    }
                    let (c, r) = (c as f64 + 0.5 * dc as f64, r as f64 + 0.5 * dr as f64);
                    let towards = if a < b { -1.0 } else { 1.0 };
                    let ray = point(c, r, 1.0).coords.normalize();
                    let n = Vector3::new(dc as f64, dr as f64, 0.0) * towards;
                    let n = (n - ray * n.dot(&ray)).normalize();
                    let mut z = a.min(b) + 0.5 * STEP_M;
                    while z < a.max(b) {
                        put(point(c, r, z), n, 3.0 * z / camera.fx * STEP_M);
                        z += STEP_M;
                    }
                }
            }
        }
        out
    }
}

impl Map3d for PointsMap {
    fn kind(&self) -> &'static str {
        "points"
    }

    fn edges_added(&mut self, graph: &PoseGraph<Se3>, _: &[EdgeId], _: &mut dyn Map3dProbe) {
        self.graph = graph.clone();
    }

    fn edge_withdrawn(&mut self, graph: &PoseGraph<Se3>, _: EdgeId, _: &mut dyn Map3dProbe) {
        self.graph = graph.clone();
    }

    fn looked(&mut self, look: &Look<'_>, _: &mut dyn Map3dProbe) -> Result<(), Maps3dError> {
        let read = |d: f32| d.is_finite() && d > 0.0;
        let volume = Volume {
            vertex: look.vertex,
            vertex_from_camera: look.vertex_from_camera,
            camera: look.image.camera,
            columns: look.image.columns,
            rows: look.image.rows(),
            depths_m: look
                .image
                .depths_m
                .iter()
                .map(|&d| if read(d) { d.into() } else { FAR_M })
                .collect(),
            hit: look.image.depths_m.iter().map(|&d| read(d)).collect(),
        };
        let near = self.near(look.vertex);
        for sample in self.samples.iter_mut().filter(|s| s.open) {
            let Some((d, here_from, _)) = near.get(&sample.vertex) else { continue };
            if *d <= SCOPE_M && volume.holds(&here_from.transform(&sample.in_vertex), WALL_M) {
                sample.open = false;
            }
        }
        let here = look.vertex;
        for (p, n, area_m2) in Self::frontier_samples(&volume) {
            let in_vertex = look.vertex_from_camera.transform(&p);
            let normal = look.vertex_from_camera.rotation * n;
            let closed = self.volumes.iter().any(|other| {
                near.get(&other.vertex).is_some_and(|(d, here_from, _)| {
                    *d <= SCOPE_M && other.holds(&here_from.inverse_transform(&in_vertex), WALL_M)
                })
            });
            self.samples.push(Sample {
                vertex: here,
                in_vertex,
                normal,
                area_m2,
                open: !closed,
                given_up: false,
            });
        }
        self.volumes.push(volume);
        self.samples.retain(|s| s.open);
        self.fresh = false;
        Ok(())
    }

    fn tally(&self) -> MapTally {
        let patches = self.patches.values().flatten();
        MapTally {
            open_m2: patches.clone().map(|p| p.area_m2).sum(),
            patches: patches.count(),
            sliver_m2: self.sliver_m2,
            largest_sliver_m2: self.largest_m2,
            given_up_m2: self
                .samples
                .iter()
                .filter(|s| s.open && s.given_up)
                .map(|s| s.area_m2)
                .sum(),
            volumes: self.volumes.len(),
            ..MapTally::default()
        }
    }

    fn frontiers(&mut self, hovering: &Hovering, out: &mut Vec<FrontierPatch>) {
        self.update();
        out.clear();
        out.extend(self.patches.get(&hovering.vertex).into_iter().flatten().cloned());
    }

    fn is_by_vertex(&self) -> bool {
        true
    }

    fn frontier_at(&self, vertex: VertexId) -> f64 {
        self.patches.get(&vertex).into_iter().flatten().map(|p| p.area_m2).sum()
    }

    fn route(
        &mut self,
        hovering: &Hovering,
        _: f64,
        comes_now: &dyn Fn(VertexId) -> bool,
    ) -> Option<FlightRoute> {
        self.update();
        let near = self.near(hovering.vertex);
        let mut best: Option<(f64, VertexId)> = None;
        for &vertex in self.patches.keys().filter(|v| comes_now(**v)) {
            if let Some((d, _, _)) = near.get(&vertex)
                && best.is_none_or(|(b, _)| *d < b)
            {
                best = Some((*d, vertex));
            }
        }
        let (_, mut at) = best?;
        let mut legs = Vec::new();
        while at != hovering.vertex {
            let (d, _, before) = near[&at];
            legs.push((at, d - near[&before].0));
            at = before;
        }
        legs.reverse();
        Some(FlightRoute::Repeat(legs))
    }

    fn clearance(&mut self, hovering: &Hovering, to: &Point3, leaving_m: f64) -> FlightClearance {
        let from = Point3::from(hovering.vertex_from_body.translation);
        let to = hovering.vertex_from_body.transform(to);
        let way = to - from;
        let length = way.norm();
        let (mut start, mut least, mut end) = (f64::MAX, f64::MAX, f64::MAX);
        let mine: Vec<&Volume> =
            self.volumes.iter().filter(|v| v.vertex == hovering.vertex).collect();
        for v in &mine {
            for i in (0..v.depths_m.len()).filter(|&i| v.hit[i]) {
                let (c, r) = (i % v.columns, i / v.columns);
                let p = v.vertex_from_camera.transform(&v.camera.point_in_camera(
                    c as f64,
                    r as f64,
                    v.depths_m[i],
                ));
                let s = ((p - from).dot(&way) / (length * length)).clamp(0.0, 1.0);
                least = least.min((p - (from + way * s)).norm());
                start = start.min((p - from).norm());
                end = end.min((p - to).norm());
            }
        }
        let reach = 0.2;
        let steps = (length / 0.1).ceil() as usize;
        let ok = (1..=steps).all(|i| {
            let along = length * i as f64 / steps as f64;
            let at = from + way * (along / length);
            along < leaving_m
                || (0..26).all(|k| {
                    let k = if k >= 13 { k + 1 } else { k };
                    let d = Vector3::new(
                        (k % 3) as f64 - 1.0,
                        (k / 3 % 3) as f64 - 1.0,
                        (k / 9) as f64 - 1.0,
                    );
                    let q = at + d.normalize() * reach;
                    mine.iter().any(|v| v.holds(&q, 0.0))
                })
        });
        let unseen = if ok { reach + 0.01 } else { 0.0 };
        FlightClearance {
            solid_at_start_m: start,
            solid_m: least,
            solid_at_end_m: end,
            unseen_m: unseen,
            unseen_at_end_m: unseen,
        }
    }

    fn give_up(
        &mut self,
        hovering: &Hovering,
        places: &[Point3],
        radius_m: f64,
        _: bool,
        _: &mut dyn Map3dProbe,
    ) {
        for place in places.iter().map(|place| hovering.vertex_from_body.transform(place)) {
            for s in self.samples.iter_mut().filter(|s| s.vertex == hovering.vertex) {
                s.given_up |= (s.in_vertex - place).norm() < radius_m;
            }
        }
        self.fresh = false;
    }

    fn knows(&self, _: &Hovering, _: &Point3) -> Known {
        Known::Unknown
    }

    fn bytes(&self) -> usize {
        self.volumes.iter().map(|v| v.depths_m.len() * 8).sum()
    }
}
