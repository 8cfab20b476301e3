//! Where the beliefs of several maps first disagree about a frontier, and why.
//!
//! Maps disagree all the time about the edge of what was just seen: a cell is unknown until it is seen
//! whole, a polygon is cut through it. That is harmless. What ends a run too early is a map that claims
//! to know what nobody has ever seen. So the first disagreement of each cause is told.

use geometry::Point2;
use maps2d::{Candidate, ExplorationMap};
use metrics::Witness;
use serde::Serialize;

use explore::StepReport;

/// How far behind a frontier the other map is asked, metres: beyond a cell that is half seen, which a
/// polygon knows a part of and a grid does not.
const BEHIND_M: f64 = 2.0;

/// Frontier shorter than this is nobody's quarrel, metres.
const LEAST_M: f64 = 0.9;

/// Two maps that were fed the same, and one of which says "unknown" where the other says "known".
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Disagreement {
    /// Step of the loop.
    pub step: u64,
    /// Distance driven until then, metres.
    pub distance_m: f64,
    /// The map that sees a frontier.
    pub open_in: &'static str,
    /// The map that believes to know what lies behind it.
    pub known_in: &'static str,
    /// The middle of the frontier where it truly is, world frame, metres.
    pub frontier_x_m: f64,
    /// The same, northwards.
    pub frontier_y_m: f64,
    /// Its length, metres.
    pub length_m: f64,
    /// The same place as the robot sees it, body frame, metres; for drawing.
    #[serde(skip)]
    pub frontier_in_body: Point2,
    /// `drift`: what lies behind was never truly seen, so the map that claims to know it has laid
    /// another place over it. `not_consolidated`: it was seen, from a place that is not near in the
    /// graph of the map with the frontier. `resolution`: it was seen, but not well enough for that map:
    /// a cell counts once it was seen whole.
    pub cause: &'static str,
}

/// How many causes there are.
pub const CAUSES: usize = 3;

impl Disagreement {
    /// What to write beside its mark.
    pub fn label(&self) -> &'static str {
        match self.cause {
            "drift" => "first disagreement by drift",
            "resolution" => "first disagreement by resolution",
            _ => "first frontier not consolidated",
        }
    }

    /// Who says what, and why, in a line.
    pub fn in_words(&self) -> String {
        let Self { open_in, known_in, step, frontier_x_m, frontier_y_m, length_m, .. } = self;
        let why = match self.cause {
            "drift" => "what lies behind was never seen: drift has laid another place over it",
            "resolution" => "what lies behind was seen, but not so well that both count it",
            _ => "what lies behind was seen, from a place that is not near in the graph",
        };
        format!(
            "step {step}: {open_in} sees {length_m:.1} m of frontier at ({frontier_x_m:.1}, \
             {frontier_y_m:.1}), {known_in} believes to know what lies behind; {why}"
        )
    }
}

/// The first frontier in view of any map behind which another map knows something, for a cause that
/// was not told before.
///
/// Cost: the frontiers in view, times the maps.
pub fn disagreement(
    step: u64,
    report: &StepReport,
    names: &[&'static str],
    maps: &mut [Box<dyn ExplorationMap + Send>],
    witness: &Witness,
    told: &[Disagreement],
) -> Option<Disagreement> {
    let standing = report.standing;
    let mut seen: Vec<Candidate> = Vec::new();
    for open in 0..maps.len() {
        maps[open].in_view(&standing, &mut seen);
        for candidate in seen.iter().filter(|c| !c.turn_only && c.length_m >= LEAST_M) {
            let goal = candidate.goals_in_body[0];
            let ahead = goal.coords.try_normalize(0.0);
            let normal = Some(candidate.normal_in_body).filter(|n| n.norm_squared() > 0.0);
            let Some(normal) = normal.or(ahead) else { continue };
            let behind = goal + normal * BEHIND_M;
            let others = (0..maps.len()).filter(|&other| other != open);
            // Cells and polygons end at different places: the map itself has to be sure.
            if maps[open].knows(&standing, &behind) {
                continue;
            }
            let places = [0.75, 1.0, 1.25].map(|k| goal + normal * (k * BEHIND_M));
            let known = others
                .into_iter()
                .find(|&other| places.iter().all(|place| maps[other].knows(&standing, place)));
            let Some(known) = known else { continue };
            let world_from_body = witness.world_from_body();
            let frontier = world_from_body.transform(&goal);
            let seen = |place: &Point2| is_seen(witness, &world_from_body.transform(place));
            let cause = match places.iter().any(seen) {
                false => "drift",
                true if matches!(names[open], "relative" | "extended") => "not_consolidated",
                true => "resolution",
            };
            if told.iter().any(|before| before.cause == cause) {
                continue;
            }
            return Some(Disagreement {
                step,
                distance_m: witness.tally().distance_m,
                open_in: names[open],
                known_in: names[known],
                frontier_x_m: frontier.x,
                frontier_y_m: frontier.y,
                length_m: candidate.length_m,
                frontier_in_body: goal,
                cause,
            });
        }
    }
    None
}

/// Whether the place was truly seen so far.
fn is_seen(witness: &Witness, point_in_world: &Point2) -> bool {
    let coverage = witness.coverage();
    let (origin, _) = witness.robot().world().bounds();
    let (columns, rows) = coverage.size();
    let side_m = coverage.cell_m();
    let x = (point_in_world.x - origin.x) / side_m.x;
    let y = (point_in_world.y - origin.y) / side_m.y;
    let within = x >= 0.0 && y >= 0.0 && x < columns as f64 && y < rows as f64;
    within && coverage.first_seen_m(y as usize * columns + x as usize).is_some()
}
