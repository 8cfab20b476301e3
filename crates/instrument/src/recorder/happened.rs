//! Every event in order: one line of text each, and what it drew.

use rerun::RecordingStream;

use crate::columns::{EventTexts, Lines, Now, Points};
use crate::{Family, InstrumentError, columns};

/// Rows of `events/<family>` and of `belief/event`, which draws the event at hand.
pub(super) struct Happened {
    texts: [EventTexts; 7],
    pub lines: Lines,
    pub points: Points,
}

impl Happened {
    pub fn new(name: &str) -> Self {
        let text = |family: Family, colour| {
            EventTexts::new(&format!("{name}/events/{}", family.name()), colour)
        };
        Self {
            texts: [
                text(Family::Sensing, columns::rgb(120, 190, 255)),
                text(Family::PoseGraph, columns::rgb(255, 120, 190)),
                text(Family::Consolidation, columns::rgb(255, 170, 80)),
                text(Family::Grid, columns::rgb(150, 220, 150)),
                text(Family::Planner, columns::rgb(230, 230, 120)),
                text(Family::Correction, columns::rgb(200, 150, 255)),
                text(Family::Polygons, columns::rgb(120, 220, 210)),
            ],
            lines: Lines::new(format!("{name}/belief/event/lines"), -2.4, 50.0),
            points: Points::new(format!("{name}/belief/event/points"), -4.0, 51.0),
        }
    }

    /// Writes an event down; what was drawn before into `lines` and `points` belongs to it.
    pub fn event(
        &mut self,
        family: Family,
        variant: &'static str,
        line: std::fmt::Arguments<'_>,
        now: &Now,
    ) {
        if let Some(texts) = self.texts.get_mut(family as usize) {
            texts.push(variant, line, now);
        }
        self.lines.end_row(now);
        self.points.end_row(now);
    }

    pub fn held_bytes(&self) -> usize {
        self.texts.iter().map(EventTexts::held_bytes).sum::<usize>()
            + self.lines.held_bytes()
            + self.points.held_bytes()
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.texts.iter_mut().try_for_each(|texts| texts.send(stream))?;
        self.lines.send(stream)?;
        self.points.send(stream)
    }
}
