//! Alignment and errors of trajectories.

use metrics::trajectory::{Alignment, Statistics, absolute_errors, align, relative_errors};
use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

fn pose() -> impl Strategy<Value = Se3> + Clone {
    (prop::array::uniform3(-9.0..9.0_f64), prop::array::uniform3(-2.0..2.0_f64))
        .prop_map(|(t, r)| Se3::new(t.into(), UnitQuaternion::from_scaled_axis(Vector3::from(r))))
}

proptest! {
    #[test]
    fn a_moved_and_scaled_copy_is_found_back(
        poses in prop::collection::vec(pose(), 4..20),
        motion in pose(),
        scale in 0.3..3.0_f64,
    ) {
        let moved: Vec<Se3> = poses.iter().map(|p| motion * *p).collect();
        let found = align(&poses, &moved, Alignment::Rigid);
        let aligned: Vec<Se3> = moved.iter().map(|p| found.apply(p)).collect();
        prop_assert!(absolute_errors(&poses, &aligned).translation_m.max < 1e-9);
        prop_assert!(absolute_errors(&poses, &aligned).rotation_rad.max < 1e-6);
        prop_assert!(relative_errors(&poses, &moved, 2).translation_m.max < 1e-9);

        let scaled: Vec<Se3> =
            moved.iter().map(|p| Se3::new(p.translation * scale, p.rotation)).collect();
        let found = align(&poses, &scaled, Alignment::Similarity);
        prop_assert!((found.scale * scale - 1.0).abs() < 1e-9);
        let aligned: Vec<Se3> = scaled.iter().map(|p| found.apply(p)).collect();
        prop_assert!(absolute_errors(&poses, &aligned).translation_m.max < 1e-9);
    }

    #[test]
    fn no_other_motion_fits_better(
        pairs in prop::collection::vec((pose(), pose()), 3..12),
        nudge in prop::array::uniform6(-0.1..0.1_f64),
        planar in any::<bool>(),
    ) {
        let flat = |p: &Se3| {
            let mut p = *p;
            if planar { p.translation.z = 0.0; }
            p
        };
        let reference: Vec<Se3> = pairs.iter().map(|(r, _)| flat(r)).collect();
        let estimate: Vec<Se3> = pairs.iter().map(|(_, e)| flat(e)).collect();
        let best = align(&reference, &estimate, Alignment::Rigid);
        let rmse = |how: &metrics::trajectory::Similarity| {
            let aligned: Vec<Se3> = estimate.iter().map(|p| how.apply(p)).collect();
            absolute_errors(&reference, &aligned).translation_m.rmse
        };
        let [x, y, z, a, b, c] = nudge;
        let (x, y, z, a, b, c) = if planar { (x, y, 0.0, 0.0, 0.0, c) } else { (x, y, z, a, b, c) };
        let nudge = Se3::new([x, y, z].into(), UnitQuaternion::from_scaled_axis([a, b, c].into()));
        let mut other = best;
        other.motion = other.motion * nudge;
        prop_assert!(rmse(&best) <= rmse(&other) + 1e-12);
        if planar {
            prop_assert_eq!(best.motion.translation.z, 0.0);
        }
    }
}

#[test]
fn statistics_by_hand() {
    let found = Statistics::of(&[3.0, 1.0, 2.0, 6.0]);
    assert_eq!(
        (found.count, found.mean, found.median, found.min, found.max),
        (4, 3.0, 2.5, 1.0, 6.0)
    );
    assert!((found.rmse - 12.5_f64.sqrt()).abs() < 1e-15);
    assert_eq!(Statistics::of(&[]), Statistics::default());
}

#[test]
fn a_wrong_step_shows_once() {
    let at = |x: f64| Se3::new([x, 0.0, 0.0].into(), UnitQuaternion::identity());
    let reference = [at(0.0), at(1.0), at(2.0), at(3.0)];
    let estimate = [at(0.0), at(1.0), at(2.5), at(3.5)];
    let step = relative_errors(&reference, &estimate, 1).translation_m;
    assert_eq!((step.count, step.max, step.min), (3, 0.5, 0.0));
    assert_eq!(relative_errors(&reference, &estimate, 9).translation_m.count, 0);
    let origin = align(&reference, &estimate[1..], Alignment::Origin);
    assert_eq!(origin.motion.translation.x, -1.0);
    assert_eq!(align(&[], &estimate, Alignment::Rigid).scale, 1.0);
}
