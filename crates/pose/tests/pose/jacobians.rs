//! Every Jacobian against central differences; the adjoint also against conjugation.

use pose::Se2;
use pose::nalgebra::{Matrix3, Point2, Vector2, Vector3};
use proptest::prelude::*;

use crate::oracle::{assert_close, central, hat, matrix_exp, motion, tangent, turning_at_most};

/// Differences with a step of 1e-5 are good to about 1e-10 for numbers of this size.
const TOLERANCE: f64 = 2e-9;

fn point() -> impl Strategy<Value = Point2<f64>> {
    (-10.0..10.0, -10.0..10.0).prop_map(|(x, y)| Point2::new(x, y))
}

proptest! {
    #[test]
    fn the_adjoint_is_conjugation(a in motion(), delta in tangent()) {
        let matrix = Matrix3::from(a);
        let inverse = matrix.try_inverse().expect("a motion has an inverse");
        let carried = hat(&(a.adjoint() * delta));
        assert_close(&carried, &(matrix * hat(&delta) * inverse), 1e-13);
        let conjugated = matrix * matrix_exp(&hat(&delta)) * inverse;
        assert_close(&Matrix3::from(Se2::exp(&(a.adjoint() * delta))), &conjugated, 1e-12);
    }

    #[test]
    fn the_adjoint_respects_products_and_inverses(a in motion(), b in motion()) {
        assert_close(&(a * b).adjoint(), &(a.adjoint() * b.adjoint()), 1e-13);
        assert_close(&(a.inverse().adjoint() * a.adjoint()), &Matrix3::identity(), 1e-13);
    }

    #[test]
    fn the_jacobians_of_exp_are_its_derivatives(xi in tangent()) {
        let at = Se2::exp(&xi);
        let right = central(|delta| at.inverse_mul(&Se2::exp(&(xi + delta))).log());
        assert_close(&Se2::right_jacobian(&xi), &right, TOLERANCE);
        let left = central(|delta| (Se2::exp(&(xi + delta)) * at.inverse()).log());
        assert_close(&Se2::left_jacobian(&xi), &left, TOLERANCE);
    }

    #[test]
    fn left_is_adjoint_times_right(xi in tangent()) {
        let product = Se2::exp(&xi).adjoint() * Se2::right_jacobian(&xi);
        assert_close(&Se2::left_jacobian(&xi), &product, 1e-14);
    }

    #[test]
    fn the_inverse_jacobians_are_inverses(xi in tangent()) {
        let right = Se2::right_jacobian(&xi) * Se2::right_jacobian_inverse(&xi);
        assert_close(&right, &Matrix3::identity(), 1e-13);
        let left = Se2::left_jacobian_inverse(&xi) * Se2::left_jacobian(&xi);
        assert_close(&left, &Matrix3::identity(), 1e-13);
    }

    #[test]
    fn the_left_jacobian_is_its_series(
        x in -9.0f64..9.0, y in -9.0f64..9.0, theta in -2.0f64..2.0,
    ) {
        // Jl(ξ) is the sum of ad(ξ)^k / (k + 1)!, with ad the adjoint of the algebra.
        let ad = Matrix3::new(0.0, -theta, y, theta, 0.0, -x, 0.0, 0.0, 0.0);
        let mut term = Matrix3::identity();
        let mut sum = term;
        for k in 1..30 {
            term = term * ad / f64::from(k + 1);
            sum += term;
        }
        assert_close(&Se2::left_jacobian(&Vector3::new(x, y, theta)), &sum, 1e-14);
    }

    #[test]
    fn the_derivatives_of_the_group_are_right(a in motion(), b in motion()) {
        let (by_a, by_b) = a.compose_jacobians(&b);
        assert_close(&by_a, &central(|d| (a.boxplus(&d) * b).boxminus(&(a * b))), TOLERANCE);
        assert_close(&by_b, &central(|d| (a * b.boxplus(&d)).boxminus(&(a * b))), TOLERANCE);

        let inverse = central(|d| a.boxplus(&d).inverse().boxminus(&a.inverse()));
        assert_close(&a.inverse_jacobian(), &inverse, TOLERANCE);

        let (by_a, by_b) = a.inverse_mul_jacobians(&b);
        let between = a.inverse_mul(&b);
        let expected = central(|d| a.boxplus(&d).inverse_mul(&b).boxminus(&between));
        assert_close(&by_a, &expected, TOLERANCE);
        let expected = central(|d| a.inverse_mul(&b.boxplus(&d)).boxminus(&between));
        assert_close(&by_b, &expected, TOLERANCE);
    }

    #[test]
    fn the_derivatives_of_differences_are_right(base in motion(), xi in tangent()) {
        // At half a turn the logarithm jumps, and differences across the jump mean nothing.
        let xi = turning_at_most(xi, 3.1);
        let end = base.boxplus(&xi);
        let (by_end, by_base) = end.boxminus_jacobians(&base);
        assert_close(&by_end, &central(|d| end.boxplus(&d).boxminus(&base)), TOLERANCE);
        assert_close(&by_base, &central(|d| end.boxminus(&base.boxplus(&d))), TOLERANCE);
    }

    #[test]
    fn the_derivatives_of_moved_points_are_right(a in motion(), p in point()) {
        let (by_motion, by_point) = a.transform_jacobians(&p);
        let expected = central(|d: Vector3<f64>| a.boxplus(&d).transform(&p).coords);
        assert_close(&by_motion, &expected, TOLERANCE);
        let expected = central(|d: Vector2<f64>| a.transform(&(p + d)).coords);
        assert_close(&by_point, &expected, TOLERANCE);

        let (by_motion, by_point) = a.inverse_transform_jacobians(&p);
        let expected = central(|d: Vector3<f64>| a.boxplus(&d).inverse_transform(&p).coords);
        assert_close(&by_motion, &expected, TOLERANCE);
        let expected = central(|d: Vector2<f64>| a.inverse_transform(&(p + d)).coords);
        assert_close(&by_point, &expected, TOLERANCE);
    }
}

#[test]
fn the_left_jacobian_keeps_its_digits_where_series_and_formula_meet() {
    // Just on either side of the limit the two ways of summing must agree.
    let xi = |theta| Vector3::new(1.0, 0.0, theta);
    for sign in [1.0, -1.0] {
        let series = Se2::left_jacobian(&xi(sign * 0.5f64.next_down()));
        let formula = Se2::left_jacobian(&xi(sign * 0.5));
        assert_close(&series, &formula, 1e-15);
    }
    // Far below the limit only the first term counts.
    let tiny = Se2::left_jacobian(&xi(-1e-9));
    let error = (tiny[(0, 2)] + 1e-9 / 6.0) / 1e-9;
    assert!(error.abs() < 1e-15, "{error:e}");
}
