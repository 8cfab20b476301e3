//! What the maps of one robot were fed.

use std::sync::{Arc, Mutex, PoisonError};

use formats::log::Decision;
use geometry::Point2;
use maps2d::{ExplorationMap, MapProbe, Standing};
use posegraph::{Edge, PoseGraph};
use probe::{EdgeId, VertexId};
use sensing::Scan;

/// One thing that every map of a robot is fed.
#[derive(Clone, Debug)]
pub enum Fed {
    /// Edges of the pose graph that came at once, with the newest vertex of the graph; the first vertex
    /// comes without.
    Edges {
        /// The newest vertex of the graph.
        vertex: VertexId,
        /// The edges.
        edges: Vec<Edge>,
    },
    /// A scan.
    Scan {
        /// Where it was taken, as the robot believes; its sensor is the body.
        standing: Standing,
        /// The scan.
        scan: Scan,
    },
    /// What the policy told the map that steers, and no other.
    Decided {
        /// The map, by its kind.
        map: String,
        /// What it was told.
        decision: Decision,
    },
}

/// Where something was given up, as a log has it.
pub fn gave_up(
    standing: &Standing,
    goal_in_body: &Point2,
    radius_m: f64,
    everywhere: bool,
) -> Decision {
    Decision::GaveUp {
        vertex: standing.vertex.0,
        vertex_from_body: standing.vertex_from_body,
        goal_in_body: [goal_in_body.x, goal_in_body.y],
        radius_m,
        everywhere,
    }
}

/// Tells a map what a policy told the map of a run; does nothing where it was told to a map of another kind.
pub fn tell(
    map: &mut dyn ExplorationMap,
    kind: &str,
    decision: &Decision,
    probe: &mut dyn MapProbe,
) {
    if map.kind() != kind {
        return;
    }
    match *decision {
        Decision::GaveUp {
            vertex,
            vertex_from_body,
            goal_in_body: [x, y],
            radius_m,
            everywhere,
        } => {
            let standing = Standing { vertex: VertexId(vertex), vertex_from_body };
            map.give_up(&standing, &Point2::new(x, y), radius_m, everywhere, probe);
        }
        Decision::LookedAgain => _ = map.look_again(probe),
    }
}

/// Collects what is fed, where somebody wants it; shared with the map that is fed first.
#[derive(Clone, Debug, Default)]
pub struct Feed(Option<Arc<Mutex<Vec<Fed>>>>);

impl Feed {
    /// A feed that collects, or one that does not and costs nothing.
    pub fn new(wanted: bool) -> Self {
        Self(wanted.then(Arc::default))
    }

    /// Notes edges.
    pub fn edges(&self, graph: &PoseGraph, edges: &[EdgeId]) {
        self.push(|| Fed::Edges {
            vertex: VertexId(graph.vertex_count().saturating_sub(1) as u32),
            edges: edges.iter().map(|&edge| *graph.edge(edge)).collect(),
        });
    }

    /// Notes a scan.
    pub fn scan(&self, standing: &Standing, scan: &Scan) {
        self.push(|| Fed::Scan { standing: *standing, scan: scan.clone() });
    }

    /// Notes what a policy told a map.
    pub fn decided(&self, map: &str, decision: Decision) {
        self.push(|| Fed::Decided { map: map.to_owned(), decision });
    }

    /// Whether anybody wants what is fed.
    pub fn is_on(&self) -> bool {
        self.0.is_some()
    }

    /// What was noted since this was asked last, in order.
    pub fn take(&self) -> Vec<Fed> {
        let Some(all) = &self.0 else { return Vec::new() };
        std::mem::take(&mut *all.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn push(&self, fed: impl FnOnce() -> Fed) {
        if let Some(all) = &self.0 {
            all.lock().unwrap_or_else(PoisonError::into_inner).push(fed());
        }
    }
}
