//! Odometry that jumps: no robot drives a kilometre from one scan to the next.

use formats::laser::LoggedScan;
use pose::Se2;

/// What is taken for driven between two scans is at most this, metres, and
const FARTHEST_M: f64 = 100.0;
/// so much more for each second between them.
const FASTEST_MPS: f64 = 50.0;

/// Takes jumps of the odometry for no motion, so that what comes after goes on from there; tells of them.
///
/// A counter that overflows or starts anew, or a broken line, would otherwise put maps in the plane of the
/// odometry kilometres apart. Scans that no jump comes before stay as they are, bit for bit.
pub(super) fn bridge(scans: &mut [LoggedScan]) -> Option<String> {
    let mut here_from_logged: Option<Se2> = None;
    let (mut jumps, mut first) = (0_usize, None);
    let mut before: Option<LoggedPose> = None;
    for scan in scans {
        let logged = LoggedPose { secs: scan.stamp_secs, pose: scan.odom_from_sensor };
        if let Some(shift) = &here_from_logged {
            scan.odom_from_sensor = *shift * logged.pose;
        }
        if let Some(before) = &before {
            let most_m = FARTHEST_M + FASTEST_MPS * (logged.secs - before.secs).max(0.0);
            let step_m = before.pose.inverse_mul(&logged.pose).distance();
            // A distance that is none is no motion, either.
            if step_m.is_nan() || step_m > most_m {
                let stays = here_from_logged.unwrap_or_else(Se2::identity) * before.pose;
                here_from_logged = Some(stays * logged.pose.inverse());
                scan.odom_from_sensor = stays;
                jumps += 1;
                first.get_or_insert((step_m, before.secs));
            }
        }
        before = Some(logged);
    }
    let (step_m, secs) = first?;
    Some(format!(
        "odometry jumps {jumps} time(s), first by {step_m:.0} m after the scan at {secs} s; taken for no motion"
    ))
}

/// What the log says of one scan.
struct LoggedPose {
    secs: f64,
    pose: Se2,
}

#[cfg(test)]
mod tests {
    use super::*;
    use sensing::Scan;

    fn driven(xs: &[f64]) -> Vec<LoggedScan> {
        let scan = |(i, &x): (usize, &f64)| LoggedScan {
            stamp_secs: i as f64,
            odom_from_sensor: Se2::new(x, 1.0, 0.5),
            scan: Scan::new(0.0, 0.1, Vec::new(), 30.0),
        };
        xs.iter().enumerate().map(scan).collect()
    }

    fn xs(scans: &[LoggedScan]) -> Vec<f64> {
        scans.iter().map(|scan| scan.odom_from_sensor.translation.x).collect()
    }

    #[test]
    fn odometry_that_drives_stays_as_it_is() {
        let mut scans = driven(&[0.0, 0.3, 100.0, 249.0]);
        let before = scans.clone();
        assert_eq!(bridge(&mut scans), None);
        assert_eq!(scans, before);
    }

    #[test]
    fn a_spike_and_a_counter_that_starts_anew_are_no_motion() {
        let mut scans = driven(&[1.0, 2.0, 1e7, 3.0, 4.0, 5e3, 5001.0]);
        let told = bridge(&mut scans).expect("jumps");
        assert!(told.contains("3 time(s)") && told.contains("at 1 s"), "{told}");
        let expected = [1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 4.0];
        for (x, expected) in xs(&scans).iter().zip(expected) {
            assert!((x - expected).abs() < 1e-6, "{x} {expected}");
        }
    }
}
