//! Rules between the keys of a flight.

use worlds::WorldError;
use worlds::space::{Cave3dParams, Office3dParams, Pillars3dParams, Rooms3dParams};

use super::super::check::{Fault, fault};
use super::super::document::join;
use super::super::{Config, World3d};

/// Tables that mean something in the plane only.
const OF_THE_PLANE: [&str; 5] = ["world", "sensor", "map", "planner", "metrics"];

/// Whether a top-level key means nothing in space.
pub(in super::super) fn is_only_of_the_plane(key: &str) -> bool {
    OF_THE_PLANE.contains(&key)
}

/// What is wrong with a config of space, beside the ranges of its keys.
pub(in super::super) fn faults(config: &Config, faults: &mut Vec<Fault>) {
    for (path, found) in of_wheels(config) {
        if found != 0.0 {
            let expected = "0: a robot that flies has none".into();
            faults.push(fault(path, format!("{found:?}"), expected));
        }
    }
    let generator = config.world3d.as_ref().map(check_generator);
    if let Some((key, Err(WorldError::Parameter { field, found, expected }))) = generator {
        let path = join(key, field);
        // What the range of the key itself refuses is told with that range.
        if !faults.iter().any(|fault| fault.path == path) {
            faults.push(fault(&path, found.to_string(), expected.into()));
        }
    }
}

/// Keys of the plane that a flight shares tables with and does not know.
fn of_wheels(config: &Config) -> [(&'static str, f64); 4] {
    [
        ("odometry.bias_translation", config.odometry.bias_translation),
        ("odometry.bias_rotation", config.odometry.bias_rotation),
        ("places.false_positive_rate", config.places.false_positive_rate),
        ("robot.snap_radius_m", config.robot.snap_radius_m),
    ]
}

/// The key of a generated world, and whether its values go together.
fn check_generator(world: &World3d) -> (&'static str, Result<(), WorldError>) {
    match world {
        World3d::Mesh(_) => ("world3d.mesh", Ok(())),
        World3d::Rooms(world) => ("world3d.rooms", Rooms3dParams::from(world).check()),
        World3d::Office(world) => ("world3d.office", Office3dParams::from(world).check()),
        World3d::Pillars(world) => ("world3d.pillars", Pillars3dParams::from(world).check()),
        World3d::Cave(world) => ("world3d.cave", Cave3dParams::from(world).check()),
    }
}
