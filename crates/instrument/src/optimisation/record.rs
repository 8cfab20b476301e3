//! The listener of an optimiser.

use std::path::PathBuf;

use posegraph::{FactorGraph, Iteration, Manifold, OptimizerEvent, Report};
use probe::Probe;
use rerun::{AnyValues, BarChart};

use super::draw::{self, DrawnPose, REJECTED, Strokes};
use super::page;
use crate::columns::{Rgba, eye, fixed, rgb};
use crate::recording::RESULT;
use crate::stage::Stage;
use crate::{InstrumentError, layout, palette};

/// The names of the events of an optimiser.
pub const OPTIMIZER_EVENTS: [&str; 3] = ["Started", "Iterated", "Finished"];

/// An edge that weighs less is drawn as rejected.
const REJECTED_BELOW: f64 = 0.5;

/// Drawings of all iterations together take about this many bytes at most.
const DRAWN_BYTES: usize = 48 << 20;

/// What the recording of an optimisation says about itself.
#[derive(Clone, Debug)]
pub struct OptimisationOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// The name of the graph.
    pub name: String,
    /// What is done to it, in words (Markdown).
    pub about: String,
}

/// The recording of one optimisation, or of several in a row: a probe for `optimize_with`.
///
/// On the timeline `iteration`, 0 is the start. Where a robust method optimises several times, the
/// count goes on. Of graphs whose drawings would take more than about 48 MB only some iterations are
/// drawn, the last among them; plots and events are complete.
pub struct OptimisationRecording<'a, P, const D: usize> {
    stage: Stage,
    options: OptimisationOptions,
    graph: &'a FactorGraph<P, D>,
    /// On the timeline; none yet before the first event.
    iteration: Option<i64>,
    drawn: bool,
    weights: Vec<f64>,
    last: Option<(Vec<P>, Vec<f64>)>,
    /// The first refusal, which ends the recording.
    refusal: Option<InstrumentError>,
}

impl<'a, P: Manifold<D> + DrawnPose, const D: usize> OptimisationRecording<'a, P, D> {
    /// Creates the file with its layout and text page.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(
        graph: &'a FactorGraph<P, D>,
        options: OptimisationOptions,
    ) -> Result<Self, InstrumentError> {
        let stage = Stage::create(&options.path, &options.name)?;
        stage.about(page::about(&options.name, &options.about, None))?;
        if P::IN_SPACE {
            fixed(&stage.stream, &"/".into(), &rerun::ViewCoordinates::RIGHT_HAND_Z_UP())?;
        } else {
            eye(&stage.stream, "/eye")?;
        }
        stage.looks(PLOTS)?;
        Ok(Self {
            stage,
            options,
            graph,
            iteration: None,
            drawn: false,
            weights: Vec::new(),
            last: None,
            refusal: None,
        })
    }

    /// Ends the recording with the last state and the result; `metrics` is kept as JSON.
    ///
    /// # Errors
    /// The first refusal of anything that was to be recorded.
    pub fn finish(mut self, metrics: &serde_json::Value) -> Result<(), InstrumentError> {
        self.draw_last();
        if let Some(refusal) = self.refusal.take() {
            return Err(refusal);
        }
        self.stage.metrics(metrics)?;
        self.stage.end()
    }

    /// Sends the layout, which shows where the poses start.
    fn lay_out(&self, start: &[P]) -> Result<(), InstrumentError> {
        let look = layout::GraphLook { in_space: P::IN_SPACE, bounds_m: bounds(start) };
        layout::send_graph(&self.stage.stream, &look).map_err(|reason| self.stage.refused(reason))
    }

    fn attempt(&mut self, what: impl FnOnce(&mut Self) -> Result<(), InstrumentError>) {
        if self.refusal.is_none()
            && let Err(refusal) = what(self)
        {
            self.refusal = Some(refusal);
        }
    }

    /// Goes to the next iteration of the timeline.
    fn advance(&mut self) {
        let next = self.iteration.map_or(0, |iteration| iteration + 1);
        self.iteration = Some(next);
        self.stage.stream.set_time_sequence("iteration", next);
    }

    /// Logs an event: its name as data, and one line of text.
    fn say(
        &self,
        variant: &'static str,
        line: std::fmt::Arguments<'_>,
    ) -> Result<(), InstrumentError> {
        self.stage.say("graph/events/optimizer", variant, line)
    }

    /// Whether the drawing of this iteration is sent: all at first, then ever fewer.
    fn is_drawn(&self) -> bool {
        let iteration = self.iteration.unwrap_or(0) as u64;
        let bytes = self.graph.factors.len() * 40 + self.graph.ids.len() * 16;
        let all = (DRAWN_BYTES / 2 / bytes.max(1)) as u64;
        iteration <= all || iteration.is_power_of_two()
    }

    fn state(&mut self, poses: &[P], chi2: &[f64], weights: &[f64]) -> Result<(), InstrumentError> {
        self.weights.clear();
        self.weights.extend_from_slice(weights);
        let rejected = (0..chi2.len()).filter(|&index| self.is_rejected(index)).count();
        self.stage.plot("rejected_edges", rejected as f64)?;
        self.histogram(chi2)?;
        self.drawn = self.is_drawn();
        if self.drawn {
            self.last = None;
            self.draw(poses, chi2)
        } else {
            self.last = Some((poses.to_vec(), chi2.to_vec()));
            Ok(())
        }
    }

    fn is_rejected(&self, index: usize) -> bool {
        self.weights.get(index).is_some_and(|&weight| weight < REJECTED_BELOW)
    }

    fn draw_last(&mut self) {
        if let Some((poses, chi2)) = self.last.take() {
            self.attempt(|this| this.draw(&poses, &chi2));
        }
    }

    /// Sends edges, poses, and the numbers of every edge.
    fn draw(&self, poses: &[P], chi2: &[f64]) -> Result<(), InstrumentError> {
        let strokes = |path, points, order| Strokes {
            path,
            ends: Vec::new(),
            colours: Vec::new(),
            points,
            order,
        };
        let mut odometry = strokes("graph/odometry", 1.2, 10.0);
        let mut closures = strokes("graph/closures", 0.5, 5.0);
        let mut rejected = strokes("graph/rejected", 0.8, 15.0);
        let mut residuals = Vec::with_capacity(chi2.len());
        for (index, (factor, &chi2)) in self.graph.factors.iter().zip(chi2).enumerate() {
            let sigmas = residual::<D>(chi2);
            #[expect(clippy::cast_possible_truncation, reason = "for looking")]
            residuals.push(sigmas as f32);
            let (Some(from), Some(to)) = (poses.get(factor.from), poses.get(factor.to)) else {
                continue;
            };
            let ends = [from.position_m(), to.position_m()];
            let (kind, colour) = match self.is_rejected(index) {
                true => (&mut rejected, REJECTED),
                false if factor.from.abs_diff(factor.to) == 1 => {
                    (&mut odometry, draw::of_residual(sigmas))
                }
                false => (&mut closures, draw::of_residual(sigmas)),
            };
            kind.ends.push(ends);
            kind.colours.push(colour);
        }
        for strokes in [closures, odometry, rejected] {
            strokes.send(&self.stage.stream, P::IN_SPACE)?;
        }
        let at = poses.iter().map(DrawnPose::position_m);
        let look = if P::IN_SPACE { rgb(235, 240, 250) } else { palette::ODOMETRY };
        draw::send_points(&self.stage.stream, "graph/poses", at, P::IN_SPACE, (look, 1.4))?;
        if let Some(first) = poses.first() {
            let at = std::iter::once(first.position_m());
            let look = (palette::GOAL, 5.0);
            draw::send_points(&self.stage.stream, "graph/first_pose", at, P::IN_SPACE, look)?;
        }
        let mut numbers = AnyValues::default()
            .with_component::<rerun::components::Opacity>("residual_sigmas", residuals);
        if self.weights.iter().any(|&weight| weight != 1.0) {
            #[expect(clippy::cast_possible_truncation, reason = "for looking")]
            let weights: Vec<f32> = self.weights.iter().map(|&weight| weight as f32).collect();
            numbers = numbers.with_component::<rerun::components::Opacity>("weight", weights);
        }
        self.stage.stream.log("edges/numbers", &numbers).map_err(|error| InstrumentError::Rows {
            entity: "edges/numbers".to_owned(),
            reason: error.to_string(),
        })
    }

    /// Sends how many edges have which residual; each bar is twice as far off as the one before.
    fn histogram(&self, chi2: &[f64]) -> Result<(), InstrumentError> {
        const BARS: usize = 16;
        let mut counts = [0_u64; BARS];
        for &chi2 in chi2 {
            // The first bar ends at 1/16 of a standard deviation.
            let bar = residual::<D>(chi2).log2() + 5.0;
            counts[(bar.max(0.0) as usize).min(BARS - 1)] += 1;
        }
        let logarithms: Vec<f64> = (0..BARS).map(|bar| bar as f64 - 4.5).collect();
        let bars = BarChart::new(counts.to_vec()).with_abscissa(logarithms);
        self.stage.stream.log("edges/histogram", &bars).map_err(|error| InstrumentError::Rows {
            entity: "edges/histogram".to_owned(),
            reason: error.to_string(),
        })
    }

    fn iterated(&mut self, iteration: &Iteration) -> Result<(), InstrumentError> {
        let Iteration { index, cost, damping, step_norm, gain_ratio, accepted, .. } = *iteration;
        self.stage.plot("log10_cost", cost.log10())?;
        self.stage.plot("log10_damping", damping.log10())?;
        self.stage.plot("log10_step_norm", step_norm.log10())?;
        self.stage.plot("gain_ratio", gain_ratio.clamp(-2.0, 2.0))?;
        self.stage.plot("accepted", f64::from(u8::from(accepted)))?;
        let taken = if accepted { "taken" } else { "taken back" };
        self.say(
            "Iterated",
            format_args!(
                "{index}: step {step_norm:.3e} {taken}, cost {cost:.6e}, gain ratio {gain_ratio:.3}, \
                 damping {damping:.2e}"
            ),
        )
    }

    fn finished(&mut self, report: &Report) -> Result<(), InstrumentError> {
        let name_of = |index: usize| {
            let factor = &self.graph.factors[index];
            let id = |vertex: usize| self.graph.ids.get(vertex).copied().unwrap_or_default();
            format!("{}-{}", id(factor.from), id(factor.to))
        };
        let rejected: Vec<String> = (0..self.graph.factors.len())
            .filter(|&index| self.is_rejected(index))
            .map(name_of)
            .collect();
        self.stage.text(RESULT, page::result(report, &rejected))?;
        self.say(
            "Finished",
            format_args!(
                "{} after {} iterations, chi2 {:.9e}",
                report.termination.name(),
                report.iterations.len(),
                report.chi2
            ),
        )
    }
}

impl<'e, P: Manifold<D> + DrawnPose, const D: usize> Probe<OptimizerEvent<'e, P>>
    for OptimisationRecording<'_, P, D>
{
    fn emit(&mut self, event: OptimizerEvent<'e, P>) {
        match event {
            OptimizerEvent::Started { poses, factor_chi2, weights, fill } => {
                self.draw_last();
                self.advance();
                let first = self.iteration == Some(0);
                self.attempt(|this| {
                    if first {
                        this.lay_out(poses)?;
                    }
                    let options = &this.options;
                    let about = page::about(&options.name, &options.about, Some(&fill));
                    this.stage.about(about)?;
                    let cost: f64 = factor_chi2.iter().sum();
                    this.stage.plot("log10_cost", cost.log10())?;
                    this.say(
                        "Started",
                        format_args!(
                            "{} poses, {} edges, chi2 {cost:.6e}, {} unknowns, factor of {} numbers",
                            poses.len(),
                            factor_chi2.len(),
                            fill.unknowns,
                            fill.factor
                        ),
                    )?;
                    this.state(poses, factor_chi2, weights)
                });
            }
            OptimizerEvent::Iterated { iteration, poses, factor_chi2, weights } => {
                self.advance();
                self.attempt(|this| {
                    this.iterated(iteration)?;
                    this.state(poses, factor_chi2, weights)
                });
            }
            OptimizerEvent::Finished { report } => {
                self.draw_last();
                self.attempt(|this| this.finished(report));
            }
        }
    }
}

/// Names, titles and colours of the plotted numbers.
const PLOTS: [(&str, &str, Rgba); 6] = [
    ("log10_cost", "log10 cost", rgb(220, 60, 40)),
    ("log10_step_norm", "log10 step norm", rgb(60, 130, 220)),
    ("log10_damping", "log10 damping", rgb(150, 90, 200)),
    ("gain_ratio", "gain ratio", rgb(40, 160, 90)),
    ("accepted", "accepted", rgb(150, 150, 150)),
    ("rejected_edges", "rejected edges", rgb(225, 30, 200)),
];

/// Standard deviations per degree of freedom.
fn residual<const D: usize>(chi2: f64) -> f64 {
    (chi2.max(0.0) / D as f64).sqrt()
}

/// What the poses span in x and y, with a margin of a tenth.
fn bounds<P: DrawnPose>(poses: &[P]) -> ([f64; 2], [f64; 2]) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for [x, y, _] in poses.iter().map(DrawnPose::position_m).filter(|at| at[0].is_finite()) {
        low = [low[0].min(x), low[1].min(y)];
        high = [high[0].max(x), high[1].max(y)];
    }
    if !(low[0].is_finite() && low[1].is_finite()) {
        return ([-1.0; 2], [1.0; 2]);
    }
    let margin = 0.1 * (high[0] - low[0]).max(high[1] - low[1]).max(1.0);
    (low.map(|x| x - margin), high.map(|x| x + margin))
}
