//! Images and poses with times, which are brought together by time.

use pose::Se3;

use super::names::{folder_of, image_stem};
use super::{DepthFolder, DepthFolderError, DepthFrame, FolderKind, Listing, poses};
use crate::tum::Trajectory;

/// The poses.
const POSES: &str = "groundtruth.txt";
/// The images and their times.
const IMAGES: &str = "depth.txt";
/// A pose farther away in time than this says nothing of an image, seconds; what the benchmark's own
/// tools take.
const FARTHEST_SECS: f64 = 0.02;

/// The folder, if it holds poses of that kind.
pub(super) fn read(listing: &Listing<'_>) -> Result<Option<DepthFolder>, DepthFolderError> {
    if !listing.has(POSES) {
        return Ok(None);
    }
    let mut images = if listing.has(IMAGES) {
        listing.parsed(IMAGES, poses::timed_files)?
    } else {
        let in_depth = listing.names.iter().filter(|name| folder_of(name) == "depth");
        let time = |name: &String| image_stem(name)?.parse().ok().filter(|t: &f64| t.is_finite());
        in_depth.filter_map(|name| Some((time(name)?, name.clone()))).collect()
    };
    images.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    let listed = listing.parsed(POSES, poses::timed)?;
    let trajectory = in_order(&listed);
    let mut folder = DepthFolder {
        kind: FolderKind::Tum,
        frames: Vec::with_capacity(images.len()),
        camera: listing.camera()?,
        units_per_metre: 5000.0,
        warnings: Vec::new(),
    };
    let none = listed.len() - trajectory.poses.len();
    if none > 0 {
        folder.warnings.push(format!("{POSES}: {none} of {} lines are no pose", listed.len()));
    }
    for (stamp_secs, file) in images {
        if !stamp_secs.is_finite() {
            folder.warnings.push(format!("{file}: left out, its time in {IMAGES} is none"));
            continue;
        }
        match at_time(&trajectory, stamp_secs) {
            Some(map_from_camera) => {
                folder.frames.push(DepthFrame { file, stamp_secs, map_from_camera });
            }
            None => folder.warnings.push(format!(
                "{file}: left out, no pose of {POSES} within {FARTHEST_SECS} s of {stamp_secs}"
            )),
        }
    }
    Ok(Some(folder))
}

/// The poses of the lines that hold one, by time.
fn in_order(listed: &[(f64, Option<Se3>)]) -> Trajectory {
    let timed = listed.iter().filter_map(|(time, pose)| Some((*time, (*pose)?)));
    let mut timed: Vec<(f64, Se3)> = timed.collect();
    timed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (stamps_secs, poses) = timed.into_iter().unzip();
    Trajectory { stamps_secs, poses }
}

/// The pose at a time, between the poses before and after it where both are near.
fn at_time(trajectory: &Trajectory, secs: f64) -> Option<Se3> {
    let times = &trajectory.stamps_secs;
    let after = times.partition_point(|&time| time < secs);
    let near = |at: usize| times.get(at).is_some_and(|time| (time - secs).abs() <= FARTHEST_SECS);
    let before = after.checked_sub(1).filter(|&at| near(at));
    match (before, near(after)) {
        (Some(before), true) => {
            let span = times[after] - times[before];
            let share = if span > 0.0 { (secs - times[before]) / span } else { 0.0 };
            let (from, to) = (trajectory.poses[before], trajectory.poses[after]);
            Some(from.boxplus(&(to.boxminus(&from) * share)))
        }
        (Some(before), false) => Some(trajectory.poses[before]),
        (None, true) => Some(trajectory.poses[after]),
        (None, false) => None,
    }
}
