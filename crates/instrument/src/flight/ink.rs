//! How things of space are drawn: one entity of the recording at a time.

use geometry::Point3;
use pose::Se3;
use rerun::components::MeshFaceRendering;
use rerun::{Color, LineStrips3D, Mesh3D, Points3D, Quaternion, Transform3D};
use solid::{Label, Polyhedron};

use crate::InstrumentError;
use crate::columns::{Rgba, fixed};
use crate::palette;
use crate::stage::Stage;

/// Triangles with a colour each, ready to be shown.
#[derive(Default)]
pub(super) struct Faces {
    corners: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    colours: Vec<Color>,
}

impl Faces {
    /// Adds a triangle; its front is where its corners run counter-clockwise.
    pub(super) fn push(&mut self, corners: [&Point3; 3], colour: Rgba) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default();
        self.corners.extend(corners.map(short));
        self.normals.extend([short(&Point3::from(normal)); 3]);
        self.colours.extend([Color::from_u32(colour); 3]);
    }

    /// The faces of a polyhedron in the colours of their labels, seen from inside.
    pub(super) fn inside_of(mesh: &Polyhedron) -> Self {
        let mut faces = Self::default();
        for (face, label) in mesh.labels().iter().enumerate() {
            let [a, b, c] = mesh.corners(face);
            faces.push([a, c, b], of_label(*label));
        }
        faces
    }

    /// As the viewer takes it: only fronts are drawn, so that one looks through near walls into a place.
    pub(super) fn mesh(self) -> Mesh3D {
        Mesh3D::new(self.corners)
            .with_vertex_normals(self.normals)
            .with_vertex_colors(self.colours)
            .with_face_rendering(MeshFaceRendering::Front)
    }
}

/// The colour of a label's faces.
pub(super) const fn of_label(label: Label) -> Rgba {
    match label {
        Label::Obstacle => palette::SURFACE,
        Label::Frontier => palette::FRONTIER,
    }
}

/// A rigid motion as the viewer takes it.
pub(super) fn placed(parent_from_child: &Se3) -> Transform3D {
    let q = parent_from_child.rotation.quaternion().coords;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a screen shows far less than a float holds"
    )]
    let turn = Quaternion::from_xyzw([q.x as f32, q.y as f32, q.z as f32, q.w as f32]);
    let at = Point3::from(parent_from_child.translation);
    Transform3D::from_translation_rotation(short(&at), turn)
}

#[expect(clippy::cast_possible_truncation, reason = "a screen shows far less than a float holds")]
pub(super) fn short(at: &Point3) -> [f32; 3] {
    [at.x as f32, at.y as f32, at.z as f32]
}

/// Lines of one colour; `points` is their width on the screen.
pub(super) fn lines(strips: &[Vec<Point3>], colour: Rgba, points: f32) -> LineStrips3D {
    LineStrips3D::new(strips.iter().map(|strip| strip.iter().map(short).collect::<Vec<_>>()))
        .with_colors([Color::from_u32(colour)])
        .with_radii([rerun::Radius::new_ui_points(points)])
}

/// Segments of one colour; `points` is their width on the screen.
pub(super) fn segments(segments: &[[Point3; 2]], colour: Rgba, points: f32) -> LineStrips3D {
    LineStrips3D::new(segments.iter().map(|ends| ends.each_ref().map(short)))
        .with_colors([Color::from_u32(colour)])
        .with_radii([rerun::Radius::new_ui_points(points)])
}

/// Points with a colour each; `points` is their size on the screen.
pub(super) fn dots(at: &[Point3], colours: &[Rgba], points: f32) -> Points3D {
    Points3D::new(at.iter().map(short))
        .with_colors(colours.iter().map(|&colour| Color::from_u32(colour)))
        .with_radii([rerun::Radius::new_ui_points(points)])
}

/// Where one map's robot is drawn: entities below its name; nothing where nothing is recorded.
pub(super) struct Ink {
    stage: Option<Stage>,
    name: String,
    refusal: Option<InstrumentError>,
}

impl Ink {
    pub(super) fn new(stage: Option<Stage>, name: &str) -> Self {
        Self { stage, name: name.to_owned(), refusal: None }
    }

    pub(super) fn is_on(&self) -> bool {
        self.stage.is_some()
    }

    /// Counts and distances that everything drawn from now on belongs to.
    pub(super) fn times(&self, times: &[(&'static str, i64)]) {
        let Some(stage) = &self.stage else { return };
        for &(timeline, at) in times {
            stage.stream.set_time_sequence(timeline, at);
        }
    }

    fn keep(&mut self, sent: Result<(), InstrumentError>) {
        if let Err(refused) = sent {
            self.refusal.get_or_insert(refused);
        }
    }

    /// Draws something at `part`, from now on.
    pub(super) fn draw(&mut self, part: &str, what: &dyn rerun::AsComponents) {
        let Some(stage) = &self.stage else { return };
        let entity = format!("{}/{part}", self.name);
        let sent = stage.stream.log(entity.as_str(), what);
        let sent = sent.map_err(|e| InstrumentError::Rows { entity, reason: e.to_string() });
        self.keep(sent);
    }

    /// Draws something at `part`, at all times.
    pub(super) fn always(&mut self, part: &str, what: &dyn rerun::AsComponents) {
        let Some(stage) = &self.stage else { return };
        let entity = format!("{}/{part}", self.name);
        let sent = fixed(&stage.stream, &entity.as_str().into(), what);
        self.keep(sent);
    }

    /// Writes an event down: its name as data, and one line of text.
    pub(super) fn say(
        &mut self,
        family: &str,
        variant: &'static str,
        line: std::fmt::Arguments<'_>,
    ) {
        let Some(stage) = &self.stage else { return };
        let sent = stage.say(&format!("{}/events/{family}", self.name), variant, line);
        self.keep(sent);
    }

    /// Plots a number.
    pub(super) fn plot(&mut self, number: &str, value: f64) {
        let Some(stage) = &self.stage else { return };
        let sent = stage.plot(&format!("{}/{number}", self.name), value);
        self.keep(sent);
    }

    /// The first refusal since this was asked last.
    pub(super) fn take_refusal(&mut self) -> Result<(), InstrumentError> {
        self.refusal.take().map_or(Ok(()), Err)
    }
}
