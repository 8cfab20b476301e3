//! Laws of matching and recognition, in rooms made for it.

use geometry::Point2;
use places::matching::{Apart, Noise, Surfaces, Table, Window, align, search};
use places::{Added, Driven, Keyframe, Measured, PlaceEvent, PlaceParams, Recognizer, Verdict};
use pose::Se2;
use pose::nalgebra::Matrix3;
use probe::Probe;
use proptest::prelude::*;
use sensing::Scan;

type Wall = ((f64, f64), (f64, f64));

/// An L-shaped room with a niche and two pillars: no two places in it look alike.
const ROOM: [Wall; 16] = [
    ((0.0, 0.0), (12.0, 0.0)),
    ((12.0, 0.0), (12.0, 5.0)),
    ((12.0, 5.0), (6.0, 5.0)),
    ((6.0, 5.0), (6.0, 9.0)),
    ((6.0, 9.0), (0.0, 9.0)),
    ((0.0, 9.0), (0.0, 6.5)),
    ((0.0, 6.5), (-1.0, 6.5)),
    ((-1.0, 6.5), (-1.0, 5.0)),
    ((-1.0, 5.0), (0.0, 5.0)),
    ((0.0, 5.0), (0.0, 0.0)),
    ((3.0, 2.0), (3.8, 2.2)),
    ((3.8, 2.2), (3.4, 2.9)),
    ((3.4, 2.9), (3.0, 2.0)),
    ((8.0, 2.4), (8.9, 2.4)),
    ((8.9, 2.4), (8.9, 2.9)),
    ((8.9, 2.9), (8.0, 2.4)),
];

/// A long corridor: nothing holds a match along it.
const CORRIDOR: [Wall; 2] = [((-500.0, 0.0), (500.0, 0.0)), ((-500.0, 2.0), (500.0, 2.0))];

fn scan(walls: &[Wall], pose: &Se2) -> Scan {
    let rays = 360;
    let step = std::f64::consts::TAU / f64::from(rays);
    let ranges = (0..rays).map(|ray| {
        let bearing = pose.angle() + step * f64::from(ray);
        let (dx, dy) = (bearing.cos(), bearing.sin());
        walls.iter().fold(99.0_f64, |nearest, &((ax, ay), (bx, by))| {
            let (ex, ey) = (bx - ax, by - ay);
            let cross = dx * ey - dy * ex;
            let (px, py) = (ax - pose.translation.x, ay - pose.translation.y);
            let (range, along) = ((px * ey - py * ex) / cross, (px * dy - py * dx) / cross);
            if range > 0.0 && (0.0..=1.0).contains(&along) { nearest.min(range) } else { nearest }
        })
    });
    Scan::new(0.0, step, ranges.collect(), 30.0)
}

/// Twice round the room, half a metre at a time; the wheels see every motion turned a little.
fn round(walls: &[Wall], bias_rad: f64, legs: &[(f64, f64)]) -> (Vec<(Scan, Driven)>, Vec<Se2>) {
    let mut truth = Se2::new(1.5, 1.0, 0.0);
    let mut frames = vec![(scan(walls, &truth), Driven::default())];
    let mut poses = vec![truth];
    for &(turn, length_m) in legs {
        for step in 0..(2.0 * length_m) as usize {
            let turned_rad = if step == 0 { turn.to_radians() } else { 0.0 };
            let motion = Se2::from_angle(turned_rad) * Se2::new(0.5, 0.0, 0.0);
            truth = truth * motion;
            let last_from_new = motion * Se2::from_angle(bias_rad);
            let turned_rad = turned_rad.abs();
            frames
                .push((scan(walls, &truth), Driven { last_from_new, distance_m: 0.5, turned_rad }));
            poses.push(truth);
        }
    }
    (frames, poses)
}

const LEGS: [(f64, f64); 8] = [
    (0.0, 9.0),
    (90.0, 2.5),
    (90.0, 8.5),
    (90.0, 2.5),
    (90.0, 9.0),
    (90.0, 2.5),
    (90.0, 8.5),
    (90.0, 2.0),
];

fn recognise(frames: &[(Scan, Driven)]) -> (Recognizer, Vec<Added>) {
    let mut recognizer = Recognizer::new(PlaceParams::default());
    let added = frames.iter().map(|(scan, driven)| recognizer.add(scan.clone(), driven)).collect();
    (recognizer, added)
}

#[test]
fn a_second_round_is_recognised_and_no_closure_is_wrong() {
    let (frames, truth) = round(&ROOM, 0.02, &LEGS);
    let (recognizer, _) = recognise(&frames);
    let second = frames.len() / 2;
    let closed: Vec<usize> = recognizer.closures().iter().map(|c| c.measured.to).collect();
    let found = (second..frames.len()).filter(|k| closed.contains(k)).count();
    assert!(2 * found >= frames.len() - second, "{found} of {}", frames.len() - second);
    for closure in recognizer.closures() {
        let measured = closure.measured;
        let between = truth[measured.from].inverse_mul(&truth[measured.to]);
        let error = between.inverse_mul(&measured.from_from_to);
        assert!(error.distance() < 0.05 && error.angle().abs() < 0.01, "{measured:?} {error:?}");
        assert!(measured.covariance.cholesky().is_some(), "{measured:?}");
    }
    let settled = recognizer.settled();
    assert_eq!(settled.rejected, []);
    for (pose, truth_of) in settled.map_from_keyframe.iter().zip(&truth) {
        let expected = truth[0].inverse_mul(truth_of);
        assert!((pose.translation - expected.translation).norm() < 0.05);
    }
}

#[test]
fn a_corridor_closes_nothing() {
    // There and back: every place looks like every other along it.
    let legs = [(0.0, 12.0), (180.0, 12.0)];
    let (frames, _) = round(&CORRIDOR, 0.0, &legs);
    let (recognizer, added) = recognise(&frames);
    assert!(added.iter().any(|added| added.proposed > 0), "nothing was tried");
    assert_eq!(recognizer.closures(), []);
}

#[test]
fn a_probe_only_looks_and_the_same_input_gives_the_same_bits() {
    struct Ears(Vec<String>);
    impl Probe<PlaceEvent<'_>> for Ears {
        fn emit(&mut self, event: PlaceEvent<'_>) {
            self.0.push(event.variant().to_owned());
        }
    }
    let (frames, _) = round(&ROOM, 0.02, &LEGS);
    let (plain, added) = recognise(&frames);
    let mut heard = Ears(Vec::new());
    let mut probed = Recognizer::new(PlaceParams::default());
    for ((scan, driven), expected) in frames.iter().zip(&added) {
        assert_eq!(probed.add_with(scan.clone(), driven, &mut heard), *expected);
    }
    assert_eq!(plain.closures(), probed.closures());
    assert_eq!(plain.tally(), probed.tally());
    for variant in ["KeyframeAdded", "Tracked", "CandidatesRanked", "PlaceMatched", "Closed"] {
        assert!(heard.0.iter().any(|name| name == variant), "{variant} never came");
    }
}

#[test]
fn what_is_of_no_use_harms_nothing() {
    let mut recognizer = Recognizer::new(PlaceParams::default());
    let empty = || Scan::new(0.0, 0.1, Vec::new(), 10.0);
    let misses = || Scan::new(0.0, 0.1, vec![f64::NAN; 30], 10.0);
    let nowhere = Driven {
        last_from_new: Se2::new(f64::NAN, 0.0, 0.0),
        distance_m: f64::INFINITY,
        turned_rad: 0.0,
    };
    let far = Driven { last_from_new: Se2::new(50.0, 0.0, 0.0), distance_m: 50.0, turned_rad: 0.0 };
    assert_eq!(recognizer.settled().map_from_keyframe, []);
    for scan in [empty(), misses(), empty(), misses()] {
        for driven in [nowhere, far] {
            let added = recognizer.add(scan.clone(), &driven);
            assert_eq!(added.closures, []);
        }
    }
    assert_eq!(recognizer.settled().map_from_keyframe.len(), 8);
    assert_eq!(recognizer.tally().untracked, 7);
    let to_nowhere = Measured {
        from: 0,
        to: 99,
        from_from_to: Se2::identity(),
        covariance: Matrix3::identity(),
    };
    assert!(!recognizer.given(&to_nowhere));
    assert!(recognizer.given(&Measured { to: 5, ..to_nowhere }));
}

#[test]
fn verdicts_have_names_of_their_own() {
    let names: std::collections::BTreeSet<&str> = Verdict::ALL.iter().map(|v| v.name()).collect();
    assert_eq!(names.len(), Verdict::ALL.len());
}

/// The score of one pose, by the table's own cells.
fn score_of(table: &Table, points: &[Point2], pose: &Se2) -> f64 {
    let sum: u32 = points.iter().map(|point| table.score_at(&pose.transform(point))).sum();
    f64::from(sum) / (255.0 * points.len() as f64)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// The search finds what trying every pose of the window's grid finds: the best, and the best elsewhere.
    #[test]
    fn a_search_is_as_good_as_trying_all(
        x in 4.4..7.4_f64, y in 0.8..4.2_f64, turn in -3.0..3.0_f64,
        dx in -0.5..0.5_f64, dy in -0.5..0.5_f64, dt in -0.2..0.2_f64,
    ) {
        let known = Keyframe::new(scan(&ROOM, &Se2::new(x, y, turn)), 0.0, 20.0, 0.0);
        let points: Vec<Point2> = known.surface.iter().map(|s| s.point).collect();
        let table = Table::new(points.iter().copied(), 0.1);
        let window = Window {
            place_from_scan: Se2::new(dx, dy, dt),
            reach_m: 0.6,
            reach_rad: 0.2,
            angle_step_rad: 0.05,
        };
        let apart = Apart { metres: 0.45, radians: 0.12, share: 0.6 };
        let few: Vec<Point2> = points.iter().step_by(7).copied().collect();
        let found = search(&table, &few, &window, &apart).expect("points");
        // Every pose of the window's grid that is within reach, one by one.
        let (mut best, mut elsewhere) = (0.0_f64, 0.0_f64);
        for turn in -4..=4 {
            for column in -6..=6 {
                for row in -6..=6 {
                    let at = Se2::new(
                        dx + f64::from(column) * 0.1,
                        dy + f64::from(row) * 0.1,
                        dt + f64::from(turn) * 0.05,
                    );
                    let score = score_of(&table, &few, &at);
                    best = best.max(score);
                    let between = found.place_from_scan.inverse_mul(&at);
                    if between.distance() > apart.metres || between.angle().abs() > apart.radians {
                        elsewhere = elsewhere.max(score);
                    }
                }
            }
        }
        // Translating by whole cells commutes with rounding but for the last bit.
        prop_assert!(found.score >= best - 0.02, "{} found, {best} there", found.score);
        let again = score_of(&table, &few, &found.place_from_scan);
        prop_assert!((found.score - again).abs() < 0.02, "{} and {again}", found.score);
        let enough = apart.share * found.score;
        if elsewhere > enough + 0.02 {
            prop_assert!((found.elsewhere - elsewhere).abs() < 0.02, "{} and {elsewhere}", found.elsewhere);
        } else if elsewhere < enough - 0.02 {
            prop_assert_eq!(found.elsewhere, 0.0);
        }
    }

    /// Points come back onto surfaces from nearby, and the covariance bounds what noise does.
    #[test]
    fn an_alignment_undoes_a_small_motion(
        x in 4.4..7.4_f64, y in 0.8..4.2_f64, turn in -3.0..3.0_f64,
        dx in -0.15..0.15_f64, dy in -0.15..0.15_f64, dt in -0.08..0.08_f64,
    ) {
        let here = Se2::new(x, y, turn);
        let known = Keyframe::new(scan(&ROOM, &here), 0.0, 20.0, 0.0);
        let motion = Se2::new(dx, dy, dt);
        let moved = Keyframe::new(scan(&ROOM, &(here * motion)), 0.0, 20.0, 0.0);
        let surfaces = Surfaces::new(&known.surface, 0.5);
        let noise = Noise { range_sigma_m: 0.02, correlated_points: 6.0 };
        let start = Se2::identity();
        let aligned = align(&surfaces, &moved.surface, &start, None, &noise).expect("a room");
        let error = motion.inverse_mul(&aligned.place_from_scan);
        prop_assert!(error.distance() < 0.02 && error.angle().abs() < 0.01, "{error:?}");
        prop_assert!(aligned.covariance.cholesky().is_some());
        prop_assert!(aligned.residual_m < 0.03);
    }
}
