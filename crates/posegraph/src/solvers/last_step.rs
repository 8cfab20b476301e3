//! The last step without a factor of its own.
//!
//! Near a minimum the matrix hardly changes from one iteration to the next, and the last step is
//! tiny: it says that nothing is left to gain. Conjugate gradients on the matrix of this iteration,
//! preconditioned by the factor of the last one, find it in a few products and solves, each of which
//! costs a tenth of a factorisation or less (Nocedal and Wright 2006, algorithm 5.3).

use super::problem::Problem;
use super::state::{Promise, State};
use crate::factors::Manifold;
use crate::linear::dot;

/// Directions that are tried at most, and given up where their pace is too slow for so many: a
/// factor is cheaper then.
const DIRECTIONS: i32 = 4;

impl<P> State<P> {
    /// Solves for the step with the factor of an earlier matrix, until what is left to promise is
    /// estimated as no more than `rest`.
    ///
    /// `None` where the first estimate is above `most`, or the step would take too many directions. The
    /// matrix is undamped and the factor that of a matrix without damping.
    pub(super) fn by_last_factor<const D: usize>(
        &mut self,
        problem: &mut Problem<'_, P, D>,
        most: f64,
        rest: f64,
    ) -> Option<Promise>
    where
        P: Manifold<D>,
    {
        let mut residual: Vec<f64> = problem.gradient.iter().map(|entry| -entry).collect();
        let mut towards = residual.clone();
        problem.apply_factor(&mut towards);
        let mut left = dot(&residual, &towards);
        if left.is_nan() || left > most {
            return None;
        }
        self.step.clear();
        self.step.resize(residual.len(), 0.0);
        let mut direction = towards.clone();
        let mut product = Vec::new();
        if left == 0.0 {
            return Some(self.promise_of_step(problem, 0.0));
        }
        for tried in 1..=DIRECTIONS {
            problem.multiply(&direction, &mut product);
            let bend = dot(&direction, &product);
            if bend.is_nan() || bend <= 0.0 {
                return None;
            }
            let length = left / bend;
            for (at, step) in self.step.iter_mut().enumerate() {
                *step += length * direction[at];
                residual[at] -= length * product[at];
            }
            towards.clone_from(&residual);
            problem.apply_factor(&mut towards);
            let before = left;
            left = dot(&residual, &towards);
            if left <= rest {
                return Some(self.promise_of_step(problem, 0.0));
            }
            if left * (left / before).powi(DIRECTIONS - tried) > rest {
                return None;
            }
            for (direction, towards) in direction.iter_mut().zip(&towards) {
                *direction = towards + left / before * *direction;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use pose::Se2;
    use pose::nalgebra::Matrix3;

    use super::super::Options;
    use super::{Problem, State};
    use crate::factors::{Factor, FactorGraph};

    /// A ladder of poses with rungs, each measured a little wrong.
    fn ladder() -> FactorGraph<Se2, 3> {
        let count = 60;
        let wrong = |k: usize| ((k * 37 + 11) % 19) as f64 / 190.0 - 0.05;
        let factor = |from: usize, to: usize, x: f64, y: f64, turn: f64| Factor {
            from,
            to,
            from_from_to: Se2::new(x + wrong(from), y + wrong(to), turn + wrong(from + to) / 5.0),
            information: Matrix3::from_diagonal(&[100.0, 50.0, 400.0].into()),
        };
        let half = count / 2;
        let mut factors = Vec::new();
        for k in 0..count - 1 {
            let (x, y, turn) =
                if k + 1 == half { (1.0, 1.0, std::f64::consts::PI) } else { (1.0, 0.0, 0.0) };
            factors.push(factor(k, k + 1, x, y, turn));
        }
        for k in 0..half {
            factors.push(factor(k, count - 1 - k, 0.0, 1.0, std::f64::consts::PI));
        }
        FactorGraph {
            ids: (0..count as u64).collect(),
            initial: vec![None; count],
            fixed: Vec::new(),
            factors,
        }
    }

    /// What a step promises, and the step.
    type Step = (f64, Vec<f64>);

    /// Steps from poses near the minimum with the factor of poses moved by `apart`, and with their own.
    fn steps(apart: f64, most: f64, rest: f64) -> (Option<Step>, Step) {
        let graph = ladder();
        let options = Options::default();
        let solution = crate::optimize(&graph, &crate::initial::odometry(&graph), &options);
        let mut problem = Problem::new(&graph, &options);
        problem.weigh(&[]);
        let mut state = State {
            poses: Vec::new(),
            cost: 0.0,
            step: Vec::new(),
            trial: Vec::new(),
            iterations: Vec::new(),
        };
        let moved = |by: f64| -> Vec<Se2> {
            let turn = |k: usize| by * ((k * 29 % 13) as f64 - 6.0);
            let poses = solution.poses.iter().enumerate();
            poses.map(|(k, pose)| *pose * Se2::new(turn(k), turn(k + 1), turn(k + 2))).collect()
        };
        problem.linearize(&moved(apart));
        problem.factorize(0.0).expect("a ladder has no loose end");
        problem.linearize(&moved(1e-6));
        let found = state.by_last_factor(&mut problem, most, rest);
        let found = found.map(|promise| (promise.decrease, state.step.clone()));
        let full = state.promise(&mut problem, 0.0).expect("a ladder has no loose end");
        (found, (full.decrease, state.step))
    }

    #[test]
    fn a_near_factor_gives_the_step_that_an_own_one_gives() {
        let (found, (decrease, step)) = steps(1e-4, 1.0, 1e-16);
        let (promised, found) = found.expect("the matrix hardly changes");
        assert!((promised / decrease - 1.0).abs() < 1e-6, "{promised:e} of {decrease:e}");
        let longest = step.iter().fold(0.0f64, |most, entry| most.max(entry.abs()));
        for (found, entry) in found.iter().zip(&step) {
            assert!((found - entry).abs() < 1e-3 * longest, "{found:e} for {entry:e}");
        }
    }

    #[test]
    fn it_is_given_up_where_much_is_left_or_the_factor_is_far() {
        let (_, (decrease, _)) = steps(1e-4, 1.0, 1e-16);
        assert!(decrease > 0.0);
        assert_eq!(steps(1e-4, 0.5 * decrease, 1e-16).0, None);
        assert_eq!(steps(0.2, f64::INFINITY, 1e-25).0, None);
    }
}
