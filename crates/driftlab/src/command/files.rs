//! Writing a file whole or not at all.

use std::path::Path;

use anyhow::anyhow;

use super::failure::Failure;
use crate::files::replace_file;

/// Refuses a file that cannot be made: in a folder that is not there, or in the place of another unless
/// forced to.
pub(super) fn free(path: &Path, force: bool) -> Result<(), Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        return Err(Failure::Input(anyhow!(
            "{}: the folder {} does not exist; expected one that does",
            path.display(),
            folder.display()
        )));
    }
    vacant(path, force)
}

/// Refuses to replace a file unless forced to; its folder may have to be made.
pub(super) fn vacant(path: &Path, force: bool) -> Result<(), Failure> {
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

/// Refuses a recording that would take the place of something else that the command reads or writes.
pub(super) fn apart<'a>(
    record: &Path,
    others: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Failure> {
    // One file may have several names; of a file that is to be made, its folder is there.
    let place = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok();
        let made = folder.zip(path.file_name()).map(|(folder, name)| folder.join(name));
        path.canonicalize().ok().or(made).unwrap_or_else(|| path.to_owned())
    };
    let own = place(record);
    if others.into_iter().all(|other| place(other) != own) {
        return Ok(());
    }
    Err(Failure::Input(anyhow!(
        "{}: found it for the recording and for another file, expected two files",
        record.display()
    )))
}

/// Writes under a temporary name beside the file, then renames.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let refused = |error| Failure::Work(anyhow!("{}: {error}", path.display()));
    replace_file(path, bytes).map_err(refused)
}
