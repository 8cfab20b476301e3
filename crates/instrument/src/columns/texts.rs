//! Events as rows of text: which variant, and what it says in one line.

use std::fmt::Write as _;
use std::sync::{Arc, LazyLock};

use rerun::external::arrow::array::StringArray;
use rerun::external::arrow::buffer::{Buffer, OffsetBuffer, ScalarBuffer};
use rerun::{ComponentDescriptor, EntityPath, RecordingStream, TextLog};

use super::send::Column;
use super::{Now, Rgba, Times, fixed, send};
use crate::InstrumentError;

/// The component that names the variant of an event.
pub(crate) static VARIANT: LazyLock<ComponentDescriptor> = LazyLock::new(|| ComponentDescriptor {
    archetype: Some("driftlab.Event".into()),
    component: "Event:variant".into(),
    component_type: Some("rerun.components.Text".into()),
});

/// Held rows of the events of one family.
pub(crate) struct EventTexts {
    path: EntityPath,
    /// Until it is sent.
    colour: Option<Rgba>,
    times: Times,
    variants: Vec<&'static str>,
    text: String,
    text_ends: Vec<i32>,
}

impl EventTexts {
    /// No rows yet.
    pub fn new(path: &str, colour: Rgba) -> Self {
        Self {
            path: path.into(),
            colour: Some(colour),
            times: Times::default(),
            variants: Vec::new(),
            text: String::new(),
            text_ends: vec![0],
        }
    }

    /// Adds an event; `line` is what it says after its name.
    pub fn push(&mut self, variant: &'static str, line: std::fmt::Arguments<'_>, now: &Now) {
        self.variants.push(variant);
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{variant}: {line}");
        self.text_ends.push(self.text.len() as i32);
        self.times.push(now);
    }

    /// Size of what is held, bytes.
    pub fn held_bytes(&self) -> usize {
        self.text.len() + self.times.len() * 64
    }

    /// Sends what is held.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        let rows = self.variants.len();
        if rows == 0 {
            return Ok(());
        }
        if let Some(colour) = self.colour.take() {
            let look = TextLog::update_fields().with_color(rerun::Color::from_u32(colour));
            fixed(stream, &self.path, &look)?;
        }
        let ends = std::mem::replace(&mut self.text_ends, vec![0]);
        let texts = StringArray::new(
            OffsetBuffer::new(ScalarBuffer::from(ends)),
            Buffer::from_vec(std::mem::take(&mut self.text).into_bytes()),
            None,
        );
        let variants = StringArray::from(std::mem::take(&mut self.variants));
        let columns = [
            Column {
                descriptor: VARIANT.clone(),
                instances: Arc::new(variants),
                lengths: vec![1; rows],
            },
            Column {
                descriptor: TextLog::descriptor_text(),
                instances: Arc::new(texts),
                lengths: vec![1; rows],
            },
        ];
        send(stream, &self.path, &mut self.times, columns)
    }
}
