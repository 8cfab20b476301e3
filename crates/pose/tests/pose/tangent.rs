//! Exponential and logarithm against the matrix exponential, and near their difficult angles.

use std::f64::consts::PI;

use pose::Se2;
use pose::nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

use crate::oracle::{assert_close, hat, matrix_exp, motion, tangent, turning_at_most};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn exp_is_the_exponential_of_the_matrix(xi in tangent()) {
        assert_close(&Matrix3::from(Se2::exp(&xi)), &matrix_exp(&hat(&xi)), 1e-13);
    }

    #[test]
    fn exp_winds_round(x in -5.0..5.0, y in -5.0..5.0, theta in -40.0f64..40.0) {
        let xi = Vector3::new(x, y, theta);
        assert_close(&Matrix3::from(Se2::exp(&xi)), &matrix_exp(&hat(&xi)), 1e-12);
    }

    #[test]
    fn the_matrix_exponential_of_log_is_the_motion(motion in motion()) {
        let xi = motion.log();
        assert_close(&matrix_exp(&hat(&xi)), &Matrix3::from(motion), 1e-13);
        prop_assert!((-PI..=PI).contains(&xi.z));
    }

    #[test]
    fn log_undoes_exp(xi in tangent()) {
        let xi = turning_at_most(xi, PI.next_down());
        assert_close(&Se2::exp(&xi).log(), &xi, 1e-13);
    }

    #[test]
    fn boxminus_undoes_boxplus(base in motion(), delta in tangent()) {
        let delta = turning_at_most(delta, PI - 1e-12);
        assert_close(&base.boxplus(&delta).boxminus(&base), &delta, 1e-12);
        let product = Matrix3::from(base) * matrix_exp(&hat(&delta));
        assert_close(&Matrix3::from(base.boxplus(&delta)), &product, 1e-12);
    }
}

#[test]
fn small_angles_of_both_signs_keep_all_digits() {
    for exponent in 1..=300 {
        for sign in [1.0, -1.0] {
            let theta = sign * 10f64.powi(-exponent);
            // The first terms of the series; from 1e-5 down the rest is below rounding.
            let sideways = theta / 2.0 - theta.powi(3) / 24.0 + theta.powi(5) / 720.0;
            let moved = Se2::exp(&Vector3::new(1.0, 0.0, theta));
            let error = (moved.translation.y - sideways) / sideways;
            assert!(error.abs() < if exponent == 1 { 1e-10 } else { 1e-14 }, "{theta:e} {error:e}");
            let back = moved.log();
            assert!((back.z - theta).abs() <= 1e-15 * theta.abs(), "{theta:e} {:e}", back.z);
            assert!(back.y.abs() <= 2e-16 * theta.abs(), "{theta:e} {:e}", back.y);
        }
    }
}

#[test]
fn a_negative_quarter_turn_is_not_taken_for_a_small_angle() {
    // A comparison of the angle itself, not of its size, with a limit passes every round trip.
    let moved = Se2::exp(&Vector3::new(PI, 0.0, -PI / 2.0));
    assert_close(&moved.translation, &[2.0, -2.0].into(), 1e-15);
    assert_close(&moved.log(), &Vector3::new(PI, 0.0, -PI / 2.0), 1e-15);
}

#[test]
fn half_a_turn_is_a_diameter() {
    for sign in [1.0, -1.0] {
        let half_turn = Se2::new(0.0, sign * 2.0, sign * PI);
        assert_close(&half_turn.log(), &Vector3::new(PI, 0.0, sign * PI), 1e-15);
    }
}

#[test]
fn zero_is_the_identity_and_its_sign_does_not_matter() {
    assert_eq!(Se2::exp(&Vector3::zeros()), Se2::identity());
    assert_eq!(Se2::exp(&-Vector3::<f64>::zeros()), Se2::identity());
    assert_eq!(Se2::identity().log(), Vector3::zeros());
}
