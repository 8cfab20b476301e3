//! The laws of a group, and that the group is the one of homogeneous matrices.

use std::f64::consts::{PI, TAU};

use pose::nalgebra::{Matrix3, Point2};
use pose::{Se2, wrap_angle};
use proptest::prelude::*;

use crate::oracle::{angle, assert_close, motion};

fn matrix(motion: Se2) -> Matrix3<f64> {
    motion.into()
}

proptest! {
    #[test]
    fn products_are_products_of_matrices(a in motion(), b in motion()) {
        assert_close(&matrix(a * b), &(matrix(a) * matrix(b)), 1e-14);
        assert_close(&matrix(a.inverse_mul(&b)), &(matrix(a.inverse()) * matrix(b)), 1e-14);
    }

    #[test]
    fn the_laws_of_a_group_hold(a in motion(), b in motion(), c in motion()) {
        assert_close(&matrix((a * b) * c), &matrix(a * (b * c)), 1e-14);
        assert_close(&matrix(a * Se2::identity()), &matrix(a), 1e-15);
        assert_close(&matrix(Se2::identity() * a), &matrix(a), 1e-15);
        assert_close(&matrix(a * a.inverse()), &Matrix3::identity(), 1e-14);
        assert_close(&matrix(a.inverse() * a), &Matrix3::identity(), 1e-14);
    }

    #[test]
    fn points_move_as_homogeneous_coordinates(a in motion(), x in -9.0..9.0, y in -9.0..9.0) {
        let point = Point2::new(x, y);
        let moved = a.transform(&point);
        let expected = matrix(a) * point.to_homogeneous();
        assert_close(&moved.to_homogeneous(), &expected, 1e-14);
        assert_close(&a.inverse_transform(&moved).coords, &point.coords, 1e-14);
    }

    #[test]
    fn a_wrapped_angle_is_the_same_direction(angle in angle(), turns in -1000i32..1000) {
        let far = angle + f64::from(turns) * TAU;
        let wrapped = wrap_angle(far);
        prop_assert!(wrapped > -PI && wrapped <= PI, "{wrapped}");
        prop_assert!((wrapped.sin() - far.sin()).abs() < 1e-11);
        prop_assert!((wrapped.cos() - far.cos()).abs() < 1e-11);
    }
}

#[test]
fn angles_at_the_seam_and_inside_are_kept() {
    for kept in [PI, -PI.next_down(), 1e-300, -1e-300, 3.0, -3.0] {
        assert_eq!(wrap_angle(kept), kept);
    }
    assert_eq!(wrap_angle(-PI), PI);
    assert_eq!(wrap_angle(3.0 * PI), PI);
    assert!(wrap_angle(f64::NAN).is_nan());
}

#[test]
fn long_chains_stay_rotations() {
    let step = Se2::new(1.0, 0.0, 0.1);
    let mut world_from_body = Se2::identity();
    for _ in 0..100_000 {
        world_from_body = world_from_body * step;
    }
    assert!((world_from_body.rotation.norm() - 1.0).abs() < 1e-15);
    let error = wrap_angle(world_from_body.angle() - 0.1 * 100_000.0);
    assert!(error.abs() < 1e-9, "{error:e}");
}
