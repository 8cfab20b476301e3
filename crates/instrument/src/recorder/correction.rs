//! Corrections: the pose graph before and after, and what the optimisation cost.

use geometry::Point2;
use maps2d::correction::CorrectionEvent;
use pose::Se2;
use probe::Probe;
use rerun::RecordingStream;

use super::Recorder;
use crate::columns::{Lines, Now};
use crate::{Family, InstrumentError, palette};

/// Rows of `graph/corrected/..`: the trajectory before the last correction, and now.
pub(super) struct Corrected {
    before: Lines,
    after: Lines,
    plots: Option<Plots>,
    is_new: bool,
}

/// What is plotted of a correction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plots {
    pub iterations: usize,
    pub moved_max_m: f64,
}

impl Corrected {
    pub fn new(name: &str) -> Self {
        Self {
            before: Lines::new(format!("{name}/graph/corrected/before"), -0.7, 6.0),
            after: Lines::new(format!("{name}/graph/corrected/after"), -1.2, 13.0),
            plots: None,
            is_new: false,
        }
    }

    fn take(&mut self, before: &[Se2], after: &[Se2], plots: Plots) {
        // Of several corrections in one step the last is drawn.
        self.before.forget();
        self.after.forget();
        let at = |pose: &Se2| Point2::from(pose.translation);
        self.before.strip(before.iter().map(at), palette::BEFORE);
        self.after.strip(after.iter().map(at), palette::CORRECTED);
        self.plots = Some(plots);
        self.is_new = true;
    }

    /// What the last correction of this step came to, once.
    pub fn take_plots(&mut self) -> Option<Plots> {
        self.plots.take()
    }

    /// Leaves the step out.
    pub fn skip_step(&mut self) {
        self.before.forget();
        self.after.forget();
        self.is_new = false;
    }

    /// Ends the step; what was drawn stays until the next correction.
    pub fn end_step(&mut self, now: &Now) {
        if std::mem::take(&mut self.is_new) {
            self.before.end_row(now);
            self.after.end_row(now);
        }
    }

    pub fn held_bytes(&self) -> usize {
        self.before.held_bytes() + self.after.held_bytes()
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        self.before.send(stream)?;
        self.after.send(stream)
    }
}

impl Probe<CorrectionEvent<'_>> for Recorder {
    /// Also at `summary`: the corrected graph is part of it.
    fn on(&self) -> bool {
        self.inner.is_some()
    }

    fn emit(&mut self, event: CorrectionEvent<'_>) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        let now = inner.now;
        if let CorrectionEvent::Corrected { before, after, moved_max_m, report, .. } = event {
            let plots = Plots { iterations: report.iterations.len(), moved_max_m };
            inner.corrected.take(before, after, plots);
            inner.places.correct(after);
        }
        if !inner.full(Family::Correction) {
            return;
        }
        let happened = &mut inner.happened;
        let variant = event.variant();
        match event {
            CorrectionEvent::Corrected {
                new_places,
                factors,
                before,
                after,
                moved_max_m,
                report,
                ..
            } => {
                for (from, to) in before.iter().zip(after) {
                    let (from, to) = (Point2::from(from.translation), Point2::from(to.translation));
                    happened.lines.segment(&from, &to, palette::CORRECTED);
                }
                let (count, ended) = (after.len(), report.termination.name());
                let iterations = report.iterations.len();
                let (chi2_before, chi2) = (report.chi2_initial, report.chi2);
                happened.event(
                    Family::Correction,
                    variant,
                    format_args!(
                        "{new_places} places: {count} vertices, {factors} factors, {iterations} \
                         iterations ({ended}), chi2 {chi2_before:.4} to {chi2:.4}, moved by up to \
                         {moved_max_m:.3} m"
                    ),
                    &now,
                );
            }
            CorrectionEvent::Refused { report } => {
                let ended = report.termination.name();
                let line = format_args!("poses stay as they are: the optimiser ended as {ended}");
                happened.event(Family::Correction, variant, line, &now);
            }
        }
    }
}
