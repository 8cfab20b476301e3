//! `driftlab mesh polyhedron`: the local volume of a depth image.

use std::time::Instant;

use instrument::{DepthRecording, DepthRecordingOptions};
use maps3d::quality::{Quality, Spread, measure};
use maps3d::view::{validity, volume_m3};
use maps3d::{DepthEvent, Made, Maps3dError, polyhedron_with};
use probe::Probe;
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::graph::numbers::{listed, shown};
use super::super::out::Out;
use super::args::PolyhedronArgs;
use super::told::Told;
use super::{depth_args, depth_input};

pub(super) fn polyhedron(args: &PolyhedronArgs, out: &Out) -> Result<(), Failure> {
    let target = args.output.target(&[&args.depth.depth])?;
    let depth = &args.depth;
    let path = depth.depth.display().to_string();
    let refused = |error: Maps3dError| depth_args::refused(&path, &error);
    // What was typed comes first: it costs nothing to check.
    let options = depth.options();
    depth.file.check()?;
    options.check().map_err(refused)?;
    let read = depth_input::depth(&depth.depth, &depth.file, out)?;
    depth_input::note(&read, &options.prepare, &depth.depth, out)?;
    let (image, secs_read) = (read.image, read.secs);
    let mut clock = Clock::default();
    let made = polyhedron_with(&image, &options, &mut clock).map_err(refused)?;
    let start = Instant::now();
    let validity = validity(&made.image, &made.mesh, &made.polyhedron);
    let secs_check = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let quality = measure(&made.image, &made.mesh);
    let secs_measure = start.elapsed().as_secs_f64();
    let told = Told::known(&made.polyhedron, validity);
    let mut json = told.json();
    add(&mut json, &quality, &made);
    json["file"] = path.clone().into();
    json["columns"] = made.image.columns().into();
    json["rows"] = made.image.rows().into();
    json["missing_pixels"] = made.image.missing_count().into();
    json["method"] = options.reduce.as_ref().map(|_| depth.reduce.name()).into();
    json["secs_read"] = secs_read.into();
    let [triangulate, reduce, joined] = clock.secs();
    json["secs_triangulate"] = triangulate.into();
    json["secs_reduce"] = reduce.into();
    json["secs_polyhedron"] = joined.into();
    json["secs_check"] = secs_check.into();
    json["secs_measure"] = secs_measure.into();
    let mut rows = vec![(
        "image",
        format!(
            "{} x {} pixels, {} missing",
            made.image.columns(),
            made.image.rows(),
            made.image.missing_count()
        ),
    )];
    rows.extend(told.rows());
    let spread = |s: &Spread| {
        format!("rms {} m, 95 % {} m, max {} m", shown(s.rms_m), shown(s.p95_m), shown(s.max_m))
    };
    rows.push(("distance", spread(&quality.plane)));
    rows.push(("along rays", spread(&quality.ray)));
    rows.push(("uncovered", format!("{} of the pixels", shown(quality.uncovered_share))));
    rows.push(("outside", format!("at most {} m", shown(quality.outside_max_m))));
    rows.push((
        "seconds",
        format!(
            "read {secs_read:.4}, triangulate {triangulate:.4}, reduce {reduce:.4}, polyhedron \
             {joined:.4}, check {secs_check:.4}, measure {secs_measure:.4}"
        ),
    ));
    let vertices = made.mesh.pixels.len();
    if let Some(target) = &target {
        // The bytes of the file take as much memory as all of this.
        let Made { polyhedron, mesh, labels, image } = made;
        drop((mesh, labels, image));
        target.write(&polyhedron)?;
    }
    if let Some(record) = &args.output.recording.record {
        // Once more, and watched: what is written down must not count as time.
        let recording = DepthRecordingOptions {
            path: record.clone(),
            name: depth.depth.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into()),
            methods: vec![depth.reduce.name()],
            shown: [&depth.ladder[..], &[vertices]].concat(),
        };
        let mut recording = DepthRecording::create(recording).map_err(Failure::work)?;
        polyhedron_with(&image, &options, &mut recording).map_err(refused)?;
        recording
            .finish(format!("```text\n{}```\n", listed(&rows)), &json)
            .map_err(Failure::work)?;
    }
    args.output.tell(&mut json);
    out.result(&json, &listed(&rows))
}

fn add(json: &mut Value, quality: &Quality, made: &Made) {
    let spread = |s: &Spread| json!({ "rms_m": s.rms_m, "p95_m": s.p95_m, "max_m": s.max_m });
    if json["closed"] == true {
        json["volume_m3"] = volume_m3(&made.mesh, made.image.camera()).into();
    }
    json["rms_m"] = quality.plane.rms_m.into();
    json["p95_m"] = quality.plane.p95_m.into();
    json["max_m"] = quality.plane.max_m.into();
    json["along_rays"] = spread(&quality.ray);
    json["uncovered_share"] = quality.uncovered_share.into();
    json["outside_max_m"] = quality.outside_max_m.into();
    json["mesh_vertices"] = made.mesh.pixels.len().into();
    json["mesh_faces"] = made.mesh.triangles.len().into();
}

/// Looks at the clock between stages; the algorithm itself knows none.
struct Clock {
    start: Instant,
    triangulated: Option<f64>,
    reduced: Option<f64>,
    joined: Option<f64>,
}

impl Default for Clock {
    fn default() -> Self {
        Self { start: Instant::now(), triangulated: None, reduced: None, joined: None }
    }
}

impl Clock {
    /// Of triangulation, reduction, and the polyhedron.
    fn secs(&self) -> [f64; 3] {
        let triangulated = self.triangulated.unwrap_or(0.0);
        let reduced = self.reduced.unwrap_or(triangulated);
        [triangulated, reduced - triangulated, self.joined.unwrap_or(reduced) - reduced]
    }
}

impl<'e> Probe<DepthEvent<'e>> for Clock {
    fn on(&self) -> bool {
        false
    }

    fn emit(&mut self, event: DepthEvent<'e>) {
        let now = || Some(self.start.elapsed().as_secs_f64());
        match event {
            DepthEvent::Triangulated { .. } => self.triangulated = now(),
            DepthEvent::Reduced { .. } => self.reduced = now(),
            DepthEvent::Joined { .. } => self.joined = now(),
            _ => {}
        }
    }
}
