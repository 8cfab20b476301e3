//! A config made ready to fly: place, voxels that count, robots.

use metrics::{VoxelCoverage, VoxelParams};
use worlds::{FlyerParams, SimFlyer, WorldError};

use super::{FlightPlace, build_flight_place};
use crate::config::{Config, ConfigError, Loaded};
use crate::run::robots_of;

/// Everything that a flight needs, checked; nothing was written yet.
#[derive(Clone, Debug)]
pub struct FlightExperiment {
    /// The config, with absolute file names.
    pub config: Config,
    /// The place.
    pub place: FlightPlace,
    /// Which voxels of it count; nothing seen yet.
    pub coverage: VoxelCoverage,
}

impl FlightExperiment {
    /// Reads the mesh or generates the place, and settles which of its voxels count.
    ///
    /// # Errors
    /// [`ConfigError`] with the line of the config.
    pub fn prepare(loaded: &Loaded) -> Result<Self, ConfigError> {
        let mut config = loaded.anchored();
        // One run has nothing to sweep.
        config.sweep = None;
        let place = build_flight_place(loaded)?;
        let params = FlyerParams::from(&config);
        let at =
            |key: &str, message: String| ConfigError::World { place: loaded.place(key), message };
        // Refused before anything is written: a robot that cannot start.
        SimFlyer::new(place.world.clone(), params.clone(), config.seed).map_err(|error| {
            let key = match &error {
                WorldError::StartTooTight { .. } => "robot.radius_m",
                _ => "camera",
            };
            at(key, error.to_string())
        })?;
        let judged = config.metrics3d.as_ref().map_or_else(VoxelParams::default, Into::into);
        let coverage = VoxelCoverage::new(&place.world, &params.camera, params.radius_m, judged)
            .map_err(|error| at("metrics3d.cell_m", error.to_string()))?;
        Ok(Self { config, place, coverage })
    }

    /// The maps of each robot; the first of a robot's maps steers it.
    pub fn robots(&self) -> Vec<Vec<&'static str>> {
        robots_of(&self.config)
    }
}
