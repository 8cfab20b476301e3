//! Maps of a log, fed side by side.

use maps2d::active::{ActiveArea, ActiveAreaParams};
use maps2d::correction::CorrectionParams;
use maps2d::extended::{ExtendedMap, ExtendedParams};
use maps2d::grid::{CorrectedGrid, GridMap, GridParams};
use maps2d::polygons::{CorrectedPolygons, CorrectedPolygonsParams};
use maps2d::relative::{RelativeMap, RelativeParams};
use maps2d::{ExplorationMap, Standing};
use places::{Added, Driven, Recognizer};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, Off, VertexId};
use sensing::Scan;

use crate::clock::{Cost, tell};

/// Returns from farther away are free up to there for maps, metres.
const RANGE_M: f64 = 8.0;

/// Keyframes between corrections of the maps that live by optimised poses.
const SETTLE_EVERY: usize = 50;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Told {
    Measured,
    Wheels,
    Settled,
}

struct Side {
    map: Box<dyn ExplorationMap>,
    told: Told,
    costs: Vec<Cost>,
    settling: Vec<Cost>,
}

/// The maps, and the graphs that they stand on.
pub struct Fed {
    sides: Vec<Side>,
    measured: PoseGraph,
    wheels: PoseGraph,
    steps: PoseGraph,
    settled_at: usize,
    settled_closures: usize,
}

fn map_of(name: &str) -> Option<(Box<dyn ExplorationMap>, Told)> {
    let grid = GridParams { cell_m: 0.2, ..GridParams::default() };
    let relative = RelativeParams { consolidation_radius_m: 8.0, ..RelativeParams::default() };
    Some(match name {
        "relative" => (Box::new(RelativeMap::new(relative)), Told::Measured),
        "grid" => (Box::new(GridMap::new(grid)), Told::Wheels),
        "grid_corrected" => {
            (Box::new(CorrectedGrid::new(grid, CorrectionParams::default())), Told::Settled)
        }
        "corrected_polygons" => {
            let params = CorrectedPolygonsParams::default();
            (Box::new(CorrectedPolygons::new(params)), Told::Settled)
        }
        "active_area" => (Box::new(ActiveArea::new(ActiveAreaParams::default())), Told::Measured),
        "extended" => (Box::new(ExtendedMap::new(ExtendedParams::default())), Told::Measured),
        _ => return None,
    })
}

impl Fed {
    pub fn new(names: &str) -> Result<Self, String> {
        let mut sides = Vec::new();
        for name in names.split(',').filter(|name| !name.is_empty()) {
            let (map, told) = map_of(name).ok_or_else(|| format!("no map is named {name}"))?;
            sides.push(Side { map, told, costs: Vec::new(), settling: Vec::new() });
        }
        Ok(Self {
            sides,
            measured: PoseGraph::new(),
            wheels: PoseGraph::new(),
            steps: PoseGraph::new(),
            settled_at: 0,
            settled_closures: 0,
        })
    }

    /// A keyframe: its edges, its scan. What the first map cost.
    pub fn keyframe(
        &mut self,
        scan: &Scan,
        driven: &Driven,
        added: &Added,
        recognizer: &Recognizer,
    ) -> Cost {
        let vertex = self.measured.add_vertex();
        self.wheels.add_vertex();
        self.steps.add_vertex();
        let mut spent = vec![Cost::default(); self.sides.len()];
        let mut own = Vec::new();
        if let Some(step) = &added.step {
            let ends = (VertexId(step.from as u32), VertexId(step.to as u32));
            let odometry = EdgeKind::Odometry;
            self.edges(Told::Wheels, &[(ends, odometry, driven.last_from_new)], &mut spent);
            self.edges(Told::Settled, &[(ends, odometry, step.from_from_to)], &mut spent);
            own.push((ends, odometry, step.from_from_to));
        }
        let mut places: Vec<_> = added
            .closures
            .iter()
            .map(|closure| {
                let measured = closure.measured;
                let ends = (VertexId(measured.from as u32), VertexId(measured.to as u32));
                (ends, EdgeKind::Place, measured.from_from_to)
            })
            .collect();
        places.sort_by_key(|place| place.0.1);
        own.extend(places.iter().filter(|place| place.0.1 == vertex));
        self.edges(Told::Measured, &own, &mut spent);
        places.retain(|place| place.0.1 != vertex);
        for waited in places.chunk_by(|one, other| one.0.1 == other.0.1) {
            self.edges(Told::Measured, waited, &mut spent);
        }
        let standing = Standing { vertex, vertex_from_body: Se2::identity() };
        let scan = Scan { range_max_m: scan.range_max_m.min(RANGE_M), ..scan.clone() };
        for (side, spent) in self.sides.iter_mut().zip(&mut spent) {
            let ((), cost) = Cost::of(|| side.map.scanned(&standing, &scan, &mut Off));
            *spent = *spent + cost;
        }
        for (side, spent) in self.sides.iter_mut().zip(&spent) {
            side.costs.push(*spent);
        }
        self.settle(recognizer);
        spent.first().copied().unwrap_or_default()
    }

    fn edges(
        &mut self,
        told: Told,
        edges: &[((VertexId, VertexId), EdgeKind, Se2)],
        spent: &mut [Cost],
    ) {
        let graph = match told {
            Told::Measured => &mut self.measured,
            Told::Wheels => &mut self.wheels,
            Told::Settled => &mut self.steps,
        };
        let added = edges.iter().map(|((a, b), kind, step)| graph.add_edge(*a, *b, *step, *kind));
        let ids: Vec<EdgeId> = added.filter_map(Result::ok).collect();
        for (side, spent) in self.sides.iter_mut().zip(spent) {
            if side.told == told {
                let ((), cost) = Cost::of(|| side.map.edges_added(graph, &ids, &mut Off));
                *spent = *spent + cost;
            }
        }
    }

    fn settle(&mut self, recognizer: &Recognizer) {
        let keyframes = recognizer.keyframes().len();
        let closures = recognizer.closures().len();
        let lives_by_poses = self.sides.iter().any(|side| side.told == Told::Settled);
        let due = keyframes - self.settled_at >= SETTLE_EVERY && closures > self.settled_closures;
        if !(due && lives_by_poses) {
            return;
        }
        let poses = recognizer.settled().map_from_keyframe;
        for side in self.sides.iter_mut().filter(|side| side.told == Told::Settled) {
            let ((), cost) = Cost::of(|| side.map.poses_reestimated(&poses, &mut Off));
            side.settling.push(cost);
        }
        (self.settled_at, self.settled_closures) = (keyframes, closures);
    }

    /// Prints what every map cost.
    pub fn tell(&self) {
        for side in &self.sides {
            let name = side.map.kind();
            tell(name, &side.costs);
            let sum = |costs: &[Cost]| costs.iter().map(|cost| cost.cpu_ms).sum::<f64>() * 1e-3;
            let frontier = side.map.frontier();
            println!(
                "{name}: {:.2} s of keyframes, {} corrections in {:.2} s; frontier left {:.1} m, {} MiB",
                sum(&side.costs),
                side.settling.len(),
                sum(&side.settling),
                frontier.open_m,
                side.map.bytes() >> 20,
            );
        }
    }
}
