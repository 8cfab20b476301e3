//! Local volumes from scans, whatever the sensor says ([ISRR19] 4.1, [Zie18] 2.4).

use std::f64::consts::{PI, TAU};

use geometry::Point2;
use maps2d::volume::{LocalVolume, OcclusionRule, Options, Samples, VolumeParams, build};
use pose::Se2;
use proptest::prelude::*;
use sensing::{Reading, Scan};

use super::config;

const SEEDS: &str = "proptest-regressions/volume.txt";

fn params(gap_m: f64, options: Options) -> VolumeParams {
    VolumeParams { occlusion_gap_m: gap_m, strict_margin_m: 0.01, options }
}

fn samples_of(scan: &Scan) -> Samples {
    let mut samples = Samples::new();
    samples.add(scan, &Se2::identity());
    samples
}

fn volume_of(scan: &Scan, params: &VolumeParams) -> LocalVolume {
    build(&samples_of(scan), params).unwrap()
}

/// Rays at whole degrees.
fn degrees(first: f64, step: f64, ranges_m: &[f64], range_max_m: f64) -> Scan {
    Scan::new(first.to_radians(), step.to_radians(), ranges_m.to_vec(), range_max_m)
}

/// Each boundary edge is labelled exactly once, frontier or obstacle, in boundary order.
fn check_labels(volume: &LocalVolume) -> Result<(), TestCaseError> {
    let bits = |p: &Point2| (p.x.to_bits(), p.y.to_bits());
    let mut boundary: Vec<_> =
        volume.polygon.boundary().map(|edge| (bits(&edge.from), bits(&edge.to))).collect();
    let frontier = volume.frontier.iter().map(|edge| (bits(&edge.from), bits(&edge.to)));
    let obstacles = volume.obstacles.iter().map(|edge| (bits(&edge.from), bits(&edge.to)));
    let mut labelled: Vec<_> = frontier.chain(obstacles).collect();
    boundary.sort_unstable();
    labelled.sort_unstable();
    prop_assert_eq!(labelled, boundary);
    prop_assert!(volume.frontier.is_sorted_by(|a, b| a.key < b.key));
    prop_assert!(volume.obstacles.is_sorted_by(|a, b| a.key < b.key));
    for edge in &volume.frontier {
        let at_sensor = edge.from == Point2::origin() || edge.to == Point2::origin();
        prop_assert_eq!(edge.spoke, at_sensor);
    }
    Ok(())
}

/// Ranges of every kind: walls, misses, nonsense, needles, touching, absurd.
fn readings() -> impl Strategy<Value = f64> {
    let odd = prop::sample::select(vec![
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        -1.0,
        -0.0,
        0.0,
        f64::MIN_POSITIVE,
        1e-320,
        1e-90,
        1e-12,
        5.0,
        5.0 - 1e-15,
        7.0,
        1e99,
        1e300,
    ]);
    prop_oneof![
        6 => 0.3..5.0_f64,
        1 => 0.0..1e-3_f64,
        2 => odd,
    ]
}

fn wild_scans() -> impl Strategy<Value = Scan> {
    let first = prop_oneof![3 => -4.0..4.0_f64, 1 => Just(0.0), 1 => Just(-PI), 1 => Just(1e-120)];
    let step = prop_oneof![
        4 => 0.02..0.4_f64,
        1 => 0.4..3.5_f64,
        1 => Just(TAU / 8.0),
        1 => Just(1e-9),
        1 => Just(1e-7),
        1 => Just(PI),
    ];
    let range_max = prop_oneof![6 => Just(5.0), 1 => Just(1e50)];
    (first, step, prop::collection::vec(readings(), 0..40), range_max)
        .prop_map(|(first, step, ranges, range_max)| Scan::new(first, step, ranges, range_max))
}

fn options() -> impl Strategy<Value = Options> {
    let rule = prop_oneof![Just(OcclusionRule::Range), Just(OcclusionRule::ForwardSigned)];
    (rule, any::<bool>(), prop_oneof![Just(0.0), Just(0.2), Just(3.0)]).prop_map(
        |(occlusion, insert_occlusion_vertex, thin_m)| Options {
            occlusion,
            insert_occlusion_vertex,
            thin_m,
        },
    )
}

proptest! {
    #![proptest_config(config(1500, SEEDS))]

    /// One to three scans of any kind, taken while turning, come to a valid volume whose labels
    /// partition its boundary, and whose every hit is bounded by something.
    #[test]
    fn any_readings_come_to_a_valid_volume(
        scans in prop::collection::vec((wild_scans(), -4.0..4.0_f64), 1..4),
        options in options(),
    ) {
        let mut samples = Samples::new();
        for (scan, turn_rad) in &scans {
            samples.add(scan, &Se2::from_angle(*turn_rad));
        }
        let bearings: Vec<f64> = samples.as_slice().iter().map(|s| s.bearing_rad).collect();
        prop_assert!(bearings.is_sorted_by(|a, b| a < b));
        let volume = build(&samples, &params(0.5, options));
        prop_assert!(volume.is_ok(), "{:?}", volume);
        let volume = volume.unwrap();
        check_labels(&volume)?;
        prop_assert!(volume.frontier.len() + volume.obstacles.len() >= volume.polygon.len());
        if options.thin_m == 0.0 {
            for hit in samples.as_slice().iter().filter(|sample| sample.hit) {
                let end = hit.end_in_anchor;
                let at_wall = volume.obstacles.iter().any(|w| w.from == end || w.to == end);
                prop_assert!(at_wall != volume.posts.contains(&end), "{:?}", hit);
            }
        }
    }

    /// [ISRR19] 4.1, ray by ray: obstacle exactly between two hits that differ by less than the gap.
    #[test]
    fn an_edge_is_obstacle_only_between_near_hits(
        ranges in prop::collection::vec(
            prop_oneof![5 => 0.3..6.0_f64, 1 => Just(f64::NAN), 1 => Just(0.0)], 2..30),
        fov_rad in 0.3..3.0_f64,
        gap_m in 0.1..2.0_f64,
    ) {
        let step_rad = fov_rad / (ranges.len() - 1) as f64;
        let scan = Scan::new(-0.5 * fov_rad, step_rad, ranges.clone(), 5.0);
        let volume = volume_of(&scan, &params(gap_m, Options::default()));
        check_labels(&volume)?;
        // Rays that touch nothing at the sensor itself, with where they end.
        let rays: Vec<usize> = (0..ranges.len()).filter(|&i| ranges[i] != 0.0).collect();
        prop_assert_eq!(volume.polygon.len(), rays.len());
        let hit_m = |i: usize| match scan.reading(i) {
            Reading::Hit(range_m) => Some(range_m),
            Reading::Miss => None,
        };
        for (k, pair) in rays.windows(2).enumerate() {
            let adjacent = pair[1] == pair[0] + 1;
            prop_assert_eq!(volume.polygon.is_gap(k), !adjacent);
            let near = match (hit_m(pair[0]), hit_m(pair[1])) {
                (Some(a), Some(b)) => (a - b).abs() < gap_m,
                _ => false,
            };
            let is_obstacle = volume.obstacles.iter().any(|edge| edge.key.0 == 2 * k as u32);
            prop_assert_eq!(is_obstacle, adjacent && near, "edge {}", k);
        }
        if let Some(last) = rays.len().checked_sub(1) {
            prop_assert!(volume.polygon.is_gap(last), "behind the sensor is a gap");
        }
    }

    /// Thinning drops vertices of surfaces only: every frontier edge stays as it was.
    #[test]
    fn thinning_changes_no_frontier(
        ranges in prop::collection::vec(readings(), 2..60),
        thin_m in 0.05..2.0_f64,
        rule in prop_oneof![Just(OcclusionRule::Range), Just(OcclusionRule::ForwardSigned)],
    ) {
        let scan = Scan::new(-1.0, 2.0 / (ranges.len() - 1) as f64, ranges, 5.0);
        let of = |thin_m: f64| {
            let options = Options { occlusion: rule, thin_m, ..Options::default() };
            volume_of(&scan, &params(0.5, options))
        };
        let (all, thinned) = (of(0.0), of(thin_m));
        let ends = |v: &LocalVolume| -> Vec<_> { v.frontier.iter().map(|e| (e.from, e.to)).collect() };
        prop_assert_eq!(ends(&all), ends(&thinned));
        prop_assert!(thinned.polygon.len() <= all.polygon.len());
        for pair in thinned.obstacles.windows(2).filter(|pair| pair[0].to == pair[1].from) {
            // A vertex between two obstacle edges stayed because it is far from the one before.
            prop_assert!((pair[0].to - pair[0].from).norm() >= thin_m);
        }
    }

    /// Scans taken while turning in place, in any order, are one wide scan of the same rays.
    #[test]
    fn scans_while_turning_are_one_wide_scan(
        ranges in prop::collection::vec(prop_oneof![5 => 0.3..6.0_f64, 1 => Just(0.0)], 6..40),
        full in any::<bool>(),
        cuts in prop::collection::vec(any::<prop::sample::Index>(), 1..4),
        overlap in 0_usize..4,
        turn_round in any::<prop::sample::Index>(),
        start_rad in -3.0..3.0_f64,
    ) {
        let n = ranges.len();
        let step_rad = if full { TAU / n as f64 } else { 5.0 / n as f64 };
        let wide = Scan::new(start_rad, step_rad, ranges.clone(), 5.0);
        // Windows of rays that share at least one ray with the next.
        let last = if full { n } else { n - 1 };
        let mut ends: Vec<usize> = cuts.iter().map(|cut| 1 + cut.index(last)).collect();
        ends.push(last);
        ends.sort_unstable();
        let mut windows: Vec<(usize, usize)> = Vec::new();
        let mut begin = 0;
        for end in ends {
            windows.push((begin, (end + overlap).min(last).min(begin + n - 1)));
            begin = windows[windows.len() - 1].1.min(end);
        }
        windows.push((begin, last));
        let turn_by = turn_round.index(windows.len());
        windows.rotate_left(turn_by);
        let mut parts = Samples::new();
        for (k, (begin, end)) in windows.into_iter().enumerate() {
            // Each from another heading.
            let heading_rad = 0.7 * k as f64 - 1.0;
            let window = (begin..=end).map(|i| ranges[i % n]).collect();
            let first_rad = start_rad + step_rad * begin as f64 - heading_rad;
            let scan = Scan::new(first_rad, step_rad, window, 5.0);
            parts.add(&scan, &Se2::from_angle(heading_rad));
        }
        let whole = samples_of(&wide);
        prop_assert_eq!(parts.len(), whole.len());
        // Rounding may put a ray at half a turn first or last.
        let (a, b) = (parts.as_slice(), whole.as_slice());
        let shift = (0..a.len())
            .find(|&s| {
                (0..a.len()).all(|i| {
                    let j = (i + s) % a.len();
                    (a[j].end_in_anchor - b[i].end_in_anchor).norm() < 1e-9 && a[j].hit == b[i].hit
                })
            });
        prop_assert!(shift.is_some() || a.is_empty(), "{:?} {:?}", a, b);
        for i in 0..a.len() {
            let j = (i + shift.unwrap_or(0)) % a.len();
            prop_assert_eq!(parts.is_gap_after(j), whole.is_gap_after(i), "after {}", i);
        }
    }
}

/// Three hits on a wall, one on another behind it, one miss.
fn corner() -> Scan {
    degrees(-40.0, 20.0, &[2.0, 1.9, 2.0, 3.5, 9.0], 5.0)
}

#[test]
fn a_range_step_is_an_occlusion_in_both_directions() {
    let rule = params(1.0, Options::default());
    let volume = volume_of(&corner(), &rule);
    let keys: Vec<u32> = volume.obstacles.iter().map(|edge| edge.key.0).collect();
    assert_eq!(keys, [0, 2], "only the near wall hangs together");
    assert_eq!(volume.posts, [volume.polygon.vertex(3)], "the hit behind it bounds no edge");
    let keys: Vec<u32> = volume.frontier.iter().map(|edge| edge.key.0).collect();
    assert_eq!(keys, [4, 6, 8, 9]);
    let spokes: Vec<bool> = volume.frontier.iter().map(|edge| edge.spoke).collect();
    assert_eq!(spokes, [false, false, true, true]);
}

#[test]
fn the_gap_itself_is_an_occlusion() {
    let scan = degrees(-10.0, 20.0, &[2.0, 3.0], 5.0);
    let volume = |gap_m: f64| volume_of(&scan, &params(gap_m, Options::default()));
    assert_eq!(volume(1.0).obstacles.len(), 0, "a difference of the gap is not below it");
    assert_eq!(volume(1.0 + 1e-9).obstacles.len(), 1);
}

/// [Zie18] eq. 2.4: the forward coordinate of the first minus that of the second, with its sign.
#[test]
fn the_signed_rule_sees_a_step_towards_the_robot_only() {
    let signed = Options { occlusion: OcclusionRule::ForwardSigned, ..Options::default() };
    let nearer = degrees(-10.0, 20.0, &[4.0, 2.0], 5.0);
    let farther = degrees(-10.0, 20.0, &[2.0, 4.0], 5.0);
    // cos 10° · 2 m = 1.97 m.
    assert_eq!(volume_of(&nearer, &params(1.9, signed)).obstacles.len(), 0);
    assert_eq!(volume_of(&nearer, &params(2.0, signed)).obstacles.len(), 1);
    assert_eq!(volume_of(&farther, &params(1.0, signed)).obstacles.len(), 1);
    // Two ranges that are alike, but one beside the robot: forward coordinates differ.
    let beside = degrees(0.0, 80.0, &[4.0, 4.0], 5.0);
    assert_eq!(volume_of(&beside, &params(1.0, signed)).obstacles.len(), 0);
    assert_eq!(volume_of(&beside, &params(1.0, Options::default())).obstacles.len(), 1);
}

#[test]
fn the_occlusion_vertex_halves_the_edge() {
    let options = Options { insert_occlusion_vertex: true, ..Options::default() };
    let volume = volume_of(&corner(), &params(1.0, options));
    let plain = volume_of(&corner(), &params(1.0, Options::default()));
    assert_eq!(volume.polygon.len(), plain.polygon.len() + 1);
    let (a, b) = (plain.polygon.vertex(2), plain.polygon.vertex(3));
    let middle = Point2::from((a.coords + b.coords) * 0.5);
    assert_eq!(volume.polygon.vertex(3), middle);
    let halves: Vec<_> = volume.frontier.iter().take(2).map(|edge| (edge.from, edge.to)).collect();
    assert_eq!(halves, [(a, middle), (middle, b)]);
    assert!(volume.continues(0), "the halves hang together");
    assert_eq!(volume.obstacles, plain.obstacles);
    assert!((volume.polygon.area() - plain.polygon.area()).abs() < 1e-12);
}

#[test]
fn thinning_keeps_the_ends_of_surfaces() {
    // A flat wall 2 m ahead at one-degree rays, then misses.
    let wall = (-20..=20).map(|deg: i32| 2.0 / f64::from(deg).to_radians().cos());
    let ranges: Vec<f64> = wall.chain([9.0, 9.0]).collect();
    let scan = degrees(-20.0, 1.0, &ranges, 5.0);
    let options = Options { thin_m: 0.3, ..Options::default() };
    let volume = volume_of(&scan, &params(1.0, options));
    // 1.46 m of wall in steps of at least 0.3 m; its last hit, before the misses, stays as well.
    assert_eq!(volume.polygon.len(), 5 + 1 + 2);
    let ahead = |p: Point2| (p.x - 2.0).abs() < 1e-12;
    assert!(volume.obstacles.iter().all(|edge| ahead(edge.from) && ahead(edge.to)));
    let covered: f64 = volume.obstacles.iter().map(|edge| (edge.to - edge.from).norm()).sum();
    assert!((covered - 4.0 * 20.0_f64.to_radians().tan()).abs() < 1e-12);
}

#[test]
fn a_full_circle_has_no_gap() {
    let walls = volume_of(&degrees(0.0, 45.0, &[2.0; 8], 5.0), &VolumeParams::default());
    assert_eq!((walls.obstacles.len(), walls.frontier.len()), (8, 0));
    assert!(!walls.polygon.has_gap());
    let nothing = volume_of(&degrees(0.0, 45.0, &[9.0; 8], 5.0), &VolumeParams::default());
    assert_eq!((nothing.obstacles.len(), nothing.frontier.len()), (0, 8));
    assert_eq!(nothing.radius_m(), nothing.polygon.outer_radius());
    assert!(nothing.inner.contains(&Point2::origin()));
}

#[test]
fn few_rays_see_nothing_and_do_no_harm() {
    let none = volume_of(&degrees(0.0, 1.0, &[], 5.0), &VolumeParams::default());
    assert_eq!(none, LocalVolume::empty());
    let one = volume_of(&degrees(0.0, 1.0, &[2.0], 5.0), &VolumeParams::default());
    assert_eq!((one.polygon.len(), one.polygon.area()), (1, 0.0));
    assert_eq!(one.frontier.len(), 2, "a needle: two spokes");
    assert_eq!(one.posts, [Point2::new(2.0, 0.0)]);
    // Two rays half a turn apart: no chord may join them.
    let two = volume_of(&degrees(0.0, 180.0, &[2.0, 2.0], 5.0), &VolumeParams::default());
    assert_eq!((two.obstacles.len(), two.frontier.len()), (0, 4));
}

#[test]
fn something_at_the_sensor_splits_the_view() {
    let scan = degrees(-20.0, 10.0, &[2.0, 2.0, 0.0, 2.0, 2.0], 5.0);
    let volume = volume_of(&scan, &VolumeParams::default());
    assert_eq!(volume.obstacles.len(), 2);
    assert!(volume.polygon.is_gap(1) && volume.polygon.is_gap(3));
    assert!(!volume.polygon.contains(&Point2::new(1.0, 0.0)));
}

#[test]
fn a_later_ray_at_the_same_bearing_counts() {
    let mut samples = Samples::new();
    samples.add(&degrees(-10.0, 10.0, &[2.0, 2.0, 2.0], 5.0), &Se2::identity());
    samples.add(&degrees(-10.0, 10.0, &[3.0, 3.0], 5.0), &Se2::from_angle(10.0_f64.to_radians()));
    let ranges: Vec<f64> = samples.as_slice().iter().map(|sample| sample.range_m).collect();
    assert_eq!(ranges, [2.0, 3.0, 3.0]);
}

#[test]
fn a_view_that_came_full_circle_has_no_seam() {
    let mut samples = Samples::new();
    samples.add(&degrees(0.0, 30.0, &[2.0; 7], 5.0), &Se2::identity());
    // The second scan begins between two old rays, and its first ray tells nothing new.
    let second = degrees(170.0, 40.0, &[2.0; 6], 5.0);
    samples.add_where(&second, &Se2::identity(), |end| end.y < -1e-9);
    let volume = build(&samples, &VolumeParams::default()).unwrap();
    assert!(!volume.polygon.has_gap(), "{:?}", volume.polygon);
    assert_eq!(volume.frontier, []);
}

#[test]
fn looking_twice_the_same_way_is_not_looking_round() {
    for turn_rad in [0.0, 1e-16, -1e-16, 1e-10, -1e-10] {
        let scan = degrees(-57.5, 115.0 / 15.0, &[2.0; 16], 5.0);
        let mut samples = samples_of(&scan);
        samples.add(&scan, &Se2::from_angle(turn_rad));
        let volume = build(&samples, &VolumeParams::default()).unwrap();
        assert_eq!(volume.frontier.len(), 2, "two spokes after a turn by {turn_rad}");
    }
}
