//! A config made ready to run: place, coverage, robots.

use metrics::Coverage;

use super::{Place, build_place};
use crate::config::{Config, ConfigError, Loaded};

/// Everything that a run needs, checked; nothing was written yet.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// The config, with absolute file names.
    pub config: Config,
    /// The place.
    pub place: Place,
    /// Which cells of it count; nothing seen yet.
    pub coverage: Coverage,
}

impl Experiment {
    /// Reads the map files and builds the place.
    ///
    /// # Errors
    /// [`ConfigError`] with the line of the config.
    pub fn prepare(loaded: &Loaded) -> Result<Self, ConfigError> {
        let mut config = loaded.anchored();
        // One run has nothing to sweep.
        config.sweep = None;
        let place = build_place(loaded)?;
        let coverage = Coverage::new(&place.world, (&config.metrics).into()).map_err(|error| {
            let key = if config.metrics.grid.is_some() { "metrics.grid" } else { "metrics.cell_m" };
            ConfigError::World { place: loaded.place(key), message: error.to_string() }
        })?;
        Ok(Self { config, place, coverage })
    }

    /// The maps of each robot; the first of a robot's maps steers it.
    pub fn robots(&self) -> Vec<Vec<&'static str>> {
        robots_of(&self.config)
    }
}

/// The maps of each robot of an experiment; the first of a robot's maps steers it.
pub(crate) fn robots_of(config: &Config) -> Vec<Vec<&'static str>> {
    let maps = config.map_keys();
    match maps.iter().find(|&&map| map == config.compare.drive) {
        None => maps.into_iter().map(|map| vec![map]).collect(),
        Some(&driver) => {
            let others = maps.iter().copied().filter(|&map| map != driver);
            vec![std::iter::once(driver).chain(others).collect()]
        }
    }
}
