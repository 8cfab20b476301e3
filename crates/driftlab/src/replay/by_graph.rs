//! The graph as the log has it: an exported run, fed to the maps as it was.

use maps2d::Standing;
use maps2d::correction::CorrectionParams;
use pose::Se2;
use pose::nalgebra::{Matrix3, Vector3};
use posegraph::{
    Edge, EdgeKind, Factor, FactorGraph2, Options, PoseGraph, Robust, optimize_robust,
};
use probe::{Off, VertexId};

use super::by_scans::NO_TIME;
use super::chain::Chain;
use super::course::{Course, Stop};
use super::planar::LoggedStep;
use super::session::{Progress, Watched};
use super::sides::{NewEdge, Sides, Told};
use super::{PlanarLog, ReplayError};
use crate::config::Config;

/// Drives through the log.
pub(super) fn by_graph(
    config: &Config,
    log: &PlanarLog,
    steps: &[LoggedStep],
    sides: &mut Sides,
    watched: &mut Watched<'_>,
) -> Result<Course, ReplayError> {
    let mut course = Course::default();
    let chain = Chain::of(log, steps);
    for (index, (scan, step)) in log.scans.iter().zip(steps).enumerate() {
        let time_secs = scan.stamp_secs - log.scans[0].stamp_secs;
        let distance_m = chain.distances_m[index];
        course.distance_m = distance_m;
        sides.begin(index as u64, distance_m, time_secs);
        watched.begin(index as u64, distance_m, time_secs);
        let mut found = |upto: u32, sides: &mut Sides| {
            while course.stops.len() <= upto as usize {
                let pose = chain.vertices[course.stops.len()];
                sides.vertex(pose);
                course.stops.push(Stop {
                    scan: index,
                    stamp_secs: scan.stamp_secs,
                    distance_m,
                    odom_from_sensor: pose,
                });
            }
        };
        step.decisions.iter().for_each(|decision| sides.decided(decision));
        for edges in step.edges.chunk_by(|one, other| one.b == other.b) {
            let new: Vec<NewEdge> = edges
                .iter()
                .map(|edge| NewEdge {
                    a: VertexId(edge.a),
                    b: VertexId(edge.b),
                    kind: if edge.place { EdgeKind::Place } else { EdgeKind::Odometry },
                    a_from_b: edge.a_from_b,
                })
                .collect();
            for edge in edges {
                found(edge.a, sides);
                found(edge.b, sides);
            }
            sides.edges(Told::Measured, &new);
        }
        found(step.standing.vertex, sides);
        let standing = Standing {
            vertex: VertexId(step.standing.vertex),
            vertex_from_body: step.standing.vertex_from_body,
        };
        let seen = config.sensor.within_range(&config.sensor.in_view(scan.scan.clone()));
        course.saw(&standing, &seen);
        course.standings.push(standing);
        sides.scanned(&standing, &seen);
        if index + 1 == log.scans.len() {
            log.last_decisions.iter().for_each(|decision| sides.decided(decision));
        }
        let on_map = sides.end();
        course.cost(NO_TIME, on_map);
        course.gated.push(0);
        let progress = Progress {
            recognizer: None,
            share: (index + 1) as f64 / log.scans.len() as f64,
            step: index as u64,
            distance_m,
            time_secs,
            standing,
        };
        watched.keyframe(&progress, &mut course, sides)?;
    }
    course.views.resize(course.stops.len(), maps2d::volume::Samples::new());
    settle(config, sides.graph(), chain.vertices, &mut course);
    watched.shown.settled(&course.optimised, sides.relative());
    course.bytes = sides.relative().map_or(0, maps2d::ExplorationMap::bytes) as u64;
    Ok(course)
}

/// Optimises the whole graph at the end, for the files and the metrics.
fn settle(config: &Config, graph: &PoseGraph, by_odometry: Vec<Se2>, course: &mut Course) {
    let noise = CorrectionParams {
        sigma_translation: config.odometry.sigma_translation,
        sigma_rotation_rad: config.odometry.sigma_rotation.to_radians(),
        ..CorrectionParams::default()
    };
    let count = by_odometry.len();
    let known = |edge: &&Edge| !edge.withdrawn && (edge.a.max(edge.b).0 as usize) < count;
    let edges: Vec<&Edge> = graph.edges().map(|(_, edge)| edge).filter(known).collect();
    let places = edges.iter().filter(|edge| edge.kind == EdgeKind::Place).count() as u64;
    course.factors = FactorGraph2 {
        ids: (0..count as u64).collect(),
        initial: by_odometry.iter().copied().map(Some).collect(),
        fixed: Vec::new(),
        factors: edges.into_iter().map(|edge| factor(edge, &noise)).collect(),
    };
    course.closures.proposed = places;
    course.closures.accepted = places;
    course.optimised = if course.factors.factors.is_empty() {
        by_odometry.clone()
    } else {
        let options = Options::default();
        let robust = Robust::GncTls;
        let solved = optimize_robust(&course.factors, &by_odometry, robust, &options, &mut Off);
        course.closures.rejected_by_graph = solved.rejected.len() as u64;
        solved.solution.poses
    };
    course.tracked = by_odometry;
}

fn factor(edge: &Edge, noise: &CorrectionParams) -> Factor<Se2, 3> {
    /// Noise is never taken for less than this, metres and radians: weights stay finite.
    const LEAST_SIGMA: f64 = 1e-4;
    let (metres, radians) = match edge.kind {
        EdgeKind::Odometry => {
            let root = edge.length_m.sqrt();
            (noise.sigma_translation * root, noise.sigma_rotation_rad * root)
        }
        EdgeKind::Place => (noise.place_sigma_m, noise.place_sigma_rotation_rad),
    };
    let weights = Vector3::new(metres, metres, radians).map(|sigma: f64| {
        let sigma = sigma.max(LEAST_SIGMA);
        (sigma * sigma).recip()
    });
    Factor {
        from: edge.a.0 as usize,
        to: edge.b.0 as usize,
        from_from_to: edge.a_from_b,
        information: Matrix3::from_diagonal(&weights),
    }
}
