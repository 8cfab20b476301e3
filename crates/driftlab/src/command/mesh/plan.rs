//! `driftlab mesh plan`: a path through the tetrahedra of a mesh.

use std::path::Path;
use std::time::Instant;

use anyhow::anyhow;
use clap::ValueEnum;
use instrument::{PlanRecording, PlanRecordingOptions, SolidOptions};
use maps3d::{Algorithm, Heuristic, Maps3dError, Plan, PlanOptions, Planner, Target};
use serde_json::{Value, json};
use solid::{Point3, Polyhedron, tetrahedralize};

use super::super::failure::Failure;
use super::super::graph::numbers::{listed, shown};
use super::super::out::Out;
use super::args::{PlanArgs, shown as shown_path};
use super::input;
use super::tetrahedralize::refused;

/// How the graph is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AlgorithmName {
    /// By the number of legs
    BreadthFirst,
    /// Down the first node first
    DepthFirst,
    /// By cost
    Dijkstra,
    /// By cost and an estimate of what is left
    Astar,
}

/// What A* takes for the cost that is left at least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum HeuristicName {
    /// Nothing
    Zero,
    /// The straight distance
    Euclidean,
    /// The sum of the differences of coordinates, over the square root of 3
    Manhattan,
    /// What the costs from a few far nodes tell
    Landmarks,
}

impl AlgorithmName {
    fn algorithm(self) -> Algorithm {
        match self {
            Self::BreadthFirst => Algorithm::Breadth,
            Self::DepthFirst => Algorithm::Depth,
            Self::Dijkstra => Algorithm::Dijkstra,
            Self::Astar => Algorithm::Astar,
        }
    }
}

impl HeuristicName {
    fn heuristic(self) -> Heuristic {
        match self {
            Self::Zero => Heuristic::Zero,
            Self::Euclidean => Heuristic::Euclidean,
            Self::Manhattan => Heuristic::Manhattan,
            Self::Landmarks => Heuristic::Landmarks,
        }
    }
}

/// A name as it is typed.
fn typed(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

pub(super) fn plan(args: &PlanArgs, out: &Out) -> Result<(), Failure> {
    let options = PlanOptions {
        radius_m: args.radius,
        spacing_m: args.spacing,
        least_area_m2: args.least_area,
        algorithm: args.algorithm.algorithm(),
        heuristic: args.heuristic.heuristic(),
        shorten: !args.no_shorten,
        ..PlanOptions::default()
    };
    options.check().map_err(bad)?;
    args.recording.check([args.file.as_path()])?;
    let read = input::mesh(&args.file, args.input.weld, out)?;
    let watch = Instant::now();
    let tetrahedra = tetrahedralize(&read.mesh).map_err(|error| refused(&error, &args.file))?;
    let secs_tetrahedralize = watch.elapsed().as_secs_f64();
    let watch = Instant::now();
    let mut planner = Planner::new(&[&tetrahedra], &options).map_err(bad)?;
    let secs_graph = watch.elapsed().as_secs_f64();
    let from = Point3::from(args.from);
    let target = match args.to {
        Some(to) => Target::Point(Point3::from(to)),
        None if planner.graph().frontier().is_empty() => {
            return Err(Failure::Input(anyhow!(
                "{}: found no frontier face of at least {} m2 that a ball of {} m can reach; expected --to, or a \
                 mesh with labels",
                args.file.display(),
                args.least_area,
                args.radius
            )));
        }
        None => Target::Frontier,
    };
    // Before a recording is begun: bad points leave nothing behind.
    planner.check(&from, &target).map_err(bad)?;
    let watch = Instant::now();
    if args.to.is_some() {
        planner.prepare();
    }
    let secs_prepare = watch.elapsed().as_secs_f64();
    let watch = Instant::now();
    let (found, recording) = match &args.recording.record {
        Some(path) => {
            let mut recording = record(path, args, &read.mesh)?;
            planner.tell(&mut recording);
            (planner.plan_with(&from, &target, &mut recording), Some(recording))
        }
        None => (planner.plan(&from, &target), None),
    };
    let secs_plan = watch.elapsed().as_secs_f64();
    let found =
        found.map_err(|error| Failure::Work(anyhow!("{}: {error}", args.file.display())))?;
    let graph = planner.graph();
    let mut json = json!({
        "file": args.file.display().to_string(),
        "from": args.from,
        "to": args.to,
        "radius_m": args.radius,
        "algorithm": typed(args.algorithm),
        "heuristic": typed(args.heuristic),
        "tetrahedra": tetrahedra.tetrahedra.len(),
        "steiner_points": tetrahedra.steiner_points,
        "frontier_points": graph.frontier().len(),
        "frontier_points_too_narrow": graph.narrow(),
        "legs": graph.edge_count(),
        "found": found.is_some(),
        "secs_read": read.secs,
        "secs_tetrahedralize": secs_tetrahedralize,
        "secs_graph": secs_graph,
        "secs_prepare": secs_prepare,
        "secs_plan": secs_plan,
    });
    let mut rows = vec![
        (
            "tetrahedra",
            format!("{}, {} points added", tetrahedra.tetrahedra.len(), tetrahedra.steiner_points),
        ),
        (
            "dual graph",
            format!("{} legs, {} frontier points", graph.edge_count(), graph.frontier().len()),
        ),
    ];
    match &found {
        Some(found) => tell(found, &planner, &mut json, &mut rows),
        None => rows.push(("path", "none: nothing leads there".to_owned())),
    }
    rows.push((
        "seconds",
        format!(
            "read {:.4}, tetrahedralize {secs_tetrahedralize:.4}, graph {secs_graph:.4}, prepare \
             {secs_prepare:.4}, plan {secs_plan:.4}",
            read.secs
        ),
    ));
    if let Some(recording) = recording {
        recording.finish(&json).map_err(Failure::work)?;
    }
    json["recording"] = shown_path(args.recording.record.as_deref());
    out.result(&json, &listed(&rows))
}

/// What is said of a path.
fn tell(found: &Plan, planner: &Planner, json: &mut Value, rows: &mut Vec<(&'static str, String)>) {
    let inside = found.corridor.leaves(planner.space(), &found.path).is_none();
    let points: Vec<[f64; 3]> = found.points().iter().map(|point| point.coords.into()).collect();
    let shortened = if found.cost_m > 0.0 { 1.0 - found.path_m / found.cost_m } else { 0.0 };
    json["expansions"] = found.expansions.into();
    json["corridors_tried"] = found.tries.into();
    json["corridor_tetrahedra"] = found.corridor.tetrahedra.len().into();
    json["inside_corridor"] = inside.into();
    json["clear"] = found.clear.into();
    json["clearance_m"] = found.clearance_m.into();
    json["way_m"] = found.cost_m.into();
    json["straight_m"] = found.straight_m.into();
    json["path_m"] = found.path_m.into();
    json["shortened_share"] = shortened.into();
    json["programmes"] = found.programmes.into();
    json["path"] = json!(points);
    let goal = found.frontier.map(|index| planner.graph().frontier()[index as usize]);
    json["frontier"] = goal.map_or(Value::Null, |goal| {
        let face = planner.space().frontier()[goal.face as usize].face;
        json!({ "face": face, "at": [goal.at.x, goal.at.y, goal.at.z], "area_m2": goal.area_m2 })
    });
    rows.push((
        "way",
        format!(
            "{} m through {} tetrahedra, {} expansions",
            shown(found.cost_m),
            found.corridor.tetrahedra.len(),
            found.expansions
        ),
    ));
    rows.push((
        "path",
        format!(
            "{} m, {} points, {:.1} % shorter; {} cone programmes",
            shown(found.path_m),
            points.len(),
            100.0 * shortened,
            found.programmes
        ),
    ));
    rows.push((
        "clear",
        if found.clear {
            format!("yes, inside of the corridor: {}", if inside { "yes" } else { "no" })
        } else {
            format!("no, {} m at the narrowest", shown(found.clearance_m))
        },
    ));
    if let Some(goal) = goal {
        let [x, y, z] = goal.at.coords.into();
        let at = format!("{}, {}, {}", shown(x), shown(y), shown(z));
        rows.push(("frontier", format!("at {at}; its face has {} m2", shown(goal.area_m2))));
    }
}

fn record(path: &Path, args: &PlanArgs, mesh: &Polyhedron) -> Result<PlanRecording, Failure> {
    let file = args.file.file_name().unwrap_or_default().to_string_lossy();
    let [x, y, z] = args.from;
    let goal = match args.to {
        Some([x, y, z]) => format!("({x}, {y}, {z})"),
        None => "the nearest frontier".to_owned(),
    };
    let about = format!(
        "A path in `{file}` from ({x}, {y}, {z}) to {goal}, for a ball of {} m; searched by {}.",
        args.radius,
        typed(args.algorithm)
    );
    let solid = SolidOptions { path: path.to_owned(), name: "plan".into(), about };
    PlanRecording::create(&PlanRecordingOptions { solid, radius_m: args.radius }, mesh)
        .map_err(Failure::work)
}

/// Points and options as they were typed are bad input.
fn bad(error: Maps3dError) -> Failure {
    let message = match &error {
        Maps3dError::Option { option, found, expected } => {
            let typed = match *option {
                "radius_m" => "--radius",
                "spacing_m" => "--spacing",
                "least_area_m2" => "--least-area",
                other => other,
            };
            anyhow!("{typed}: found {found}, expected {expected}")
        }
        Maps3dError::Outside { what, .. } | Maps3dError::TooNear { what, .. } => {
            let typed = if *what == "start" { "--from" } else { "--to" };
            anyhow!(
                "{typed}: {error}; expected a point inside of the mesh, farther from its obstacle faces than the radius"
            )
        }
        _ => anyhow!("{error}"),
    };
    Failure::Input(message)
}
