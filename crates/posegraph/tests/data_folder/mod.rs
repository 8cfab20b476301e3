//! Where the test data of others is.

use std::io::Write;
use std::path::PathBuf;

/// The folder `posegraphs` of `$DRIFTLAB_DATA`, else of the test data beside the project; none, said
/// loudly, where it is not there.
pub fn graphs() -> Option<PathBuf> {
    let given = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = given.unwrap_or(beside).join("posegraphs");
    if folder.is_dir() {
        return Some(folder);
    }
    // Said past the test harness, which would swallow it.
    let text = "SKIPPED: no real pose graphs here; DRIFTLAB_DATA names the folder around it";
    writeln!(std::io::stderr(), "{text}: {}", folder.display()).expect("stderr takes text");
    None
}
