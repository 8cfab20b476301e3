//! Explores a generated place of space and prints how it went:
//! `cargo run --release -p explore --example fly3d -- WORLD SEED SCALE [MAP] [key=value ...]`
//!
//! WORLD is `rooms`, `office`, `pillars` or `cave`; SCALE multiplies the drift of odometry. MAP is `relative`,
//! or `points`: a second map that decides by samples alone.

#![expect(clippy::print_stdout, reason = "an example that prints")]

mod points_map;

use std::sync::Arc;
use std::time::Instant;

use explore::{FlightEvent, FlightExplorer, FlightGiveUp, FlightParams, Ways};
use maps3d::{
    ConsolidationEvent, DepthEvent, Map3d, PlanEvent, RelativeMap, RelativeParams, UnionEvent,
    UnionMap, UnionParams,
};
use metrics::{FlightWitness, VoxelCoverage, VoxelParams};
use probe::Probe;
use worlds::space::{
    Cave3dParams, Office3dParams, Pillars3dParams, Rooms3dParams, cave, office, pillars, rooms,
};
use worlds::{FlyerParams, SimFlyer, World3d};

/// Prints what happens, where asked to.
struct Told(bool, Vec<(probe::VertexId, geometry::Point3, f64, FlightGiveUp)>);

impl Probe<FlightEvent<'_>> for Told {
    fn emit(&mut self, event: FlightEvent<'_>) {
        if let FlightEvent::FrontierGivenUp { owner, place_in_vertex, area_m2, why } = event {
            self.1.push((owner, place_in_vertex, area_m2, why));
        }
        if !self.0 {
            return;
        }
        match event {
            FlightEvent::ViewpointsScored { at, targets, scored } => {
                println!("    scored at {at}: {} targets, {} places", targets.len(), scored.len());
            }
            FlightEvent::Looked { hovering, .. } => {
                let yaw = hovering.vertex_from_body.rotation.euler_angles().2.to_degrees();
                println!("    looked at {} yaw {yaw:.0}", hovering.vertex);
            }
            FlightEvent::RoutePlanned { hovering, route, length_m } => {
                println!("    route from {}: {length_m:.1} m {route:?}", hovering.vertex);
            }
            other => println!("    {other:?}"),
        }
    }
}

impl Probe<DepthEvent<'_>> for Told {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, _: DepthEvent<'_>) {}
}

impl Probe<PlanEvent<'_>> for Told {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, _: PlanEvent<'_>) {}
}

impl Probe<ConsolidationEvent<'_>> for Told {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, _: ConsolidationEvent<'_>) {}
}

impl Probe<UnionEvent<'_>> for Told {
    fn on(&self) -> bool {
        self.0
    }

    fn emit(&mut self, event: UnionEvent<'_>) {
        if self.0 {
            println!("    {}", event.variant());
        }
    }
}

fn world(name: &str, seed: u64, columns: Option<usize>) -> World3d {
    match name {
        "rooms" => {
            let good = Rooms3dParams::default();
            rooms(&Rooms3dParams { seed, columns: columns.unwrap_or(good.columns), ..good })
        }
        "office" => office(&Office3dParams { seed, ..Office3dParams::default() }),
        "pillars" => pillars(&Pillars3dParams { seed, ..Pillars3dParams::default() }),
        _ => cave(&Cave3dParams { seed, ..Cave3dParams::default() }),
    }
    .expect("a world")
}

fn map_of(name: &str, relative: RelativeParams) -> Box<dyn Map3d + Send> {
    match name {
        "relative" => Box::new(RelativeMap::new(relative).expect("parameters")),
        "global_union" => Box::new(UnionMap::new(UnionParams::default()).expect("usual options")),
        "points" => Box::new(points_map::PointsMap::default()),
        _ => panic!("unknown map {name}"),
    }
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let arg = |at: usize, or: &'static str| args.get(at).cloned().unwrap_or(or.into());
    let place = arg(0, "rooms");
    let seed: u64 = arg(1, "1").parse().expect("a seed");
    let scale: f64 = arg(2, "1").parse().expect("a scale");
    let kind = arg(3, "relative");
    let mut params = FlyerParams::default();
    params.odometry.scale = scale;
    let mut flight =
        FlightParams { body_radius_m: params.radius_m, max_steps: 3000, ..FlightParams::default() };
    let mut relative = RelativeParams::default();
    let mut verbose = false;
    let mut columns = None;
    for pair in args.iter().skip(4) {
        let (key, value) = pair.split_once('=').expect("key=value");
        let number = || value.parse::<f64>().expect("a number");
        match key {
            "v" => verbose = true,
            "doubt" => relative.contradiction_share = number(),
            "doubt_m" => relative.contradiction_m = number(),
            "weight" => relative.place_weight = number(),
            "steps" => flight.max_steps = number() as u64,
            "slip" => params.odometry.sigma_translation = number(),
            "yaw" => params.odometry.sigma_rotation_rad = number().to_radians(),
            "columns" => columns = Some(number() as usize),
            "tries" => flight.tries = number() as usize,
            "around" => flight.around_m = number(),
            "fov" => params.camera.fov_down_rad = number().to_radians(),
            "ways" => {
                flight.ways = match value {
                    "repeat" => Ways::Repeat,
                    "planned" => Ways::Planned,
                    _ => Ways::Told,
                }
            }
            "hop" => flight.hop_m = number(),
            "vertices" => {
                let stop = maps3d::reduce::Stop::Vertices(number() as usize);
                relative.view.reduce.as_mut().expect("a default").stop = stop;
            }
            "conservative" => {
                relative.view.reduce.as_mut().expect("a default").conservative_m = Some(number());
            }
            "share" => relative.view.frontier_share = number(),
            "scope" => relative.consolidation_radius_m = number(),
            "wall" => relative.wall_closing_m = number(),
            "shrink" => relative.shrink_m = number(),
            "sliver" => relative.sliver_m2 = number(),
            "spacing" => relative.point_spacing_m = number(),
            _ => panic!("unknown key {key}"),
        }
    }
    let started = Instant::now();
    let world = Arc::new(world(&place, seed, columns));
    let coverage =
        VoxelCoverage::new(&world, &params.camera, params.radius_m, VoxelParams::default());
    let coverage = coverage.expect("voxels");
    let judged_secs = started.elapsed().as_secs_f64();
    println!(
        "{place} seed {seed} scale {scale}: {} triangles, {} of {} voxels count, {judged_secs:.1} s",
        world.triangles().len(),
        coverage.cells_counted(),
        coverage.cells_total()
    );
    let robot = SimFlyer::new(world.clone(), params, seed).expect("it fits");
    let mut witness = FlightWitness::new(robot, coverage);
    let mut explorer = FlightExplorer::new(vec![map_of(&kind, relative)], flight);
    let started = Instant::now();
    let mut told = Told(verbose, Vec::new());
    let mut worst_m = 0.0_f64;
    let mut collided = 0;
    let report = loop {
        let before = witness.world_from_body().translation;
        let report = explorer.step(&mut witness, &mut told);
        if verbose || explorer.steps().is_multiple_of(100) {
            println!(
                "  step {} at {} looks {} flown {:.1} coverage {:.4} open {:.2} m2 in {} sliver {:.3} given up {:.3} bumps {}",
                explorer.steps(),
                report.hovering.vertex,
                explorer.looks(),
                witness.tally().distance_m,
                witness.coverage().fraction(),
                report.tally.open_m2,
                report.tally.patches,
                report.tally.sliver_m2,
                report.tally.given_up_m2,
                witness.tally().bumps,
            );
        }
        let odom_error_m = (world.world_from_start() * report.odom_from_body)
            .inverse_mul(&witness.world_from_body())
            .translation
            .norm();
        worst_m = worst_m.max(odom_error_m);
        for (owner, place, area_m2, why) in told.1.drain(..) {
            if let Some(from) = witness.robot().world_from_vertex(owner) {
                let p = from.transform(&place);
                println!(
                    "  GAVE UP {why:?} {area_m2:.3} m2 of {owner} at {:.2} {:.2} {:.2} in vertex {:.2} {:.2} {:.2} surface {:.3} step {}",
                    p.x,
                    p.y,
                    p.z,
                    place.x,
                    place.y,
                    place.z,
                    world.caster().distance_to(&p),
                    explorer.steps()
                );
            }
        }
        if witness.tally().collisions > collided {
            collided = witness.tally().collisions;
            let after = witness.world_from_body().translation;
            println!(
                "  COLLISION at step {} before {}, flown {:.3} m from {:.3} {:.3} {:.3} to {:.3} {:.3} {:.3}, surface {:.4} m",
                explorer.steps(),
                report.hovering.vertex,
                (after - before).norm(),
                before.x,
                before.y,
                before.z,
                after.x,
                after.y,
                after.z,
                world.caster().distance_to(&before.into())
            );
        }
        if report.ending.is_some() {
            break report;
        }
    };
    let verdict = witness.verdict(report.ending == Some(explore::Ending::Complete));
    let tally = witness.tally();
    let start = world.world_from_start();
    let odom_error_m =
        (start * report.odom_from_body).inverse_mul(&witness.world_from_body()).translation.norm();
    println!(
        "{place} {seed} {scale} {kind}: {:?} coverage {:.4} flown {:.0} m d_max {:?} steps {} looks {} vertices {} \
         collisions {} bumps {} clearance {:.3} open {:.3} sliver {:.3} largest {:.3} given_up {:.3} ({}) unreachable_m2 {:.3} {:.3} hidden_m2 {:.3} {:.3} ignored_m2 {:.3} {:.3} odom error {odom_error_m:.2} m worst {worst_m:.2} m bytes per view {:.1} KiB {:.1} s",
        report.ending,
        verdict.coverage,
        verdict.distance_m,
        verdict.d_max_m.map(|d| d.round()),
        explorer.steps(),
        explorer.looks(),
        explorer.graph().vertex_count(),
        tally.collisions,
        tally.bumps,
        tally.min_clearance_m,
        report.tally.open_m2,
        report.tally.sliver_m2,
        report.tally.largest_sliver_m2,
        report.tally.given_up_m2,
        explorer.given_up(),
        explorer.given_up_m2(FlightGiveUp::Unreachable).0,
        explorer.given_up_m2(FlightGiveUp::Unreachable).1,
        explorer.given_up_m2(FlightGiveUp::Hidden).0,
        explorer.given_up_m2(FlightGiveUp::Hidden).1,
        explorer.given_up_m2(FlightGiveUp::NothingNew).0,
        explorer.given_up_m2(FlightGiveUp::NothingNew).1,
        explorer.maps()[0].bytes() as f64 / 1024.0 / explorer.looks() as f64,
        started.elapsed().as_secs_f64()
    );
    let work = explorer.maps()[0].work();
    println!(
        "  ways {:?}, paths {} of {:.1} m through centroids, {:.1} m shortened",
        explorer.ways(),
        work.paths,
        work.paths_m,
        work.shortened_m
    );
    if verdict.coverage < 0.999 {
        let missing: Vec<String> = witness
            .coverage()
            .unseen()
            .iter()
            .take(12)
            .map(|&at| {
                let p = witness.coverage().centre_in_world(at);
                format!("({:.1} {:.1} {:.1})", p.x, p.y, p.z)
            })
            .collect();
        println!("  unseen {}: {}", witness.coverage().unseen().len(), missing.join(" "));
    }
}
