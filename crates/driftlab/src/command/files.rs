//! Writing a file whole or not at all.

use std::path::Path;

use anyhow::anyhow;

use super::failure::Failure;
use crate::files::replace_file;

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
    let refused = |error| Failure::Work(anyhow!("{}: {error}", path.display()));
    replace_file(path, bytes).map_err(refused)
}
