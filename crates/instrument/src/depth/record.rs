//! The listener of the way from a depth image to a polyhedron.

use std::fmt::Arguments;
use std::path::PathBuf;

use maps3d::DepthEvent;
use maps3d::image::FilledImage;
use maps3d::quality::measure;
use maps3d::triangulate::{FrontierSquares, ImageMesh, label};
use probe::Probe;

use super::{draw, page};
use crate::columns::fixed;
use crate::stage::Stage;
use crate::{InstrumentError, layout, palette};

/// The names of the events on the way from a depth image to a polyhedron.
pub const DEPTH_EVENTS: &[&str] = DepthEvent::VARIANTS;

/// What the recording of a depth image says about itself.
#[derive(Clone, Debug)]
pub struct DepthRecordingOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// The name of the image.
    pub name: String,
    /// The reductions that will be shown side by side, in words.
    pub methods: Vec<String>,
    /// The numbers of vertices at which a mesh is shown: the timeline `vertices` starts at the fewest,
    /// the plots reach to the most at first.
    pub shown: Vec<usize>,
}

/// The recording of one image, or of several reductions of it in a row: a probe for
/// `polyhedron_with`.
///
/// The timeline `vertices` counts the vertices of the mesh. Single removals and insertions are told
/// ever less often the more vertices there are: one in every hundredth of the count. What happens
/// before there is a mesh to look at stands on the timeline `event` only: a viewer opens at the first
/// time of `vertices`, and its views must not be empty there.
pub struct DepthRecording {
    stage: Stage,
    options: DepthRecordingOptions,
    event: i64,
    /// The reduction that is going on, as a place in the options' methods.
    method: usize,
    squares: Option<FrontierSquares>,
    /// Whether the image is drawn already, and the layout sent.
    drawn: bool,
    /// Vertices when a removal or insertion was told last.
    told: Option<usize>,
    vertices: usize,
    refusal: Option<InstrumentError>,
}

impl DepthRecording {
    /// Creates the file with its text page.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(options: DepthRecordingOptions) -> Result<Self, InstrumentError> {
        let stage = Stage::create(&options.path, &options.name)?;
        stage.about(page::about(&options.name, &options.methods))?;
        fixed(&stage.stream, &"view".into(), &rerun::ViewCoordinates::RIGHT_HAND_Y_DOWN())?;
        for (at, method) in options.methods.iter().enumerate() {
            let colour = palette::MAPS[at % palette::MAPS.len()];
            let titles = layout::DEPTH_PLOTS.map(|(name, title)| {
                (format!("{name}/{}", entity_of(method)), format!("{method}: {title}"))
            });
            stage.looks(
                titles.iter().map(|(name, title)| (name.as_str(), title.as_str(), colour)),
            )?;
        }
        Ok(Self {
            stage,
            options,
            event: 0,
            method: 0,
            squares: None,
            drawn: false,
            told: None,
            vertices: 0,
            refusal: None,
        })
    }

    /// What follows belongs to this reduction, counted in the options' methods: it is drawn in a view
    /// of its own.
    pub fn begin(&mut self, method: usize) {
        self.method = method;
        self.told = None;
    }

    /// Ends the recording with a result (Markdown); `metrics` is kept as JSON.
    ///
    /// # Errors
    /// The first refusal of anything that was to be recorded.
    pub fn finish(
        self,
        result: String,
        metrics: &serde_json::Value,
    ) -> Result<(), InstrumentError> {
        self.stage.finish(self.refusal, result, metrics)
    }

    fn at(&mut self, vertices: usize) {
        self.vertices = vertices;
        self.stage.stream.set_time_sequence("vertices", vertices as i64);
        self.stage.stream.set_time_sequence("event", self.event);
        self.event += 1;
    }

    /// The name of the reduction, as it stands in paths.
    fn name(&self) -> String {
        self.options.methods.get(self.method).map_or_else(String::new, |name| entity_of(name))
    }

    fn say(&self, variant: &'static str, line: Arguments<'_>) -> Result<(), InstrumentError> {
        self.stage.say(&format!("events/{}", self.name()), variant, line)
    }

    fn plot(&self, name: &str, value: f64) -> Result<(), InstrumentError> {
        self.stage.plot(&format!("{name}/{}", self.name()), value)
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
        let name = self.name();
        draw::edges(&self.stage.stream, &format!("image/{name}/edges"), mesh)?;
        let Some(squares) = &self.squares else { return Ok(()) };
        let points = mesh.points_in_camera(image.camera());
        let labels = label(mesh, squares, 0.0);
        let path = format!("view/{name}/surface");
        draw::surface(&self.stage.stream, &path, &points, &mesh.triangles, &labels)
    }

    fn prepared(&mut self, image: &FilledImage) -> Result<(), InstrumentError> {
        if std::mem::replace(&mut self.drawn, true) {
            return Ok(());
        }
        let mut depths: Vec<f32> = image.depths_m().to_vec();
        let middle = depths.len() / 2;
        let (_, middle_m, _) = depths.select_nth_unstable_by(middle, f32::total_cmp);
        let names: Vec<(String, String)> =
            self.options.methods.iter().map(|m| (m.clone(), entity_of(m))).collect();
        let look = layout::DepthLook {
            methods: names,
            middle_m: *middle_m,
            largest: self.options.shown.iter().copied().max().unwrap_or(image.pixels()),
        };
        layout::send_depth(&self.stage.stream, &look)
            .map_err(|reason| self.stage.refused(reason))?;
        // A viewer that still loads the file opens at the first time that it meets: removals start at
        // the most vertices, where there is little to see.
        let pixels = image.pixels();
        let fewest = self.options.shown.iter().copied().fold(pixels, usize::min);
        self.at(fewest);
        self.stage.open_with("events", "Meshes are shown from here on")?;
        draw::image(&self.stage.stream, "image/depth", image)
    }

    fn record(&mut self, event: DepthEvent<'_>) -> Result<(), InstrumentError> {
        let variant = event.variant();
        match event {
            DepthEvent::Prepared { image } => {
                self.prepared(image)?;
                self.at(image.pixels());
                let (columns, rows) = (image.columns(), image.rows());
                let missing = image.missing_count();
                self.say(variant, format_args!("{columns} x {rows} pixels, {missing} missing"))
            }
            DepthEvent::Triangulated { image, squares } => {
                self.at(image.pixels());
                if self.squares.is_none() {
                    draw::frontier(&self.stage.stream, "image/frontier", squares)?;
                }
                self.squares = Some(squares.clone());
                let faces = 2 * squares.columns() * squares.rows();
                self.say(variant, format_args!("{faces} faces of the grid"))
            }
            DepthEvent::Removed { pixel, contribution_m, hole, vertices, .. } => {
                if !self.tells(vertices) {
                    return Ok(());
                }
                self.at(vertices);
                self.plot("contribution_m", contribution_m)?;
                let sides = hole.len();
                self.say(
                    variant,
                    format_args!("{pixel:?}, {contribution_m:.5} m, a hole of {sides} sides"),
                )
            }
            DepthEvent::Inserted { pixel, error_m, vertices } => {
                if !self.tells(vertices) {
                    return Ok(());
                }
                self.at(vertices);
                if self.options.shown.iter().all(|&shown| vertices < shown) {
                    self.stage.stream.disable_timeline("vertices");
                }
                self.plot("error_m", error_m)?;
                self.say(variant, format_args!("{pixel:?}, {error_m:.5} m off"))
            }
            DepthEvent::Reached { image, mesh } => {
                self.at(mesh.pixels.len());
                self.mesh(image, mesh)?;
                self.say(variant, format_args!("{}", counts(mesh)))
            }
            DepthEvent::Thinned { mesh } => {
                self.at(mesh.pixels.len());
                self.say(variant, format_args!("{}", counts(mesh)))
            }
            DepthEvent::Flipped { round, sides } => {
                self.at(self.vertices);
                self.say(variant, format_args!("round {round}: {sides} sides"))
            }
            DepthEvent::Fitted { mesh } => {
                self.at(self.vertices);
                self.say(variant, format_args!("{}", counts(mesh)))
            }
            DepthEvent::Withheld { mesh, vertices } => {
                self.at(mesh.pixels.len());
                self.say(variant, format_args!("{vertices} vertices came nearer"))
            }
            DepthEvent::Reduced { image, mesh } => {
                self.at(mesh.pixels.len());
                self.mesh(image, mesh)?;
                self.say(variant, format_args!("{}", counts(mesh)))
            }
            DepthEvent::Labelled { mesh, labels } => {
                self.at(mesh.pixels.len());
                let frontier =
                    labels.iter().filter(|label| **label == solid::Label::Frontier).count();
                self.say(variant, format_args!("{frontier} of {} faces are frontier", labels.len()))
            }
            DepthEvent::Joined { polyhedron } => {
                self.at(self.vertices);
                let path = format!("view/{}", self.name());
                draw::walls(&self.stage.stream, &path, polyhedron)?;
                self.say(variant, format_args!("{} faces", polyhedron.faces().len()))
            }
        }
    }
}

/// A name as it may stand in a path.
fn entity_of(method: &str) -> String {
    method.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
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
