//! Losses, and the weights that callers give.

use pose::Se2;
use posegraph::initial::odometry;
use posegraph::{Factor, Loss, LossOn, Optimizer, Options, optimize, optimize_weighted};
use probe::Off;
use proptest::prelude::*;

use crate::oracle::{distance, graph};

fn losses(width: f64) -> [Loss; 6] {
    [
        Loss::None,
        Loss::Huber { width },
        Loss::Cauchy { width },
        Loss::GemanMcClure { width },
        Loss::Tls { width },
        Loss::Dcs { width },
    ]
}

proptest! {
    #[test]
    fn the_weight_is_the_derivative_of_the_cost(s in 0.01f64..100.0, width in 0.3f64..5.0) {
        for loss in losses(width) {
            // At its corner a loss has no derivative.
            prop_assume!((s - width * width).abs() > 1e-3);
            let h = 1e-6 * s;
            let slope = (loss.cost(s + h) - loss.cost(s - h)) / (2.0 * h);
            prop_assert!((slope - loss.weight(s)).abs() < 1e-6, "{loss:?} {slope}");
            prop_assert!(loss.weight(1e-9) > 1.0 - 1e-6 && loss.cost(0.0) == 0.0);
        }
    }
}

#[test]
fn losses_take_the_weight_from_a_wrong_closure() {
    let clean = graph::<Se2, 3>(21, 30, 90, 0.02);
    let start = odometry(&clean);
    let right = optimize(&clean, &start, &Options::default());
    let mut wrong = clean.clone();
    let far = Se2::new(8.0, -9.0, 2.0);
    wrong.factors.push(Factor { from: 3, to: 25, from_from_to: far, ..wrong.factors[0] });
    // From the clean solution: which losses find it from far away is another question.
    let plain = optimize(&wrong, &right.poses, &Options::default());
    let off = distance(&plain.poses, &right.poses);
    for loss in &losses(1.0)[1..] {
        let options = Options { loss: *loss, loss_on: LossOn::Closures, ..Options::default() };
        let solution = optimize(&wrong, &right.poses, &options);
        let weight = solution.weights.last().unwrap();
        assert!(*weight < 0.2, "{loss:?} {weight}");
        assert!(distance(&solution.poses, &right.poses) < 0.5 * off, "{loss:?}");
        assert!(solution.report.cost < solution.report.chi2);
    }
}

#[test]
fn a_factor_of_weight_zero_has_no_say() {
    let clean = graph::<Se2, 3>(22, 20, 10, 0.02);
    let start = odometry(&clean);
    let mut wrong = clean.clone();
    wrong.factors.push(Factor {
        from: 2,
        to: 17,
        from_from_to: Se2::new(30.0, 0.0, 1.0),
        ..wrong.factors[0]
    });
    let mut weights = vec![1.0; wrong.factors.len()];
    *weights.last_mut().unwrap() = 0.0;
    let options = Options { relative_decrease: 1e-14, ..Options::default() };
    let expected = optimize(&clean, &start, &options);
    let solution = optimize_weighted(&wrong, &start, &weights, &options, &mut Off);
    assert!(distance(&solution.poses, &expected.poses) < 1e-7);
    assert!((solution.report.cost - expected.report.cost).abs() < 1e-9);
    assert!(solution.report.chi2 > expected.report.chi2 + 1.0);
}

#[test]
fn an_optimizer_forgets_its_earlier_runs() {
    let graph = graph::<Se2, 3>(23, 40, 30, 0.05);
    let start = odometry(&graph);
    let options = Options::default();
    let weights: Vec<f64> =
        (0..graph.factors.len()).map(|index| 0.1 + (index % 7) as f64).collect();
    let mut optimizer = Optimizer::new(&graph, &options);
    let first = optimizer.run(&start, &[], &mut Off);
    let second = optimizer.run(&first.poses, &weights, &mut Off);
    let third = optimizer.run(&start, &[], &mut Off);
    assert_eq!(first, optimize(&graph, &start, &options));
    assert_eq!(second, optimize_weighted(&graph, &first.poses, &weights, &options, &mut Off));
    assert_eq!(third, first);
    assert!(distance(&second.poses, &first.poses) > 1e-6);
}
