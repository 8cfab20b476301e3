//! From held rows to a chunk of the recording.

use rerun::external::arrow::array::ArrayRef;
use rerun::external::re_sdk_types::SerializedComponentBatch;
use rerun::{ComponentDescriptor, EntityPath, RecordingStream};

use super::Times;
use crate::InstrumentError;

/// One component of the held rows: all instances end to end, and how many belong to each row.
pub(crate) struct Column {
    pub descriptor: ComponentDescriptor,
    pub instances: ArrayRef,
    pub lengths: Vec<usize>,
}

/// The lengths of the stretches that end at `ends`.
pub(crate) fn lengths(ends: &[i32]) -> Vec<usize> {
    let starts = std::iter::once(&0).chain(ends);
    starts.zip(ends).map(|(from, to)| (to - from) as usize).collect()
}

/// Sends the held rows of an entity as one chunk; does nothing where none are held.
pub(crate) fn send(
    stream: &RecordingStream,
    path: &EntityPath,
    times: &mut Times,
    columns: impl IntoIterator<Item = Column>,
) -> Result<(), InstrumentError> {
    if times.len() == 0 {
        return Ok(());
    }
    let refuse = |reason: String| InstrumentError::Rows { entity: path.to_string(), reason };
    let mut sent = Vec::new();
    for Column { descriptor, instances, lengths } in columns {
        let batch = SerializedComponentBatch::new(instances, descriptor);
        sent.push(batch.partitioned(lengths).map_err(|e| refuse(e.to_string()))?);
    }
    stream.send_columns(path.clone(), times.take(), sent).map_err(|e| refuse(e.to_string()))
}

/// Sends what holds at all times: how an entity looks, or a text.
pub(crate) fn fixed(
    stream: &RecordingStream,
    path: &EntityPath,
    what: &dyn rerun::AsComponents,
) -> Result<(), InstrumentError> {
    stream
        .log_static(path.clone(), what)
        .map_err(|e| InstrumentError::Rows { entity: path.to_string(), reason: e.to_string() })
}
