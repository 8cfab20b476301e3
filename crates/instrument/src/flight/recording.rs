//! The recording of a flight as a whole: its file, what it says about itself, and its end.

use super::{FlightOptions, FlightRecorder, page};
use crate::columns::fixed;
use crate::recording::{CONFIG, RESULT};
use crate::stage::Stage;
use crate::{InstrumentError, Level, layout, palette};

/// The numbers that are plotted for each map.
pub(crate) const FLIGHT_PLOTS: [(&str, &str); 7] = [
    ("coverage", "coverage"),
    ("frontier_open_m2", "open frontier, m²"),
    ("frontier_ignored_m2", "ignored frontier, m²"),
    ("map_faces", "faces of the map"),
    ("odometry_error_m", "odometry error, m"),
    ("views_in_scope", "views in scope"),
    ("distance_m", "distance, m"),
];

/// One recording of a flight: one file, shared by the recorders of all maps.
///
/// The file grows under its final name and opens in the viewer with everything that was sent so far, even
/// when the process was killed.
pub struct FlightRecording {
    /// None where nothing is recorded.
    stage: Option<Stage>,
    options: FlightOptions,
}

impl FlightRecording {
    /// Creates the file, with the layout, the text page and the config; at [`Level::Off`] nothing.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: FlightOptions) -> Result<Self, InstrumentError> {
        if options.level == Level::Off {
            return Ok(Self { stage: None, options });
        }
        let stage = Stage::create(&options.path, &options.name)?;
        layout::send_flight(&stage.stream, &options).map_err(|reason| stage.refused(reason))?;
        stage.about(page::about(&options))?;
        stage.text(CONFIG, format!("```toml\n{}\n```\n", options.config.trim_end()))?;
        fixed(&stage.stream, &"/".into(), &rerun::ViewCoordinates::RIGHT_HAND_Z_UP())?;
        for (at, map) in options.maps.iter().enumerate() {
            let colour = palette::MAPS[at % palette::MAPS.len()];
            let titles = FLIGHT_PLOTS
                .map(|(name, title)| (format!("{map}/{name}"), format!("{map}: {title}")));
            let looks = titles.iter().map(|(name, title)| (name.as_str(), title.as_str(), colour));
            stage.looks(looks)?;
        }
        stage.flush()?;
        Ok(Self { stage: Some(stage), options })
    }

    /// A recorder for a map of the options.
    pub fn recorder(&self, name: &str) -> FlightRecorder {
        FlightRecorder::new(self.stage.clone(), name, &self.options)
    }

    /// Ends the recording with its final metrics.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file could not be written.
    pub fn finish(self, metrics: &serde_json::Value) -> Result<(), InstrumentError> {
        let Some(stage) = &self.stage else { return Ok(()) };
        stage.metrics(metrics)?;
        stage.text(RESULT, layout::result(metrics))?;
        // Recorders may still hold the stream: only this ends the file properly.
        stage.end()
    }
}
