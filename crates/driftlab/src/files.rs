//! Files that are whole or not there.

use std::fs;
use std::io;
use std::path::Path;

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
