//! Transported covariances against the spread of perturbed motions.

use pose::nalgebra::{Matrix3, Vector3};
use pose::{Se2, covariance_of_compose, covariance_of_inverse};
use proptest::prelude::*;

use crate::oracle::{assert_close, motion};

/// The covariance of `f` under independent errors with the given covariances: `f` is evaluated at
/// plus and minus every column of their roots, which is exact where `f` is linear.
fn spread<const N: usize>(
    covariances: [&Matrix3<f64>; N],
    f: impl Fn([Vector3<f64>; N]) -> Vector3<f64>,
) -> Matrix3<f64> {
    let mut sum = Matrix3::zeros();
    for (which, covariance) in covariances.into_iter().enumerate() {
        let root = covariance.cholesky().expect("a covariance is positive definite").l();
        for column in root.column_iter() {
            for sign in [1.0, -1.0] {
                let mut errors = [Vector3::zeros(); N];
                errors[which] = column * sign;
                let moved = f(errors);
                sum += moved * moved.transpose() * 0.5;
            }
        }
    }
    sum
}

fn covariance() -> impl Strategy<Value = Matrix3<f64>> {
    proptest::array::uniform6(-1.0f64..1.0).prop_map(|v| {
        let root = Matrix3::new(
            0.2 + v[0].abs(),
            0.0,
            0.0,
            v[1],
            0.2 + v[2].abs(),
            0.0,
            v[3],
            v[4],
            0.2 + v[5].abs(),
        );
        // Small enough that the second order does not show.
        root * root.transpose() * 1e-10
    })
}

proptest! {
    #[test]
    fn the_error_of_a_product_spreads_as_said(
        a_from_b in motion(), b_from_c in motion(), first in covariance(), second in covariance(),
    ) {
        let a_from_c = a_from_b * b_from_c;
        let sampled = spread([&first, &second], |[b, c]| {
            (a_from_b.boxplus(&b) * b_from_c.boxplus(&c)).boxminus(&a_from_c)
        });
        let carried = covariance_of_compose(&first, &b_from_c, &second);
        assert_close(&(carried * 1e10), &(sampled * 1e10), 1e-7);
        prop_assert_eq!(carried, carried.transpose());
    }

    #[test]
    fn the_error_of_an_inverse_spreads_as_said(a_from_b in motion(), covariance in covariance()) {
        let b_from_a = a_from_b.inverse();
        let sampled = spread([&covariance], |[b]| {
            a_from_b.boxplus(&b).inverse().boxminus(&b_from_a)
        });
        let carried = covariance_of_inverse(&a_from_b, &covariance);
        assert_close(&(carried * 1e10), &(sampled * 1e10), 1e-7);
        prop_assert_eq!(carried, carried.transpose());
        let back = covariance_of_inverse(&b_from_a, &carried);
        assert_close(&(back * 1e10), &(covariance * 1e10), 1e-10);
    }

    #[test]
    fn transport_along_a_chain_is_associative(
        b_from_c in motion(), c_from_d in motion(),
        of_b in covariance(), of_c in covariance(), of_d in covariance(),
    ) {
        let left =
            covariance_of_compose(&covariance_of_compose(&of_b, &b_from_c, &of_c), &c_from_d, &of_d);
        let b_from_d = b_from_c * c_from_d;
        let right =
            covariance_of_compose(&of_b, &b_from_d, &covariance_of_compose(&of_c, &c_from_d, &of_d));
        assert_close(&(left * 1e10), &(right * 1e10), 1e-12);
    }
}

/// Standard normal numbers: the splitmix64 generator through the Box-Muller map.
fn normals() -> impl Iterator<Item = Vector3<f64>> {
    let mut state = 1u64;
    let mut uniform = move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut normal = move || {
        let radius = (-2.0 * (1.0 - uniform()).ln()).sqrt();
        radius * (uniform() * std::f64::consts::TAU).cos()
    };
    std::iter::repeat_with(move || Vector3::from_fn(|_, _| normal()))
}

#[test]
fn ten_noisy_steps_spread_as_the_transported_covariance_says() {
    let step = Se2::new(1.0, 0.2, 0.3);
    let deviation = Vector3::new(0.02, 0.01, 0.02);
    let step_covariance = Matrix3::from_diagonal(&deviation.component_mul(&deviation));
    let mut end = Se2::identity();
    let mut expected = Matrix3::zeros();
    for _ in 0..10 {
        end = end * step;
        expected = covariance_of_compose(&expected, &step, &step_covariance);
    }

    let count = 20_000;
    let mut errors = normals().map(|normal| normal.component_mul(&deviation));
    let mut sampled = Matrix3::zeros();
    for _ in 0..count {
        let noisy = (0..10).fold(Se2::identity(), |pose, _| {
            pose * step.boxplus(&errors.next().expect("there is no last one"))
        });
        let error = noisy.boxminus(&end);
        sampled += error * error.transpose() / count as f64;
    }
    // 20,000 samples leave about 1 %; the second order is smaller still.
    assert_close(&(sampled / expected.amax()), &(expected / expected.amax()), 0.03);
}
