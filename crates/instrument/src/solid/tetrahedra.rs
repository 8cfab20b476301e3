//! The listener of tetrahedralisations.

use probe::Probe;
use serde_json::Value;
use solid::{Point3, Polyhedron, TetrahedraEvent};

use super::SolidOptions;
use super::stage::SolidStage;
use crate::columns::rgb;
use crate::{InstrumentError, palette};

/// Edges of the whole mesh are drawn up to so many tetrahedra.
const MOST_DRAWN: usize = 20_000;

/// The recording of one tetrahedralisation: a probe.
pub struct TetrahedraRecording {
    stage: SolidStage,
    result: String,
}

impl TetrahedraRecording {
    /// Creates the file with its layout, its text page and the edges of the input.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: &SolidOptions, input: &Polyhedron) -> Result<Self, InstrumentError> {
        let page = format!(
            "{}\n\n- **the step**: red edges are those of tetrahedra that went, green those that came; the \
             white point is the one put in or taken out; the yellow lines are the segment or facet \
             brought in; thin lines are the edges of the input, grey of obstacle and orange of frontier\n\
             - **the mesh**: its edges after all points, and inside in the end\n\n\
             Step along `event`: each insertion, each flip and reconnection with what it was for, each \
             recovery, each Steiner point, inside and outside, the result.",
            options.about
        );
        let options = SolidOptions { about: page, ..options.clone() };
        let panels: [(&str, &[&str]); 2] = [
            ("the step: went red, came green", &["step", "input"]),
            ("the mesh", &["mesh", "input"]),
        ];
        let mut stage = SolidStage::create(&options, &panels)?;
        stage.outlined("input", input);
        Ok(Self { stage, result: String::new() })
    }

    /// Ends the recording; `metrics` is kept as JSON.
    ///
    /// # Errors
    /// The first refusal of anything that was to be recorded.
    pub fn finish(self, metrics: &Value) -> Result<(), InstrumentError> {
        self.stage.finish(self.result, metrics)
    }

    /// Shows what went and what came in one step.
    fn step(&mut self, went: &[[u32; 4]], came: &[[u32; 4]], points: &[[f64; 3]]) {
        self.stage.lines("step/went", &edges(went, points), rgb(230, 60, 60), 1.0);
        self.stage.lines("step/came", &edges(came, points), rgb(60, 200, 90), 1.5);
    }

    fn point(&mut self, at: [f64; 3]) {
        self.stage.points("step/point", &[Point3::from(at)], rgb(255, 255, 255), 5.0);
    }
}

/// The edges of some tetrahedra, each once.
fn edges(tetrahedra: &[[u32; 4]], points: &[[f64; 3]]) -> Vec<[Point3; 2]> {
    let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(6 * tetrahedra.len());
    for tet in tetrahedra {
        for i in 0..4 {
            pairs.extend((i + 1..4).map(|j| [tet[i].min(tet[j]), tet[i].max(tet[j])]));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs.into_iter().map(|pair| pair.map(|v| Point3::from(points[v as usize]))).collect()
}

impl Probe<TetrahedraEvent<'_>> for TetrahedraRecording {
    fn emit(&mut self, event: TetrahedraEvent<'_>) {
        let variant = event.variant();
        match event {
            TetrahedraEvent::Inserted { vertex, removed, mesh, made } => {
                let line =
                    format!("vertex {vertex}: {removed} tetrahedra went, {} came", made.len());
                self.stage.event(variant, format_args!("{line}"));
                let came: Vec<[u32; 4]> =
                    made.iter().filter_map(|&slot| mesh.tetrahedron(slot)).collect();
                self.step(&[], &came, mesh.points());
                self.point(mesh.points()[vertex as usize]);
            }
            TetrahedraEvent::Triangulated { mesh, box_corners, facets } => {
                let count = mesh.tetrahedra().count();
                self.stage.event(
                    variant,
                    format_args!(
                        "{count} Delaunay tetrahedra with the {box_corners} corners of a box; {} faces \
                         must appear",
                        facets.len()
                    ),
                );
                let inner: Vec<[u32; 4]> = mesh
                    .tetrahedra()
                    .filter(|tet| tet.iter().all(|&v| v as usize >= box_corners))
                    .take(MOST_DRAWN)
                    .collect();
                self.stage.lines(
                    "mesh/edges",
                    &edges(&inner, mesh.points()),
                    rgb(110, 110, 130),
                    0.5,
                );
                self.step(&[], &[], mesh.points());
            }
            TetrahedraEvent::Exchanged { cause, removed, made, points } => {
                self.stage.event(
                    variant,
                    format_args!("{} to {} for a {}", removed.len(), made.len(), cause.name()),
                );
                self.step(removed, made, points);
            }
            TetrahedraEvent::Recovered { corners, points } => {
                let what = if corners.len() == 2 { "segment" } else { "facet" };
                self.stage.event(variant, format_args!("{what} {corners:?}"));
                let at = |i: usize| Point3::from(points[corners[i % corners.len()] as usize]);
                let lines: Vec<[Point3; 2]> =
                    (0..corners.len()).map(|i| [at(i), at(i + 1)]).collect();
                self.stage.lines("step/recovered", &lines, palette::GOAL, 3.0);
            }
            TetrahedraEvent::SteinerPlaced { vertex, point, cause } => {
                self.stage.event(variant, format_args!("vertex {vertex} for a {}", cause.name()));
                self.point(point);
            }
            TetrahedraEvent::SteinerRemoved { vertex, point } => {
                self.stage.event(variant, format_args!("vertex {vertex}"));
                self.point(point);
            }
            TetrahedraEvent::Classified { inside, outside, points } => {
                self.stage
                    .event(variant, format_args!("{} inside, {outside} outside", inside.len()));
                let drawn = &inside[..inside.len().min(MOST_DRAWN)];
                self.stage.lines("mesh/edges", &edges(drawn, points), rgb(110, 110, 130), 0.5);
                self.step(&[], &[], points);
            }
            TetrahedraEvent::Finished { result } => {
                let volume = result.volume_m3();
                self.stage.event(
                    variant,
                    format_args!("{} tetrahedra, {volume:.6} m3", result.tetrahedra.len()),
                );
                self.result = format!(
                    "| | |\n|---|---|\n| vertices | {} |\n| of these added | {} |\n| faces | {} |\n\
                     | tetrahedra | {} |\n| volume | {volume:.9} m3 |\n",
                    result.vertices.len(),
                    result.steiner_points,
                    result.boundary.len(),
                    result.tetrahedra.len()
                );
            }
        }
    }
}
