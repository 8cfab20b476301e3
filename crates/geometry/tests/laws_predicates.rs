//! The predicates agree with big integers, also where floats cannot tell.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::cmp::Ordering;

use common::config;
use common::oracle::At;
use common::places::{Grid, by_bearing, exact, scaled_up};
use geometry::Point2;
use geometry::predicates::{
    compare_bearing_from, cross_precise, cross_sign, orient, orient_precise, sign, sort_by_bearing,
};
use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};
use proptest::prelude::*;

const SEEDS: &str = "proptest-regressions/laws_predicates.txt";

/// Three points on a line but for rounding, at any scale inside the envelope.
fn nearly_collinear() -> impl Strategy<Value = [Point2; 3]> {
    let unit = || -1.0..1.0_f64;
    ((unit(), unit()), (unit(), unit()), unit(), -300..300_i32, 0..3_u8).prop_map(
        |((x, y), (dx, dy), t, power, how)| {
            let k = 2.0_f64.powi(power);
            let t = if how == 0 { 1e-9 * t } else { 4.0 * t };
            let shift = if how == 1 { 1e6 } else { 1.0 };
            let at = |t: f64| Point2::new(k * (shift * x + t * dx), k * (shift * y + t * dy));
            [at(0.0), at(1.0), at(t)]
        },
    )
}

fn exact_orient(p: &[Point2]) -> (BigInt, BigInt, BigInt) {
    let e = scaled_up(p);
    let (ax, ay) = (e[0].x.clone() - &e[2].x, e[0].y.clone() - &e[2].y);
    let (bx, by) = (e[1].x.clone() - &e[2].x, e[1].y.clone() - &e[2].y);
    let (left, right) = (ax * by, ay * bx);
    (left.clone() - &right, left, right)
}

fn integer_sign(value: &BigInt) -> Ordering {
    value.cmp(&BigInt::zero())
}

/// The quotient of two big integers to double precision.
fn quotient(over: &BigInt, under: &BigInt) -> f64 {
    let shift = 256_usize;
    let scaled: BigInt = (over.clone() << shift) / under;
    scaled.to_f64().unwrap() / 2.0_f64.powi(256)
}

proptest! {
    #![proptest_config(config(10_000, SEEDS))]

    #[test]
    fn orientation_is_exact(p in nearly_collinear()) {
        let [a, b, c] = p;
        let expected = integer_sign(&exact_orient(&p).0);
        prop_assert_eq!(sign(orient(&a, &b, &c)), expected);
        prop_assert_eq!(sign(orient(&b, &c, &a)), expected);
        prop_assert_eq!(sign(orient(&b, &a, &c)), expected.reverse());
    }

    #[test]
    fn cross_is_orientation_about_the_origin(p in nearly_collinear()) {
        let zero = Point2::origin();
        for (a, b) in [(p[0], p[1]), (p[1], p[2])] {
            prop_assert_eq!(cross_sign(&a, &b), integer_sign(&exact_orient(&[a, b, zero]).0));
        }
    }

    /// The measured determinant is right to `1e-15`, or to `1e-30` of the products it subtracts.
    #[test]
    fn the_precise_determinant_is_precise(p in nearly_collinear()) {
        let (det, left, right) = exact_orient(&p);
        let terms = left.abs() + right.abs();
        if !terms.is_zero() {
            // Scaling by powers of two alone: the product of the floats tells the scale.
            let e = scaled_up(&p);
            let unit = [(p[0].x, &e[0].x), (p[0].y, &e[0].y), (p[1].x, &e[1].x)]
                .iter()
                .find(|(c, _)| *c != 0.0)
                .map(|(c, whole)| c / whole.to_f64().unwrap());
            if let Some(unit) = unit {
                let expected = quotient(&det, &terms);
                let measured = orient_precise(&p[0], &p[1], &p[2])
                    / (terms.to_f64().unwrap() * unit * unit);
                prop_assert!(
                    (measured - expected).abs() <= 4e-15 * expected.abs() + 1e-30,
                    "{} {}", measured, expected
                );
            }
        }
    }

    #[test]
    fn bearings_compare_as_in_integers(
        first in (-5_i64..=5, -5_i64..=5),
        a in (-5_i64..=5, -5_i64..=5),
        b in (-5_i64..=5, -5_i64..=5),
    ) {
        prop_assume!(first != (0, 0) && a != (0, 0) && b != (0, 0));
        // Turning by the conjugate of `first` puts it on the x axis.
        let turned = |p: Grid| (p.0 * first.0 + p.1 * first.1, p.1 * first.0 - p.0 * first.1);
        prop_assert_eq!(
            compare_bearing_from(&exact(first), &exact(a), &exact(b)),
            by_bearing(&turned(a), &turned(b))
        );
    }

    #[test]
    fn sorting_orders_by_bearing_then_distance(
        drawn in prop::collection::vec((-3_i64..=3, -3_i64..=3), 0..12),
    ) {
        let mut points: Vec<(Point2, usize)> =
            drawn.iter().enumerate().map(|(i, &p)| (exact(p), i)).collect();
        sort_by_bearing(&mut points);
        let length = |p: Grid| p.0 * p.0 + p.1 * p.1;
        let mut expected: Vec<usize> = (0..drawn.len()).collect();
        expected.sort_by(|&i, &j| {
            let (a, b) = (drawn[i], drawn[j]);
            (length(a) > 0).cmp(&(length(b) > 0))
                .then(by_bearing(&a, &b))
                .then(length(a).cmp(&length(b)))
        });
        prop_assert_eq!(points.iter().map(|(_, i)| *i).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn the_precise_cross_is_exact_where_it_can_be(
        a in (-1_i64 << 26..1 << 26, -1_i64 << 26..1 << 26),
        b in (-1_i64 << 26..1 << 26, -1_i64 << 26..1 << 26),
    ) {
        let whole = |p: Grid| At { x: p.0, y: p.1 };
        let expected = whole(a).cross(&whole(b));
        if expected.abs() < 1 << 53 {
            prop_assert_eq!(cross_precise(&exact(a), &exact(b)), expected as f64);
        }
    }
}
