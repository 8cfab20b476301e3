//! A drawing that only ever grows, at a cost per step that does not grow with it.

use geometry::Point2;
use rerun::RecordingStream;

use super::{Lines, Now, Points, Rgba};
use crate::InstrumentError;

/// What a growing drawing consists of: straight lines, or points.
pub(crate) trait Strokes {
    /// Draws one item; a point is drawn where the line starts.
    fn draw(&mut self, from: &Point2, to: &Point2, colour: Rgba);
    /// Ends the row.
    fn end_row(&mut self, now: &Now);
    /// Size of what is held, bytes.
    fn held_bytes(&self) -> usize;
    /// Sends what is held.
    fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError>;
}

impl Strokes for Lines {
    fn draw(&mut self, from: &Point2, to: &Point2, colour: Rgba) {
        self.segment(from, to, colour);
    }
    fn end_row(&mut self, now: &Now) {
        Lines::end_row(self, now);
    }
    fn held_bytes(&self) -> usize {
        Lines::held_bytes(self)
    }
    fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        Lines::send(self, stream)
    }
}

impl Strokes for Points {
    fn draw(&mut self, from: &Point2, _to: &Point2, colour: Rgba) {
        self.point(from, colour);
    }
    fn end_row(&mut self, now: &Now) {
        Points::end_row(self, now);
    }
    fn held_bytes(&self) -> usize {
        Points::held_bytes(self)
    }
    fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        Points::send(self, stream)
    }
}

/// Items of the first part before it is handed on to the second.
const FIRST: usize = 16;

type Item = (Point2, Point2, Rgba);

struct Part<R> {
    rows: R,
    items: Vec<Item>,
    dirty: bool,
}

/// Items in parts of doubling size, each an entity of its own (`path/0`, `path/1`, ...): a row
/// repeats one part only, so n items cost O(n log n) rows in all, and at every step the latest rows
/// of all parts together are everything that was added (the logarithmic method of Bentley and Saxe).
pub(crate) struct Growing<R> {
    parts: Vec<Part<R>>,
    new_rows: Box<dyn Fn(usize) -> R + Send>,
}

impl<R: Strokes> Growing<R> {
    /// Nothing yet; `new_rows` opens the entity of the part of a number.
    pub fn new(new_rows: impl Fn(usize) -> R + Send + 'static) -> Self {
        Self { parts: Vec::new(), new_rows: Box::new(new_rows) }
    }

    /// Adds an item.
    pub fn push(&mut self, from: &Point2, to: &Point2, colour: Rgba) {
        self.part(0).items.push((*from, *to, colour));
        if self.parts[0].items.len() < FIRST {
            return;
        }
        let mut carried = std::mem::take(&mut self.parts[0].items);
        for level in 1.. {
            let part = self.part(level);
            if part.items.is_empty() {
                part.items = carried;
                return;
            }
            // Older items first, so that newer ones are drawn over them.
            let mut older = std::mem::take(&mut part.items);
            older.append(&mut carried);
            carried = older;
        }
    }

    fn part(&mut self, level: usize) -> &mut Part<R> {
        if level == self.parts.len() {
            let rows = (self.new_rows)(level);
            self.parts.push(Part { rows, items: Vec::new(), dirty: false });
        }
        let part = &mut self.parts[level];
        part.dirty = true;
        part
    }

    /// Ends the row of every part that changed.
    pub fn end_row(&mut self, now: &Now) {
        for part in self.parts.iter_mut().filter(|part| part.dirty) {
            for (from, to, colour) in &part.items {
                part.rows.draw(from, to, *colour);
            }
            part.rows.end_row(now);
            part.dirty = false;
        }
    }

    /// Size of what is held, bytes.
    pub fn held_bytes(&self) -> usize {
        self.parts.iter().map(|part| part.rows.held_bytes()).sum()
    }

    /// Sends what is held.
    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.parts.iter_mut().try_for_each(|part| part.rows.send(stream))
    }
}
