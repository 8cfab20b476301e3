//! The listener of the way from a depth image to a polyhedron.

use std::path::PathBuf;
use std::sync::Arc;

use maps3d::DepthEvent;
use maps3d::image::FilledImage;
use maps3d::quality::measure;
use maps3d::triangulate::ImageMesh;
use probe::Probe;
use rerun::external::arrow::array::StringArray;
use rerun::external::re_sdk_types::SerializedComponentBatch;
use rerun::{
    AsComponents as _, RecordingStream, RecordingStreamBuilder, Scalars, SeriesLines, TextDocument,
    TextLog,
};

use super::{draw, page};
use crate::columns::{Rgba, VARIANT, fixed, rgb};
use crate::recording::{ABOUT, METRICS};
use crate::{InstrumentError, layout};

/// The names of the events on the way from a depth image to a polyhedron.
pub const DEPTH_EVENTS: &[&str] = DepthEvent::VARIANTS;

/// What the recording of a depth image says about itself.
#[derive(Clone, Debug)]
pub struct DepthRecordingOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// The name of the image.
    pub name: String,
    /// The reduction, in words.
    pub method: String,
}

/// The recording of one image, or of several reductions of it in a row: a probe for
/// `polyhedron_with`.
///
/// The timeline `vertices` counts the vertices of the mesh. Single removals and insertions are told
/// ever less often the more vertices there are: one in every hundredth of the count.
pub struct DepthRecording {
    stream: RecordingStream,
    options: DepthRecordingOptions,
    event: i64,
    /// Under what the meshes are drawn.
    root: String,
    /// Vertices when a removal or insertion was told last.
    told: Option<usize>,
    vertices: usize,
    refusal: Option<InstrumentError>,
}

/// Names, titles and colours of the plotted numbers.
const PLOTS: [(&str, &str, Rgba); 4] = [
    ("rms_m", "root mean square", rgb(60, 130, 220)),
    ("p95_m", "95 %", rgb(220, 60, 40)),
    ("contribution_m", "contribution of the removed vertex", rgb(150, 90, 200)),
    ("error_m", "distance of the inserted pixel", rgb(40, 160, 90)),
];

impl DepthRecording {
    /// Creates the file with its layout and text page.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: DepthRecordingOptions) -> Result<Self, InstrumentError> {
        let refuse = |reason: String| InstrumentError::Write { path: options.path.clone(), reason };
        let stream = RecordingStreamBuilder::new("driftlab")
            .recording_name(options.name.clone())
            .save(&options.path)
            .map_err(|e| refuse(e.to_string()))?;
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        layout::send_depth(&stream).map_err(refuse)?;
        let about = TextDocument::from_markdown(page::about(&options.name, &options.method));
        fixed(&stream, &ABOUT.into(), &about)?;
        fixed(&stream, &"view".into(), &rerun::ViewCoordinates::RIGHT_HAND_Y_DOWN())?;
        for (name, title, colour) in PLOTS {
            let look = SeriesLines::new()
                .with_names([title])
                .with_colors([rerun::Color::from_u32(colour)])
                .with_widths([2.0]);
            fixed(&stream, &format!("plots/{name}").as_str().into(), &look)?;
        }
        let root = "view".to_owned();
        Ok(Self { stream, options, event: 0, root, told: None, vertices: 0, refusal: None })
    }

    /// Draws what follows under `view/name`: several methods in one recording, side by side in the
    /// tree.
    pub fn begin(&mut self, name: &str) {
        self.root = format!("view/{name}");
        self.told = None;
    }

    /// Ends the recording; `metrics` is kept as JSON.
    ///
    /// # Errors
    /// The first refusal of anything that was to be recorded.
    pub fn finish(mut self, metrics: &serde_json::Value) -> Result<(), InstrumentError> {
        if let Some(refusal) = self.refusal.take() {
            return Err(refusal);
        }
        let json = TextDocument::new(metrics.to_string()).with_media_type("application/json");
        fixed(&self.stream, &METRICS.into(), &json)?;
        self.stream.flush_blocking().map_err(|e| InstrumentError::Write {
            path: self.options.path.clone(),
            reason: e.to_string(),
        })?;
        self.stream.disconnect();
        Ok(())
    }

    fn at(&mut self, vertices: usize) {
        self.vertices = vertices;
        self.stream.set_time_sequence("vertices", vertices as i64);
        self.stream.set_time_sequence("event", self.event);
        self.event += 1;
    }

    /// Logs an event: its name as data, and one line of text.
    fn say(&self, variant: &'static str, line: &str) -> Result<(), InstrumentError> {
        let path = "events/depth";
        let mut batches = TextLog::new(format!("{variant}: {line}")).as_serialized_batches();
        let name = Arc::new(StringArray::from(vec![variant]));
        batches.push(SerializedComponentBatch::new(name, VARIANT.clone()));
        self.stream.log_serialized_batches(path, false, batches).map_err(|error| {
            InstrumentError::Rows { entity: path.to_owned(), reason: error.to_string() }
        })
    }

    fn plot(&self, name: &str, value: f64) -> Result<(), InstrumentError> {
        if !value.is_finite() {
            return Ok(());
        }
        let entity = format!("plots/{name}");
        self.stream.log(entity.as_str(), &Scalars::single(value)).map_err(|error| {
            InstrumentError::Rows { entity: entity.clone(), reason: error.to_string() }
        })
    }

    /// Whether a single step at this number of vertices is told.
    fn tells(&mut self, vertices: usize) -> bool {
        let tells = self.told.is_none_or(|told| told.abs_diff(vertices) * 100 >= told);
        if tells {
            self.told = Some(vertices);
        }
        tells
    }

    fn mesh(&self, image: &FilledImage, mesh: &ImageMesh) -> Result<(), InstrumentError> {
        let quality = measure(image, mesh);
        self.plot("rms_m", quality.plane.rms_m)?;
        self.plot("p95_m", quality.plane.p95_m)?;
        draw::edges(&self.stream, "image/edges", mesh)?;
        draw::surface(&self.stream, &format!("{}/surface", self.root), image, mesh)
    }

    fn record(&mut self, event: DepthEvent<'_>) -> Result<(), InstrumentError> {
        let variant = event.variant();
        match event {
            DepthEvent::Prepared { image } => {
                self.at(image.pixels());
                let (columns, rows) = (image.columns(), image.rows());
                let missing = image.missing_count();
                draw::image(&self.stream, "image/depth", image)?;
                self.say(variant, &format!("{columns} x {rows} pixels, {missing} missing"))
            }
            DepthEvent::Triangulated { image, squares } => {
                self.at(image.pixels());
                draw::frontier(&self.stream, "image/frontier", squares)?;
                let faces = 2 * squares.columns() * squares.rows();
                self.say(variant, &format!("{faces} faces of the grid"))
            }
            DepthEvent::Removed { pixel, contribution_m, hole, vertices, .. } => {
                if !self.tells(vertices) {
                    return Ok(());
                }
                self.at(vertices);
                self.plot("contribution_m", contribution_m)?;
                let sides = hole.len();
                let line = format!("{pixel:?}, {contribution_m:.5} m, a hole of {sides} sides");
                self.say(variant, &line)
            }
            DepthEvent::Inserted { pixel, error_m, vertices } => {
                if !self.tells(vertices) {
                    return Ok(());
                }
                self.at(vertices);
                self.plot("error_m", error_m)?;
                self.say(variant, &format!("{pixel:?}, {error_m:.5} m off"))
            }
            DepthEvent::Reached { image, mesh } => {
                self.at(mesh.pixels.len());
                self.mesh(image, mesh)?;
                self.say(variant, &counts(mesh))
            }
            DepthEvent::Flipped { round, sides } => {
                self.at(self.vertices);
                self.say(variant, &format!("round {round}: {sides} sides"))
            }
            DepthEvent::Fitted { mesh } => {
                self.at(self.vertices);
                self.say(variant, &counts(mesh))
            }
            DepthEvent::Withheld { mesh, vertices } => {
                self.at(mesh.pixels.len());
                self.say(variant, &format!("{vertices} vertices came nearer"))
            }
            DepthEvent::Reduced { image, mesh } => {
                self.at(mesh.pixels.len());
                self.mesh(image, mesh)?;
                self.say(variant, &counts(mesh))
            }
            DepthEvent::Labelled { mesh, labels } => {
                self.at(mesh.pixels.len());
                let frontier =
                    labels.iter().filter(|label| **label == solid::Label::Frontier).count();
                self.say(variant, &format!("{frontier} of {} faces are frontier", labels.len()))
            }
            DepthEvent::Joined { polyhedron } => {
                self.at(self.vertices);
                draw::polyhedron(&self.stream, &format!("{}/polyhedron", self.root), polyhedron)?;
                self.say(variant, &format!("{} faces", polyhedron.faces().len()))
            }
        }
    }
}

fn counts(mesh: &ImageMesh) -> String {
    format!("{} vertices, {} faces", mesh.pixels.len(), mesh.triangles.len())
}

impl<'e> Probe<DepthEvent<'e>> for DepthRecording {
    fn emit(&mut self, event: DepthEvent<'e>) {
        if self.refusal.is_none()
            && let Err(refusal) = self.record(event)
        {
            self.refusal = Some(refusal);
        }
    }
}
