//! Paths on maps of united views: A* beside Dijkstra, shortening, and how long both take.
//!
//! `cargo bench -p maps3d --bench plan [-- --queries N --radius M --views N,noisy:N]`. Maps are unions of views along
//! a path and of views all over a hall, filled with tetrahedra. Start and goal are uniform in the free
//! space. Seconds are those of this thread on a processor.

#[path = "../../solid/benches/clock/mod.rs"]
mod clock;

use std::io::Write;

use clock::secs;
use maps3d::{Algorithm, Heuristic, PlanEvent, PlanOptions, Planner, Target};
use probe::Probe;
use solid::boolean::Options;
use solid::mesh::weld;
use solid::synthetic::{Kind, views};
use solid::{Point3, Tetrahedra, tetrahedralize, unite};

fn say(line: &str) {
    writeln!(std::io::stdout(), "{line}").expect("stdout takes text");
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Points uniform in the free space.
struct Sampler<'a> {
    map: &'a Tetrahedra,
    sums: Vec<f64>,
    random: Random,
}

impl<'a> Sampler<'a> {
    fn new(map: &'a Tetrahedra) -> Self {
        let mut sum = 0.0;
        let sums = map.tetrahedra.iter().map(|tet| {
            let [a, b, c, d] = tet.map(|v| map.vertices[v as usize]);
            sum += (b - a).cross(&(c - a)).dot(&(d - a));
            sum
        });
        Self { map, sums: sums.collect(), random: Random(7) }
    }

    fn point(&mut self) -> Point3 {
        let at = self.random.unit() * self.sums[self.sums.len() - 1];
        let t = self.sums.partition_point(|&sum| sum < at).min(self.sums.len() - 1);
        let mut cuts = [self.random.unit(), self.random.unit(), self.random.unit()];
        cuts.sort_by(f64::total_cmp);
        let shares = [cuts[0], cuts[1] - cuts[0], cuts[2] - cuts[1], 1.0 - cuts[2]];
        let corners = self.map.tetrahedra[t].map(|v| self.map.vertices[v as usize].coords);
        Point3::from(corners.iter().zip(shares).map(|(c, s)| c * s).sum::<solid::Vector3>())
    }
}

/// One piece of work is too short for the clock of the processor: it is done again and again.
const REPEATS: u32 = 5;

/// What the work gives, and milliseconds of one of the repeats.
fn millis<T>(mut work: impl FnMut() -> T) -> (T, f64) {
    let (done, took) = secs(|| {
        for _ in 1..REPEATS {
            work();
        }
        work()
    });
    (done, took * 1e3 / f64::from(REPEATS))
}

fn median(values: &mut [f64]) -> f64 {
    at_share(values, 0.5)
}

fn at_share(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    values.get((last as f64 * share).round() as usize).copied().unwrap_or(f64::NAN)
}

/// The cost of the way that the search found first, before any corridor was found too narrow.
#[derive(Default)]
struct First(Option<f64>);

impl Probe<PlanEvent<'_>> for First {
    fn emit(&mut self, event: PlanEvent<'_>) {
        if let PlanEvent::Routed { cost, .. } = event {
            self.0.get_or_insert(cost);
        }
    }
}

/// Dijkstra's search, and A* by what it goes by.
const SEARCHES: [(Algorithm, Heuristic); 4] = [
    (Algorithm::Dijkstra, Heuristic::Zero),
    (Algorithm::Astar, Heuristic::Manhattan),
    (Algorithm::Astar, Heuristic::Euclidean),
    (Algorithm::Astar, Heuristic::Landmarks),
];

fn measure(name: &str, map: &Tetrahedra, radius_m: f64, queries: usize) {
    let options = PlanOptions { radius_m, least_area_m2: 0.01, ..PlanOptions::default() };
    let (planner, built) = secs(|| Planner::new(&[map], &options));
    let mut planner = planner.expect("sound tetrahedra");
    let mut sampler = Sampler::new(map);
    let free = |point: &Point3, planner: &Planner| {
        planner.space().locate(point).is_some()
            && planner.space().obstacles().within(point, radius_m).is_none()
    };
    let mut asked = Vec::new();
    while asked.len() < queries {
        let pair = [sampler.point(), sampler.point()];
        if pair.iter().all(|point| free(point, &planner)) {
            asked.push(pair);
        }
    }
    let (_, prepared) = secs(|| planner.prepare());
    // Which gates a ball passes is found out once for a map; the rest is timed apart.
    let (mut ways, mut found, mut none, mut equal, mut first_equal) = (0, 0, 0, 0, 0);
    let mut expansions = [0; 4];
    let search = |planner: &mut Planner, which, heuristic, pair: &[Point3; 2]| {
        planner.set_search(which, heuristic);
        planner.set_shorten(false);
        let mut first = First::default();
        let plan = planner.plan_with(&pair[0], &Target::Point(pair[1]), &mut first);
        (plan.expect("points inside"), first.0)
    };
    let (_, warmed) = secs(|| {
        for pair in &asked {
            let searched =
                SEARCHES.map(|(which, heuristic)| search(&mut planner, which, heuristic, pair));
            let firsts = searched.each_ref().map(|(_, first)| *first);
            first_equal += usize::from(firsts.iter().all(|&first| first == firsts[0]));
            let plans = searched.map(|(plan, _)| plan);
            let costs = plans.each_ref().map(|plan| plan.as_ref().map(|plan| plan.cost_m));
            found += usize::from(costs[0].is_some());
            none += usize::from(costs.iter().any(|cost| cost.is_some() != costs[0].is_some()));
            equal += usize::from(costs[0].is_some() && costs.iter().all(|&cost| cost == costs[0]));
            ways += usize::from(costs.iter().all(Option::is_some));
            for (sum, plan) in expansions.iter_mut().zip(plans.iter().flatten()) {
                *sum += plan.expansions;
            }
        }
    });
    planner.set_search(Algorithm::Astar, Heuristic::Landmarks);
    planner.set_shorten(true);
    let (mut inside, mut clear, mut tries, mut knots) = (0, 0, 0, 0);
    let mut took = Vec::new();
    let (mut search_took, mut against_way, mut against_straight) = (vec![], vec![], vec![]);
    let (mut programmes, mut corridors) = (vec![], vec![]);
    for pair in &asked {
        planner.set_shorten(false);
        let (_, alone) = millis(|| planner.plan(&pair[0], &Target::Point(pair[1])));
        planner.set_shorten(true);
        let (plan, both) = millis(|| planner.plan(&pair[0], &Target::Point(pair[1])));
        let Some(plan) = plan.expect("points inside") else { continue };
        took.push(both);
        search_took.push(alone);
        against_way.push(1.0 - plan.path_m / plan.cost_m);
        against_straight.push(1.0 - plan.path_m / plan.straight_m);
        programmes.push(plan.programmes as f64);
        corridors.push(plan.corridor.tetrahedra.len() as f64);
        inside += usize::from(plan.corridor.leaves(planner.space(), &plan.path).is_none());
        clear += usize::from(plan.clear);
        tries += plan.tries;
        knots += plan.path.len();
    }
    let paths = took.len();
    say(&format!(
        "{name}, radius {radius_m} m: {} tetrahedra, {} frontier points ({} too narrow), {} edges; \
         ready in {built:.3} s, landmarks in {prepared:.3} s; {queries} queries, {paths} with a way; four searches of \
         each {warmed:.2} s",
        map.tetrahedra.len(),
        planner.graph().frontier().len(),
        planner.graph().narrow(),
        planner.graph().edge_count(),
    ));
    say(&format!(
        "  cost the same by all searches: {first_equal} of {queries} (after corridors that are too narrow: {equal} of \
         {found}, {none} found by some alone); expansions over {ways}: \
         Dijkstra {}, A* Manhattan {:.3} of that, Euclidean {:.3}, landmarks {:.3}",
        expansions[0],
        expansions[1] as f64 / expansions[0] as f64,
        expansions[2] as f64 / expansions[0] as f64,
        expansions[3] as f64 / expansions[0] as f64,
    ));
    say(&format!(
        "  inside, exact: {inside} of {paths}; clear of obstacles: {clear}; corridors tried {:.2} each, points \
         {:.1} each, tetrahedra passed {:.0} (median)",
        tries as f64 / paths as f64,
        knots as f64 / paths as f64,
        median(&mut corridors),
    ));
    say(&format!(
        "  shorter than the way by {:.1} % (median), than the straight lines between its nodes by {:.1} %",
        100.0 * median(&mut against_way),
        100.0 * median(&mut against_straight),
    ));
    say(&format!(
        "  plan and shorten {:.2} ms (median), {:.2} ms (95 %), of which plan {:.2} ms; programmes {:.0} (median), \
         {:.0} (95 %)",
        median(&mut took),
        at_share(&mut took, 0.95),
        median(&mut search_took),
        median(&mut programmes),
        at_share(&mut programmes, 0.95),
    ));
    nearest(&mut planner, &asked);
}

/// Many goals: the nearest frontier.
fn nearest(planner: &mut Planner, asked: &[[Point3; 2]]) {
    planner.set_shorten(false);
    let mut sums = [0; 3];
    let (mut same, mut both) = (0, 0);
    let all = [
        (Algorithm::Astar, Heuristic::Euclidean),
        (Algorithm::Astar, Heuristic::Zero),
        (Algorithm::Dijkstra, Heuristic::Zero),
    ];
    for pair in asked {
        let mut costs = Vec::new();
        for (sum, (algorithm, heuristic)) in sums.iter_mut().zip(all) {
            planner.set_search(algorithm, heuristic);
            let plan = planner.plan(&pair[0], &Target::Frontier).expect("a point inside");
            if let Some(plan) = plan {
                *sum += plan.expansions;
                costs.push(plan.cost_m);
            }
        }
        both += usize::from(costs.len() == 3);
        same += usize::from(costs.len() == 3 && costs.iter().all(|&cost| cost == costs[0]));
    }
    say(&format!(
        "  nearest frontier: same cost {same} of {both}; expansions A* {}, A* without estimate {}, Dijkstra {}",
        sums[0], sums[1], sums[2]
    ));
}

/// A kind of views and how many: `130` along a path, `noisy:90` all over the hall.
fn views_of(word: &str) -> (Kind, usize) {
    match word.split_once(':') {
        Some(("noisy", count)) => (Kind::Noisy, count.parse().expect("a count")),
        _ => (Kind::Path, word.parse().expect("a count, or noisy:COUNT")),
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let value = |name: &str| {
        words.iter().position(|word| word == name).and_then(|at| words.get(at + 1)).cloned()
    };
    let queries = value("--queries").map_or(1000, |text| text.parse().expect("a count"));
    let radii = value("--radius").map_or(vec![0.0, 0.2], |text| {
        text.split(',').map(|one| one.parse().expect("metres")).collect()
    });
    let maps: Vec<(Kind, usize)> = match value("--views") {
        Some(text) => text.split(',').map(views_of).collect(),
        None => vec![(Kind::Path, 50), (Kind::Noisy, 52), (Kind::Noisy, 104)],
    };
    for (kind, count) in maps {
        let map = unite(&views(kind, count), &Options::default()).expect("sound views");
        let found = tetrahedralize(&weld(&map).mesh).expect("a sound map");
        for &radius_m in &radii {
            measure(&format!("{kind:?} {count}"), &found, radius_m, queries);
        }
    }
}
