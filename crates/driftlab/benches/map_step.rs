//! What a step costs: the relative map beside the plain grid, without and with a recording.
//!
//! Runs are deterministic, so a run can be repeated and the least time taken step by step: what is
//! left is the work, without what else the machine did at that moment. Long drives and recordings
//! are measured once; there the medians count.
//!
//! Measured in one run on two cores with nothing else to do:
//!
//! | microseconds | relative | grid |
//! |---|---|---|
//! | exploring the maze at alpha 1, 10 seeds: median, p99, max (the last look) | 36, 468, 1496 | 18, 60, 85 |
//! | ever new ground: median of the second and the last tenth | 18, 18 (1.00) | 15, 15 (1.01) |
//! | round and round: median of tenths 1, 2, 3, 6, 9, 10 | 70, 112, 79, 83, 89, 88 | 16 to 18 |
//! | round and round: greatest p99 of a tenth | 389 | 29 |
//! | recording `off`, added per step: median, p99 | 0.0, 0.4 | 0.0, 0.3 |
//! | recording `summary` | 17, 77 | 4, 30 |
//! | recording `full` | 40, 239 | 5, 24 |
//!
//! Round and round, 372 of 20,000 volumes take part in comparisons in the last tenth.
//!
//! `-- --quick` measures less; `-- --poses N` sets the length of the long drives.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use driftlab::config::{Loaded, Overrides};
use driftlab::run::{Experiment, MapTiming, drive, quantile, start_recording};
use explore::{ExploreParams, Explorer};
use geometry::Point2;
use maps2d::grid::{GridMap, GridParams};
use maps2d::relative::{RelativeMap, RelativeParams};
use maps2d::{ExplorationMap, Standing};
use pose::Se2;
use posegraph::{EdgeKind, PoseGraph};
use probe::{Off, VertexId};
use sensing::{Odometry, PlaceMatch, Repeated, Robot, Scan};
use worlds::{RobotParams, SimRobot, World2d, paper};

const KINDS: [&str; 2] = ["relative", "grid"];

/// How much is measured.
struct Effort {
    seeds: u64,
    repeats: usize,
    poses: usize,
}

/// Said where nothing else can be: a benchmark's report is what it prints.
#[expect(clippy::print_stdout, reason = "the report of a benchmark")]
fn say(line: &str) {
    println!("{line}");
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let quick = arguments.iter().any(|argument| argument == "--quick" || argument == "--test");
    let mut effort = match quick {
        true => Effort { seeds: 1, repeats: 1, poses: 1_000 },
        false => Effort { seeds: 10, repeats: 5, poses: 20_000 },
    };
    if let Some(at) = arguments.iter().position(|argument| argument == "--poses") {
        let poses = arguments.get(at + 1).and_then(|poses| poses.parse().ok());
        effort.poses = poses.expect("--poses takes a number");
    }
    exploring(&effort);
    recording(&effort);
    new_ground(&effort);
    round_and_round(&effort);
}

fn map_of(kind: &str) -> Box<dyn ExplorationMap + Send> {
    match kind {
        "grid" => Box::new(GridMap::new(GridParams::default())),
        _ => Box::new(RelativeMap::new(RelativeParams::default())),
    }
}

fn micros(time: Duration) -> f64 {
    time.as_secs_f64() * 1e6
}

/// Median, 99th percentile and greatest.
fn spread(times_us: &[f64]) -> [f64; 3] {
    [0.5, 0.99, 1.0].map(|share| quantile(times_us, share))
}

// ------------------------------------------------------------------ exploring the paper's maze

/// A robot whose own time is taken, so that it can be left out.
struct Stopwatch {
    robot: SimRobot,
    spent: Duration,
}

impl Stopwatch {
    fn timed<T>(&mut self, work: impl FnOnce(&mut SimRobot) -> T) -> T {
        let start = Instant::now();
        let result = work(&mut self.robot);
        self.spent += start.elapsed();
        result
    }
}

impl Robot for Stopwatch {
    fn turn(&mut self, angle_rad: f64) -> Odometry {
        self.timed(|robot| robot.turn(angle_rad))
    }

    fn forward(&mut self, distance_m: f64) -> Odometry {
        self.timed(|robot| robot.forward(distance_m))
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated {
        self.timed(|robot| robot.repeat(to, length_m))
    }

    fn scan(&mut self) -> Scan {
        self.timed(|robot| robot.scan())
    }

    fn mark(&mut self, vertex: VertexId) {
        self.timed(|robot| robot.mark(vertex));
    }

    fn recognize(&mut self) -> Vec<PlaceMatch> {
        self.timed(|robot| robot.recognize())
    }
}

/// The time of each step of one run, policy and map, without the simulator.
fn explore(kind: &str, seed: u64) -> Vec<f64> {
    let robot = SimRobot::new(Arc::new(paper::maze()), RobotParams::default(), seed);
    let mut robot = Stopwatch { robot, spent: Duration::ZERO };
    let mut explorer = Explorer::new(vec![map_of(kind)], ExploreParams::default());
    let mut times_us = Vec::new();
    loop {
        robot.spent = Duration::ZERO;
        let start = Instant::now();
        let report = explorer.step(&mut robot, &mut Off);
        times_us.push(micros(start.elapsed().saturating_sub(robot.spent)));
        if report.ending.is_some() {
            return times_us;
        }
    }
}

fn exploring(effort: &Effort) {
    say("\nExploring the paper's maze at alpha 1: a step of policy and map, microseconds");
    say("map        steps   median      p99      max");
    let mut medians_us = [0.0; 2];
    for (kind, median_us) in KINDS.iter().zip(&mut medians_us) {
        let mut all_us = Vec::new();
        for seed in 1..=effort.seeds {
            let mut least_us = explore(kind, seed);
            for _ in 1..effort.repeats {
                let again_us = explore(kind, seed);
                assert_eq!(least_us.len(), again_us.len(), "runs are deterministic");
                for (least_us, again_us) in least_us.iter_mut().zip(again_us) {
                    *least_us = least_us.min(again_us);
                }
            }
            all_us.append(&mut least_us);
        }
        let [median, p99, max] = spread(&all_us);
        *median_us = median;
        say(&format!("{kind:<9} {:>6} {median:>8.1} {p99:>8.1} {max:>8.1}", all_us.len()));
    }
    say(&format!("median, relative to grid: {:.2}", medians_us[0] / medians_us[1]));
}

// --------------------------------------------------------- long drives: both maps hear the same

/// A drive along points given in truth.
struct Drive<'a> {
    world: World2d,
    params: RobotParams,
    /// Where the robot goes next, by the count of points reached.
    point: &'a dyn Fn(usize) -> Point2,
}

/// The time of each pose, for each of [`KINDS`]: taking its edges and its scan.
fn follow(drive: Drive<'_>, poses: usize) -> [Vec<f64>; 2] {
    let mut robot = SimRobot::new(Arc::new(drive.world), drive.params, 1);
    let mut graph = PoseGraph::new();
    let mut maps = KINDS.map(map_of);
    let mut times_us = KINDS.map(|_| Vec::with_capacity(poses));
    let mut before: Option<VertexId> = None;
    let mut reached = 0;
    for _ in 0..poses {
        let before_from_here = match before {
            Some(_) => go_on(&mut robot, drive.point, &mut reached),
            None => Se2::identity(),
        };
        let vertex = graph.add_vertex();
        robot.mark(vertex);
        let odometry = before.map(|before| (before, before_from_here, EdgeKind::Odometry));
        let places = robot.recognize().into_iter();
        let places = places.map(|place| (place.vertex, place.known_from_current, EdgeKind::Place));
        let mut edges = Vec::new();
        for (from, from_vertex, kind) in odometry.into_iter().chain(places) {
            let edge = graph.add_edge(from, vertex, from_vertex, kind);
            edges.push(edge.expect("both ends exist and the pose is finite"));
        }
        let scan = robot.scan();
        let standing = Standing { vertex, vertex_from_body: Se2::identity() };
        for (map, times_us) in maps.iter_mut().zip(&mut times_us) {
            let start = Instant::now();
            map.edges_added(&graph, &edges, &mut Off);
            map.scanned(&standing, &scan, &mut Off);
            times_us.push(micros(start.elapsed()));
        }
        before = Some(vertex);
    }
    for (kind, map) in KINDS.iter().zip(&maps) {
        let edges = graph.edges().count() as f64 / poses as f64;
        let megabytes = map.bytes() as f64 / 1e6;
        say(&format!("{kind:<9} {megabytes:.1} MB after {poses} poses, {edges:.1} edges each"));
    }
    times_us
}

/// Turns to the next point and drives at most a metre towards it; returns the motion as odometry
/// tells it. Points are aimed at from the true pose, so that noise does not add up.
fn go_on(robot: &mut SimRobot, point: &dyn Fn(usize) -> Point2, reached: &mut usize) -> Se2 {
    let at = robot.world_from_body();
    let mut way = point(*reached).coords - at.translation;
    while way.norm() < 0.6 {
        *reached += 1;
        way = point(*reached).coords - at.translation;
    }
    let turn_rad = pose::wrap_angle(way.y.atan2(way.x) - at.angle());
    let turned = robot.turn(turn_rad);
    turned.before_from_after * robot.forward(way.norm().min(1.0)).before_from_after
}

/// Prints median and 99th percentile of each tenth; returns the medians.
fn tenths(times_us: &[Vec<f64>; 2]) -> [Vec<f64>; 2] {
    say("tenth       1    2    3    4    5    6    7    8    9   10");
    let mut medians_us = KINDS.map(|_| Vec::new());
    for ((kind, times_us), medians_us) in KINDS.iter().zip(times_us).zip(&mut medians_us) {
        let tenths = || times_us.chunks_exact(times_us.len() / 10);
        for (share, name) in [(0.5, "median"), (0.99, "p99")] {
            let row: Vec<f64> = tenths().map(|tenth| quantile(tenth, share)).collect();
            let text: String = row.iter().map(|us| format!("{us:>5.0}")).collect();
            say(&format!("{text:>58}  {kind} {name}"));
            if share == 0.5 {
                *medians_us = row;
            }
        }
    }
    medians_us
}

fn last_to_second(medians_us: &[Vec<f64>; 2]) {
    for (kind, row) in KINDS.iter().zip(medians_us) {
        say(&format!("{kind}: last tenth to second tenth {:.2}", row[9] / row[1]));
    }
}

/// One long corridor, 4 m wide, with niches: no pose ever sees known ground again.
fn new_ground(effort: &Effort) {
    say(&format!("\nEver new ground, {} poses: edges and scan, microseconds", effort.poses));
    let length_m = effort.poses as f64 + 100.0;
    let corner = |(x, y): (f64, f64)| Point2::new(x, y);
    let mut outline: Vec<Point2> =
        [(0.0, 0.0), (length_m, 0.0), (length_m, 4.0)].map(corner).into();
    let mut x = length_m - 7.0;
    while x > 10.0 {
        outline.extend([(x, 4.0), (x, 6.0), (x - 2.0, 6.0), (x - 2.0, 4.0)].map(corner));
        x -= 9.0;
    }
    outline.push(corner((0.0, 4.0)));
    let start = Se2::new(1.0, 2.0, 0.0);
    let world = World2d::from_polygons("corridor", vec![outline], start);
    let mut params = RobotParams::default();
    params.odometry.scale = 0.0;
    let drive = Drive {
        world: world.expect("a simple outline"),
        params,
        point: &|k| Point2::new(2.0 + 3.0 * k as f64, 1.2 + 1.6 * (k % 2) as f64),
    };
    last_to_second(&tenths(&follow(drive, effort.poses)));
}

/// The maze's only way, there and back without end, a little beside the last time each time.
///
/// Each pose recognises the three nearest places. With all of them, as in the paper, the graph
/// itself grows by some hundreds of edges with each pose: that would measure the graph.
fn round_and_round(effort: &Effort) {
    say(&format!(
        "\nRound and round in the maze at alpha 1, {} poses, 3 places recognised each: \
         edges and scan, microseconds",
        effort.poses
    ));
    let way = maze_way();
    let turn = 2 * (way.len() - 1);
    let mut params = RobotParams::default();
    params.places.max_matches = Some(3);
    let point = |k: usize| {
        let along = k % turn;
        let at = way[along.min(turn - along)];
        let aside_m = ((k as f64 * 0.618).fract() - 0.5) * 1.6;
        Point2::new(at.x, at.y + aside_m)
    };
    let drive = Drive { world: paper::maze(), params, point: &point };
    last_to_second(&tenths(&follow(drive, effort.poses)));
}

/// Points every 3 m or less along the corridor that winds through the six bays.
fn maze_way() -> Vec<Point2> {
    let (west, east) = (2.9, 27.9);
    // From where the robot starts to the end of its bay first, so that nothing is left unseen.
    let mut corners = vec![Point2::new(15.1, 3.1), Point2::new(west, 3.1)];
    for (bay, y) in [3.1, 8.0, 13.0, 18.0, 23.0, 28.0].into_iter().enumerate() {
        let (from, to) = if bay % 2 == 0 { (west, east) } else { (east, west) };
        if bay > 0 {
            corners.push(Point2::new(from, y));
        }
        corners.push(Point2::new(to, y));
    }
    let mut way = Vec::new();
    for leg in corners.windows(2) {
        let parts = ((leg[1] - leg[0]).norm() / 3.0).ceil();
        let shares = (0..parts as usize).map(|part| part as f64 / parts);
        way.extend(shares.map(|share| leg[0] + (leg[1] - leg[0]) * share));
    }
    way
}

// ------------------------------------------------------------------------------ the recording

fn recording(effort: &Effort) {
    say("\nRecording the maze at alpha 1: what is added to a step, microseconds");
    say("map       level     median      p99");
    for kind in KINDS {
        for level in ["off", "summary", "full"] {
            let runs: Vec<MapTiming> =
                (1..=effort.seeds.min(3)).map(|seed| recorded(kind, level, seed)).collect();
            let over = |of: fn(&MapTiming) -> f64| {
                let values: Vec<f64> = runs.iter().map(of).collect();
                quantile(&values, 0.5)
            };
            let median = over(|timing| timing.record_micros_median);
            let p99 = over(|timing| timing.record_micros_p99);
            say(&format!("{kind:<9} {level:<8} {median:>7.1} {p99:>8.1}"));
        }
    }
}

/// One run as the command makes it, recorded to a file.
fn recorded(kind: &'static str, level: &str, seed: u64) -> MapTiming {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/paper/maze.toml");
    let sets = vec![format!("seed={seed}"), format!("record.level='{level}'")];
    let loaded = Loaded::read(&config, &Overrides { sets, world: None }).expect("a config");
    let experiment = Experiment::prepare(&loaded).expect("a place");
    let folder = tempfile::tempdir().expect("a folder");
    let recording = start_recording(&experiment, &folder.path().join("run.rrd"), "A benchmark.")
        .expect("a new file");
    let mut recorder = recording.recorder(kind);
    let Experiment { config, place, coverage } = &experiment;
    let mut runs =
        drive(config, &place.world, coverage, &[kind], &mut recorder, &mut |_| ()).expect("a disk");
    recorder.send().expect("rows fit together");
    recording.finish(&serde_json::json!({})).expect("a disk");
    runs.remove(0).timing
}
