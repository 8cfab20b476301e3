//! Global poses of all vertices, kept up to date.

use pose::Se2;
use pose::nalgebra::{Matrix3, Vector3};
use posegraph::{Edge, EdgeKind, Factor, FactorGraph2, Options, PoseGraph, optimize};
use probe::{EdgeId, IdVec, Probe, VertexId};

use super::CorrectionEvent;

/// Noise is never taken for less than this, metres and radians: weights stay finite.
const LEAST_SIGMA: f64 = 1e-4;

/// What the optimiser is told of the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectionParams {
    /// Standard deviation of the odometry along each axis, metres per square root of a metre.
    pub sigma_translation: f64,
    /// Standard deviation of the odometry's heading, radians per square root of a metre.
    pub sigma_rotation_rad: f64,
    /// Standard deviation of a place edge along each axis, metres.
    pub place_sigma_m: f64,
    /// Standard deviation of a place edge's heading, radians.
    pub place_sigma_rotation_rad: f64,
    /// How the optimiser works.
    pub optimizer: Options,
}

impl Default for CorrectionParams {
    fn default() -> Self {
        Self {
            sigma_translation: 0.1,
            sigma_rotation_rad: 5.0_f64.to_radians(),
            place_sigma_m: 0.01,
            place_sigma_rotation_rad: 0.1_f64.to_radians(),
            optimizer: Options::default(),
        }
    }
}

impl CorrectionParams {
    /// The edge as an optimiser takes it, between vertices by their numbers.
    pub fn factor(&self, edge: &Edge) -> Factor<Se2, 3> {
        let (metres, radians) = match edge.kind {
            EdgeKind::Odometry => {
                let root = edge.length_m.sqrt();
                (self.sigma_translation * root, self.sigma_rotation_rad * root)
            }
            EdgeKind::Place => (self.place_sigma_m, self.place_sigma_rotation_rad),
        };
        let weight = |sigma: f64| sigma.max(LEAST_SIGMA).powi(-2);
        let weights = Vector3::new(weight(metres), weight(metres), weight(radians));
        Factor {
            from: edge.a.0 as usize,
            to: edge.b.0 as usize,
            from_from_to: edge.a_from_b,
            information: Matrix3::from_diagonal(&weights),
        }
    }
}

/// A vertex that moves by less, metres and radians, stays where it is for whatever hangs on it.
const STILL: f64 = 1e-9;

fn is_elsewhere(before: &Se2, after: &Se2) -> bool {
    let motion = before.inverse_mul(after);
    motion.translation.norm() > STILL || motion.angle().abs() > STILL
}

/// Poses of all vertices in one frame: odometry from the last correction on.
#[derive(Clone, Debug, Default)]
pub struct Correction {
    params: CorrectionParams,
    map_from_vertex: IdVec<VertexId, Se2>,
    corrections: u64,
    moved: bool,
}

impl Correction {
    /// No vertex yet.
    pub fn new(params: CorrectionParams) -> Self {
        Self { params, map_from_vertex: IdVec::new(), corrections: 0, moved: false }
    }

    /// `map_from_vertex` of every vertex, by vertex.
    pub fn poses(&self) -> &[Se2] {
        self.map_from_vertex.as_slice()
    }

    /// `map_from_vertex`, or the identity for a vertex that is not known.
    pub fn pose(&self, vertex: VertexId) -> Se2 {
        self.map_from_vertex.get(vertex).copied().unwrap_or_default()
    }

    /// How often poses were corrected.
    pub fn count(&self) -> u64 {
        self.corrections
    }

    /// Whether the last correction, or the poses that were set last, moved any vertex by more than
    /// nothing: without drift they do not.
    pub fn has_moved(&self) -> bool {
        self.moved
    }

    /// Makes room for a vertex; one without edges lies at the origin.
    pub fn cover(&mut self, vertex: VertexId) {
        while self.map_from_vertex.next_id() <= vertex {
            self.map_from_vertex.push(Se2::identity());
        }
    }

    /// Takes poses as they are.
    pub fn set(&mut self, map_from_vertex: &[Se2]) {
        self.moved = false;
        for (i, pose) in map_from_vertex.iter().enumerate() {
            let vertex = VertexId(i as u32);
            self.cover(vertex);
            self.moved |= is_elsewhere(&self.map_from_vertex[vertex], pose);
            self.map_from_vertex[vertex] = *pose;
        }
    }

    /// Takes new edges; says whether poses were corrected, which a place edge among them causes.
    ///
    /// Cost: one optimisation of the whole graph where there is a place edge, else the new edges.
    pub fn edges_added(
        &mut self,
        graph: &PoseGraph,
        edges: &[EdgeId],
        probe: &mut (impl for<'a> Probe<CorrectionEvent<'a>> + ?Sized),
    ) -> bool {
        let mut places = 0;
        for &edge in edges {
            let edge = graph.edge(edge);
            self.cover(edge.a.max(edge.b));
            match edge.kind {
                EdgeKind::Odometry => {
                    self.map_from_vertex[edge.b] = self.map_from_vertex[edge.a] * edge.a_from_b;
                }
                EdgeKind::Place => places += 1,
            }
        }
        places > 0 && self.optimise(graph, places, probe)
    }

    /// Optimises the whole graph as it stands; says whether poses were taken.
    pub fn optimise(
        &mut self,
        graph: &PoseGraph,
        new_places: usize,
        probe: &mut (impl for<'a> Probe<CorrectionEvent<'a>> + ?Sized),
    ) -> bool {
        let count = self.map_from_vertex.len();
        let known = |edge: &&Edge| !edge.withdrawn && (edge.a.max(edge.b).0 as usize) < count;
        let factors: Vec<_> = graph
            .edges()
            .map(|(_, edge)| edge)
            .filter(known)
            .map(|edge| self.params.factor(edge))
            .collect();
        let factors_len = factors.len();
        let problem = FactorGraph2 {
            ids: (0..count as u64).collect(),
            initial: vec![None; count],
            fixed: if count > 0 { vec![0] } else { Vec::new() },
            factors,
        };
        let before = self.map_from_vertex.as_slice();
        let solution = optimize(&problem, before, &self.params.optimizer);
        let usable = solution.poses.len() == count
            && solution
                .poses
                .iter()
                .all(|pose| pose.distance().is_finite() && pose.angle().is_finite());
        if !usable {
            probe.emit(CorrectionEvent::Refused { report: &solution.report });
            return false;
        }
        let moved_max_m = before
            .iter()
            .zip(&solution.poses)
            .map(|(a, b)| (a.translation - b.translation).norm())
            .fold(0.0, f64::max);
        self.corrections += 1;
        self.moved = before.iter().zip(&solution.poses).any(|(a, b)| is_elsewhere(a, b));
        probe.emit(CorrectionEvent::Corrected {
            new_places,
            factors: factors_len,
            before,
            after: &solution.poses,
            moved_max_m,
            report: &solution.report,
        });
        self.map_from_vertex = solution.poses.into_iter().collect();
        true
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        self.map_from_vertex.len() * size_of::<Se2>()
    }
}
