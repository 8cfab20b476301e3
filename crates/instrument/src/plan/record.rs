//! The listener of planning.

use std::fmt::Arguments;

use maps3d::PlanEvent;
use probe::Probe;
use serde_json::Value;
use solid::{Point3, Polyhedron};

use super::draw;
use crate::columns::rgb;
use crate::solid::{SolidOptions, SolidStage};
use crate::{InstrumentError, layout, palette};

/// The names of the events of planning.
pub const PLAN_EVENTS: &[&str] = PlanEvent::VARIANTS;

/// Expansions that are told one by one; afterwards only what was closed so far.
const MOST_STEPS: usize = 5_000;

/// What was closed is drawn again when it grew by this factor: all drawings together are linear in it.
const GROWTH: f64 = 1.25;

/// What the recording of a plan says about itself.
#[derive(Clone, Debug)]
pub struct PlanRecordingOptions {
    /// Its file, name and text.
    pub solid: SolidOptions,
    /// The radius of the robot, metres.
    pub radius_m: f64,
}

/// The recording of one plan: a probe.
///
/// Single steps stand on the timeline `event`.
pub struct PlanRecording {
    stage: SolidStage,
    radius_m: f64,
    tetrahedra: Vec<[Point3; 4]>,
    /// Legs of the nodes that were expanded.
    closed: Vec<[Point3; 2]>,
    expanded: usize,
    /// The number of expansions at which what was closed is drawn next.
    next: usize,
    half_spaces: Vec<[Point3; 2]>,
    gates: Vec<[Point3; 2]>,
    result: String,
}

impl PlanRecording {
    /// Creates the file with its layout, its text page and the edges of the mesh.
    ///
    /// # Errors
    /// [`InstrumentError::Write`] where the file cannot be created.
    pub fn create(
        options: &PlanRecordingOptions,
        mesh: &Polyhedron,
    ) -> Result<Self, InstrumentError> {
        let about = format!(
            "{}\n\n- **search**: thin blue lines are the dual graph, orange points its frontier nodes; green \
             lines are the legs to the nodes closed so far, the white point is the node expanded now, the \
             yellow line the leg opened last\n\
             - **path**: grey edges are the corridor, the violet line is the way through its nodes, the red line \
             the polyline of the last cone programme, the green line the path as it was verified; orange \
             triangles are gates that take part; white squares are the half-spaces that keep the polyline {} m \
             from obstacles\n\
             - thin lines are the edges of the mesh, grey of obstacle and orange of frontier\n\n\
             Step along `event`. The first {MOST_STEPS} expansions are told one by one.",
            options.solid.about, options.radius_m
        );
        let solid = SolidOptions { about, ..options.solid.clone() };
        let mut stage = SolidStage::create_with(&solid, layout::send_plan)?;
        stage.looks(&[
            ("plan/cost_m", "cost of the node expanded", palette::MAPS[1]),
            ("plan/total_m", "cost and estimate", palette::MAPS[0]),
            ("plan/length_m", "length of the polyline", palette::MAPS[2]),
        ]);
        stage.outlined("input", mesh);
        Ok(Self {
            stage,
            radius_m: options.radius_m,
            tetrahedra: Vec::new(),
            closed: Vec::new(),
            expanded: 0,
            next: 1,
            half_spaces: Vec::new(),
            gates: Vec::new(),
            result: String::new(),
        })
    }

    /// Ends the recording; `metrics` is kept as JSON.
    ///
    /// # Errors
    /// The first refusal of anything that was to be recorded.
    pub fn finish(self, metrics: &Value) -> Result<(), InstrumentError> {
        self.stage.finish(self.result, metrics)
    }

    fn say(&mut self, variant: &'static str, line: Arguments<'_>) {
        self.stage.event(variant, line);
    }

    fn draw_closed(&mut self) {
        self.stage.lines("search/closed", &self.closed, palette::BEST, 1.0);
        self.next = ((self.expanded as f64) * GROWTH) as usize + 1;
    }

    /// Another search begins: nothing is closed, no polyline is known.
    fn begin(&mut self) {
        (self.closed, self.expanded, self.next) = (Vec::new(), 0, 1);
        (self.half_spaces, self.gates) = (Vec::new(), Vec::new());
        self.stage.lines("search/opened", &[], palette::WORST, 2.0);
        for entity in ["path/solved", "path/gates", "path/half_spaces"] {
            self.stage.lines(entity, &[], palette::GOAL, 1.0);
        }
    }
}

impl Probe<PlanEvent<'_>> for PlanRecording {
    fn emit(&mut self, event: PlanEvent<'_>) {
        let variant = event.variant();
        let white = rgb(255, 255, 255);
        match event {
            PlanEvent::Joined { space, graph } => {
                let (nodes, legs) = (graph.points().len(), graph.edge_count());
                self.say(
                    variant,
                    format_args!(
                        "{} tetrahedra, {} frontier points, {nodes} nodes, {legs} legs",
                        space.len(),
                        graph.frontier().len()
                    ),
                );
                self.tetrahedra = draw::corners(space);
                self.stage.lines(
                    "space/edges",
                    &draw::edges(&self.tetrahedra),
                    rgb(60, 62, 78),
                    0.3,
                );
                self.stage.lines("space/frontier", &draw::frontier(space), palette::FRONTIER, 0.6);
                self.stage.lines("graph/legs", &draw::legs(graph), rgb(50, 90, 150), 0.4);
                self.stage.points("graph/frontier", &draw::goals(graph), palette::FRONTIER, 2.5);
            }
            PlanEvent::Located { from, to, tetrahedron } => {
                self.say(variant, format_args!("the start is in tetrahedron {tetrahedron}"));
                self.begin();
                let ends: Vec<Point3> = [Some(from), to].into_iter().flatten().collect();
                self.stage.points("ends", &ends, palette::GOAL, 6.0);
            }
            PlanEvent::Opened { node, at, before, cost } => {
                if self.expanded < MOST_STEPS {
                    self.say(variant, format_args!("node {}, {cost:.4}", node.0));
                    let leg: Vec<[Point3; 2]> =
                        before.map(|before| [before, at]).into_iter().collect();
                    self.stage.lines("search/opened", &leg, palette::WORST, 2.0);
                }
            }
            PlanEvent::Expanded { node, at, before, cost, estimate } => {
                self.expanded += 1;
                self.closed.extend(before.map(|before| [before, at]));
                let is_told = self.expanded <= MOST_STEPS || self.expanded >= self.next;
                if is_told {
                    let closed = self.expanded;
                    self.say(
                        variant,
                        format_args!(
                            "node {}, {cost:.4} and at least {estimate:.4} to go; {closed} closed",
                            node.0
                        ),
                    );
                    self.stage.points("search/node", &[at], white, 5.0);
                    self.stage.plot("plan/cost_m", cost);
                    self.stage.plot("plan/total_m", cost + estimate);
                }
                if self.expanded >= self.next {
                    self.draw_closed();
                }
            }
            PlanEvent::Routed { points, corridor, cost, expansions } => {
                self.say(
                    variant,
                    format_args!(
                        "{cost:.4} m through {} tetrahedra, {expansions} expansions",
                        corridor.len()
                    ),
                );
                self.draw_closed();
                let way = draw::segments(points);
                self.stage.lines("search/way", &way, palette::GIVEN_UP, 3.0);
                self.stage.lines("path/way", &way, palette::GIVEN_UP, 2.0);
                let passed = corridor.iter().filter_map(|&t| self.tetrahedra.get(t as usize));
                self.stage.lines("path/corridor", &draw::edges(passed), rgb(150, 150, 165), 0.7);
                self.stage.plot("plan/length_m", cost);
                self.begin();
            }
            PlanEvent::Solved { points, length_m, half_spaces } => {
                self.say(
                    variant,
                    format_args!(
                        "{length_m:.6} m, {} points, {half_spaces} half-spaces",
                        points.len()
                    ),
                );
                self.stage.lines("path/solved", &draw::segments(points), palette::ROUTE, 2.0);
                self.stage.plot("plan/length_m", length_m);
            }
            PlanEvent::Activated { face: [a, b, c] } => {
                self.say(variant, format_args!("a gate that was missed takes part"));
                self.gates.extend([[a, b], [b, c], [c, a]]);
                self.stage.lines("path/gates", &self.gates, palette::FRONTIER, 1.5);
            }
            PlanEvent::Separated { from, obstacle, distance_m } => {
                self.say(variant, format_args!("{distance_m:.4} m from an obstacle"));
                self.half_spaces.extend(draw::half_space(&from, &obstacle, self.radius_m));
                self.stage.lines("path/half_spaces", &self.half_spaces, white, 1.0);
            }
            PlanEvent::Verified { points, length_m } => {
                self.say(variant, format_args!("{length_m:.6} m, inside and clear"));
                self.stage.lines("path/verified", &draw::segments(points), palette::BEST, 3.0);
                self.stage.plot("plan/length_m", length_m);
            }
            PlanEvent::Blocked { at, clearance_m } => {
                self.say(variant, format_args!("too narrow: {clearance_m:.4} m"));
                self.stage.points("path/blocked", &[at], palette::GOAL, 8.0);
                self.begin();
            }
            PlanEvent::Finished { points, length_m } => {
                self.say(variant, format_args!("{length_m:.6} m, {} points", points.len()));
                self.stage.lines("path/verified", &draw::segments(points), palette::BEST, 4.0);
                self.result = format!(
                    "| | |\n|---|---|\n| path | {length_m:.6} m |\n| points | {} |\n",
                    points.len()
                );
            }
            PlanEvent::Unreachable { expansions } => {
                self.say(variant, format_args!("no way; {expansions} expansions"));
                self.draw_closed();
                self.result = format!("No way; {expansions} expansions.\n");
            }
        }
    }
}
