//! Volumes that are retired are not missed.

use maps2d::ExplorationMap;
use maps2d::relative::{RelativeMap, RelativeParams};
use pose::Se2;
use posegraph::EdgeKind;
use probe::Off;
use proptest::prelude::*;

use super::config;
use super::drive::{Done, Drive, Mix, Story, params, stories};
use super::room::{rooms, sensors};

const SEEDS: &str = "proptest-regressions/retirement.txt";

/// What counts is the same, volume by volume; where slivers are told apart, more may be held with
/// retirement (`relative::slivers`), so there the map may not believe that it is done any earlier.
///
/// Lengths are compared, not parts: rounding may split a part.
fn check_same(with: &RelativeMap, without: &RelativeMap) -> Result<(), TestCaseError> {
    let told = || format!("{:?} with, {:?} without", with.frontier(), without.frontier());
    if with.params().sliver_m > 0.0 {
        let done = |map: &RelativeMap| map.frontier().places == 0;
        prop_assert!(!done(with) || done(without), "{}", told());
        return Ok(());
    }
    for ((vertex, a), (_, b)) in with.volumes().zip(without.volumes()) {
        let told = || format!("{vertex}: {} m with, {} m without", a.open_m, b.open_m);
        prop_assert!((a.open_m - b.open_m).abs() < 1e-6, "{}", told());
    }
    prop_assert_eq!(with.frontier().places, without.frontier().places);
    Ok(())
}

/// Tells a story to a map that retires and to one that does not.
fn check_story(story: &Story, params: RelativeParams) -> Result<usize, TestCaseError> {
    let mut drive = Drive::new(&story.room, &story.sensor);
    let mut with = RelativeMap::new(RelativeParams { retire: true, ..params });
    let mut without = RelativeMap::new(RelativeParams { retire: false, ..params });
    for op in &story.ops {
        if drive.act(op, &mut [&mut with, &mut without]) != Done::Nothing {
            check_same(&with, &without)?;
        }
    }
    prop_assert_eq!(without.active_count(), without.volumes().count());
    Ok(with.volumes().count() - with.active_count())
}

proptest! {
    #![proptest_config(config(250, SEEDS))]

    #[test]
    fn what_counts_is_the_same_without_turning(
        story in stories(Mix { turns: 0, links: 1, withdrawals: 0 }, 10..40),
        params in params(),
    ) {
        check_story(&story, params)?;
    }

    /// Where volumes are replaced and edges withdrawn, all is in one scope: pairs beyond its radius
    /// are compared only if they once lay in the scope of a third vertex, and what they closed and
    /// lost does not come back. And slivers count: which rays a second look adds depends on them.
    #[test]
    fn what_counts_is_the_same_in_any_story(
        story in stories(Mix { turns: 1, links: 2, withdrawals: 1 }, 10..40),
        params in params(),
    ) {
        let params = RelativeParams { consolidation_radius_m: 1e3, sliver_m: 0.0, ..params };
        check_story(&story, params)?;
    }
}

proptest! {
    #![proptest_config(config(16, SEEDS))]

    /// Round and round through the same places, a little beside them each time.
    #[test]
    fn what_counts_is_the_same_going_round(
        room in rooms(),
        sensor in sensors(),
        stops in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 3..7),
        jitters in prop::collection::vec((-0.3..0.3_f64, -0.3..0.3_f64, -3.1..3.1_f64), 24),
        params in params(),
    ) {
        let mut drive = Drive::new(&room, &sensor);
        let mut with = RelativeMap::new(RelativeParams { retire: true, ..params });
        let mut without = RelativeMap::new(RelativeParams { retire: false, ..params });
        let mut places: Vec<Vec<usize>> = vec![Vec::new(); stops.len()];
        for (i, (dx, dy, heading)) in jitters.iter().enumerate() {
            let stop = i % stops.len();
            let (x, y) = stops[stop];
            let pose = Se2::new(x * room.width_m + dx, y * room.height_m + dy, *heading);
            let known: Vec<usize> = places[stop].last().copied().into_iter().collect();
            let done = drive.go(&pose, &known, &mut [&mut with, &mut without], &mut Off);
            if let Done::Founded(vertex) = done {
                places[stop].push(vertex.0 as usize);
                check_same(&with, &without)?;
            }
        }
    }
}

/// A robot that goes round in a closed room keeps a bounded number of volumes at work.
#[test]
fn the_number_of_active_volumes_comes_to_rest() {
    let room =
        super::room::Room { width_m: 8.0, height_m: 6.0, pillars: vec![[3.0, 2.0, 2.0, 2.0]] };
    let sensor = super::room::Sensor { fov_rad: std::f64::consts::TAU, rays: 40, range_m: 5.0 };
    let mut drive = Drive::new(&room, &sensor);
    let mut map = RelativeMap::new(RelativeParams::default());
    let mut active: Vec<usize> = Vec::new();
    for i in 0..400 {
        // An ellipse around the pillar, seven steps and a bit per round.
        let angle = 0.87 * f64::from(i);
        let pose = Se2::new(
            4.0 + 2.8 * angle.cos(),
            3.0 + 2.2 * angle.sin(),
            angle + std::f64::consts::FRAC_PI_2,
        );
        // Every third time the nearest place of the first round is recognised.
        let apart_m = |known: &Se2| (known.translation - pose.translation).norm();
        let first_round = drive.world_from_vertex.iter().take(8).enumerate();
        let nearest = first_round.min_by(|a, b| apart_m(a.1).total_cmp(&apart_m(b.1)));
        let places =
            if i >= 8 && i % 3 == 0 { nearest.map(|n| n.0).into_iter().collect() } else { vec![] };
        drive.go(&pose, &places, &mut [&mut map], &mut Off);
        active.push(map.active_count());
    }
    assert_eq!(drive.world_from_vertex.len(), 400);
    assert!(map.frontier().places <= 1, "{:?}", map.frontier());
    assert!(active[399] < 80, "{active:?}");
    assert!(active[399] < active[299] + 12, "{active:?}");
    assert!(drive.graph.edges().any(|(_, edge)| edge.kind == EdgeKind::Place));
}
