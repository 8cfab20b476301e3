//! What a map believes at the end of a step.

use geometry::planar::Closed;
use geometry::{Point2, Vector2};
use maps2d::grid::{CellState, GridMap};
use maps2d::relative::{Cause, Closing, RelativeMap, VolumeState};
use pose::Se2;
use probe::VertexId;
use rerun::RecordingStream;

use super::places::Places;
use crate::InstrumentError;
use crate::columns::{Lines, Now, Points, Poses, Tiles};
use crate::palette;

/// Closed parts shorter than this are drawn as what is next to them, metres.
const BITS_M: f64 = 0.05;

/// Lines are drawn straight where they pass what they stand for by no more than this, metres.
/// Recordings of large places are a tenth as large for it.
const STRAIGHT_M: f32 = 0.01;

/// At `summary`, the edges of so many volumes are drawn, the nearest along the graph; the frontier of all.
/// Where a robot has been often, hundreds see the same walls, and each row would hold them all.
const VOLUMES_AT_SUMMARY: usize = 40;

/// Rows of `belief/..`.
pub(super) struct Belief {
    pub(super) obstacle: Lines,
    pub(super) frontier: Lines,
    pub(super) ignored: Lines,
    pub(super) free: Lines,
    pub(super) wall: Lines,
    unreachable: Lines,
    posts: Points,
    scope: Lines,
    anchors: Points,
    robot: Lines,
    frame: Poses,
    eye: Option<Poses>,
    pub(super) cells: Option<Tiles>,
    frontier_cells: Points,
    pub(super) cells_path: String,
    fresh_cells: Vec<(i64, i64)>,
    cells_now: Vec<(i64, i64)>,
    /// Volumes in the last scope, for the plots.
    pub volumes_in_scope: usize,
}

impl Belief {
    pub fn new(name: &str, eye_follows: bool) -> Self {
        let edges = |label: &str, radius: f32, order: f32| {
            Lines::new(format!("{name}/belief/edges/{label}"), radius, order)
                .straightening(STRAIGHT_M)
        };
        Self {
            free: edges("free", -0.7, 10.0).joining(BITS_M as f32),
            wall: edges("wall_closed", -0.9, 11.0).joining(BITS_M as f32),
            unreachable: edges("unreachable", -1.2, 12.0),
            ignored: edges("ignored", -1.2, 13.0),
            obstacle: edges("obstacle", -1.4, 14.0),
            frontier: edges("frontier", -2.2, 15.0),
            posts: Points::new(format!("{name}/belief/posts"), -2.0, 14.0),
            scope: Lines::new(format!("{name}/belief/scope_tree"), -0.7, 20.0),
            anchors: Points::new(format!("{name}/belief/vertices"), -1.8, 21.0),
            robot: Lines::new(format!("{name}/belief/robot"), -1.6, 40.0),
            frame: Poses::new(&format!("{name}/belief")),
            eye: eye_follows.then(|| Poses::eye(&format!("{name}/belief/eye"))),
            cells: None,
            frontier_cells: Points::new(format!("{name}/belief/frontier_cells"), -3.0, 15.0),
            cells_path: format!("{name}/belief/cells"),
            fresh_cells: Vec::new(),
            cells_now: Vec::new(),
            volumes_in_scope: 0,
        }
    }

    /// Draws the volumes in scope around the robot, edges by label.
    ///
    /// Cost: the edges of the volumes in scope.
    pub fn settled(&mut self, map: &RelativeMap, places: &Places, keep_rows: bool, now: &Now) {
        if !keep_rows {
            for lines in self.edge_lines() {
                lines.drop_row_of(now.step);
            }
        }
        self.volumes_in_scope = 0;
        let most = if keep_rows { usize::MAX } else { VOLUMES_AT_SUMMARY };
        // By vertex, not by distance: rows then repeat long stretches of the row before.
        let mut vertices: Vec<_> = map
            .scope()
            .placed()
            .iter()
            .enumerate()
            .map(|(i, row)| (row.vertex, i < most))
            .collect();
        vertices.sort_unstable();
        for (vertex, is_near) in vertices {
            if let Some(state) = map.volume(vertex) {
                let belief_from_volume = places.of(vertex);
                self.volumes_in_scope += 1;
                self.left(state, &belief_from_volume, map.params().sliver_m);
                if is_near {
                    self.known(state, &belief_from_volume);
                }
            }
        }
        for lines in self.edge_lines() {
            lines.end_row(now);
        }
        self.posts.end_row(now);
    }

    pub(super) fn edge_lines(&mut self) -> [&mut Lines; 6] {
        [
            &mut self.free,
            &mut self.wall,
            &mut self.unreachable,
            &mut self.ignored,
            &mut self.obstacle,
            &mut self.frontier,
        ]
    }

    /// Draws what a volume knows: obstacles, and frontier that was closed.
    fn known(&mut self, state: &VolumeState, belief_from_volume: &Se2) {
        let place = |p: &Point2| belief_from_volume.transform(p);
        for edge in &state.volume.obstacles {
            self.obstacle.segment(&place(&edge.from), &place(&edge.to), palette::OBSTACLE);
        }
        for post in &state.volume.posts {
            self.posts.point(&place(post), palette::OBSTACLE);
        }
        for (edge, ledger) in state.volume.frontier.iter().zip(&state.ledgers) {
            // Parts that touch and were closed for the same cause are one line.
            let alike = |a: &Closed<Closing>, b: &Closed<Closing>| {
                a.reason.cause == b.reason.cause && a.span.to == b.span.from
            };
            for run in ledger.closed().chunk_by(alike) {
                let (Some(first), Some(last)) = (run.first(), run.last()) else { continue };
                let cause = first.reason.cause;
                let lines = match cause {
                    Cause::Inside => &mut self.free,
                    Cause::Wall => &mut self.wall,
                    Cause::Unreachable => &mut self.unreachable,
                };
                let (from, to) = (edge.at(first.span.from), edge.at(last.span.to));
                if cause != Cause::Unreachable && (to - from).norm() < BITS_M {
                    continue;
                }
                lines.segment(&place(&from), &place(&to), palette::of_cause(cause));
            }
        }
    }

    /// Draws the frontier that a volume has left.
    fn left(&mut self, state: &VolumeState, belief_from_volume: &Se2, sliver_m: f64) {
        let place = |p: &Point2| belief_from_volume.transform(p);
        for chain in &state.chains {
            let counts = chain.length_m >= sliver_m;
            let (lines, colour) = if counts {
                (&mut self.frontier, palette::FRONTIER)
            } else {
                (&mut self.ignored, palette::IGNORED)
            };
            for part in &chain.parts {
                let edge = &state.volume.frontier[part.edge];
                let (from, to) = (edge.at(part.span.from), edge.at(part.span.to));
                lines.segment(&place(&from), &place(&to), colour);
            }
        }
    }

    /// Draws the tree of shortest paths along which the scope was laid out.
    pub fn scope(&mut self, links: impl Iterator<Item = (Point2, Option<Point2>)>, now: &Now) {
        self.scope.drop_row_of(now.step);
        for (at, parent) in links {
            self.anchors.point(&at, palette::SCOPE);
            if let Some(parent) = parent {
                self.scope.segment(&parent, &at, palette::SCOPE);
            }
        }
        self.scope.end_row(now);
        self.anchors.end_row(now);
    }

    /// Takes over what a grid believes of the cells that changed, or of all of them.
    pub fn grid(
        &mut self,
        grid: &GridMap,
        changed: Option<&[(maps2d::grid::Cell, CellState, CellState)]>,
    ) {
        let path = &self.cells_path;
        let cells = self.cells.get_or_insert_with(|| {
            Tiles::new(path, Vector2::repeat(grid.cells().cell_m()), Point2::origin(), 0.9, -10.0)
        });
        let class = |state: CellState| match state {
            CellState::Unknown => 0,
            CellState::Free => palette::CELL_FREE,
            CellState::Occupied => palette::CELL_OCCUPIED,
        };
        match changed {
            Some(changed) => {
                for (cell, _, state) in changed {
                    let at = (i64::from(cell.column), i64::from(cell.row));
                    if *state == CellState::Free {
                        cells.set(at.0, at.1, palette::CELL_CHANGED);
                        self.cells_now.push(at);
                    } else {
                        cells.set(at.0, at.1, class(*state));
                    }
                }
            }
            None => {
                cells.clear();
                self.cells_now.clear();
                for slot in 0..grid.cells().slots() {
                    let cell = grid.cells().cell(slot);
                    let state = grid.cells().state(cell);
                    if state != CellState::Unknown {
                        cells.set(i64::from(cell.column), i64::from(cell.row), class(state));
                    }
                }
            }
        }
        self.frontier_cells.forget();
        for cell in grid.frontier_cells() {
            self.frontier_cells.point(&grid.cells().centre(cell), palette::FRONTIER);
        }
    }

    /// Ends the step: where the robot is believed, and where the belief lies in truth.
    pub fn end_step(
        &mut self,
        belief_from_body: &Se2,
        belief_from_eye: &Se2,
        world_from_belief: Option<&Se2>,
        draw_cells: bool,
        now: &Now,
    ) {
        super::draw_robot(&mut self.robot, belief_from_body);
        self.robot.end_row(now);
        if let Some(world_from_belief) = world_from_belief {
            self.frame.push(world_from_belief, now);
        }
        if let Some(eye) = &mut self.eye {
            let centred = Se2 { rotation: Se2::identity().rotation, ..*belief_from_eye };
            eye.push(&centred, now);
        }
        if let Some(cells) = &mut self.cells {
            // What was new in the step before is not new any more.
            self.cells_now.sort_unstable();
            for (column, row) in self.fresh_cells.drain(..) {
                if self.cells_now.binary_search(&(column, row)).is_err()
                    && cells.get(column, row) == palette::CELL_CHANGED
                {
                    cells.set(column, row, palette::CELL_FREE);
                }
            }
            std::mem::swap(&mut self.fresh_cells, &mut self.cells_now);
            if draw_cells {
                cells.end_row(now);
                self.frontier_cells.end_row(now);
            }
        }
    }

    pub fn held_bytes(&self) -> usize {
        let edges = [
            &self.free,
            &self.wall,
            &self.unreachable,
            &self.ignored,
            &self.obstacle,
            &self.frontier,
            &self.scope,
        ];
        edges.iter().map(|lines| lines.held_bytes()).sum::<usize>()
            + self.anchors.held_bytes()
            + self.frontier_cells.held_bytes()
            + self.cells.as_ref().map_or(0, Tiles::held_bytes)
    }

    pub fn send(&mut self, stream: &RecordingStream) -> Result<(), InstrumentError> {
        for lines in self.edge_lines() {
            lines.send(stream)?;
        }
        self.posts.send(stream)?;
        self.scope.send(stream)?;
        self.anchors.send(stream)?;
        self.robot.send(stream)?;
        self.frame.send(stream)?;
        self.frontier_cells.send(stream)?;
        if let Some(eye) = &mut self.eye {
            eye.send(stream)?;
        }
        if let Some(cells) = &mut self.cells {
            cells.send(stream)?;
        }
        Ok(())
    }
}

/// The vertices of a scope with their parents, where they are drawn.
pub(super) fn scope_links<'a>(
    scope: &'a posegraph::Scope,
    place: impl Fn(VertexId) -> Se2 + 'a,
) -> impl Iterator<Item = (Point2, Option<Point2>)> + 'a {
    let at = move |vertex| Point2::from(place(vertex).translation);
    scope.placed().iter().map(move |row| {
        let parent = row.parent.and_then(|i| scope.placed().get(i as usize));
        (at(row.vertex), parent.map(|parent| at(parent.vertex)))
    })
}
