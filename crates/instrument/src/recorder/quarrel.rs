//! Where maps that one robot feeds first disagree about a frontier, for each cause.

use geometry::Point2;
use rerun::RecordingStream;

use super::Recorder;
use crate::columns::{EventTexts, Labels, Lines, Now, rgb};
use crate::{Centre, InstrumentError, palette};

/// A frontier that one map sees where another believes to know what lies behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quarrel<'a> {
    /// The frontier where it truly is, world frame, metres.
    pub at_in_world: Point2,
    /// The frontier as the robot sees it, body frame, metres.
    pub at_in_body: Point2,
    /// What to write beside its mark.
    pub label: &'a str,
    /// Who says what, and why, in a line.
    pub text: &'a str,
}

/// How large a ring is drawn around it, metres.
const RING_M: f64 = 1.5;

/// Rows of `truth/disagreement`, `belief/disagreement` and `events/comparison`.
pub(super) struct Quarrels {
    in_truth: Lines,
    label: Labels,
    in_belief: Lines,
    text: EventTexts,
    /// Whether the belief's frame stays where it is, so that the ring may.
    stays: bool,
    /// The marks so far: those in the truth all stay.
    marked: Vec<Point2>,
}

impl Quarrels {
    pub fn new(name: &str, centre: Centre) -> Self {
        Self {
            in_truth: Lines::new(format!("{name}/truth/disagreement"), -2.0, 60.0),
            label: Labels::new(format!("{name}/truth/disagreement/label"), 61.0),
            in_belief: Lines::new(format!("{name}/belief/disagreement"), -2.0, 60.0),
            text: EventTexts::new(&format!("{name}/events/comparison"), rgb(255, 255, 255)),
            stays: centre == Centre::Start,
            marked: Vec::new(),
        }
    }

    fn take(&mut self, quarrel: &Quarrel<'_>, at_in_belief: &Point2, now: &Now) {
        self.marked.push(quarrel.at_in_world);
        self.marked.iter().for_each(|at| ring(&mut self.in_truth, at));
        self.in_truth.end_row(now);
        let above = quarrel.at_in_world + geometry::Vector2::new(0.0, RING_M);
        self.label.put(&above, quarrel.label, palette::QUARREL, now);
        ring(&mut self.in_belief, at_in_belief);
        self.in_belief.end_row(now);
        self.text.push("Disagreed", format_args!("{}", quarrel.text), now);
    }

    /// Before a step is drawn: in a frame that moves with the robot the ring is gone again.
    pub fn begin_step(&mut self, now: &Now) {
        if !self.stays {
            self.in_belief.end_row(now);
        }
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.in_truth.send(stream)?;
        self.label.send(stream)?;
        self.in_belief.send(stream)?;
        self.text.send(stream)
    }
}

fn ring(lines: &mut Lines, around: &Point2) {
    let corners = (0..=32).map(|i| {
        let (sin, cos) = (f64::from(i) / 32.0 * std::f64::consts::TAU).sin_cos();
        Point2::new(around.x + RING_M * cos, around.y + RING_M * sin)
    });
    lines.strip(corners, palette::QUARREL);
}

impl Recorder {
    /// Marks where the beliefs of several maps first part: a ring in the truth and in this map's
    /// belief, and a line of text. After the step's [`end_step`](Self::end_step) it is too late.
    pub fn disagreed(&mut self, standing: &maps2d::Standing, quarrel: &Quarrel<'_>) {
        if let Some(inner) = &mut self.inner {
            let at = inner.places.of_body(standing).transform(&quarrel.at_in_body);
            inner.quarrels.take(quarrel, &at, &inner.now);
        }
    }
}
