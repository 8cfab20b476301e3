//! Every error of every convention: its value against matrices, its Jacobians against differences.

use pose::nalgebra::{Matrix3, Matrix4, Rotation3, SMatrix, UnitQuaternion};
use pose::{Se2, Se3};
use posegraph::{ErrorKind, Manifold};
use proptest::prelude::*;

use crate::oracle::{Draw, Drawn, KINDS, central};

/// A measurement and two poses that agree with it but for a discrepancy of this size.
fn drawn<P: Drawn<D>, const D: usize>(seed: u64, size: f64) -> (P, P, P) {
    let draw = &mut Draw(seed);
    let (from, measured) = (P::drawn(draw, 5.0, 3.0), P::drawn(draw, 5.0, 3.0));
    let to = from.compose(&measured).compose(&P::drawn(draw, size, size));
    (measured, from, to)
}

fn hold_jacobians<P: Drawn<D>, const D: usize>(seed: u64, size: f64) {
    let (measured, from, to) = drawn::<P, D>(seed, size);
    for kind in KINDS {
        let linear = P::linearize(kind, &measured, &from, &to);
        let error = P::error(kind, &measured, &from, &to);
        assert!((linear.error - error).amax() < 1e-14, "{kind:?}");
        let by_from = central(|d| P::error(kind, &measured, &from.retract(&d), &to));
        let by_to = central(|d| P::error(kind, &measured, &from, &to.retract(&d)));
        let scale = 1.0 + by_from.amax();
        assert!((linear.by_from - by_from).amax() < 1e-8 * scale, "{kind:?} {by_from}");
        assert!((linear.by_to - by_to).amax() < 1e-8 * scale, "{kind:?} {by_to}");
        // A step of `from` is a step of `to` the other way, carried over by the adjoint.
        let carried = -linear.by_to * to.between(&from).adjoint();
        assert!((linear.by_from - carried).amax() < 1e-12 * scale, "{kind:?}");
    }
}

proptest! {
    #[test]
    fn jacobians_of_the_plane_are_derivatives(seed: u64, size in 0.0..2.5) {
        hold_jacobians::<Se2, 3>(seed, size);
    }

    #[test]
    fn jacobians_of_space_are_derivatives(seed: u64, size in 0.0..2.5) {
        hold_jacobians::<Se3, 6>(seed, size);
    }

    #[test]
    fn normal_blocks_are_products_of_jacobians(seed: u64, size in 0.0..2.5) {
        let (measured, from, to) = drawn::<Se3, 6>(seed, size);
        let information = Draw(!seed).information::<6>();
        for kind in KINDS {
            let linear = Se3::linearize(kind, &measured, &from, &to);
            let blocks = Se3::normal_blocks(&linear, &information);
            let (a, b) = (linear.by_from, linear.by_to);
            let scale = 1e-12 * (1.0 + information.amax()) * (1.0 + a.amax()).powi(2);
            prop_assert!((blocks.from_from - a.transpose() * information * a).amax() < scale);
            prop_assert!((blocks.to_from - b.transpose() * information * a).amax() < scale);
            prop_assert!((blocks.to_to - b.transpose() * information * b).amax() < scale);
            let error = linear.error;
            prop_assert!((blocks.gradient_from - a.transpose() * information * error).amax() < scale);
            prop_assert!((blocks.gradient_to - b.transpose() * information * error).amax() < scale);
        }
    }

    #[test]
    fn errors_of_the_plane_are_those_of_matrices(seed: u64, size in 0.0..3.1) {
        let (measured, from, to) = drawn::<Se2, 3>(seed, size);
        let matrix = |pose: Se2| -> Matrix3<f64> { pose.into() };
        let gap = matrix(measured).try_inverse().unwrap()
            * matrix(from).try_inverse().unwrap() * matrix(to);
        let angle = gap[(1, 0)].atan2(gap[(0, 0)]);
        let error = Se2::error(ErrorKind::G2o, &measured, &from, &to);
        prop_assert!((error.x - gap[(0, 2)]).abs() < 1e-12);
        prop_assert!((error.y - gap[(1, 2)]).abs() < 1e-12);
        prop_assert!((error.z - angle).abs() < 1e-12);
        prop_assert_eq!(error, Se2::error(ErrorKind::Split, &measured, &from, &to));
        let log = Se2::error(ErrorKind::Log, &measured, &from, &to);
        prop_assert!((matrix(Se2::exp(&log)) - gap).amax() < 1e-11);
    }

    #[test]
    fn errors_of_space_are_those_of_matrices(seed: u64, size in 0.0..3.1) {
        let (measured, from, to) = drawn::<Se3, 6>(seed, size);
        let matrix = |pose: Se3| -> Matrix4<f64> { pose.into() };
        let gap = matrix(measured).try_inverse().unwrap()
            * matrix(from).try_inverse().unwrap() * matrix(to);
        let turn = Rotation3::from_matrix_unchecked(gap.fixed_view::<3, 3>(0, 0).into_owned());
        let quaternion = UnitQuaternion::from_rotation_matrix(&turn);
        let sign = if quaternion.w < 0.0 { -1.0 } else { 1.0 };
        let g2o = Se3::error(ErrorKind::G2o, &measured, &from, &to);
        let split = Se3::error(ErrorKind::Split, &measured, &from, &to);
        for k in 0..3 {
            prop_assert!((g2o[k] - gap[(k, 3)]).abs() < 1e-11);
            prop_assert!((split[k] - gap[(k, 3)]).abs() < 1e-11);
            prop_assert!((g2o[3 + k] - sign * quaternion.imag()[k]).abs() < 1e-11);
        }
        // The rotation part of `split`, and the whole of `log`, by their exponentials.
        let turned = UnitQuaternion::from_scaled_axis(split.fixed_rows::<3>(3).into_owned());
        prop_assert!(turned.angle_to(&quaternion) < 1e-7);
        let log = Se3::error(ErrorKind::Log, &measured, &from, &to);
        prop_assert!((matrix(Se3::exp(&log)) - gap).amax() < 1e-10);
    }
}

/// Half the cost of one factor.
fn half_cost<P: Drawn<D>, const D: usize>(
    measured: &P,
    poses: (&P, &P),
    information: &SMatrix<f64, D, D>,
) -> f64 {
    let error = P::error(ErrorKind::G2o, measured, poses.0, poses.1);
    0.5 * error.dot(&(information * error))
}

/// The second derivative of half the cost by steps `a` of `from` and `b` of `to`, by differences.
fn hold_curvature<P: Drawn<D>, const D: usize>(seed: u64, size: f64) {
    let (measured, from, to) = drawn::<P, D>(seed, size);
    let draw = &mut Draw(!seed);
    let information = draw.information::<D>();
    let (a, b) = (draw.vector::<D>(1.0), draw.vector::<D>(1.0));
    let linear = P::linearize(ErrorKind::G2o, &measured, &from, &to);
    let mut blocks = P::normal_blocks(&linear, &information);
    let curvature = P::curvature(ErrorKind::G2o, &linear, &information).unwrap();
    curvature.add_to(&mut blocks, &to.between(&from).adjoint());
    let second = a.dot(&(blocks.from_from * a))
        + 2.0 * b.dot(&(blocks.to_from * a))
        + b.dot(&(blocks.to_to * b));
    let at = |s: f64| {
        half_cost(&measured, (&from.retract(&(a * s)), &to.retract(&(b * s))), &information)
    };
    let h = 1e-3;
    // Central differences of fourth order.
    let expected =
        (16.0 * (at(h) + at(-h)) - at(2.0 * h) - at(-2.0 * h) - 30.0 * at(0.0)) / (12.0 * h * h);
    let scale = 1.0 + information.amax() * (1.0 + linear.by_from.amax()).powi(2);
    assert!((second - expected).abs() < 1e-6 * scale, "{second} {expected} {scale}");
}

proptest! {
    #[test]
    fn curvature_completes_the_second_derivatives(seed: u64, size in 0.0..2.0) {
        hold_curvature::<Se2, 3>(seed, size);
        hold_curvature::<Se3, 6>(seed, size);
    }
}
