//! The recording as a whole: its file, what it says about itself, and its end.

use std::path::PathBuf;

use rerun::log::LogMsg;
use rerun::{AnnotationContext, RecordingStream, RecordingStreamBuilder, TextDocument};

use crate::columns::{fixed, rgb};
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
    stream: RecordingStream,
    options: RecordingOptions,
}

impl Recording {
    /// Creates the file, with the layout, the text page and the config; at [`Level::Off`] nothing.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: RecordingOptions) -> Result<Self, InstrumentError> {
        if options.level == Level::Off {
            return Ok(Self { stream: RecordingStream::disabled(), options });
        }
        let refuse = |reason: String| InstrumentError::Write { path: options.path.clone(), reason };
        // A viewer that has seen another run must not mix the two: one id per file.
        let stream = RecordingStreamBuilder::new("driftlab")
            .recording_name(options.name.clone())
            .save(&options.path)
            .map_err(|e| refuse(e.to_string()))?;
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        layout::send(&stream, &options).map_err(refuse)?;
        let recording = Self { stream, options };
        recording.describe()?;
        recording.flush()?;
        Ok(recording)
    }

    fn describe(&self) -> Result<(), InstrumentError> {
        let (stream, options) = (&self.stream, &self.options);
        let about = TextDocument::from_markdown(layout::about(options));
        fixed(stream, &ABOUT.into(), &about)?;
        let config = format!("```toml\n{}\n```\n", options.config.trim_end());
        fixed(stream, &CONFIG.into(), &TextDocument::from_markdown(config))?;
        let classes = palette::CELL_CLASSES.map(|(id, label, colour)| {
            let colour = rerun::datatypes::Rgba32(colour);
            rerun::AnnotationInfo::from((u16::from(id), label, colour))
        });
        fixed(stream, &"/".into(), &AnnotationContext::new(classes))
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
        Recorder::new(self.stream.clone(), &map, colour, self.options.level, self.options.every)
    }

    /// Writes everything that was sent so far to the file; the wait is that of the disk.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file could not be written.
    pub fn flush(&self) -> Result<(), InstrumentError> {
        if self.options.level == Level::Off {
            return Ok(());
        }
        self.stream.flush_blocking().map_err(|e| InstrumentError::Write {
            path: self.options.path.clone(),
            reason: e.to_string(),
        })
    }

    /// Ends the recording with its final metrics; all recorders must have sent their rows.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file could not be written.
    pub fn finish(self, metrics: &serde_json::Value) -> Result<(), InstrumentError> {
        if self.options.level == Level::Off {
            return Ok(());
        }
        let json = TextDocument::new(metrics.to_string()).with_media_type("application/json");
        fixed(&self.stream, &METRICS.into(), &json)?;
        let table = TextDocument::from_markdown(layout::result(metrics));
        fixed(&self.stream, &RESULT.into(), &table)?;
        self.flush()?;
        // Recorders may still hold the stream: only this ends the file properly.
        self.stream.disconnect();
        Ok(())
    }
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
