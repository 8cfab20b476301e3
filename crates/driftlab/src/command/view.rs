//! `driftlab view`: finds the viewer and starts it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, anyhow};
use serde_json::json;

use super::args::ViewArgs;
use super::failure::Failure;
use super::out::Out;
use crate::run::names;

/// The version of the viewer that fits the recordings.
const VIEWER_VERSION: &str = "0.36.3";

pub(super) fn view(args: &ViewArgs, out: &Out) -> Result<(), Failure> {
    let file = recording(&args.file)?;
    let Some(viewer) = on_path("rerun") else {
        return Err(Failure::Work(anyhow!(
            "no `rerun` program on the PATH; get the viewer with `pip install \
             rerun-sdk=={VIEWER_VERSION}` and run `rerun {}`",
            file.display()
        )));
    };
    if let Some(found) = version_of(&viewer).filter(|found| found != VIEWER_VERSION) {
        out.note(&format!(
            "warning: {} is version {found}; recordings are written for {VIEWER_VERSION}",
            viewer.display()
        ));
    }
    out.detail(&format!("starting {}", viewer.display()));
    let status = Command::new(&viewer)
        .arg(&file)
        .stdout(Stdio::null())
        .status()
        .with_context(|| format!("{}: cannot be started", viewer.display()))
        .map_err(Failure::Work)?;
    if !status.success() {
        return Err(Failure::Work(anyhow!("{} ended with {status}", viewer.display())));
    }
    let (viewer, file) = (viewer.display().to_string(), file.display().to_string());
    out.result(&json!({ "viewer": viewer, "file": file }), "")
}

/// The recording that was named, or the one in the folder that was.
pub(super) fn recording(path: &Path) -> Result<PathBuf, Failure> {
    let file = if path.is_dir() { path.join(names::RECORDING) } else { path.to_owned() };
    if file.is_file() {
        return Ok(file);
    }
    let expected = "expected a recording (.rrd) or the folder of a run";
    Err(Failure::Input(anyhow!("{}: no such file; {expected}", file.display())))
}

fn on_path(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let name = format!("{program}{}", std::env::consts::EXE_SUFFIX);
    std::env::split_paths(&path).map(|folder| folder.join(&name)).find(|file| is_program(file))
}

#[cfg(unix)]
fn is_program(file: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    file.metadata().is_ok_and(|meta| meta.is_file() && meta.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_program(file: &Path) -> bool {
    file.is_file()
}

/// The version that the viewer tells, as `0.36.3`; `None` where it tells none.
fn version_of(viewer: &Path) -> Option<String> {
    let output = Command::new(viewer).arg("--version").stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let is_version =
        |word: &&str| word.split('.').count() == 3 && word.starts_with(char::is_numeric);
    text.split_whitespace().find(is_version).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_viewer_fits_the_recordings() {
        let manifest = include_str!("../../../../Cargo.toml");
        let pinned = format!("rerun = {{ version = \"={VIEWER_VERSION}\"");
        assert!(manifest.contains(&pinned), "{pinned}");
    }
}
