//! Known answers on one small polygon.
use geometry::Point2;
use geometry::planar::{EdgeLedger, Interval, StarPolygon};

fn p(x: f64, y: f64) -> Point2 {
    Point2::new(x, y)
}

#[test]
fn a_square_around_the_origin() {
    let square = StarPolygon::try_new(
        vec![p(1.0, -1.0), p(1.0, 1.0), p(-1.0, 1.0), p(-1.0, -1.0)],
        vec![false; 4],
    )
    .unwrap();
    assert!(square.contains(&p(0.0, 0.0)));
    assert!(square.contains(&p(0.5, 0.5)));
    assert!(!square.contains(&p(1.0, 1.0)));
    assert!(!square.contains(&p(1.0, 0.0)));
    assert_eq!(square.area(), 4.0);
    let mut out = Vec::new();
    square.clip(&p(-2.0, 0.5), &p(2.0, 0.5), &mut out);
    square.clip(&p(2.0, 0.0), &p(-2.0, 0.0), &mut out);
    square.clip(&p(2.0, 1.0), &p(-2.0, 1.0), &mut out);
    square.clip(&p(2.0, -0.5), &p(0.0, 0.5), &mut out);
    assert_eq!(
        out,
        [Interval::new(0.25, 0.75), Interval::new(0.25, 0.75), Interval::new(0.5, 1.0)]
    );
}

#[test]
fn a_quarter_view_with_a_gap() {
    let view = StarPolygon::try_new(vec![p(4.0, 0.0), p(0.0, 4.0)], vec![false, true]).unwrap();
    assert!(view.contains(&p(1.0, 1.0)));
    assert!(!view.contains(&p(1.0, 0.0)));
    assert!(!view.contains(&p(0.0, 0.0)));
    let mut out = Vec::new();
    view.clip(&p(1.0, -1.0), &p(1.0, 7.0), &mut out);
    view.clip(&p(1.0, 7.0), &p(1.0, -1.0), &mut out);
    assert_eq!(out, [Interval::new(0.125, 0.5), Interval::new(0.5, 0.875)]);
    let small = view.shrunk(0.5);
    assert!(small.area() < view.area());
    assert!(StarPolygon::try_new(small.vertices().to_vec(), vec![false, true]).is_ok());
}

#[test]
fn a_ledger_keeps_the_first_reason() {
    let mut ledger = EdgeLedger::new();
    let mut newly = Vec::new();
    ledger.close(Interval::new(0.25, 0.5), &"a", &mut newly);
    ledger.close(Interval::new(0.0, 0.75), &"b", &mut newly);
    assert_eq!(
        newly,
        [Interval::new(0.25, 0.5), Interval::new(0.0, 0.25), Interval::new(0.5, 0.75)]
    );
    assert_eq!(ledger.reason_at(0.3), Some(&"a"));
    assert_eq!(ledger.open_share() + ledger.closed_share(), 1.0);
    let mut again = Vec::new();
    ledger.reopen(|r| *r == "b", &mut again);
    assert_eq!(again, [Interval::new(0.0, 0.25), Interval::new(0.5, 0.75)]);
    assert!(!ledger.is_closed());
}
