//! Volumes that are retired are not missed.

use geometry::planar::Interval;
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

/// The parts of frontier that count, by volume and edge.
fn counting(map: &RelativeMap) -> Vec<(u32, usize, Interval)> {
    let mut parts = Vec::new();
    for (vertex, state) in map.volumes() {
        for chain in state.counting_chains(map.params().sliver_m) {
            parts.extend(chain.parts.iter().map(|part| (vertex.0, part.edge, part.span)));
        }
    }
    parts.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.from.total_cmp(&b.2.from)));
    parts
}

fn check_same(with: &RelativeMap, without: &RelativeMap) -> Result<(), TestCaseError> {
    let (a, b) = (counting(with), counting(without));
    let told = || format!("with: {a:?}\nwithout: {b:?}");
    prop_assert_eq!(a.len(), b.len(), "{}", told());
    for (x, y) in a.iter().zip(&b) {
        let near = (x.2.from - y.2.from).abs() < 1e-9 && (x.2.to - y.2.to).abs() < 1e-9;
        prop_assert!((x.0, x.1) == (y.0, y.1) && near, "{}", told());
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
    #![proptest_config(config(64, SEEDS))]

    #[test]
    fn what_counts_is_the_same_in_any_story(
        story in stories(Mix { turns: 1, links: 1, withdrawals: 0 }, 10..40),
        params in params(),
    ) {
        check_story(&story, params)?;
    }

    #[test]
    fn what_counts_is_the_same_where_place_edges_are_withdrawn(
        story in stories(Mix { turns: 1, links: 2, withdrawals: 1 }, 10..40),
        params in params(),
    ) {
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
    let sensor = super::room::Sensor { fov_rad: 2.0, rays: 24, range_m: 5.0 };
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
        let places = if i >= 8 && i % 7 == 0 { vec![i as usize - 7] } else { Vec::new() };
        drive.go(&pose, &places, &mut [&mut map], &mut Off);
        active.push(map.active_count());
    }
    assert_eq!(drive.world_from_vertex.len(), 400);
    assert_eq!(map.frontier().places, 0, "{:?}", map.frontier());
    assert!(active[399] <= active[100] + 2, "{active:?}");
    assert!(active[399] < 60, "{active:?}");
    assert!(drive.graph.edges().any(|(_, edge)| edge.kind == EdgeKind::Place));
}
