//! Files that are whole or not there.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Writes a file under a temporary name beside it, then renames: a reader sees the old bytes or the
/// new ones.
pub(crate) fn replace_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let waiting = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
    let done = fs::write(&waiting, bytes).and_then(|()| fs::rename(&waiting, path));
    if done.is_err() {
        // It may not even be there: the write itself can have failed.
        let _ = fs::remove_file(&waiting);
    }
    done
}

/// A file that grows under a temporary name beside its own; dropped before its end, it leaves nothing.
#[derive(Debug)]
pub(crate) struct PartialFile {
    path: PathBuf,
    waiting: PathBuf,
    file: Option<fs::File>,
}

impl PartialFile {
    /// Makes the file under its temporary name.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let waiting = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
        let file = fs::File::create(&waiting)?;
        Ok(Self { path: path.to_owned(), waiting, file: Some(file) })
    }

    /// Another handle to write to.
    pub(crate) fn handle(&self) -> io::Result<fs::File> {
        match &self.file {
            Some(file) => file.try_clone(),
            None => Err(io::Error::other("the file is finished")),
        }
    }

    /// The name that it will get.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the file its name.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.file = None;
        fs::rename(&self.waiting, &self.path)
    }
}

impl Drop for PartialFile {
    fn drop(&mut self) {
        // It is not there any more where it got its name.
        let _ = fs::remove_file(&self.waiting);
    }
}
