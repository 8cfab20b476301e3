//! The listener of reductions.

use probe::Probe;
use serde_json::Value;
use solid::ReduceEvent;

use super::SolidOptions;
use super::stage::SolidStage;
use crate::{InstrumentError, palette};

/// The recording of one reduction: a probe.
pub struct ReduceRecording {
    stage: SolidStage,
    result: String,
}

impl ReduceRecording {
    /// Creates the file with its layout and text page.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: &SolidOptions) -> Result<Self, InstrumentError> {
        let page = format!(
            "{}\n\n- grey is obstacle, orange is frontier\n- the red line is the edge along which a \
             vertex was drawn into its neighbour\n\nStep along `event`: each collapse; the mesh each \
             time that its faces have halved; the result.",
            options.about
        );
        let options = SolidOptions { about: page, ..options.clone() };
        let panels: [(&str, &[&str]); 1] =
            [("the mesh: obstacle grey, frontier orange", &["labels", "collapse"])];
        Ok(Self { stage: SolidStage::create(&options, &panels)?, result: String::new() })
    }

    /// Ends the recording; `metrics` is kept as JSON.
    ///
    /// # Errors
    /// The first refusal of anything that was to be recorded.
    pub fn finish(self, metrics: &Value) -> Result<(), InstrumentError> {
        self.stage.finish(self.result, metrics)
    }
}

impl Probe<ReduceEvent<'_>> for ReduceRecording {
    fn emit(&mut self, event: ReduceEvent<'_>) {
        let (stage, variant) = (&mut self.stage, event.variant());
        match event {
            ReduceEvent::Started { mesh } => {
                stage.event(variant, format_args!("{} faces", mesh.faces().len()));
                stage.labelled("labels/mesh", mesh);
            }
            ReduceEvent::Collapsed { from, to, faces, error_m } => {
                stage.event(variant, format_args!("{faces} faces left, error {error_m:.4e} m"));
                stage.lines("collapse", &[[from, to]], palette::GOAL, 3.0);
            }
            ReduceEvent::Halved { mesh, error_m } => {
                stage.event(
                    variant,
                    format_args!("{} faces, error {error_m:.4e} m", mesh.faces().len()),
                );
                stage.labelled("labels/mesh", mesh);
            }
            ReduceEvent::Finished { reduced } => {
                let (faces, error_m) = (reduced.mesh.faces().len(), reduced.error_m);
                stage.event(variant, format_args!("{faces} faces, error {error_m:.4e} m"));
                stage.labelled("labels/mesh", &reduced.mesh);
                stage.lines("collapse", &[], palette::GOAL, 3.0);
                let why = reduced.refusals;
                self.result = format!(
                    "| | |\n|---|---|\n| faces | {faces} |\n| vertices taken out | {} |\n\
                     | error | {error_m:.6} m |\n| refused: link condition | {} |\n\
                     | refused: labels | {} |\n| refused: flat or turned over | {} |\n\
                     | refused: beyond the bound | {} |\n| refused: faces would meet | {} |\n",
                    reduced.removed, why.link, why.label, why.fold, why.bound, why.crossing
                );
            }
        }
    }
}
