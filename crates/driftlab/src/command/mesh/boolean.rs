//! `driftlab mesh boolean`: two meshes made one.

use std::path::Path;
use std::time::Instant;

use anyhow::anyhow;
use instrument::{BooleanRecording, SolidOptions};
use solid::boolean::{BooleanResult, JITTER_M, ManifoldKernel, Options, Provenance, boolean_told};
use solid::{Operation, SolidError};

use super::super::failure::Failure;
use super::super::graph::numbers::listed;
use super::super::out::Out;
use super::args::{BooleanArgs, OperationName};
use super::input;
use super::told::Told;

pub(super) fn boolean(args: &BooleanArgs, out: &Out) -> Result<(), Failure> {
    let target = args.output.target(&[&args.a, &args.b])?;
    let a = input::mesh(&args.a, args.input.weld, out)?;
    let b = input::mesh(&args.b, args.input.weld, out)?;
    let operation = match args.operation {
        OperationName::Union => Operation::Union,
        OperationName::Intersection => Operation::Intersection,
        OperationName::Difference => Operation::Difference,
        OperationName::SymmetricDifference => Operation::SymmetricDifference,
    };
    let provenance = if args.origins { Provenance::Origins } else { Provenance::Labels };
    if !(args.clean >= 0.0 && args.clean.is_finite()) {
        return Err(Failure::Input(anyhow!(
            "--clean: found {}, expected metres from 0",
            args.clean
        )));
    }
    let jitter_m = if args.jitter { JITTER_M } else { 0.0 };
    let (clean_m, seed) = (args.clean, args.seed);
    let options = Options { provenance, clean_m, jitter_m, seed, ..Options::default() };
    let mut recording = match &args.output.recording.record {
        Some(path) => Some(record(path, operation, args)?),
        None => None,
    };
    let start = Instant::now();
    let (a_mesh, b_mesh) = (&a.mesh, &b.mesh);
    let combined = match &mut recording {
        Some(recording) => {
            boolean_told(&ManifoldKernel, a_mesh, b_mesh, operation, &options, recording)
        }
        None => boolean_told(&ManifoldKernel, a_mesh, b_mesh, operation, &options, &mut probe::Off),
    };
    let secs = start.elapsed().as_secs_f64();
    let result = combined.map_err(|error| refused(&error, args))?;
    if let Some(target) = &target {
        target.write(&result.mesh)?;
    }
    tell(&result, secs, a.secs + b.secs, recording, args, out)
}

fn record(
    path: &Path,
    operation: Operation,
    args: &BooleanArgs,
) -> Result<BooleanRecording, Failure> {
    let options = SolidOptions {
        path: path.to_owned(),
        name: operation.to_string(),
        about: format!("The {operation} of `{}` and `{}`.", shown(&args.a), shown(&args.b)),
    };
    BooleanRecording::create(&options).map_err(Failure::work)
}

fn shown(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// An operand that is no closed 2-manifold is bad input; its file is named.
fn refused(error: &SolidError, args: &BooleanArgs) -> Failure {
    match error {
        SolidError::Operand { which, defect } => {
            let path = if which == "first" { &args.a } else { &args.b };
            Failure::Input(anyhow!(
                "{}: found no closed 2-manifold: {defect}; expected one",
                path.display()
            ))
        }
        other => Failure::Work(anyhow!("{other}")),
    }
}

fn tell(
    result: &BooleanResult,
    secs: f64,
    secs_read: f64,
    recording: Option<BooleanRecording>,
    args: &BooleanArgs,
    out: &Out,
) -> Result<(), Failure> {
    let told = Told::of(&result.mesh);
    let mut json = told.json();
    json["jitter_m"] = result.jitter_m.into();
    json["secs"] = secs.into();
    json["secs_read"] = secs_read.into();
    if let Some(recording) = recording {
        recording.finish(&json).map_err(Failure::work)?;
    }
    args.output.tell(&mut json);
    let mut rows = told.rows();
    if result.jitter_m > 0.0 {
        rows.push(("moved", format!("faces of the second by {:.1e} m", result.jitter_m)));
    }
    rows.push(("seconds", format!("read {secs_read:.4}, combine {secs:.4}")));
    out.result(&json, &listed(&rows))
}
