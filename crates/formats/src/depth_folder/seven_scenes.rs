//! A pose file beside each image.

use std::collections::BTreeSet;

use super::names::number;
use super::{DepthFolder, DepthFolderError, DepthFrame, FolderKind, Listing, poses};

/// The folder, if it holds images of that kind.
pub(super) fn read(listing: &Listing<'_>) -> Result<Option<DepthFolder>, DepthFolderError> {
    let number_of =
        |name: &String| number(name.strip_prefix("frame-")?.strip_suffix(".depth.png")?);
    let numbered = listing.names.iter().filter_map(|name| Some((number_of(name)?, name.clone())));
    let mut images: Vec<(u64, String)> = numbered.collect();
    images.sort();
    if images.is_empty() {
        return Ok(None);
    }
    let mut folder = DepthFolder {
        kind: FolderKind::SevenScenes,
        frames: Vec::with_capacity(images.len()),
        camera: listing.camera()?,
        units_per_metre: 1000.0,
        warnings: Vec::new(),
    };
    let names: BTreeSet<&str> = listing.names.iter().map(String::as_str).collect();
    for (at, (_, file)) in images.into_iter().enumerate() {
        let pose_file = file.replace(".depth.png", ".pose.txt");
        if !names.contains(pose_file.as_str()) {
            folder.warnings.push(format!("{file}: left out, there is no {pose_file}"));
            continue;
        }
        let why = match listing.parsed(&pose_file, poses::matrix) {
            Ok(Some(map_from_camera)) => {
                folder.frames.push(DepthFrame { file, stamp_secs: at as f64, map_from_camera });
                continue;
            }
            Ok(None) => format!("{pose_file} is no pose"),
            // One bad file of many is no reason to refuse the others.
            Err(error) => error.to_string(),
        };
        folder.warnings.push(format!("{file}: left out, {why}"));
    }
    Ok(Some(folder))
}
