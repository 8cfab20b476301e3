//! What every recording of work on a mesh stands on.

use std::fmt::Arguments;
use std::path::PathBuf;
use std::sync::Arc;

use rerun::external::arrow::array::StringArray;
use rerun::external::re_sdk_types::SerializedComponentBatch;
use rerun::{
    AsComponents as _, Color, LineStrips3D, Mesh3D, Points3D, RecordingStream,
    RecordingStreamBuilder, TextDocument, TextLog,
};
use solid::{Label, Point3, Polyhedron};

use crate::columns::{Rgba, VARIANT, fixed, rgb, rgba};
use crate::recording::{ABOUT, METRICS, RESULT};
use crate::{InstrumentError, layout, palette};

/// What a recording of work on a mesh says about itself.
#[derive(Clone, Debug)]
pub struct SolidOptions {
    /// The file, under its final name; it is overwritten.
    pub path: PathBuf,
    /// Its name.
    pub name: String,
    /// What is done, in words (Markdown).
    pub about: String,
}

/// The colour of a label's faces.
pub(super) const fn colour(label: Label) -> Rgba {
    match label {
        Label::Obstacle => rgb(150, 150, 165),
        Label::Frontier => rgba(255, 140, 30, 200),
    }
}

/// A file, the count of its events, and its first refusal.
pub(super) struct Stage {
    stream: RecordingStream,
    path: PathBuf,
    event: i64,
    refusal: Option<InstrumentError>,
}

impl Stage {
    /// Creates the file with its layout and text page; `panels` are its 3D views.
    pub(super) fn create(
        options: &SolidOptions,
        panels: &[(&str, &[&str])],
    ) -> Result<Self, InstrumentError> {
        let refuse = |reason: String| InstrumentError::Write { path: options.path.clone(), reason };
        let stream = RecordingStreamBuilder::new("driftlab")
            .recording_name(options.name.clone())
            .save(&options.path)
            .map_err(|e| refuse(e.to_string()))?;
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        layout::send_solid(&stream, panels).map_err(refuse)?;
        let about = format!("# {}\n\n{}\n", options.name, options.about);
        fixed(&stream, &ABOUT.into(), &TextDocument::from_markdown(about))?;
        fixed(&stream, &"/".into(), &rerun::ViewCoordinates::RIGHT_HAND_Z_UP())?;
        Ok(Self { stream, path: options.path.clone(), event: -1, refusal: None })
    }

    /// Goes to the next event and writes one line about it.
    pub(super) fn event(&mut self, variant: &'static str, line: Arguments<'_>) {
        const PATH: &str = "events/solid";
        self.event += 1;
        self.stream.set_time_sequence("event", self.event);
        let mut batches = TextLog::new(format!("{variant}: {line}")).as_serialized_batches();
        let name = Arc::new(StringArray::from(vec![variant]));
        batches.push(SerializedComponentBatch::new(name, VARIANT.clone()));
        let sent = self.stream.log_serialized_batches(PATH, false, batches);
        self.note(PATH, sent);
    }

    fn note(&mut self, entity: &str, sent: Result<(), rerun::RecordingStreamError>) {
        if let Err(error) = sent {
            let entity = entity.to_owned();
            let refused = InstrumentError::Rows { entity, reason: error.to_string() };
            self.refusal.get_or_insert(refused);
        }
    }

    /// Shows a mesh in the colours of its labels; every face has corners of its own.
    pub(super) fn labelled(&mut self, entity: &str, mesh: &Polyhedron) {
        let colours: Vec<Rgba> = mesh.labels().iter().map(|&label| colour(label)).collect();
        self.mesh(entity, mesh, &colours);
    }

    /// Shows a mesh with a colour for each face.
    pub(super) fn mesh(&mut self, entity: &str, mesh: &Polyhedron, colours: &[Rgba]) {
        let mut corners = Vec::with_capacity(3 * mesh.faces().len());
        let mut normals = Vec::with_capacity(3 * mesh.faces().len());
        for face in 0..mesh.faces().len() {
            let normal = mesh.scaled_normal(face).try_normalize(0.0).unwrap_or_default();
            corners.extend(mesh.corners(face).map(short));
            normals.extend([short(&Point3::from(normal)); 3]);
        }
        let each = colours.iter().flat_map(|&colour| [Color::from_u32(colour); 3]);
        let shown = Mesh3D::new(corners).with_vertex_normals(normals).with_vertex_colors(each);
        let sent = self.stream.log(entity, &shown);
        self.note(entity, sent);
    }

    /// Shows lines.
    pub(super) fn lines(&mut self, entity: &str, ends: &[[Point3; 2]], colour: Rgba, points: f32) {
        let strips = ends.iter().map(|[from, to]| [short(from), short(to)]);
        let shown = LineStrips3D::new(strips)
            .with_colors([Color::from_u32(colour)])
            .with_radii([rerun::Radius::new_ui_points(points)]);
        let sent = self.stream.log(entity, &shown);
        self.note(entity, sent);
    }

    /// Shows points.
    pub(super) fn points(&mut self, entity: &str, at: &[Point3], colour: Rgba, points: f32) {
        let shown = Points3D::new(at.iter().map(short))
            .with_colors([Color::from_u32(colour)])
            .with_radii([rerun::Radius::new_ui_points(points)]);
        let sent = self.stream.log(entity, &shown);
        self.note(entity, sent);
    }

    /// Ends the recording with its result; `metrics` is kept as JSON.
    pub(super) fn finish(
        mut self,
        result: String,
        metrics: &serde_json::Value,
    ) -> Result<(), InstrumentError> {
        if let Some(refusal) = self.refusal.take() {
            return Err(refusal);
        }
        fixed(&self.stream, &RESULT.into(), &TextDocument::from_markdown(result))?;
        let json = TextDocument::new(metrics.to_string()).with_media_type("application/json");
        fixed(&self.stream, &METRICS.into(), &json)?;
        self.stream.flush_blocking().map_err(|e| InstrumentError::Write {
            path: self.path.clone(),
            reason: e.to_string(),
        })?;
        self.stream.disconnect();
        Ok(())
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a screen shows far less than a float holds")]
fn short(at: &Point3) -> [f32; 3] {
    [at.x as f32, at.y as f32, at.z as f32]
}

/// The colours of two operands.
pub(super) const OPERANDS: [Rgba; 2] = [palette::MAPS[1], palette::MAPS[2]];
