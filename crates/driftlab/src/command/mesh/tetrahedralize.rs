//! `driftlab mesh tetrahedralize`: a mesh filled with tetrahedra.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::anyhow;
use formats::mesh::{MeshFormat, TetrahedraFile, write_medit, write_vtk};
use instrument::{SolidOptions, TetrahedraRecording};
use probe::Probe;
use serde_json::json;
use solid::tetrahedra::{Inside, delaunay_with, tetrahedralize_in};
use solid::{Polyhedron, SolidError, Tetrahedra, TetrahedraEvent};

use super::super::failure::Failure;
use super::super::files::{free, write_whole};
use super::super::graph::numbers::{listed, shown};
use super::super::out::Out;
use super::args::{TetrahedralizeArgs, shown as shown_path};
use super::input;

pub(super) fn tetrahedralize(args: &TetrahedralizeArgs, out: &Out) -> Result<(), Failure> {
    let recording = &args.recording;
    let target =
        args.output.as_deref().map(|path| Target::new(path, recording.force)).transpose()?;
    recording.check([args.file.as_path()].into_iter().chain(args.output.as_deref()))?;
    let read = input::mesh(&args.file, args.input.weld, out)?;
    let is_complex = matches!(read.file.format, MeshFormat::Plc(_));
    if read.mesh.is_empty() && !is_complex {
        return Err(Failure::Input(anyhow!(
            "{}: found no faces, expected a closed mesh (points alone are read from a .node file)",
            args.file.display()
        )));
    }
    let holes = &read.file.hole_points;
    let inside = if args.enclosed || !holes.is_empty() {
        Inside::Enclosed(holes.clone())
    } else {
        Inside::Odd
    };
    let mut recording =
        recording.record.as_deref().map(|path| record(path, args, &read.mesh)).transpose()?;
    let start = Instant::now();
    let found = match &mut recording {
        Some(recording) => filled(&read.mesh, &inside, recording),
        None => filled(&read.mesh, &inside, &mut probe::Off),
    };
    let secs = start.elapsed().as_secs_f64();
    let found = found.map_err(|error| refused(&error, &args.file))?;
    if found.tetrahedra.is_empty() {
        return Err(Failure::Input(anyhow!(
            "{}: found no space that its faces enclose, expected a closed mesh",
            args.file.display()
        )));
    }
    let mut json = json!({
        "vertices": read.mesh.vertices().len(),
        "input_faces": read.mesh.faces().len(),
        "preserved_faces": found.preserved_faces(),
        "faces_outside": found.faces_outside(),
        "tetrahedra": found.tetrahedra.len(),
        "steiner_points": found.steiner_points,
        "volume_m3": found.volume_m3(),
        "secs": secs,
        "secs_read": read.secs,
    });
    if let Some(recording) = recording {
        recording.finish(&json).map_err(Failure::work)?;
    }
    if let Some(target) = &target {
        target.write(&found)?;
    }
    json["file"] = args.file.display().to_string().into();
    json["output"] = shown_path(args.output.as_deref());
    json["recording"] = shown_path(args.recording.record.as_deref());
    let rows = [
        ("vertices", format!("{}, {} added", read.mesh.vertices().len(), found.steiner_points)),
        ("faces", kept(&found, read.mesh.faces().len())),
        ("tetrahedra", found.tetrahedra.len().to_string()),
        ("volume", format!("{} m3", shown(found.volume_m3()))),
        ("seconds", format!("read {:.4}, tetrahedralize {secs:.4}", read.secs)),
    ];
    out.result(&json, &listed(&rows))
}

/// How many faces were kept; in a complex some may have no space to be kept beside.
fn kept(found: &Tetrahedra, faces: usize) -> String {
    let outside = match found.faces_outside() {
        0 => String::new(),
        count => format!(", {count} with no space inside beside them"),
    };
    format!("{} of {faces} kept{outside}", found.preserved_faces())
}

/// The inside of a mesh; of points without faces all that they span.
fn filled(
    mesh: &Polyhedron,
    inside: &Inside,
    probe: &mut impl for<'a> Probe<TetrahedraEvent<'a>>,
) -> Result<Tetrahedra, SolidError> {
    match mesh.faces().is_empty() {
        true => {
            let points = mesh.vertices();
            Ok(delaunay_with(points, probe)?.into_tetrahedra(points.to_vec()))
        }
        false => tetrahedralize_in(mesh, inside, probe),
    }
}

fn record(
    path: &Path,
    args: &TetrahedralizeArgs,
    input: &Polyhedron,
) -> Result<TetrahedraRecording, Failure> {
    let file = args.file.file_name().unwrap_or_default().to_string_lossy();
    let options = SolidOptions {
        path: path.to_owned(),
        name: "tetrahedra".into(),
        about: format!("The tetrahedra of `{file}`."),
    };
    TetrahedraRecording::create(&options, input).map_err(Failure::work)
}

/// What is wrong with the input is bad input; the rest is work that failed.
pub(super) fn refused(error: &SolidError, path: &Path) -> Failure {
    let path = path.display();
    match error {
        SolidError::NoVolume { .. } => Failure::Input(anyhow!(
            "{path}: found {error}; expected a closed mesh whose faces meet at common edges and corners only"
        )),
        SolidError::Coplanar { .. } | SolidError::OutsideEnvelope { .. } => {
            Failure::Input(anyhow!("{path}: {error}"))
        }
        other => Failure::Work(anyhow!("{path}: {other}")),
    }
}

/// A file that will be written: checked before the work starts.
struct Target {
    path: PathBuf,
    write: fn(&TetrahedraFile<'_>) -> Vec<u8>,
}

impl Target {
    fn new(path: &Path, force: bool) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let write: fn(&TetrahedraFile<'_>) -> Vec<u8> =
            match extension.map(str::to_ascii_lowercase).as_deref() {
                Some("vtk") => write_vtk,
                Some("mesh") => write_medit,
                _ => {
                    return Err(Failure::Input(anyhow!(
                        "{}: found no known extension, expected .vtk or .mesh",
                        path.display()
                    )));
                }
            };
        free(path, force)?;
        Ok(Self { path: path.to_owned(), write })
    }

    fn write(&self, found: &Tetrahedra) -> Result<(), Failure> {
        let faces: Vec<_> = found.boundary.iter().map(|face| face.corners).collect();
        let labels: Vec<_> = found.boundary.iter().map(|face| face.label).collect();
        let file = TetrahedraFile {
            vertices: &found.vertices,
            tetrahedra: &found.tetrahedra,
            faces: &faces,
            labels: &labels,
        };
        write_whole(&self.path, &(self.write)(&file))
    }
}
