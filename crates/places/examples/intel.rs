//! What place recognition makes of a raw log, held against published relations and corrected poses.
//!
//! ```text
//! cargo run --release -p places --example intel -- [LOG] [CORRECTED|-] [RELATIONS|-]
//! ```
#![expect(clippy::print_stdout, reason = "a program")]

use std::path::PathBuf;
use std::time::Instant;

use formats::laser::{LoggedScan, read, relations};
use places::{Driven, PlaceParams, Recognizer, Verdict};
use pose::Se2;

fn data(name: &str) -> PathBuf {
    let named = std::env::var_os("DRIFTLAB_DATA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    named.unwrap_or(beside).join("laser").join(name)
}

fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    sorted.get((q * last as f64).round() as usize).copied().unwrap_or(f64::NAN)
}

/// The pose at a time, between keyframes by the twist from one to the next.
fn pose_at(stamps: &[f64], poses: &[Se2], secs: f64) -> Se2 {
    let next = stamps.partition_point(|stamp| *stamp <= secs).clamp(1, stamps.len() - 1);
    let span = stamps[next] - stamps[next - 1];
    let share = if span > 0.0 { (secs - stamps[next - 1]) / span } else { 0.0 };
    let step = poses[next - 1].inverse_mul(&poses[next]).log();
    poses[next - 1].boxplus(&(step * share.clamp(0.0, 1.0)))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut file = |default: &str| match arguments.next() {
        Some(name) if name == "-" => None,
        Some(name) => Some(PathBuf::from(name)),
        None => Some(data(default)),
    };
    let log = file("intel_gfs.json.gz").ok_or("a log")?;
    let corrected = file("intel_corrected.json.gz");
    let relations_file = file("intel.relations");
    let scans = read(&std::fs::read(log)?)?.scans;

    let params = PlaceParams::default();
    let mut recognizer = Recognizer::new(params);
    let (mut millis, mut stamps, mut raw) = (Vec::new(), Vec::new(), Vec::new());
    let mut driven = Driven::default();
    let mut last: Option<&LoggedScan> = None;
    let (mut proposed, mut gated) = (0, 0);
    for scan in &scans {
        if let Some(last) = last {
            let step = last.odom_from_sensor.inverse_mul(&scan.odom_from_sensor);
            driven.last_from_new = driven.last_from_new * step;
            driven.distance_m += step.distance();
            driven.turned_rad += step.angle().abs();
        }
        let first = last.is_none();
        last = Some(scan);
        if !first && !params.keyframes.is_due(&driven.last_from_new) {
            continue;
        }
        let start = Instant::now();
        let added = recognizer.add(scan.scan.clone(), &driven);
        millis.push(start.elapsed().as_secs_f64() * 1e3);
        proposed += added.proposed;
        gated += added.gated;
        stamps.push(scan.stamp_secs);
        raw.push(scan.odom_from_sensor);
        driven = Driven::default();
    }
    let start = Instant::now();
    let settled = recognizer.settled();
    let settle_secs = start.elapsed().as_secs_f64();
    println!(
        "scans {}, keyframes {}, driven {:.0} m, gated {gated}, proposed {proposed}, accepted {}, rejected at the end {}",
        scans.len(),
        stamps.len(),
        recognizer.keyframes().last().map_or(0.0, |k| k.travelled_m),
        recognizer.closures().len(),
        settled.rejected.len()
    );
    for (verdict, count) in Verdict::ALL.iter().zip(recognizer.tally().verdicts) {
        print!("{} {count}, ", verdict.name());
    }
    println!("untracked {}", recognizer.tally().untracked);
    let tenth = (millis.len() / 10).max(1);
    println!(
        "millis per keyframe: median {:.2}, p99 {:.2}, most {:.2}; first tenth {:.2}, last {:.2}; settling {settle_secs:.2} s; {} bytes per keyframe",
        quantile(&millis, 0.5),
        quantile(&millis, 0.99),
        quantile(&millis, 1.0),
        quantile(&millis[..tenth], 0.5),
        quantile(&millis[millis.len() - tenth..], 0.5),
        recognizer.bytes() / stamps.len().max(1),
    );

    let chained = recognizer.chained();
    if let Some(file) = corrected {
        let truth = read(&std::fs::read(file)?)?.scans;
        let true_stamps: Vec<f64> = truth.iter().map(|scan| scan.stamp_secs).collect();
        let true_poses: Vec<Se2> = truth.iter().map(|scan| scan.odom_from_sensor).collect();
        let truth: Vec<Se2> =
            stamps.iter().map(|stamp| pose_at(&true_stamps, &true_poses, *stamp)).collect();
        let steps = |poses: &[Se2]| {
            let errors: Vec<f64> = (1..poses.len())
                .map(|i| {
                    let (a, b) =
                        (poses[i - 1].inverse_mul(&poses[i]), truth[i - 1].inverse_mul(&truth[i]));
                    (a.translation - b.translation).norm()
                })
                .collect();
            quantile(&errors, 0.9)
        };
        println!(
            "steps off, 90 %: odometry {:.3} m, tracked {:.3} m",
            steps(&raw),
            steps(&chained)
        );
        let mut off: Vec<(f64, f64, usize, usize)> = Vec::new();
        for closure in recognizer.closures() {
            let measured = closure.measured;
            let between = truth[measured.from].inverse_mul(&truth[measured.to]);
            let error = between.inverse_mul(&measured.from_from_to);
            off.push((
                error.distance(),
                error.angle().abs().to_degrees(),
                measured.from,
                measured.to,
            ));
        }
        let metres: Vec<f64> = off.iter().map(|o| o.0).collect();
        let degrees: Vec<f64> = off.iter().map(|o| o.1).collect();
        println!(
            "closures off: median {:.3} m {:.2} deg, 99 % {:.3} m {:.2} deg, most {:.3} m {:.2} deg",
            quantile(&metres, 0.5),
            quantile(&degrees, 0.5),
            quantile(&metres, 0.99),
            quantile(&degrees, 0.99),
            quantile(&metres, 1.0),
            quantile(&degrees, 1.0)
        );
        for wrong in off.iter().filter(|o| o.0 > 1.0 || o.1 > 10.0) {
            println!("WRONG {wrong:?}");
        }
        for (within_m, turned) in [(1.0, 45.0), (2.0, 45.0), (2.0, 180.0)] {
            let (mut revisits, mut found) = (0, 0);
            let keyframes = recognizer.keyframes();
            for k in 0..keyframes.len() {
                let is_revisit = (0..k).any(|i| {
                    let between = truth[i].inverse_mul(&truth[k]);
                    keyframes[k].travelled_m - keyframes[i].travelled_m >= params.candidates.loop_m
                        && between.distance() <= within_m
                        && between.angle().abs().to_degrees() <= turned
                });
                revisits += usize::from(is_revisit);
                let is_found = recognizer.closures().iter().any(|c| c.measured.to == k);
                found += usize::from(is_revisit && is_found);
            }
            println!("revisits within {within_m} m, {turned} deg: {revisits}, found {found}");
        }
    }
    if let Some(file) = relations_file {
        let relations = relations::read(&std::fs::read(file)?)?;
        let nearest = |secs: f64| {
            let next = stamps.partition_point(|stamp| *stamp <= secs);
            let all = [next.saturating_sub(1), next.min(stamps.len() - 1)];
            let (a, b) = ((stamps[all[0]] - secs).abs(), (stamps[all[1]] - secs).abs());
            if a <= b { (all[0], a) } else { (all[1], b) }
        };
        for (name, poses) in
            [("odometry", &raw), ("tracked", &chained), ("settled", &settled.map_from_keyframe)]
        {
            for which in ["within 50 ms", "of two scans", "within 2 ms", "others"] {
                let (mut metres, mut degrees) = (Vec::new(), Vec::new());
                for relation in &relations {
                    let (a, b) = (nearest(relation.from_secs), nearest(relation.to_secs));
                    let near = a.1.max(b.1) <= 0.05;
                    let counts = match which {
                        "within 50 ms" => near,
                        "of two scans" => near && a.0 != b.0,
                        "within 2 ms" => a.1.max(b.1) <= 0.002 && a.0 != b.0,
                        _ => !near,
                    };
                    if !counts {
                        continue;
                    }
                    let at = |secs| pose_at(&stamps, poses, secs);
                    let between = at(relation.from_secs).inverse_mul(&at(relation.to_secs));
                    let error = relation.from_from_to.inverse_mul(&between);
                    metres.push(error.distance());
                    degrees.push(error.angle().abs().to_degrees());
                }
                let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
                println!(
                    "relations, {name}, {which}: {}: {:.4} m, {:.3} deg (median {:.4} m, {:.3} deg)",
                    metres.len(),
                    mean(&metres),
                    mean(&degrees),
                    quantile(&metres, 0.5),
                    quantile(&degrees, 0.5)
                );
            }
        }
    }
    Ok(())
}
