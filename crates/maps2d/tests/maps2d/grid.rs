//! The plain grid: cells, frontier and ways, against brute force ([ISRR19] 6.2).

use std::collections::{BTreeMap, BTreeSet};

use geometry::Point2;
use geometry::planar::StarPolygon;
use maps2d::grid::{Cell, CellState, GridMap, GridParams};
use maps2d::volume::{Samples, VolumeParams, build};
use maps2d::{Candidate, ExplorationMap, Route, Standing};
use pose::Se2;
use probe::{Off, VertexId};
use proptest::prelude::*;
use sensing::{Reading, Scan};

use super::config;
use super::drive::{Done, Drive, Mix, Op, Story, stories};
use super::oracle::inside;

const SEEDS: &str = "proptest-regressions/grid.txt";
const MIX: Mix = Mix { turns: 2, links: 1, withdrawals: 1 };

fn grid_params() -> impl Strategy<Value = GridParams> {
    (prop_oneof![Just(1.0), 0.3..2.0_f64], prop_oneof![Just(0.1), Just(0.0), Just(0.3)]).prop_map(
        |(cell_m, cell_margin)| GridParams { cell_m, cell_margin, ..GridParams::default() },
    )
}

/// Cells by eq. 6 with certain probabilities, scan after scan; cells where rounding could decide
/// are not judged any more.
struct Model {
    params: GridParams,
    cells: BTreeMap<Cell, CellState>,
    unsure: BTreeSet<Cell>,
}

impl Model {
    fn new(params: GridParams) -> Self {
        Self { params, cells: BTreeMap::new(), unsure: BTreeSet::new() }
    }

    fn cell_at(&self, p: &Point2) -> Cell {
        let index = |v: f64| (v / self.params.cell_m).floor() as i32;
        Cell { column: index(p.x), row: index(p.y) }
    }

    fn see(&mut self, scan: &Scan, odom_from_sensor: &Se2) {
        let mut samples = Samples::new();
        samples.add(scan, &Se2::identity());
        let polygon = build(&samples, &VolumeParams::default()).unwrap().polygon;
        let reach = (polygon.outer_radius() / self.params.cell_m).ceil() as i32 + 1;
        let here = self.cell_at(&odom_from_sensor.translation.into());
        for row in here.row - reach..=here.row + reach {
            for column in here.column - reach..=here.column + reach {
                let cell = Cell { column, row };
                match self.is_inside(&polygon, odom_from_sensor, cell) {
                    Some(true) => _ = self.cells.insert(cell, CellState::Free),
                    Some(false) => {}
                    None => _ = self.unsure.insert(cell),
                }
            }
        }
        for (bearing, reading) in scan.readings() {
            let Reading::Hit(range) = reading else { continue };
            // A millimetre into the wall.
            let range = range + 1e-3;
            let hit = Point2::new(range * bearing.cos(), range * bearing.sin());
            let hit = odom_from_sensor.transform(&hit);
            let near_border = |v: f64| {
                let share = (v / self.params.cell_m).fract().abs();
                share.min(1.0 - share) < 1e-9
            };
            let cell = self.cell_at(&hit);
            if near_border(hit.x) || near_border(hit.y) {
                self.unsure.extend(cell.sides());
                self.unsure.insert(cell);
            }
            self.cells.insert(cell, CellState::Occupied);
        }
    }

    /// Whether a cell, less its margin, lies in the polygon: its middle does, and no boundary edge
    /// cuts its square.
    fn is_inside(&self, polygon: &StarPolygon, odom_from_sensor: &Se2, cell: Cell) -> Option<bool> {
        let middle = Point2::new(
            (f64::from(cell.column) + 0.5) * self.params.cell_m,
            (f64::from(cell.row) + 0.5) * self.params.cell_m,
        );
        let half_m = (0.5 - self.params.cell_margin) * self.params.cell_m;
        let cuts = |half_m: f64| {
            polygon.boundary().any(|edge| {
                let from = odom_from_sensor.transform(&edge.from) - middle;
                let to = odom_from_sensor.transform(&edge.to) - middle;
                cuts_square(&Point2::from(from), &Point2::from(to), half_m)
            })
        };
        let (less, more) = (cuts(half_m - 1e-9), cuts(half_m + 1e-9));
        if less {
            return Some(false);
        }
        if more {
            return None;
        }
        inside(polygon, &odom_from_sensor.inverse_transform(&middle))
    }
}

/// Whether a segment meets the square around the origin: the part of it within each pair of
/// parallel sides is found in turn.
fn cuts_square(a: &Point2, b: &Point2, half_m: f64) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (at_a, at_b) in [(a.x, b.x), (a.y, b.y)] {
        let slope = at_b - at_a;
        if slope == 0.0 {
            if at_a.abs() > half_m {
                return false;
            }
            continue;
        }
        let (t, u) = ((-half_m - at_a) / slope, (half_m - at_a) / slope);
        from = from.max(t.min(u));
        to = to.min(t.max(u));
    }
    from <= to
}

/// Tells a story to a grid.
fn tell(
    story: &Story,
    params: GridParams,
    mut each: impl FnMut(&Drive, &mut GridMap, &Standing) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    let mut drive = Drive::new(&story.room, &story.sensor);
    let mut grid = GridMap::new(params);
    for op in &story.ops {
        match drive.act(op, &mut [&mut grid]) {
            Done::Founded(_) | Done::Rescanned(_) => {
                let standing = drive.standing;
                each(&drive, &mut grid, &standing)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// All cells around a grid's block.
fn all_cells(grid: &GridMap) -> impl Iterator<Item = Cell> + '_ {
    (0..grid.cells().slots()).map(|slot| grid.cells().cell(slot))
}

fn is_frontier(grid: &GridMap, cell: Cell) -> bool {
    grid.cells().state(cell) == CellState::Free
        && cell.sides().iter().any(|side| grid.cells().state(*side) == CellState::Unknown)
}

fn check_frontier(grid: &GridMap) -> Result<(), TestCaseError> {
    let all: BTreeSet<Cell> = all_cells(grid).filter(|&cell| is_frontier(grid, cell)).collect();
    let (given_up, counts): (BTreeSet<Cell>, BTreeSet<Cell>) =
        all.into_iter().partition(|&cell| grid.cells().is_given_up(cell));
    prop_assert_eq!(grid.frontier_cells().collect::<BTreeSet<_>>(), counts.clone());
    let told = grid.frontier();
    prop_assert_eq!(told.places, counts.len());
    let cell_m = grid.cells().cell_m();
    prop_assert!((told.open_m - counts.len() as f64 * cell_m).abs() < 1e-9);
    prop_assert!((told.ignored_m - given_up.len() as f64 * cell_m).abs() < 1e-9);
    Ok(())
}

/// Least cost from a cell to every other over free cells, relaxed until nothing changes.
fn costs_from(grid: &GridMap, start: Cell) -> BTreeMap<Cell, f64> {
    let open = |cell: Cell| cell == start || grid.cells().state(cell) == CellState::Free;
    let mut cost: BTreeMap<Cell, f64> = BTreeMap::from([(start, 0.0)]);
    loop {
        let mut changed = false;
        for (cell, so_far) in cost.clone() {
            for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                let at = |dx, dy| Cell { column: cell.column + dx, row: cell.row + dy };
                let to = at(dx, dy);
                if to == cell || !open(to) || !open(at(dx, 0)) || !open(at(0, dy)) {
                    continue;
                }
                let through = so_far + f64::from(dx * dx + dy * dy).sqrt();
                if through < cost.get(&to).copied().unwrap_or(f64::INFINITY) - 1e-12 {
                    cost.insert(to, through);
                    changed = true;
                }
            }
        }
        if !changed {
            return cost;
        }
    }
}

proptest! {
    #![proptest_config(config(64, SEEDS))]

    /// Hit: occupied; wholly in a scan polygon: free; the latest evidence wins.
    #[test]
    fn cells_are_those_of_equation_6(story in stories(MIX, 1..12), params in grid_params()) {
        let mut model = Model::new(params);
        tell(&story, params, |drive, grid, standing| {
            let world_from_body = drive.world_from(standing.vertex) * standing.vertex_from_body;
            let odom_from_world = drive.world_from(VertexId(0)).inverse();
            let scan = drive.room.scan(&world_from_body, &drive.sensor);
            let odom_from_body = grid.odom_from_body(standing);
            let exact = odom_from_world * world_from_body;
            let apart = odom_from_body.inverse_mul(&exact);
            prop_assert!(apart.distance() < 1e-9 && apart.angle().abs() < 1e-9);
            model.see(&scan, &odom_from_body);
            let known: BTreeSet<Cell> =
                all_cells(grid).chain(model.cells.keys().copied()).collect();
            for cell in known.into_iter().filter(|cell| !model.unsure.contains(cell)) {
                let expected = model.cells.get(&cell).copied().unwrap_or_default();
                prop_assert_eq!(grid.cells().state(cell), expected, "{:?}", cell);
            }
            check_frontier(grid)
        })?;
    }

    /// Applying every scan again at the same poses changes nothing; at moved poses it is the grid
    /// that would have come of those poses.
    #[test]
    fn a_rebuilt_grid_is_the_grid(story in stories(MIX, 1..12), params in grid_params()) {
        let mut drive = Drive::new(&story.room, &story.sensor);
        let mut grid = GridMap::new(params);
        for op in &story.ops {
            drive.act(op, &mut [&mut grid]);
        }
        let odom_from_vertex: Vec<Se2> = (0..drive.world_from_vertex.len() as u32)
            .map(|vertex| {
                let vertex_from_body = Se2::identity();
                grid.odom_from_body(&Standing { vertex: VertexId(vertex), vertex_from_body })
            })
            .collect();
        let mut again = grid.clone();
        again.poses_reestimated(&odom_from_vertex, &mut Off);
        let states = |grid: &GridMap| -> Vec<(Cell, CellState)> {
            let known = |cell: &Cell| grid.cells().state(*cell) != CellState::Unknown;
            let mut states: Vec<_> = all_cells(grid)
                .filter(known)
                .map(|cell| (cell, grid.cells().state(cell)))
                .collect();
            states.sort_unstable_by_key(|state| state.0);
            states
        };
        prop_assert_eq!(states(&grid), states(&again));
        prop_assert_eq!(grid.frontier(), again.frontier());
        check_frontier(&again)?;
        // There and back.
        let moved: Vec<Se2> =
            odom_from_vertex.iter().map(|pose| Se2::new(40.0, 3.0, 0.5) * *pose).collect();
        again.poses_reestimated(&moved, &mut Off);
        check_frontier(&again)?;
        again.poses_reestimated(&odom_from_vertex, &mut Off);
        prop_assert_eq!(states(&grid), states(&again));
    }

    /// The way leads over free cells, cuts no corner, ends at frontier and is the shortest.
    #[test]
    fn the_way_is_the_shortest_over_free_cells(
        story in stories(MIX, 1..10),
        params in grid_params(),
    ) {
        tell(&story, params, |_, grid, standing| {
            let odom_from_body = grid.odom_from_body(standing);
            let start = grid.cells().at(&Point2::from(odom_from_body.translation));
            let cost = costs_from(grid, start);
            let goals = grid.frontier_cells().filter(|&cell| cell != start);
            let nearest = goals.filter_map(|cell| cost.get(&cell).copied()).reduce(f64::min);
            let before = grid.frontier();
            match grid.route(standing, 0.0) {
                Some(Route::Drive(way)) => {
                    let (mut at, mut length) = (start, 0.0);
                    for point in way {
                        let to = grid.cells().at(&odom_from_body.transform(&point));
                        let (dx, dy) = (to.column - at.column, to.row - at.row);
                        prop_assert!(dx.abs() <= 1 && dy.abs() <= 1);
                        let free = |cell| {
                            cell == start || grid.cells().state(cell) == CellState::Free
                        };
                        let corners = [
                            to,
                            Cell { column: at.column + dx, row: at.row },
                            Cell { column: at.column, row: at.row + dy },
                        ];
                        prop_assert!(corners.into_iter().all(free));
                        length += f64::from(dx * dx + dy * dy).sqrt();
                        at = to;
                    }
                    prop_assert!(grid.frontier_cells().any(|cell| cell == at));
                    prop_assert!(nearest.is_some_and(|nearest| (nearest - length).abs() < 1e-9));
                }
                Some(other) => prop_assert!(false, "{:?}", other),
                None => {
                    prop_assert_eq!(nearest, None);
                    let after = grid.frontier();
                    prop_assert_eq!(after.places, 0, "what cannot be reached is given up");
                    let sum = before.open_m + before.ignored_m;
                    prop_assert!((after.ignored_m - sum).abs() < 1e-9);
                }
            }
            check_frontier(grid)
        })?;
    }

    /// Candidates in view are the frontier cells whose middle is seen, and the robot's own.
    #[test]
    fn candidates_are_the_cells_in_view(story in stories(MIX, 1..10), params in grid_params()) {
        tell(&story, params, |_, grid, standing| {
            let odom_from_body = grid.odom_from_body(standing);
            let here = grid.cells().at(&Point2::from(odom_from_body.translation));
            let (mut seen, mut around) = (Vec::new(), Vec::new());
            grid.in_view(standing, &mut seen);
            grid.around(standing, &mut around);
            let cell_of = |candidate: &Candidate| {
                grid.cells().at(&odom_from_body.transform(&candidate.goals_in_body[0]))
            };
            let cells: BTreeSet<Cell> = seen.iter().map(cell_of).collect();
            prop_assert_eq!(cells.len(), seen.len());
            let frontier: BTreeSet<Cell> = grid.frontier_cells().collect();
            prop_assert!(cells.is_subset(&frontier));
            for candidate in &seen {
                prop_assert_eq!(candidate.turn_only, cell_of(candidate) == here);
            }
            prop_assert_eq!(frontier.contains(&here), cells.contains(&here));
            for candidate in &around {
                prop_assert!(candidate.turn_only && frontier.contains(&cell_of(candidate)));
                prop_assert!(!cells.contains(&cell_of(candidate)), "seen and not seen");
            }
            Ok(())
        })?;
    }

    /// A reach without end gives up all frontier, and costs no more than what is there.
    #[test]
    fn a_reach_without_end_gives_up_everything(
        story in stories(MIX, 2..6),
        params in grid_params(),
        radius_m in prop_oneof![Just(1e12), Just(f64::MAX)],
    ) {
        tell(&story, params, |_, grid, standing| {
            let before = grid.frontier();
            grid.give_up(standing, &Point2::new(1.0, 0.0), radius_m, true, &mut Off);
            let after = grid.frontier();
            prop_assert_eq!((after.open_m, after.places), (0.0, 0));
            prop_assert!((after.ignored_m - before.ignored_m - before.open_m).abs() < 1e-9);
            check_frontier(grid)
        })?;
    }

    /// What is given up counts no more, however often it is seen again.
    #[test]
    fn what_is_given_up_stays_so(
        story in stories(MIX, 2..10),
        params in grid_params(),
        radius_m in 0.0..3.0_f64,
    ) {
        tell(&story, params, |_, grid, standing| {
            let mut seen: Vec<Candidate> = Vec::new();
            grid.in_view(standing, &mut seen);
            if let Some(first) = seen.first() {
                let goal = first.goals_in_body[0];
                let cell = grid.cells().at(&grid.odom_from_body(standing).transform(&goal));
                grid.give_up(standing, &goal, radius_m, true, &mut Off);
                prop_assert!(grid.cells().is_given_up(cell));
                prop_assert!(grid.frontier_cells().all(|left| left != cell));
            }
            check_frontier(grid)
        })?;
    }
}

#[test]
fn a_wall_ahead_is_occupied_and_the_way_to_it_free() {
    // A wall 2.5 m ahead, seen from the middle of a cell by rays of one degree.
    let rays = (-45..=45).map(|deg: i32| 2.5 / f64::from(deg).to_radians().cos()).collect();
    let scan = Scan::new(-45.0_f64.to_radians(), 1.0_f64.to_radians(), rays, 5.0);
    let mut grid = GridMap::new(GridParams::default());
    let mut graph = posegraph::PoseGraph::new();
    // The grid's origin is the first vertex; the scan is taken half a cell into it.
    let (a, b) = (graph.add_vertex(), graph.add_vertex());
    let step = Se2::new(0.5, 0.5, 0.0);
    let edge = graph.add_edge(a, b, step, posegraph::EdgeKind::Odometry).unwrap();
    grid.edges_added(&graph, &[edge], &mut Off);
    let standing = Standing { vertex: b, vertex_from_body: Se2::identity() };
    grid.scanned(&standing, &scan, &mut Off);
    let state = |column, row| grid.cells().state(Cell { column, row });
    assert_eq!(state(3, 0), CellState::Occupied);
    assert_eq!((state(1, 0), state(2, 0)), (CellState::Free, CellState::Free));
    assert_eq!(state(0, 0), CellState::Unknown, "the robot's own cell is not wholly in view");
    assert_eq!(state(4, 0), CellState::Unknown, "behind the wall");
    assert_eq!(grid.kind(), "grid");
    assert!(grid.bytes() > 0);
}

/// A place edge does not move the plain grid.
#[test]
fn only_odometry_moves_the_estimate() {
    let op =
        |x: f64, places: Vec<prop::sample::Index>| Op::Go { x, y: 0.5, heading_rad: 0.0, places };
    let story = Story {
        room: super::room::Room { width_m: 10.0, height_m: 6.0, pillars: Vec::new() },
        sensor: super::room::Sensor { fov_rad: 2.0, rays: 9, range_m: 5.0 },
        ops: vec![op(0.3, vec![]), op(0.5, vec![]), op(0.7, vec![])],
    };
    let mut drive = Drive::new(&story.room, &story.sensor);
    let mut grid = GridMap::new(GridParams::default());
    for op in &story.ops {
        drive.act(op, &mut [&mut grid]);
    }
    let before = grid.odom_from_body(&drive.standing);
    let wrong = Se2::new(3.0, 3.0, 1.0);
    let edge =
        drive.graph.add_edge(VertexId(0), VertexId(2), wrong, posegraph::EdgeKind::Place).unwrap();
    grid.edges_added(&drive.graph, &[edge], &mut Off);
    assert_eq!(grid.odom_from_body(&drive.standing), before);
}
