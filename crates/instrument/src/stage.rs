//! What every recording stands on: its file, lines about events, plots, and its end.

use std::fmt::Arguments;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rerun::external::arrow::array::StringArray;
use rerun::external::re_sdk_types::SerializedComponentBatch;
use rerun::{
    AsComponents as _, RecordingStream, RecordingStreamBuilder, Scalars, SeriesLines, TextDocument,
    TextLog,
};

use crate::InstrumentError;
use crate::columns::{Rgba, VARIANT, fixed};
use crate::recording::{ABOUT, METRICS, RESULT};

/// A recording's stream, and the file that it goes to.
#[derive(Clone)]
pub(crate) struct Stage {
    pub stream: RecordingStream,
    path: PathBuf,
}

impl Stage {
    /// Creates the file, under its final name. Times are those of the work, never of a clock.
    pub fn create(path: &Path, name: &str) -> Result<Self, InstrumentError> {
        // A viewer that has seen another run must not mix the two: one id per file.
        let stream = RecordingStreamBuilder::new("driftlab").recording_name(name).save(path);
        let stream = stream
            .map_err(|e| InstrumentError::Write { path: path.to_owned(), reason: e.to_string() })?;
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        Ok(Self { stream, path: path.to_owned() })
    }

    /// Why the file could not be written.
    pub fn refused(&self, reason: String) -> InstrumentError {
        InstrumentError::Write { path: self.path.clone(), reason }
    }

    /// Shows a text (Markdown) at all times.
    pub fn text(&self, entity: &str, text: impl Into<String>) -> Result<(), InstrumentError> {
        fixed(&self.stream, &entity.into(), &TextDocument::from_markdown(text.into()))
    }

    /// Shows the text that a reader meets first.
    pub fn about(&self, text: impl Into<String>) -> Result<(), InstrumentError> {
        self.text(ABOUT, text)
    }

    /// Says how plotted numbers look: name, title, colour.
    pub fn looks<'p>(
        &self,
        plots: impl IntoIterator<Item = (&'p str, &'p str, Rgba)>,
    ) -> Result<(), InstrumentError> {
        for (name, title, colour) in plots {
            let look = SeriesLines::new()
                .with_names([title])
                .with_colors([rerun::Color::from_u32(colour)])
                .with_widths([2.0]);
            fixed(&self.stream, &format!("plots/{name}").as_str().into(), &look)?;
        }
        Ok(())
    }

    /// Logs a line of text, and sees that it is in the file before anything else.
    pub fn open_with(&self, entity: &str, line: &str) -> Result<(), InstrumentError> {
        let sent = self.stream.log(entity, &TextLog::new(line));
        sent.map_err(|error| InstrumentError::Rows {
            entity: entity.to_owned(),
            reason: error.to_string(),
        })?;
        self.stream.flush_blocking().map_err(|error| self.refused(error.to_string()))
    }

    /// Logs an event at `entity`: its name as data, and one line of text.
    pub fn say(
        &self,
        entity: &str,
        variant: &'static str,
        line: Arguments<'_>,
    ) -> Result<(), InstrumentError> {
        let mut batches = TextLog::new(format!("{variant}: {line}")).as_serialized_batches();
        let name = Arc::new(StringArray::from(vec![variant]));
        batches.push(SerializedComponentBatch::new(name, VARIANT.clone()));
        let sent = self.stream.log_serialized_batches(entity, false, batches);
        sent.map_err(|error| InstrumentError::Rows {
            entity: entity.to_owned(),
            reason: error.to_string(),
        })
    }

    /// Plots a number, if it is one.
    pub fn plot(&self, name: &str, value: f64) -> Result<(), InstrumentError> {
        if !value.is_finite() {
            return Ok(());
        }
        let entity = format!("plots/{name}");
        self.stream.log(entity.as_str(), &Scalars::single(value)).map_err(|error| {
            InstrumentError::Rows { entity: entity.clone(), reason: error.to_string() }
        })
    }

    /// Writes everything that was sent so far to the file; the wait is that of the disk.
    pub fn flush(&self) -> Result<(), InstrumentError> {
        self.stream.flush_blocking().map_err(|e| self.refused(e.to_string()))
    }

    /// Keeps the final metrics as JSON.
    pub fn metrics(&self, metrics: &serde_json::Value) -> Result<(), InstrumentError> {
        let json = TextDocument::new(metrics.to_string()).with_media_type("application/json");
        fixed(&self.stream, &METRICS.into(), &json)
    }

    /// Ends the file with its result (Markdown) and its metrics, unless something was refused before.
    pub fn finish(
        &self,
        refusal: Option<InstrumentError>,
        result: String,
        metrics: &serde_json::Value,
    ) -> Result<(), InstrumentError> {
        if let Some(refusal) = refusal {
            return Err(refusal);
        }
        self.text(RESULT, result)?;
        self.metrics(metrics)?;
        self.end()
    }

    /// Ends the file properly, even where others still hold the stream.
    pub fn end(&self) -> Result<(), InstrumentError> {
        self.flush()?;
        self.stream.disconnect();
        Ok(())
    }
}
