//! The recording as a whole: its file, what it says about itself, and its end.

use std::path::PathBuf;

use rerun::log::LogMsg;
use rerun::{AnnotationContext, RecordingStream};

use crate::columns::{fixed, rgb};
use crate::stage::Stage;
use crate::{InstrumentError, Level, Recorder, RecordingOptions, layout, palette};

/// Where the recording keeps what it says about itself.
pub(crate) const ABOUT: &str = "about";
pub(crate) const CONFIG: &str = "config";
pub(crate) const RESULT: &str = "result";
/// Where the final metrics are, as JSON.
pub(crate) const METRICS: &str = "result/metrics";

/// One recording: one file, shared by the recorders of all maps of a run.
///
/// The file grows under its final name and opens in the viewer with everything that was sent so
/// far, even when the process was killed. [`finish`](Self::finish) adds the final metrics.
pub struct Recording {
    /// None where nothing is recorded.
    stage: Option<Stage>,
    options: RecordingOptions,
}

impl Recording {
    /// Creates the file, with the layout, the text page and the config; at [`Level::Off`] nothing.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: RecordingOptions) -> Result<Self, InstrumentError> {
        if options.level == Level::Off {
            return Ok(Self { stage: None, options });
        }
        let stage = Stage::create(&options.path, &options.name)?;
        layout::send(&stage.stream, &options).map_err(|reason| stage.refused(reason))?;
        describe(&stage, &options)?;
        stage.flush()?;
        Ok(Self { stage: Some(stage), options })
    }

    /// The file.
    pub fn path(&self) -> &PathBuf {
        &self.options.path
    }

    /// A recorder for a map of the options; an unknown name gets one too, but no views.
    pub fn recorder(&self, name: &str) -> Recorder {
        let known = self.options.maps.iter().position(|map| map.name == name);
        let map = known
            .map_or_else(|| crate::MapOptions::of_kind(name), |at| self.options.maps[at].clone());
        let colour = known.map_or(rgb(80, 80, 80), |at| palette::MAPS[at % palette::MAPS.len()]);
        let stream =
            self.stage.as_ref().map_or_else(RecordingStream::disabled, |s| s.stream.clone());
        Recorder::new(stream, &map, colour, self.options.level, self.options.every)
    }

    /// Writes everything that was sent so far to the file; the wait is that of the disk.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file could not be written.
    pub fn flush(&self) -> Result<(), InstrumentError> {
        self.stage.as_ref().map_or(Ok(()), Stage::flush)
    }

    /// Ends the recording with its final metrics; all recorders must have sent their rows.
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

/// Sends what the recording says about itself: a page, the config, the classes of cells.
fn describe(stage: &Stage, options: &RecordingOptions) -> Result<(), InstrumentError> {
    stage.about(layout::about(options))?;
    stage.text(CONFIG, format!("```toml\n{}\n```\n", options.config.trim_end()))?;
    let classes = palette::CELL_CLASSES.map(|(id, label, colour)| {
        let colour = rerun::datatypes::Rgba32(colour);
        rerun::AnnotationInfo::from((u16::from(id), label, colour))
    });
    fixed(&stage.stream, &"/".into(), &AnnotationContext::new(classes))
}

/// The messages that make up a layout, and the id of its store.
pub(crate) fn send_layout(stream: &RecordingStream, messages: Vec<LogMsg>) {
    let id = messages.iter().find_map(|message| match message {
        LogMsg::SetStoreInfo(info) => Some(info.info.store_id.clone()),
        _ => None,
    });
    if let Some(blueprint_id) = id {
        let activation = rerun::external::re_log_types::BlueprintActivationCommand {
            blueprint_id,
            make_active: true,
            make_default: true,
        };
        stream.send_blueprint(messages, activation);
    }
}
