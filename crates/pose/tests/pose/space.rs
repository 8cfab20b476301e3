//! SE(3) and SO(3): the group, exponential and logarithm, and every Jacobian.

use pose::nalgebra::{Matrix3, Matrix4, Matrix6, Point3, SVector, Vector3, Vector6};
use pose::{Se3, So3};
use proptest::prelude::*;

use crate::oracle::{angle, assert_close, central, matrix_exp};

/// The matrix of a tangent vector, by definition of the order of its entries.
fn hat(xi: &Vector6<f64>) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&cross(&xi.fixed_rows::<3>(3).into_owned()));
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&xi.fixed_rows::<3>(0));
    matrix
}

/// The matrix of a cross product, column by column.
fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[v.cross(&Vector3::x()), v.cross(&Vector3::y()), v.cross(&Vector3::z())])
}

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0)
        .prop_filter_map("too short", |(x, y, z)| Vector3::new(x, y, z).try_normalize(1e-3))
}

/// Rotation vectors of all lengths up to half a turn.
fn turn() -> impl Strategy<Value = Vector3<f64>> {
    (direction(), angle()).prop_map(|(direction, angle)| direction * angle)
}

fn tangent() -> impl Strategy<Value = Vector6<f64>> {
    (-10.0..10.0, -10.0..10.0, -10.0..10.0, turn())
        .prop_map(|(x, y, z, turn)| Vector6::new(x, y, z, turn.x, turn.y, turn.z))
}

fn motion() -> impl Strategy<Value = Se3> {
    tangent().prop_map(|xi| Se3::new(xi.fixed_rows::<3>(0).into_owned(), So3::exp(&part(&xi))))
}

fn part(xi: &Vector6<f64>) -> Vector3<f64> {
    xi.fixed_rows::<3>(3).into_owned()
}

fn matrix(motion: Se3) -> Matrix4<f64> {
    motion.into()
}

/// A tangent vector with a turn of at most `limit_rad`.
fn at_most(xi: &Vector6<f64>, limit_rad: f64) -> Vector6<f64> {
    let turn = part(xi);
    let scale = if turn.norm() > limit_rad { limit_rad / turn.norm() } else { 1.0 };
    Vector6::new(xi.x, xi.y, xi.z, turn.x * scale, turn.y * scale, turn.z * scale)
}

proptest! {
    #[test]
    fn the_exponential_is_that_of_the_matrix(xi in tangent()) {
        assert_close(&matrix(Se3::exp(&xi)), &matrix_exp(&hat(&xi)), 2e-13);
    }

    #[test]
    fn the_logarithm_undoes_the_exponential(xi in tangent()) {
        let xi = at_most(&xi, 3.1);
        assert_close(&Se3::exp(&xi).log(), &xi, 1e-12);
    }

    #[test]
    fn the_exponential_undoes_the_logarithm(motion in motion()) {
        prop_assert!(part(&motion.log()).norm() <= std::f64::consts::PI + 1e-15);
        assert_close(&matrix(Se3::exp(&motion.log())), &matrix(motion), 2e-12);
    }

    #[test]
    fn products_and_inverses_are_those_of_matrices(a in motion(), b in motion(), c in motion()) {
        assert_close(&matrix(a * b), &(matrix(a) * matrix(b)), 1e-13);
        assert_close(&(matrix(a) * matrix(a.inverse())), &Matrix4::identity(), 1e-13);
        assert_close(&matrix(a.inverse_mul(&b)), &(matrix(a.inverse()) * matrix(b)), 1e-13);
        assert_close(&matrix((a * b) * c), &matrix(a * (b * c)), 1e-13);
        assert_close(&matrix(a * Se3::identity()), &matrix(a), 1e-15);
        let point = Point3::new(1.0, -2.0, 0.5);
        prop_assert!((a.inverse_transform(&a.transform(&point)) - point).norm() < 1e-13);
    }

    #[test]
    fn long_products_stay_rotations(a in motion()) {
        let product = (0..1000).fold(Se3::identity(), |product, _| product * a);
        prop_assert!((product.rotation.into_inner().norm() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_adjoint_carries_a_perturbation_to_the_left(motion in motion(), xi in tangent()) {
        let left = matrix(motion) * hat(&xi) * matrix(motion.inverse());
        assert_close(&hat(&(motion.adjoint() * xi)), &left, 1e-12);
    }

    #[test]
    fn jacobians_of_the_exponential_are_its_derivatives(xi in tangent()) {
        let right = central(|delta: Vector6<f64>| Se3::exp(&(xi + delta)).boxminus(&Se3::exp(&xi)));
        assert_close(&Se3::right_jacobian(&xi), &right, 1e-8);
        assert_close(&(Se3::exp(&xi).adjoint() * Se3::right_jacobian(&xi)),
            &Se3::left_jacobian(&xi), 1e-12);
    }

    #[test]
    fn inverse_jacobians_are_inverses(xi in tangent()) {
        assert_close(&(Se3::right_jacobian_inverse(&xi) * Se3::right_jacobian(&xi)),
            &Matrix6::identity(), 1e-11);
        assert_close(&(Se3::left_jacobian(&xi) * Se3::left_jacobian_inverse(&xi)),
            &Matrix6::identity(), 1e-11);
        let turn = part(&xi);
        assert_close(&(So3::left_jacobian(&turn) * So3::left_jacobian_inverse(&turn)),
            &Matrix3::identity(), 1e-12);
        assert_close(&(So3::right_jacobian_inverse(&turn) * So3::right_jacobian(&turn)),
            &Matrix3::identity(), 1e-12);
    }

    #[test]
    fn jacobians_of_the_operations_are_their_derivatives(a in motion(), b in motion()) {
        let (by_a, by_b) = a.compose_jacobians(&b);
        assert_close(&by_a, &central(|d: Vector6<f64>| (a.boxplus(&d) * b).boxminus(&(a * b))), 1e-7);
        assert_close(&by_b, &central(|d: Vector6<f64>| (a * b.boxplus(&d)).boxminus(&(a * b))), 1e-7);
        assert_close(&a.inverse_jacobian(),
            &central(|d: Vector6<f64>| a.boxplus(&d).inverse().boxminus(&a.inverse())), 1e-7);
        let (by_a, by_b) = a.inverse_mul_jacobians(&b);
        let between = a.inverse_mul(&b);
        assert_close(&by_a,
            &central(|d: Vector6<f64>| a.boxplus(&d).inverse_mul(&b).boxminus(&between)), 1e-7);
        assert_close(&by_b,
            &central(|d: Vector6<f64>| a.inverse_mul(&b.boxplus(&d)).boxminus(&between)), 1e-7);
        let point = Point3::new(1.5, -0.5, 2.0);
        let (by_motion, by_point) = a.transform_jacobians(&point);
        assert_close(&by_motion,
            &central(|d: Vector6<f64>| a.boxplus(&d).transform(&point).coords), 1e-7);
        assert_close(&by_point,
            &central(|d: SVector<f64, 3>| a.transform(&(point + d)).coords), 1e-7);
    }

    #[test]
    fn jacobians_of_the_difference_are_its_derivatives(base in motion(), xi in tangent()) {
        let motion = base.boxplus(&at_most(&xi, 2.8));
        let (by_motion, by_base) = motion.boxminus_jacobians(&base);
        assert_close(&by_motion,
            &central(|d: Vector6<f64>| motion.boxplus(&d).boxminus(&base)), 1e-7);
        assert_close(&by_base,
            &central(|d: Vector6<f64>| motion.boxminus(&base.boxplus(&d))), 1e-7);
    }
}

#[test]
fn the_two_quaternions_of_a_rotation_have_one_logarithm() {
    let rotation = So3::exp(&Vector3::new(0.3, -1.0, 2.0));
    let other = -rotation.into_inner();
    let other = pose::nalgebra::UnitQuaternion::new_unchecked(other);
    assert!((So3::log(&rotation) - So3::log(&other)).norm() < 1e-15);
}

#[test]
fn coefficients_meet_where_the_series_ends() {
    for at in [0.25, 1.5] {
        let below = Vector6::new(1.0, -2.0, 3.0, at - 1e-14, 0.0, 0.0);
        let above = Vector6::new(1.0, -2.0, 3.0, at, 0.0, 0.0);
        assert_close(&Se3::left_jacobian(&below), &Se3::left_jacobian(&above), 2e-13);
        assert_close(&Se3::exp(&below).log(), &below, 1e-13);
        assert_close(&Se3::exp(&above).log(), &above, 1e-13);
    }
}
