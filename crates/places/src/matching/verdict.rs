//! What of a scan a place explains, and what it contradicts.

use pose::Se2;

use super::Surfaces;
use crate::{Keyframe, SurfacePoint};

/// A return so far inside what was seen to be free contradicts it, metres.
const INSIDE_M: f64 = 0.4;

/// How a scan agrees with a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Share of the returns that lie on a known surface.
    pub overlap: f64,
    /// Share of the returns that lie on one, or well inside what was seen to be free, that do the latter.
    pub contradiction: f64,
}

/// Holds returns against known surfaces, and against what the place's keyframes saw to be free.
///
/// `place_from_keyframe` goes with each keyframe. People walk by: some contradiction is normal.
pub fn agreement(
    surfaces: &Surfaces,
    keyframes: &[(&Keyframe, Se2)],
    points: &[SurfacePoint],
    place_from_scan: &Se2,
    same_m: f64,
) -> Agreement {
    let (mut explained, mut contradicted) = (0_u32, 0_u32);
    for source in points {
        let point = place_from_scan.transform(&source.point);
        if surfaces.nearest(&point, same_m).is_some() {
            explained += 1;
            continue;
        }
        let seen_through = keyframes.iter().any(|(keyframe, place_from_keyframe)| {
            let in_keyframe = place_from_keyframe.inverse_transform(&point);
            keyframe.free_beyond(&in_keyframe).is_some_and(|beyond_m| beyond_m > INSIDE_M)
        });
        contradicted += u32::from(seen_through);
    }
    let share = |part: u32, whole: f64| if whole > 0.0 { f64::from(part) / whole } else { 0.0 };
    Agreement {
        overlap: share(explained, points.len() as f64),
        contradiction: share(contradicted, f64::from(explained + contradicted)),
    }
}
