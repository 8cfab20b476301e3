//! Images with numbers, and poses in the same order.

use pose::Se3;

use super::names::{folder_of, image_stem, number};
use super::{DepthFolder, DepthFolderError, DepthFrame, FolderKind, Listing, poses};

/// Names of the poses' file.
const POSES: [&str; 3] = ["pose.txt", "poses.txt", "trajectory.txt"];

/// The folder; without frames if it holds no numbered images.
pub(super) fn read(listing: &Listing<'_>) -> Result<DepthFolder, DepthFolderError> {
    let mut images: Vec<(u64, String)> =
        listing.names.iter().filter_map(|name| Some((number_of(name)?, name.clone()))).collect();
    images.sort();
    let of_tum = images.iter().all(|(_, name)| image_stem(name).is_some_and(is_tum));
    let mut folder = DepthFolder {
        kind: FolderKind::Numbered,
        frames: Vec::with_capacity(images.len()),
        camera: listing.camera()?,
        units_per_metre: if of_tum { 5000.0 } else { 1000.0 },
        warnings: Vec::new(),
    };
    if images.is_empty() {
        return Ok(folder);
    }
    let listed = match POSES.iter().find(|name| listing.has(name)) {
        None => {
            let count = images.len();
            folder.warnings.push(format!(
                "no {}: all {count} images are taken from one place",
                POSES.join(", ")
            ));
            vec![Some(Se3::identity()); count]
        }
        Some(file) => {
            let listed = listing.parsed(file, poses::lines)?;
            if listed.len() < images.len() {
                let (found, expected) = (listed.len(), images.len());
                let file = (*file).to_owned();
                return Err(DepthFolderError::TooFewPoses { file, found, expected });
            }
            by_image(&images, listed, file, &mut folder.warnings)
        }
    };
    for (at, ((_, file), pose)) in images.into_iter().zip(listed).enumerate() {
        match pose {
            Some(map_from_camera) => {
                folder.frames.push(DepthFrame { file, stamp_secs: at as f64, map_from_camera });
            }
            None => folder.warnings.push(format!("{file}: left out, its line is no pose")),
        }
    }
    Ok(folder)
}

/// The pose of each image, of a file that has more lines: where the last image is that of the last line, counted from 0
/// or from 1, images are missing and the number of an image is that of its line; else lines are taken in order.
fn by_image(
    images: &[(u64, String)],
    listed: Vec<Option<Se3>>,
    file: &str,
    warnings: &mut Vec<String>,
) -> Vec<Option<Se3>> {
    let (lines, last) = (listed.len() as u64, images.last().map_or(0, |(number, _)| *number));
    if lines == images.len() as u64 {
        return listed;
    }
    let count = images.len();
    let first = match lines {
        _ if last + 1 == lines => 0,
        _ if last == lines && images[0].0 > 0 => 1,
        _ => {
            warnings.push(format!("{file}: {lines} poses for {count} images, taken in order"));
            return listed;
        }
    };
    warnings
        .push(format!("{file}: {lines} poses for {count} images, taken by number from {first}"));
    let of = |number: u64| listed[usize::try_from(number - first).unwrap_or(usize::MAX)];
    images.iter().map(|(number, _)| of(*number)).collect()
}

fn is_tum(stem: &str) -> bool {
    stem.strip_suffix("_depth").is_some_and(|rest| number(rest).is_some())
}

/// The number in the name of a depth image.
fn number_of(name: &str) -> Option<u64> {
    let stem = image_stem(name)?;
    match folder_of(name) {
        "" => {
            let rest = stem.strip_prefix("depth").map(|rest| rest.trim_start_matches(['_', '-']));
            rest.or_else(|| stem.strip_suffix("_depth")).and_then(number)
        }
        "depth" => number(stem),
        _ => None,
    }
}
