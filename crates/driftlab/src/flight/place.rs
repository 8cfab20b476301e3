//! From the `[world3d]` table to a place of space with a start.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use geometry::{Point3, Vector3};
use worlds::space::{cave, office, pillars, rooms};
use worlds::{World3d, WorldError};

use crate::config::{self, Config, ConfigError, Loaded, MeshWorld, never_ends};
use crate::run::{Input, JITTER_TRIES, jitter};

/// The place of a flight, and the files that it was read from.
#[derive(Clone, Debug)]
pub struct FlightPlace {
    /// The place, with the robot's start.
    pub world: Arc<World3d>,
    /// The mesh file, if there is one.
    pub inputs: Vec<Input>,
    /// What the reader let pass, one line each.
    pub warnings: Vec<String>,
}

/// Builds the place of space that a config names.
///
/// # Errors
/// [`ConfigError`] with the line of the config, and for a broken mesh the position in it.
pub fn build_flight_place(loaded: &Loaded) -> Result<FlightPlace, ConfigError> {
    let config = loaded.anchored();
    let Some(world) = &config.world3d else {
        // Running refuses a config without one.
        return Err(ConfigError::World { place: loaded.place(""), message: "no world3d".into() });
    };
    let mut place = Gathered::default();
    let built = built(world, &config, &mut place).and_then(|world| jittered(world, &config));
    let told =
        |key: &str, message: String| ConfigError::World { place: loaded.place(key), message };
    let of_kind = format!("world3d.{}", world.key());
    let world = built.map_err(|trouble| match trouble {
        Trouble::File(message) => told("world3d.mesh.file", message),
        Trouble::World(error) => match &error {
            WorldError::StartInSpace { .. } | WorldError::NotClosedIn => {
                told("start", error.to_string())
            }
            WorldError::Parameter { field, .. } => {
                told(&format!("{of_kind}.{field}"), error.to_string())
            }
            _ => told(&of_kind, error.to_string()),
        },
    })?;
    let Gathered { inputs, warnings } = place;
    Ok(FlightPlace { world: Arc::new(world), inputs, warnings })
}

/// Why a place could not be built.
enum Trouble {
    File(String),
    World(WorldError),
}

impl From<WorldError> for Trouble {
    fn from(error: WorldError) -> Self {
        Self::World(error)
    }
}

#[derive(Default)]
struct Gathered {
    inputs: Vec<Input>,
    warnings: Vec<String>,
}

fn built(
    world: &config::World3d,
    config: &Config,
    gathered: &mut Gathered,
) -> Result<World3d, Trouble> {
    let start = config.start.as_ref();
    let world = match world {
        config::World3d::Mesh(mesh) => return mesh_world(mesh, config, gathered),
        config::World3d::Rooms(world) => rooms(&world.into())?,
        config::World3d::Office(world) => office(&world.into())?,
        config::World3d::Pillars(world) => pillars(&world.into())?,
        config::World3d::Cave(world) => cave(&world.into())?,
    };
    let Some(start) = start else { return Ok(world) };
    // A start without a height keeps the height of the world's own.
    let z_m = start.z_m.unwrap_or(world.world_from_start().translation.z);
    Ok(world.with_start(Point3::new(start.x_m, start.y_m, z_m), start.heading_deg.to_radians())?)
}

fn mesh_world(
    mesh: &MeshWorld,
    config: &Config,
    gathered: &mut Gathered,
) -> Result<World3d, Trouble> {
    let path = &mesh.file;
    let expected = "a mesh: OBJ, STL, PLY or OFF";
    let at = |message: String| Trouble::File(format!("{}: {message}", path.display()));
    if never_ends(path) {
        return Err(at(format!("is no ordinary file; expected {expected}")));
    }
    let bytes = fs::read(path)
        .map_err(|reason| at(format!("cannot be read ({reason}); expected {expected}")))?;
    gathered.inputs.push(Input::new(path, &bytes));
    let extension = path.extension().and_then(|extension| extension.to_str());
    let file =
        formats::mesh::read(&bytes, extension, None).map_err(|error| at(error.to_string()))?;
    if file.left_out > 0 {
        gathered.warnings.push(format!(
            "{}: {} faces with fewer than three different corners left out",
            path.display(),
            file.left_out
        ));
    }
    let vertices: Vec<Point3> = file.mesh.vertices().iter().map(|at| at * mesh.unit_m).collect();
    let middle_z = || {
        let z =
            |pick: fn(f64, f64) -> f64, from: f64| vertices.iter().map(|at| at.z).fold(from, pick);
        0.5 * (z(f64::min, f64::INFINITY) + z(f64::max, f64::NEG_INFINITY))
    };
    let start = config.start.as_ref().map(|start| {
        let z_m = start.z_m.unwrap_or_else(middle_z);
        (Point3::new(start.x_m, start.y_m, z_m), start.heading_deg.to_radians())
    });
    let name = path.file_stem().unwrap_or(Path::new("mesh").as_os_str()).to_string_lossy();
    let world = World3d::from_mesh(name, vertices, file.mesh.faces().to_vec(), start);
    world.map_err(|error| match error {
        WorldError::StartInSpace { .. } | WorldError::NotClosedIn => Trouble::World(error),
        other => at(other.to_string()),
    })
}

/// The place with its start moved by up to the jitter along each axis, to where the body fits.
fn jittered(world: World3d, config: &Config) -> Result<World3d, Trouble> {
    let jitter_m = config.start_jitter_m;
    if jitter_m == 0.0 {
        return Ok(world);
    }
    let mut even = jitter(config.seed, jitter_m);
    let start = world.world_from_start();
    let from = Point3::from(start.translation);
    let yaw_rad = start.rotation.euler_angles().2;
    let fits = |at: &Point3| world.caster().distance_to(at) > config.robot.radius_m;
    for _ in 0..JITTER_TRIES {
        let to = from + Vector3::new(even(), even(), even());
        // A start beyond a thin wall would be in another room.
        if world.caster().blocked(&from, &to) || (!fits(&to) && fits(&from)) {
            continue;
        }
        if let Ok(moved) = world.with_start(to, yaw_rad) {
            return Ok(moved);
        }
    }
    let [x_m, y_m, z_m] = from.coords.into();
    Err(WorldError::StartInSpace { x_m, y_m, z_m }.into())
}
