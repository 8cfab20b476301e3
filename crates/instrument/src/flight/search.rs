//! Ways through tetrahedra: the dual graph, what A* closed, the corridor, the cone programmes.

use geometry::Point3;
use maps3d::PlanEvent;
use pose::Se3;

use super::ink::{Ink, dots, placed};
use crate::columns::{Rgba, rgb};
use crate::palette;
use crate::plan::draw;

/// What was closed is drawn, and told, again when it grew by this factor: searches come by the dozen here, and one
/// alone is stepped node by node by `driftlab mesh plan`.
const GROWTH: f64 = 2.0;

/// What is drawn of one search; all of it goes with the next.
const PARTS: [&str; 9] =
    ["ends", "closed", "node", "corridor", "way", "solved", "gates", "half_spaces", "path"];

/// The searches of one map, drawn under an entity of their own.
pub(super) struct Searches {
    entity: &'static str,
    corners: Vec<[Point3; 4]>,
    /// Legs to the nodes that were expanded.
    closed: Vec<[Point3; 2]>,
    opened: usize,
    expanded: usize,
    /// The number of expansions at which what was closed is drawn next.
    next: usize,
    gates: Vec<[Point3; 2]>,
    half_spaces: Vec<[Point3; 2]>,
    drawn: bool,
}

impl Searches {
    /// In the global frame of a map, or round the vertex where the robot hovers.
    pub(super) fn new(around_robot: bool) -> Self {
        Self {
            entity: if around_robot { "belief/search" } else { "belief/union/search" },
            corners: Vec::new(),
            closed: Vec::new(),
            opened: 0,
            expanded: 0,
            next: 1,
            gates: Vec::new(),
            half_spaces: Vec::new(),
            drawn: false,
        }
    }

    /// Takes the drawings of the step before away.
    pub(super) fn wipe(&mut self, ink: &mut Ink) {
        // What is searched next may be another space, of which nothing was told.
        self.corners.clear();
        if std::mem::take(&mut self.drawn) {
            for part in ["tetrahedra", "graph", "goals"].iter().chain(&PARTS) {
                ink.draw(&format!("{}/{part}", self.entity), &rerun::Clear::flat());
            }
        }
    }

    /// Where the frame of the points lies in the one that is drawn, from now on.
    pub(super) fn place(&self, ink: &mut Ink, drawn_from_vertex: &Se3) {
        ink.draw(self.entity, &placed(drawn_from_vertex));
    }

    fn draw(&self, ink: &mut Ink, part: &str, segments: &[[Point3; 2]], colour: Rgba, points: f32) {
        ink.draw(
            &format!("{}/{part}", self.entity),
            &super::ink::segments(segments, colour, points),
        );
    }

    fn points(&self, ink: &mut Ink, part: &str, at: &[Point3], colour: Rgba, size: f32) {
        ink.draw(&format!("{}/{part}", self.entity), &dots(at, &[colour], size));
    }

    /// Nothing is opened or closed yet, and no polyline is known.
    fn begin(&mut self) {
        (self.opened, self.expanded, self.next) = (0, 0, 1);
        self.closed.clear();
        self.gates.clear();
        self.half_spaces.clear();
    }

    /// Counts an event; false where it is told with later ones of its kind.
    pub(super) fn count(&mut self, event: &PlanEvent<'_>) -> bool {
        match event {
            // The first of a search stands for all: how many there are is told with the expansions.
            PlanEvent::Opened { .. } => {
                self.opened += 1;
                self.opened == 1
            }
            PlanEvent::Expanded { at, before, .. } => {
                self.expanded += 1;
                self.closed.extend(before.map(|before| [before, *at]));
                self.expanded >= self.next
            }
            _ => true,
        }
    }

    /// Draws what a counted event is about, and gives the line of text that goes with it.
    pub(super) fn tell(&mut self, ink: &mut Ink, event: &PlanEvent<'_>) -> String {
        self.drawn = true;
        let white = rgb(255, 255, 255);
        match event {
            PlanEvent::Joined { space, graph } => {
                self.corners = draw::corners(space);
                self.draw(ink, "tetrahedra", &draw::edges(&self.corners), rgb(70, 74, 95), 0.4);
                self.draw(ink, "graph", &draw::legs(graph), rgb(50, 90, 150), 0.4);
                self.points(ink, "goals", &draw::goals(graph), palette::FRONTIER, 2.5);
                format!(
                    "{} tetrahedra, {} frontier points, {} legs",
                    space.len(),
                    graph.frontier().len(),
                    graph.edge_count()
                )
            }
            PlanEvent::Located { from, to, tetrahedron } => {
                for part in PARTS {
                    ink.draw(&format!("{}/{part}", self.entity), &rerun::Clear::flat());
                }
                self.begin();
                let ends: Vec<Point3> = [Some(*from), *to].into_iter().flatten().collect();
                self.points(ink, "ends", &ends, palette::GOAL, 5.0);
                format!("the start is in tetrahedron {tetrahedron}")
            }
            PlanEvent::Opened { cost, .. } => format!("the first node, {cost:.2}"),
            PlanEvent::Expanded { at, cost, estimate, .. } => {
                self.next = (self.expanded as f64 * GROWTH).ceil() as usize;
                self.draw(ink, "closed", &self.closed, palette::BEST, 1.0);
                self.points(ink, "node", &[*at], white, 4.0);
                format!(
                    "{} closed, {} opened; {cost:.2} and at least {estimate:.2} to go",
                    self.expanded, self.opened
                )
            }
            PlanEvent::Routed { points, corridor, cost, expansions } => {
                self.draw(ink, "closed", &self.closed, palette::BEST, 1.0);
                self.draw(ink, "way", &draw::segments(points), palette::GIVEN_UP, 1.5);
                let passed = corridor.iter().filter_map(|&t| self.corners.get(t as usize));
                self.draw(ink, "corridor", &draw::edges(passed), rgb(150, 150, 165), 0.7);
                let tetrahedra = corridor.len();
                self.begin();
                format!("{cost:.2} m through {tetrahedra} tetrahedra, {expansions} expansions")
            }
            PlanEvent::Solved { points, length_m, half_spaces } => {
                self.draw(ink, "solved", &draw::segments(points), palette::ROUTE, 1.5);
                format!("{length_m:.3} m, {half_spaces} half-spaces")
            }
            PlanEvent::Activated { face: [a, b, c] } => {
                self.gates.extend([[*a, *b], [*b, *c], [*c, *a]]);
                self.draw(ink, "gates", &self.gates, palette::FRONTIER, 1.2);
                "a gate that was missed takes part".to_owned()
            }
            PlanEvent::Separated { from, obstacle, distance_m } => {
                // The square stands where the point was: the radius is not told, its own distance is.
                let radius_m = (from - obstacle).norm();
                self.half_spaces.extend(draw::half_space(from, obstacle, radius_m));
                self.draw(ink, "half_spaces", &self.half_spaces, white, 0.8);
                format!("{distance_m:.3} m from an obstacle")
            }
            PlanEvent::Verified { points, length_m } => {
                self.draw(ink, "path", &draw::segments(points), palette::BEST, 2.5);
                format!("{length_m:.3} m, inside and clear")
            }
            PlanEvent::Blocked { at, clearance_m } => {
                self.points(ink, "node", &[*at], palette::GOAL, 6.0);
                self.begin();
                format!("too narrow: {clearance_m:.3} m")
            }
            PlanEvent::Finished { points, length_m } => {
                self.draw(ink, "path", &draw::segments(points), palette::BEST, 3.0);
                format!("{length_m:.3} m, {} points", points.len())
            }
            PlanEvent::Unreachable { expansions } => {
                self.draw(ink, "closed", &self.closed, palette::BEST, 1.0);
                format!("no way; {expansions} expansions")
            }
        }
    }
}
