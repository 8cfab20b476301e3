//! Writing a file whole or not at all.

use std::fs;
use std::path::Path;

use anyhow::anyhow;

use super::failure::Failure;

/// Refuses to replace a file unless forced to.
pub(super) fn free(path: &Path, force: bool) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::Input(anyhow!("{}: found a folder, expected a file", path.display())));
    }
    if path.exists() && !force {
        return Err(Failure::Input(anyhow!(
            "{}: the file exists already; --force replaces it",
            path.display()
        )));
    }
    Ok(())
}

/// Writes under a temporary name beside the file, then renames.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let waiting = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
    let refused = |path: &Path| {
        let path = path.display().to_string();
        move |error: std::io::Error| Failure::Work(anyhow!("{path}: {error}"))
    };
    let written = fs::write(&waiting, bytes).map_err(refused(path));
    let renamed = written.and_then(|()| fs::rename(&waiting, path).map_err(refused(path)));
    if renamed.is_err() {
        // It may not even be there: the write itself can have failed.
        let _ = fs::remove_file(&waiting);
    }
    renamed
}
