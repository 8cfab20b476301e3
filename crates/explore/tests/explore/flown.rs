//! The beginning of flights through a hall with pillars, and the ways that are planned on them.

use std::sync::Arc;

use explore::{Ending, FlightExplorer, FlightParams, Ways, WaysTally};
use maps3d::{MapWork, RelativeMap, RelativeParams};
use probe::Off;
use worlds::space::{Pillars3dParams, pillars};
use worlds::{FlyerParams, SimFlyer};

/// What a flight came to.
#[derive(Debug, PartialEq)]
struct Flown {
    ending: Option<Ending>,
    /// Where the robot was after each step, by odometry, metres.
    track: Vec<[f64; 3]>,
    collisions: u64,
    ways: WaysTally,
    work: MapWork,
}

fn flown(ways: Ways) -> Flown {
    let place = Pillars3dParams { seed: 1, ..Pillars3dParams::default() };
    let world = Arc::new(pillars(&place).expect("a place"));
    let flyer = FlyerParams::default();
    let params = FlightParams {
        body_radius_m: flyer.radius_m,
        // The first way is asked for at the fourteenth.
        max_steps: 16,
        ways,
        ..FlightParams::default()
    };
    let mut robot = SimFlyer::new(world, flyer, 1).expect("it fits");
    let map = RelativeMap::new(RelativeParams::default()).expect("usual parameters");
    let mut explorer = FlightExplorer::new(vec![Box::new(map)], params);
    let mut track = Vec::new();
    let ending = loop {
        let report = explorer.step(&mut robot, &mut Off);
        track.push(report.odom_from_body.translation.into());
        if report.ending.is_some() {
            break report.ending;
        }
    };
    let (ways, work) = (explorer.ways(), explorer.maps()[0].work());
    Flown { ending, track, collisions: robot.tally().collisions, ways, work }
}

#[test]
fn ways_that_are_told_and_not_flown_change_no_flight_and_are_counted() {
    let (told, repeated) = (flown(Ways::Told), flown(Ways::Repeat));
    assert_eq!((told.ending, told.track.len()), (Some(Ending::StepLimit), 16));
    assert!(told.ending == repeated.ending && told.track == repeated.track);
    assert_eq!((repeated.ways, repeated.work.paths), (WaysTally::default(), 0));
    let (ways, work) = (told.ways, told.work);
    assert!(ways.found > 0 && ways.found <= ways.asked && ways.begun == 0, "{ways:?}");
    assert!(work.paths == ways.found && work.tetrahedra > 0, "{work:?}");
    assert!(work.shortened_m > 0.0 && work.shortened_m < work.paths_m, "{work:?}");
    assert!((work.shortened_m - ways.found_m).abs() < 1e-6, "{work:?} {ways:?}");
}

#[test]
fn flights_by_planned_ways_are_the_same_each_time() {
    let first = flown(Ways::Planned);
    assert_eq!((first.ending, first.collisions), (Some(Ending::StepLimit), 0));
    assert!(first.ways.found > 0 && first.work.paths > 0, "{first:?}");
    assert_eq!(first, flown(Ways::Planned));
}
