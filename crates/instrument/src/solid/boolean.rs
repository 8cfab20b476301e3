//! The listener of booleans.

use probe::Probe;
use serde_json::Value;
use solid::{BooleanEvent, Polyhedron};

use super::SolidOptions;
use super::stage::{OPERANDS, SolidStage};
use crate::columns::rgb;
use crate::{InstrumentError, palette};

/// The recording of one boolean, or of the unions that make a map: a probe.
pub struct BooleanRecording {
    stage: SolidStage,
    result: String,
}

impl BooleanRecording {
    /// Creates the file with its layout and text page.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: &SolidOptions) -> Result<Self, InstrumentError> {
        let page = format!(
            "{}\n\n- **labels**: grey is obstacle, orange is frontier\n\
             - **where from**: blue is the first operand, green the second; the white curve is where \
             their surfaces meet\n\
             - red faces: frontier that coincided with obstacle, and became obstacle\n\n\
             Step along `event`: the operands, the engine's result, the faces that became obstacle, \
             each pass of cleaning, the result.",
            options.about
        );
        let options = SolidOptions { about: page, ..options.clone() };
        let panels: [(&str, &[&str]); 2] = [
            ("labels: obstacle grey, frontier orange", &["labels"]),
            ("where from: first operand blue, second green", &["operands", "curve", "changed"]),
        ];
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

impl Probe<BooleanEvent<'_>> for BooleanRecording {
    fn emit(&mut self, event: BooleanEvent<'_>) {
        let (stage, variant) = (&mut self.stage, event.variant());
        match event {
            BooleanEvent::Started { operation, a, b } => {
                let (of_a, of_b) = (a.faces().len(), b.faces().len());
                stage.event(variant, format_args!("{operation} of {of_a} and {of_b} faces"));
                stage.labelled("labels/a", a);
                stage.labelled("labels/b", b);
                stage.mesh("operands/a", a, &vec![OPERANDS[0]; of_a]);
                stage.mesh("operands/b", b, &vec![OPERANDS[1]; of_b]);
                stage.lines("curve", &[], palette::GOAL, 1.0);
                stage.points("changed", &[], palette::GOAL, 1.0);
            }
            BooleanEvent::Combined { mesh, operand_of, curve } => {
                stage.event(
                    variant,
                    format_args!(
                        "{} faces, {} of the second operand; surfaces meet along {} edges",
                        mesh.faces().len(),
                        operand_of.iter().filter(|&&of| of == 1).count(),
                        curve.len()
                    ),
                );
                let nothing = Polyhedron::empty();
                stage.labelled("labels/a", mesh);
                stage.labelled("labels/b", &nothing);
                let colours: Vec<_> =
                    operand_of.iter().map(|&of| OPERANDS[usize::from(of.min(1))]).collect();
                stage.mesh("operands/a", mesh, &colours);
                stage.mesh("operands/b", &nothing, &[]);
                let ends: Vec<_> = curve.iter().map(|edge| edge.ends).collect();
                stage.lines("curve", &ends, rgb(255, 255, 255), 1.5);
            }
            BooleanEvent::Settled { mesh, faces } => {
                stage
                    .event(variant, format_args!("{} frontier faces became obstacle", faces.len()));
                stage.labelled("labels/a", mesh);
            }
            BooleanEvent::Cleaned { mesh, removed, undone } => {
                stage.event(
                    variant,
                    format_args!(
                        "{} vertices taken out, {undone} removals undone, {} faces left",
                        removed.len(),
                        mesh.faces().len()
                    ),
                );
                stage.labelled("labels/a", mesh);
                stage.points("changed", removed, palette::GOAL, 3.0);
            }
            BooleanEvent::Finished { mesh } => {
                let (volume, area) = (mesh.volume_m3(), mesh.area_by_label());
                stage.event(variant, format_args!("{} faces, {volume:.6} m3", mesh.faces().len()));
                stage.labelled("labels/a", mesh);
                self.result = format!(
                    "| | |\n|---|---|\n| vertices | {} |\n| faces | {} |\n| volume | {volume:.9} m3 |\n\
                     | obstacle | {:.6} m2 |\n| frontier | {:.6} m2 |\n",
                    mesh.vertices().len(),
                    mesh.faces().len(),
                    area.obstacle_m2,
                    area.frontier_m2
                );
            }
        }
    }
}
