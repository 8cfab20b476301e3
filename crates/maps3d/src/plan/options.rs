//! What a planner can be asked for.

use solid::Point3;

use crate::Maps3dError;

/// How the dual graph is searched (\[Mos15\] 4.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Algorithm {
    /// By the number of legs.
    Breadth,
    /// Down the node of the least number first; the path is as it comes.
    Depth,
    /// By cost.
    Dijkstra,
    /// By cost and what is left at least.
    #[default]
    Astar,
}

/// What A* takes for the cost that is left at least.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heuristic {
    /// Nothing: A* is Dijkstra's search then.
    Zero,
    /// The straight distance to the goal, or to the frontier point next to the node.
    Euclidean,
    /// The sum of the three differences of coordinates, over the square root of 3.
    ///
    /// The sum alone exceeds the straight distance by up to that factor, so that it would not be
    /// admissible where legs are measured straight, and the path need not be the shortest. Divided it
    /// never exceeds the straight distance.
    Manhattan,
    /// To a point: the straight distance, or what the costs from a few far nodes tell, whichever is more.
    /// These costs are found out once for a map. To frontier: the straight distance.
    #[default]
    Landmarks,
}

/// Where to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// To a point, in the frame of the space.
    Point(Point3),
    /// To the frontier point that is nearest along the graph.
    Frontier,
}

/// Options of a planner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanOptions {
    /// The robot is a ball of this radius, metres; paths keep this from obstacle faces.
    pub radius_m: f64,
    /// Points of a frontier face lie no farther apart than this, metres.
    pub spacing_m: f64,
    /// Smaller frontier faces are no goals, square metres.
    pub least_area_m2: f64,
    /// How the graph is searched.
    pub algorithm: Algorithm,
    /// What A* goes by.
    pub heuristic: Heuristic,
    /// Only legs that keep the radius themselves are gone. Fewer ways are found, and none of them is refused
    /// later: for volumes that reach into each other's obstacles. Else a gate is passed where a ball fits
    /// somewhere on it.
    pub clear_legs: bool,
    /// Whether the path is shortened.
    pub shorten: bool,
    /// How many corridors are tried where one turns out too narrow for the radius.
    pub tries: usize,
}

impl Default for PlanOptions {
    fn default() -> Self {
        Self {
            radius_m: 0.0,
            spacing_m: 1.0,
            least_area_m2: 0.0,
            algorithm: Algorithm::default(),
            heuristic: Heuristic::default(),
            clear_legs: false,
            shorten: true,
            tries: 16,
        }
    }
}

impl PlanOptions {
    /// Checks what can be told without a map.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for what is out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        let wrong = |option, found, expected| Err(Maps3dError::Option { option, found, expected });
        if !(self.radius_m >= 0.0 && self.radius_m.is_finite()) {
            return wrong("radius_m", self.radius_m, "metres from 0");
        }
        if !(self.spacing_m >= 1e-3 && self.spacing_m.is_finite()) {
            return wrong("spacing_m", self.spacing_m, "metres from 0.001");
        }
        if !(self.least_area_m2 >= 0.0 && self.least_area_m2.is_finite()) {
            return wrong("least_area_m2", self.least_area_m2, "square metres from 0");
        }
        if self.tries == 0 {
            return wrong("tries", 0.0, "at least 1");
        }
        Ok(())
    }
}
