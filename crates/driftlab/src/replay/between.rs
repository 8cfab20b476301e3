//! Poses between keyframes: of every scan of a log, and at any time.

use maps2d::Standing;
use pose::Se2;

use super::PlanarLog;
use super::course::{Course, Stop};

/// The poses of all scans, from those of the keyframes.
///
/// Where the log says at which vertex each scan was taken, the scan is there, in the frame of that vertex:
/// known vertices are come back to. Else the scan lies between two keyframes.
pub(super) fn of_scans(log: &PlanarLog, course: &Course, map_from_keyframe: &[Se2]) -> Vec<Se2> {
    if course.standings.is_empty() {
        return spread(log, &course.stops, map_from_keyframe);
    }
    let stood = |standing: &Standing| {
        let pose = map_from_keyframe.get(standing.vertex.0 as usize).copied();
        pose.unwrap_or_default() * standing.vertex_from_body
    };
    course.standings.iter().map(stood).collect()
}

/// The poses of all scans between two keyframes as odometry has it, with the difference at the end spread over
/// the way.
///
/// `map_from_keyframe` is by keyframe; scans before the first keyframe are as odometry has them from it.
fn spread(log: &PlanarLog, stops: &[Stop], map_from_keyframe: &[Se2]) -> Vec<Se2> {
    let mut poses = Vec::with_capacity(log.scans.len());
    for (index, scan) in log.scans.iter().enumerate() {
        let next = stops.partition_point(|stop| stop.scan <= index);
        let at = next.saturating_sub(1);
        let Some((stop, pose)) = stops.get(at).zip(map_from_keyframe.get(at)) else {
            poses.push(scan.odom_from_sensor);
            continue;
        };
        let by_odometry = stop.odom_from_sensor.inverse_mul(&scan.odom_from_sensor);
        let ends = stops.get(next).zip(map_from_keyframe.get(next)).filter(|_| next > at);
        let Some((end, end_pose)) = ends else {
            poses.push(*pose * by_odometry);
            continue;
        };
        let whole = stop.odom_from_sensor.inverse_mul(&end.odom_from_sensor);
        let off = whole.inverse_mul(&pose.inverse_mul(end_pose)).log();
        poses.push(*pose * by_odometry.boxplus(&(off * share(log, stop.scan, index, end.scan))));
    }
    poses
}

/// How far a scan is between two, by what odometry says was driven and turned.
fn share(log: &PlanarLog, from: usize, at: usize, to: usize) -> f64 {
    let way = |from: usize, to: usize| {
        let scans = log.scans[from..=to].windows(2);
        scans
            .map(|pair| {
                let step = pair[0].odom_from_sensor.inverse_mul(&pair[1].odom_from_sensor);
                step.distance() + step.angle().abs()
            })
            .sum::<f64>()
    };
    let (part, whole) = (way(from, at), way(from, to));
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// A pose at a time, between two scans by the twist from one to the other.
pub(super) fn at(log: &PlanarLog, map_from_scan: &[Se2], secs: f64) -> Option<Se2> {
    let next = log.scans.partition_point(|scan| scan.stamp_secs <= secs);
    let before = next.saturating_sub(1);
    let first = map_from_scan.get(before)?;
    let Some(last) = map_from_scan.get(next).filter(|_| next > before) else { return Some(*first) };
    let span = log.scans[next].stamp_secs - log.scans[before].stamp_secs;
    let share = (secs - log.scans[before].stamp_secs) / span;
    Some(first.boxplus(&(first.inverse_mul(last).log() * share)))
}

/// The scan nearest to a time, and how far off it is, seconds.
pub(super) fn nearest(log: &PlanarLog, secs: f64) -> Option<(usize, f64)> {
    let next = log.scans.partition_point(|scan| scan.stamp_secs < secs);
    let around = next.saturating_sub(1)..(next + 1).min(log.scans.len());
    let gaps = around.map(|i| (i, (log.scans[i].stamp_secs - secs).abs()));
    gaps.min_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use formats::laser::LoggedScan;
    use probe::VertexId;
    use sensing::Scan;

    fn log() -> PlanarLog {
        let scan = |i: u32| LoggedScan {
            stamp_secs: f64::from(i),
            odom_from_sensor: Se2::new(f64::from(i), 0.0, 0.0),
            scan: Scan::new(0.0, 0.1, vec![1.0], 5.0),
        };
        PlanarLog { scans: (0..7).map(scan).collect(), ..PlanarLog::default() }
    }

    #[test]
    fn a_correction_is_spread_over_the_way() {
        let log = log();
        let stop = |scan: usize| Stop {
            scan,
            stamp_secs: scan as f64,
            distance_m: scan as f64,
            odom_from_sensor: log.scans[scan].odom_from_sensor,
        };
        let keyframes = [Se2::new(0.0, 0.0, 0.0), Se2::new(4.0, 0.4, 0.0)];
        let mut course = Course { stops: vec![stop(0), stop(4)], ..Course::default() };
        let poses = of_scans(&log, &course, &keyframes);
        let y: Vec<f64> =
            poses.iter().map(|pose| (pose.translation.y * 1e9).round() / 1e9).collect();
        assert_eq!(y, [0.0, 0.1, 0.2, 0.3, 0.4, 0.4, 0.4]);
        assert_eq!(poses[6].translation.x, 6.0);
        let between = at(&log, &poses, 2.5).expect("scans");
        assert!((between.translation.y - 0.25).abs() < 1e-12);
        assert_eq!(at(&log, &poses, -5.0), Some(poses[0]));
        assert_eq!(nearest(&log, 3.4).map(|n| n.0), Some(3));
        assert_eq!(nearest(&log, 99.0), Some((6, 93.0)));

        // Back at the first vertex, nothing of the second is in the poses.
        course.standings = [0, 0, 1, 1, 0, 0, 0]
            .map(|vertex| Standing {
                vertex: VertexId(vertex),
                vertex_from_body: Se2::new(0.0, 0.5, 0.0),
            })
            .to_vec();
        let poses = of_scans(&log, &course, &keyframes);
        let y: Vec<f64> = poses.iter().map(|pose| pose.translation.y).collect();
        assert_eq!(y, [0.5, 0.5, 0.9, 0.9, 0.5, 0.5, 0.5]);
    }
}
