//! `driftlab graph compare`: how far the poses of one file are from those of another.

use anyhow::anyhow;
use formats::tum::Trajectory;
use metrics::trajectory::{Alignment, Statistics, absolute_errors, align, relative_errors};
use pose::Se3;
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::out::Out;
use super::super::table::table;
use super::args::{Align, CompareArgs};
use super::input;
use super::numbers::shown;

pub(super) fn compare(args: &CompareArgs, out: &Out) -> Result<(), Failure> {
    let (first, second) = (input::poses(&args.a, out)?, input::poses(&args.b, out)?);
    if let (Some(2), Some(3)) | (Some(3), Some(2)) = (first.dimensions, second.dimensions) {
        let flat = if first.dimensions == Some(2) { &args.a } else { &args.b };
        let solid = if first.dimensions == Some(2) { &args.b } else { &args.a };
        out.note(&format!(
            "warning: {} is in 2D and {} in 3D; poses of the plane are compared as at height 0",
            flat.display(),
            solid.display()
        ));
    }
    let (a, b) = (first.trajectory, second.trajectory);
    let (reference, estimate) = matched(&a, &b, args.max_diff);
    if reference.is_empty() {
        let (a, b) = (args.a.display(), args.b.display());
        return Err(Failure::Input(anyhow!(
            "{b}: no pose has the id or the time of a pose of {a}, within {} s",
            args.max_diff
        )));
    }
    let how = match args.align {
        Align::Rigid => Alignment::Rigid,
        Align::Similarity => Alignment::Similarity,
        Align::Origin => Alignment::Origin,
        Align::None => Alignment::None,
    };
    let found = align(&reference, &estimate, how);
    let aligned: Vec<Se3> = estimate.iter().map(|pose| found.apply(pose)).collect();
    let ate = absolute_errors(&reference, &aligned);
    let rpe = relative_errors(&reference, &aligned, args.delta);
    let degrees = |statistics: &Statistics| Statistics {
        count: statistics.count,
        rmse: statistics.rmse.to_degrees(),
        mean: statistics.mean.to_degrees(),
        median: statistics.median.to_degrees(),
        min: statistics.min.to_degrees(),
        max: statistics.max.to_degrees(),
    };
    let rows = [
        ("ATE translation, m", ate.translation_m),
        ("ATE rotation, deg", degrees(&ate.rotation_rad)),
        ("RPE translation, m", rpe.translation_m),
        ("RPE rotation, deg", degrees(&rpe.rotation_rad)),
    ];
    let cells: Vec<Vec<String>> = rows
        .iter()
        .map(|(name, s)| {
            let numbers = [s.rmse, s.mean, s.median, s.min, s.max].map(shown);
            std::iter::once((*name).to_owned()).chain(numbers).collect()
        })
        .collect();
    let how = match args.align {
        Align::Rigid => "rigid",
        Align::Similarity => "similarity",
        Align::Origin => "origin",
        Align::None => "none",
    };
    let mut text = format!(
        "{} of {} poses match {} of the reference; alignment {how}, scale {}; RPE over {} pose(s)\n\n",
        reference.len(),
        b.poses.len(),
        a.poses.len(),
        shown(found.scale),
        args.delta.max(1),
    );
    text.push_str(&table(&["", "rmse", "mean", "median", "min", "max"], &cells, 1));
    let json = json!({
        "poses_a": a.poses.len(),
        "poses_b": b.poses.len(),
        "matched": reference.len(),
        "alignment": how,
        "scale": found.scale,
        "delta": args.delta.max(1),
        "ate_rmse_m": ate.translation_m.rmse,
        "rpe_translation_rmse_m": rpe.translation_m.rmse,
        "rpe_rotation_rmse_deg": rpe.rotation_rad.rmse.to_degrees(),
        "ate": {
            "translation_m": in_json(&rows[0].1),
            "rotation_deg": in_json(&rows[1].1),
        },
        "rpe": {
            "translation_m": in_json(&rows[2].1),
            "rotation_deg": in_json(&rows[3].1),
        },
    });
    out.result(&json, &text)
}

fn in_json(statistics: &Statistics) -> Value {
    json!({
        "count": statistics.count,
        "rmse": statistics.rmse,
        "mean": statistics.mean,
        "median": statistics.median,
        "min": statistics.min,
        "max": statistics.max,
    })
}

/// Pairs of poses whose times are nearest and differ by at most `max_diff`, in the order of times.
///
/// As in evo, the shorter trajectory looks for partners in the longer one.
fn matched(a: &Trajectory, b: &Trajectory, max_diff: f64) -> (Vec<Se3>, Vec<Se3>) {
    let by_time = |trajectory: &Trajectory| {
        let stamps = trajectory.stamps_secs.iter().copied();
        let mut all: Vec<(f64, Se3)> = stamps.zip(trajectory.poses.iter().copied()).collect();
        all.sort_by(|x, y| x.0.total_cmp(&y.0));
        all
    };
    let (a, b) = (by_time(a), by_time(b));
    let partners = |of: &[(f64, Se3)], among: &[(f64, Se3)]| -> Vec<(Se3, Se3)> {
        let find = |&(stamp, pose): &(f64, Se3)| {
            let after = among.partition_point(|other| other.0 < stamp);
            let near = [after.checked_sub(1), Some(after)];
            let near = near.into_iter().flatten().filter_map(|index| among.get(index));
            let nearest =
                near.min_by(|x, y| (x.0 - stamp).abs().total_cmp(&(y.0 - stamp).abs()))?;
            ((nearest.0 - stamp).abs() <= max_diff).then_some((pose, nearest.1))
        };
        of.iter().filter_map(find).collect()
    };
    if a.len() <= b.len() {
        partners(&a, &b).into_iter().unzip()
    } else {
        partners(&b, &a).into_iter().map(|(b, a)| (a, b)).unzip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_in_time_match() {
        let at = |x: f64| {
            let mut pose = Se3::identity();
            pose.translation.x = x;
            pose
        };
        let line = |stamps: &[f64]| Trajectory {
            stamps_secs: stamps.to_vec(),
            poses: stamps.iter().map(|&stamp| at(stamp)).collect(),
        };
        let (a, b) = matched(&line(&[2.0, 0.0, 1.0]), &line(&[0.004, 0.9, 1.006, 3.0]), 0.01);
        let x = |poses: &[Se3]| poses.iter().map(|pose| pose.translation.x).collect::<Vec<f64>>();
        assert_eq!((x(&a), x(&b)), (vec![0.0, 1.0], vec![0.004, 1.006]));
        assert!(matched(&line(&[1.0]), &line(&[2.0]), 0.01).0.is_empty());
    }
}
