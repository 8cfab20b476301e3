//! Along which ways volumes are held against each other, and how sure of them the map has to be.

use geometry::Point2;
use maps2d::relative::{Certainty, RelativeMap, RelativeParams, ReopenCause};
use maps2d::{ExplorationMap, Standing};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, Off, VertexId};
use proptest::prelude::*;
use sensing::Scan;

use super::config;
use super::consolidation::{check_partition, check_reasons};
use super::drive::{Drive, Mix, params, stories};
use super::oracle::{SAMPLES, cause_at};
use super::told::Told;

const SEEDS: &str = "proptest-regressions/trust.txt";
const PLAIN: Mix = Mix { turns: 0, links: 1, withdrawals: 0 };
const ALL: Mix = Mix { turns: 2, links: 1, withdrawals: 1 };

const PAPER: Certainty =
    Certainty { sigmas: 0.0, sigma_translation: 0.1, sigma_rotation_rad: 5.0 * PI_180 };
const PI_180: f64 = std::f64::consts::PI / 180.0;

/// A graph and a map of views into the open: 115 degrees wide, 5 m far, nothing in them.
struct Open {
    graph: PoseGraph,
    map: RelativeMap,
}

impl Open {
    fn new(certainty: Certainty, last_look_sigmas: f64) -> Self {
        let params = RelativeParams {
            certainty,
            last_look_sigmas,
            wall_closing_m: 0.0,
            ..RelativeParams::default()
        };
        Self { graph: PoseGraph::new(), map: RelativeMap::new(params) }
    }

    /// A vertex with edges from others, all told at once.
    fn found(&mut self, from: &[(VertexId, Se2, EdgeKind)]) -> (VertexId, Vec<EdgeId>) {
        let vertex = self.graph.add_vertex();
        let edges: Vec<EdgeId> = from
            .iter()
            .map(|&(other, other_from_here, kind)| {
                self.graph.add_edge(other, vertex, other_from_here, kind).unwrap()
            })
            .collect();
        self.map.edges_added(&self.graph, &edges, &mut Off);
        (vertex, edges)
    }

    fn look(&mut self, vertex: VertexId) {
        let fov_rad = 115.0 * PI_180;
        let scan = Scan::new(-0.5 * fov_rad, fov_rad / 15.0, vec![f64::INFINITY; 16], 5.0);
        let standing = Standing { vertex, vertex_from_body: Se2::identity() };
        self.map.scanned(&standing, &scan, &mut Off);
    }

    /// Share of the frontier straight ahead of a view that another closed.
    fn closed_ahead(&self, vertex: VertexId) -> f64 {
        let state = self.map.volume(vertex).unwrap();
        let ahead = |p: &Point2| p.x > 4.0;
        let edges = state.volume.frontier.iter().zip(&state.ledgers);
        let shares: Vec<f64> = edges
            .filter(|(edge, _)| ahead(&edge.from) && ahead(&edge.to))
            .map(|(_, ledger)| ledger.closed_share())
            .collect();
        assert!(shares.len() > 4);
        shares.iter().sum::<f64>() / shares.len() as f64
    }
}

/// From a view by a long way round to one a quarter of a metre ahead of it: what the first has open
/// ahead lies in the second, by less than the odometry in between may be off.
fn round_to_just_ahead(kind: EdgeKind, last_look_sigmas: f64) -> (Open, VertexId) {
    let mut open = Open::new(PAPER, last_look_sigmas);
    let (first, _) = open.found(&[]);
    open.look(first);
    let (aside, _) = open.found(&[(first, Se2::new(0.0, 4.0, 0.0), kind)]);
    let (ahead, _) = open.found(&[(aside, Se2::new(0.25, -4.0, 0.0), kind)]);
    open.look(ahead);
    (open, first)
}

#[test]
fn the_last_look_opens_what_was_closed_over_a_long_way() {
    let (mut open, first) = round_to_just_ahead(EdgeKind::Odometry, 1.0);
    assert_eq!(open.closed_ahead(first), 1.0);
    let mut told: Vec<Told> = Vec::new();
    assert!(open.map.look_again(&mut told));
    assert_eq!(open.closed_ahead(first), 0.0);
    assert!(format!("{told:?}").contains(&format!("{:?}", ReopenCause::LastLook)));
}

#[test]
fn the_last_look_trusts_recognised_places() {
    let (mut open, first) = round_to_just_ahead(EdgeKind::Place, 1.0);
    open.map.look_again(&mut Off);
    assert_eq!(open.closed_ahead(first), 1.0);
}

#[test]
fn without_a_last_look_or_noise_nothing_opens() {
    let (mut open, first) = round_to_just_ahead(EdgeKind::Odometry, 0.0);
    assert!(!open.map.look_again(&mut Off));
    assert_eq!(open.closed_ahead(first), 1.0);
    let mut open = Open::new(Certainty::default(), 1.0);
    assert!(!open.map.look_again(&mut Off));
}

/// Who recognises two neighbours from afar does not place them better than they lie by their own step.
#[test]
fn pairs_are_compared_along_their_own_shortest_way_only() {
    let (odometry, place) = (EdgeKind::Odometry, EdgeKind::Place);
    let mut open = Open::new(Certainty::default(), 0.0);
    let (a, _) = open.found(&[]);
    open.look(a);
    let (b, _) = open.found(&[(a, Se2::new(1.0, 0.0, 0.0), odometry)]);
    open.look(b);
    assert_eq!(open.closed_ahead(b), 0.0);
    // By way of the new vertex `a` would lie 2 m ahead of `b`, and close what that has open.
    open.found(&[(b, Se2::new(0.0, 3.0, 0.0), odometry), (a, Se2::new(-2.0, 3.0, 0.0), place)]);
    assert_eq!(open.closed_ahead(b), 0.0);
}

/// The same where it is the shortest: then the better known way counts.
#[test]
fn a_shorter_way_between_a_pair_is_taken() {
    let (odometry, place) = (EdgeKind::Odometry, EdgeKind::Place);
    let mut open = Open::new(Certainty::default(), 0.0);
    let (a, _) = open.found(&[]);
    open.look(a);
    let (aside, _) = open.found(&[(a, Se2::new(0.0, 4.5, 0.0), odometry)]);
    let (b, _) = open.found(&[(aside, Se2::new(1.0, -4.5, 0.0), odometry)]);
    open.look(b);
    assert_eq!(open.closed_ahead(b), 0.0);
    open.found(&[(b, Se2::new(0.0, 2.0, 0.0), odometry), (a, Se2::new(-1.0, 2.0, 0.0), place)]);
    assert!(open.closed_ahead(b) > 0.5);
}

/// Whether each sample point of every frontier edge is closed.
fn closed(map: &RelativeMap) -> Vec<bool> {
    let edges = map
        .volumes()
        .flat_map(|(vertex, state)| (0..state.ledgers.len()).map(move |edge| (vertex, edge)));
    edges.flat_map(|(v, e)| SAMPLES.map(|t| cause_at(map, v, e, t).is_some())).collect()
}

/// Whether each sample point of every frontier edge is open, in a chain shorter than that.
fn in_scraps(map: &RelativeMap, least_m: f64) -> Vec<bool> {
    let mut points = Vec::new();
    for (_, state) in map.volumes() {
        for edge in 0..state.ledgers.len() {
            points.extend(SAMPLES.map(|t| {
                let scraps = state.chains.iter().filter(|c| c.length_m < least_m - 1e-9);
                let mut parts = scraps.flat_map(|chain| &chain.parts);
                parts.any(|part| part.edge == edge && part.span.from < t && t < part.span.to)
            }));
        }
    }
    points
}

proptest! {
    #![proptest_config(config(48, SEEDS))]

    /// What is closed after the last look was closed before it: what counts can only get more.
    #[test]
    fn the_last_look_only_opens(
        story in stories(PLAIN, 1..14),
        params in params(),
        sigmas in 0.1..3.0_f64,
    ) {
        let params = RelativeParams {
            certainty: PAPER, last_look_sigmas: sigmas, retire: false, ..params
        };
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        for op in &story.ops {
            drive.act(op, &mut [&mut map]);
        }
        let (before, left) = (closed(&map), map.frontier());
        let more = map.look_again(&mut Off);
        // Nothing opened in scraps: what is open in them was so before.
        for (in_scrap, was_closed) in in_scraps(&map, 3.0 * params.sliver_m).iter().zip(&before) {
            prop_assert!(!(in_scrap & was_closed));
        }
        for (was, is) in before.iter().zip(closed(&map)) {
            prop_assert!(*was || !is);
        }
        prop_assert!(map.frontier().open_m >= left.open_m - 1e-9);
        prop_assert_eq!(more, map.frontier().places > 0);
    }

    /// It leaves a map whose closings all hold, retired volumes or not; and there is but one.
    #[test]
    fn after_the_last_look_every_reason_holds(
        story in stories(ALL, 1..14),
        params in params(),
        sigmas in 0.1..3.0_f64,
    ) {
        let params = RelativeParams { certainty: PAPER, last_look_sigmas: sigmas, ..params };
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut map = RelativeMap::new(params);
        let half = story.ops.len() / 2;
        for (i, op) in story.ops.iter().enumerate() {
            if i == half {
                map.look_again(&mut Off);
                check_partition(&map)?;
                check_reasons(&drive, &map)?;
            }
            drive.act(op, &mut [&mut map]);
        }
        check_partition(&map)?;
        check_reasons(&drive, &map)?;
        prop_assert!(!map.look_again(&mut Off));
    }
}
