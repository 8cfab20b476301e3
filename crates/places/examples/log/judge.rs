//! A recogniser's results against corrected poses and published relations.

use formats::laser::LoggedScan;
use formats::laser::relations::Relation;
use places::{PlaceParams, Recognizer, Settled};
use pose::Se2;

use crate::clock::quantile;

/// What is judged, and the scans that were kept.
pub struct Judged<'a> {
    pub params: &'a PlaceParams,
    pub recognizer: &'a Recognizer,
    pub kept: &'a [&'a LoggedScan],
}

/// The pose at a time, between keyframes by the twist from one to the next.
fn pose_at(stamps: &[f64], poses: &[Se2], secs: f64) -> Se2 {
    let next = stamps.partition_point(|stamp| *stamp <= secs).clamp(1, stamps.len() - 1);
    let span = stamps[next] - stamps[next - 1];
    let share = if span > 0.0 { (secs - stamps[next - 1]) / span } else { 0.0 };
    let step = poses[next - 1].inverse_mul(&poses[next]).log();
    poses[next - 1].boxplus(&(step * share.clamp(0.0, 1.0)))
}

impl Judged<'_> {
    fn stamps(&self) -> Vec<f64> {
        self.kept.iter().map(|scan| scan.stamp_secs).collect()
    }

    fn raw(&self) -> Vec<Se2> {
        self.kept.iter().map(|scan| scan.odom_from_sensor).collect()
    }

    /// Steps, closures and revisits by corrected poses.
    pub fn against_poses(&self, truth: &[LoggedScan]) {
        let (params, recognizer) = (self.params, self.recognizer);
        let (stamps, raw, chained) = (self.stamps(), self.raw(), recognizer.chained());
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

    /// Mean absolute errors of relative poses.
    pub fn against_relations(&self, relations: &[Relation], settled: &Settled) {
        let (stamps, raw, chained) = (self.stamps(), self.raw(), self.recognizer.chained());
        let nearest = |secs: f64| {
            let next = stamps.partition_point(|stamp| *stamp <= secs);
            let all = [next.saturating_sub(1), next.min(stamps.len() - 1)];
            let (a, b) = ((stamps[all[0]] - secs).abs(), (stamps[all[1]] - secs).abs());
            if a <= b { (all[0], a) } else { (all[1], b) }
        };
        for (name, poses) in
            [("odometry", &raw), ("tracked", &chained), ("settled", &settled.map_from_keyframe)]
        {
            for which in
                ["within 50 ms", "of two scans", "within 2 ms", "of their stamps", "others"]
            {
                let (mut metres, mut degrees) = (Vec::new(), Vec::new());
                for relation in relations {
                    let (a, b) = (nearest(relation.from_secs), nearest(relation.to_secs));
                    let near = a.1.max(b.1) <= 0.05;
                    let counts = match which {
                        "within 50 ms" => near,
                        "of two scans" => near && a.0 != b.0,
                        "within 2 ms" => a.1.max(b.1) <= 0.002 && a.0 != b.0,
                        "of their stamps" => a.1.max(b.1) <= 0.0005 && a.0 != b.0,
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
}
