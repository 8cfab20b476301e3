//! Maps that unite views, without drift, in the paper's places: complete, and truly so.

use std::sync::Arc;

use explore::{Ending, ExploreParams, Explorer};
use maps2d::ExplorationMap;
use maps2d::active::{ActiveArea, ActiveAreaParams};
use maps2d::polygons::{CorrectedPolygons, CorrectedPolygonsParams};
use metrics::{Coverage, CoverageParams, Witness};
use pose::Se2;
use probe::Off;
use worlds::{SimRobot, World2d, paper};

use super::ending::drift;

/// The start moved by up to a centimetre.
fn moved(world: World2d, seed: u64) -> Arc<World2d> {
    let start = world.world_from_start();
    let by = |k: f64| 0.01 * (2.0 * (seed as f64 * k).fract() - 1.0);
    let (x, y) = (start.translation.x + by(0.618_034), start.translation.y + by(0.414_214));
    Arc::new(world.with_start(Se2::new(x, y, start.angle())).expect("free"))
}

/// How a run ends, and what it has truly seen.
fn ends(world: &Arc<World2d>, map: Box<dyn ExplorationMap + Send>) -> (Option<Ending>, f64, u64) {
    let coverage = Coverage::new(world, CoverageParams::default()).expect("sound");
    let mut witness = Witness::new(SimRobot::new(Arc::clone(world), drift(0.0), 1), coverage);
    let mut explorer = Explorer::new(vec![map], ExploreParams::default());
    loop {
        let report = explorer.step(&mut witness, &mut Off);
        if report.ending.is_some() {
            let invalid = explorer.maps()[0].invalid();
            return (report.ending, witness.coverage().fraction(), invalid);
        }
    }
}

/// Explores one of the paper's places without drift.
fn sees_all(name: &str, seed: u64, map: Box<dyn ExplorationMap + Send>) {
    let world = moved(paper::by_name(name).expect("known"), seed);
    let (ending, coverage, _) = ends(&world, map);
    assert_eq!((ending, coverage), (Some(Ending::Complete), 1.0), "{name}, seed {seed}");
}

fn corrected() -> Box<dyn ExplorationMap + Send> {
    Box::new(CorrectedPolygons::new(CorrectedPolygonsParams::default()))
}

/// Long straight walls make long triangles: ways once led to points out of view and to where the
/// robot stood already, and it gave up everything that it had left behind.
#[test]
fn corrected_polygons_without_drift_see_all_of_the_maze() {
    sees_all("maze", 1, corrected());
}

#[test]
fn corrected_polygons_without_drift_see_all_of_the_open_place() {
    sees_all("open", 2, corrected());
}

#[test]
fn corrected_polygons_without_drift_see_all_of_the_forest_house() {
    sees_all("forest_house", 3, corrected());
}

#[test]
fn the_active_area_without_drift_sees_all_of_the_maze() {
    sees_all("maze", 1, Box::new(ActiveArea::new(ActiveAreaParams::default())));
}
