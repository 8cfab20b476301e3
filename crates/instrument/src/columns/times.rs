//! The four timelines.

use rerun::TimeColumn;

/// Where a row stands on every timeline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Now {
    pub step: i64,
    pub distance_mm: i64,
    pub sim_time_ns: i64,
    pub event: i64,
}

/// The times of the rows of one entity.
#[derive(Clone, Debug, Default)]
pub(crate) struct Times {
    step: Vec<i64>,
    distance_mm: Vec<i64>,
    sim_time_ns: Vec<i64>,
    event: Vec<i64>,
}

impl Times {
    pub fn push(&mut self, now: &Now) {
        self.step.push(now.step);
        self.distance_mm.push(now.distance_mm);
        self.sim_time_ns.push(now.sim_time_ns);
        self.event.push(now.event);
    }

    pub fn pop(&mut self) {
        self.step.pop();
        self.distance_mm.pop();
        self.sim_time_ns.pop();
        self.event.pop();
    }

    pub fn len(&self) -> usize {
        self.step.len()
    }

    /// The step of the last row, if it is still held.
    pub fn last_step(&self) -> Option<i64> {
        self.step.last().copied()
    }

    /// Hands out the columns and starts anew.
    pub fn take(&mut self) -> [TimeColumn; 4] {
        let Self { step, distance_mm, sim_time_ns, event } = std::mem::take(self);
        let duration = rerun::Timeline::new("sim_time", rerun::time::TimeType::DurationNs);
        [
            TimeColumn::new_sequence("step", step),
            TimeColumn::new_sequence("distance_mm", distance_mm),
            TimeColumn::new(None, duration, sim_time_ns.into()),
            TimeColumn::new_sequence("event", event),
        ]
    }
}
