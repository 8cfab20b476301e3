//! Construction, measures, boundary and shrinking of star polygons.
#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::config;
use common::places::{exact, spots, stars};
use geometry::Point2;
use geometry::planar::{BoundaryKind, Interval, PlanarError, Sector, StarPolygon};
use geometry::predicates::{compare_bearing_from, cross_sign, sort_by_bearing};
use proptest::prelude::*;

const SEEDS: &str = "proptest-regressions/laws_star.txt";

/// A view as a sensor gives it: bearings a degree or more apart, ranges from centimetres on.
fn views() -> impl Strategy<Value = StarPolygon> {
    let sample = (1.0..9.0_f64, prop_oneof![0.02..5.0_f64, Just(5.0)], prop::bool::weighted(0.1));
    prop::collection::vec(sample, 1..40).prop_map(|samples| {
        let mut bearing = -3.0_f64;
        let (mut vertices, mut gap_after) = (Vec::new(), Vec::new());
        for (step, range, gap) in samples {
            bearing += step.to_radians();
            vertices.push(Point2::new(range * bearing.cos(), range * bearing.sin()));
            gap_after.push(gap);
        }
        let last = gap_after.len() - 1;
        gap_after[last] = true;
        StarPolygon::try_new(vertices, gap_after).unwrap()
    })
}

proptest! {
    #![proptest_config(config(800, SEEDS))]

    #[test]
    fn a_sector_is_found_as_by_looking_at_all(star in stars(), spot in spots()) {
        let polygon = star.star(exact);
        let p = exact(spot.on(&star));
        let mut expected = None;
        if p != Point2::origin() {
            for (index, v) in polygon.vertices().iter().enumerate() {
                let order = compare_bearing_from(&polygon.vertex(0), v, &p);
                if order.is_le() {
                    expected = Some(Sector { index, on_ray: order.is_eq() });
                }
            }
        }
        prop_assert_eq!(polygon.sector_of(&p), expected);
    }

    #[test]
    fn the_radius_is_where_membership_ends(star in stars(), spot in spots()) {
        let polygon = star.star(exact);
        let p = exact(spot.on(&star));
        let radius = polygon.radius_towards(&p);
        let length = p.coords.norm();
        prop_assert!(radius <= polygon.outer_radius() * (1.0 + 1e-12));
        if length > 0.0 {
            let at = |share: f64| Point2::from(p.coords * (share * radius / length));
            // Scaling rounds the bearing, which matters only on a ray beside a gap.
            if radius > 0.0 && !polygon.sector_of(&p).unwrap().on_ray {
                prop_assert!(polygon.contains(&at(1.0 - 1e-9)));
                prop_assert!(!polygon.contains(&at(1.0 + 1e-9)));
            }
            prop_assert!(radius > 0.0 || !polygon.contains(&p));
        }
    }

    #[test]
    fn the_boundary_is_one_closed_chain(star in stars()) {
        let polygon = star.star(exact);
        let edges: Vec<_> = polygon.boundary().collect();
        let gaps = star.gap_after.iter().filter(|g| **g).count();
        prop_assert_eq!(edges.len(), polygon.len() + gaps);
        let mut twice_area = 0.0;
        for (k, edge) in edges.iter().enumerate() {
            prop_assert_eq!(edge.to, edges[(k + 1) % edges.len()].from);
            twice_area += edge.from.x * edge.to.y - edge.from.y * edge.to.x;
            match edge.kind {
                BoundaryKind::Chord(i) => {
                    prop_assert!(!polygon.is_gap(i) && edge.from == polygon.vertex(i));
                }
                BoundaryKind::SpokeIn(i) => {
                    prop_assert!(polygon.is_gap(i) && edge.from == polygon.vertex(i));
                    prop_assert_eq!(edge.to, Point2::origin());
                }
                BoundaryKind::SpokeOut(i) => {
                    prop_assert!(polygon.is_gap(i) && edge.from == Point2::origin());
                    prop_assert_eq!(edge.to, polygon.vertex(polygon.next(i)));
                }
            }
        }
        // Integers: sums are exact.
        prop_assert_eq!(polygon.area(), 0.5 * twice_area);
    }

    #[test]
    fn clipping_backwards_mirrors(star in stars(), ends in (spots(), spots())) {
        let polygon = star.star(exact);
        let (a, b) = (exact(ends.0.on(&star)), exact(ends.1.on(&star)));
        let (mut there, mut back) = (Vec::new(), Vec::new());
        polygon.clip(&a, &b, &mut there);
        polygon.clip(&b, &a, &mut back);
        prop_assert_eq!(there.len(), back.len());
        for (t, s) in there.iter().zip(back.iter().rev()) {
            prop_assert!((t.from - (1.0 - s.to)).abs() < 1e-12);
            prop_assert!((t.to - (1.0 - s.from)).abs() < 1e-12);
        }
    }

    /// Clipping refuses segments that keep out of the circle through the farthest vertex; here
    /// they reach just inside of it.
    #[test]
    fn a_segment_through_the_last_bit_of_a_spike_is_clipped(star in stars(), inset in 1e-9..1e-2_f64) {
        let polygon = star.star(exact);
        for v in polygon.vertices() {
            let p = v * (1.0 - inset);
            if polygon.contains(&p) {
                let across = Point2::new(-v.y, v.x).coords;
                for (a, b) in [(p, v * 2.0), (v * 2.0, p), (p - across, p + across), (p, p)] {
                    let mut out = Vec::new();
                    polygon.clip(&a, &b, &mut out);
                    prop_assert!(!out.is_empty(), "{} {}", a, b);
                }
            }
        }
    }

    #[test]
    fn wrong_input_is_refused_by_name(star in stars(), at in any::<prop::sample::Index>()) {
        let polygon = star.star(exact);
        prop_assume!(polygon.len() > 1);
        let vertex = at.index(polygon.len());
        let with = |p: Point2| {
            let mut vertices = polygon.vertices().to_vec();
            vertices[vertex] = p;
            StarPolygon::try_new(vertices, star.gap_after.clone())
        };
        prop_assert_eq!(with(Point2::origin()), Err(PlanarError::AtOrigin { vertex }));
        for c in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e101, 1e-101, f64::MIN_POSITIVE] {
            let refused = matches!(
                with(Point2::new(c, 1.0)),
                Err(PlanarError::OutsideEnvelope { vertex: v, .. }) if v == vertex
            );
            prop_assert!(refused, "{}", c);
        }
        if vertex > 0 {
            let before = vertex - 1;
            prop_assert_eq!(
                with(polygon.vertex(before) * 0.5),
                Err(PlanarError::BearingOrder { vertex, before })
            );
        }
        if polygon.is_gap(vertex) {
            let next = polygon.next(vertex);
            let mut gap_after = star.gap_after.clone();
            gap_after[vertex] = false;
            let closed = StarPolygon::try_new(polygon.vertices().to_vec(), gap_after);
            let (v, w) = (star.vertices[vertex], star.vertices[next]);
            if v.0 * w.1 - v.1 * w.0 <= 0 {
                prop_assert_eq!(closed, Err(PlanarError::WideChord { vertex, next }));
            } else {
                prop_assert!(closed.is_ok());
            }
        }
    }

    #[test]
    fn a_shrunk_polygon_keeps_its_margin(
        view in views(),
        margin in prop_oneof![Just(0.01), 0.001..0.3_f64],
        queries in prop::collection::vec((-3.2..3.2_f64, 0.0..1.0_f64), 30),
    ) {
        let small = view.shrunk(margin);
        let gaps = (0..small.len()).map(|i| small.is_gap(i)).collect();
        prop_assert_eq!(&StarPolygon::try_new(small.vertices().to_vec(), gaps).unwrap(), &small);
        prop_assert!(small.area() <= view.area());
        prop_assert!(small.outer_radius() < view.outer_radius());
        for (bearing, share) in queries {
            let direction = Point2::new(bearing.cos(), bearing.sin());
            let reach = small.radius_towards(&direction);
            let p = direction * (share * reach);
            if !small.contains(&p) {
                continue;
            }
            prop_assert!(view.contains(&p));
            let i = view.sector_of(&p).unwrap().index;
            let (v, w) = (view.vertex(i), view.vertex(view.next(i)));
            let chord = (w - v).normalize();
            let away = |q: &Point2| chord.perp(&(q - v));
            let sine = |q: &Point2| chord.perp(&-q.coords.normalize()).abs();
            let kept = margin * (5.0 * sine(&v).min(sine(&w))).min(1.0);
            prop_assert!(away(&p) >= kept - 1e-12, "{} {}", away(&p), kept);
        }
    }

    /// Any polygon, also full circles whose first vertex is dropped.
    #[test]
    fn a_shrunk_polygon_lies_inside(
        star in stars(),
        margin in 0.5..30.0_f64,
        queries in prop::collection::vec((-3.2..3.2_f64, 0.0..1.0_f64), 30),
    ) {
        let polygon = star.star(exact);
        let small = polygon.shrunk(margin);
        let gaps = (0..small.len()).map(|i| small.is_gap(i)).collect();
        prop_assert_eq!(&StarPolygon::try_new(small.vertices().to_vec(), gaps).unwrap(), &small);
        prop_assert!(small.len() == polygon.len() || small.is_empty() || small.has_gap());
        for (bearing, share) in queries {
            let direction = Point2::new(bearing.cos(), bearing.sin());
            let p = direction * (share * small.radius_towards(&direction));
            prop_assert!(!small.contains(&p) || polygon.contains(&p));
        }
    }

    /// Bearings that differ in the last bit: pulling rounds, and must not turn one past the next.
    #[test]
    fn a_shrunk_needle_is_still_in_order(
        bearing in -3.2..3.2_f64,
        radii in prop::collection::vec(1.0..9.0_f64, 2..12),
        margin in 0.01..0.5_f64,
    ) {
        let mut samples: Vec<(Point2, ())> = radii
            .iter()
            .map(|r| (Point2::new(r * bearing.cos(), r * bearing.sin()), ()))
            .collect();
        sort_by_bearing(&mut samples);
        samples.dedup_by(|b, a| cross_sign(&a.0, &b.0).is_eq());
        let vertices: Vec<Point2> = samples.into_iter().map(|(p, ())| p).collect();
        let mut gap_after = vec![false; vertices.len()];
        gap_after[vertices.len() - 1] = true;
        let small = StarPolygon::try_new(vertices, gap_after).unwrap().shrunk(margin);
        let gaps = (0..small.len()).map(|i| small.is_gap(i)).collect();
        prop_assert_eq!(&StarPolygon::try_new(small.vertices().to_vec(), gaps).unwrap(), &small);
    }

    #[test]
    fn a_margin_beyond_the_polygon_leaves_nothing(view in views()) {
        prop_assert!(view.shrunk(6.0).is_empty());
        prop_assert_eq!(view.shrunk(0.0), view.clone());
        prop_assert_eq!(view.shrunk(f64::NAN), view);
    }
}

#[test]
fn one_flag_per_vertex() {
    let refused = StarPolygon::try_new(vec![Point2::new(1.0, 0.0)], Vec::new());
    assert_eq!(refused, Err(PlanarError::FlagCount { vertices: 1, flags: 0 }));
}

#[test]
fn nothing_is_inside_the_empty_polygon_and_a_lone_vertex() {
    let lone = StarPolygon::try_new(vec![Point2::new(1.0, 1.0)], vec![true]).unwrap();
    for polygon in [StarPolygon::empty(), lone] {
        let mut out = Vec::new();
        for x in -2..=2 {
            for y in -2..=2 {
                let p = Point2::new(f64::from(x), f64::from(y));
                assert!(!polygon.contains(&p));
                polygon.clip(&Point2::new(-1.5, 0.5), &p, &mut out);
                polygon.clip(&p, &p, &mut out);
            }
        }
        assert_eq!(out, []);
        assert_eq!(polygon.area(), 0.0);
    }
}

#[test]
fn queries_beyond_the_envelope() {
    let p = |x: f64, y: f64| Point2::new(x, y);
    let square = StarPolygon::try_new(
        vec![p(1.0, 0.0), p(0.0, 1.0), p(-1.0, 0.0), p(0.0, -1.0)],
        vec![false; 4],
    )
    .unwrap();
    assert!(square.contains(&p(1e-320, -1e-200)));
    for wrong in [f64::NAN, f64::INFINITY, 1e200] {
        assert!(!square.contains(&p(wrong, 0.0)));
        let mut out = Vec::new();
        square.clip(&p(0.0, 0.0), &p(0.5, wrong), &mut out);
        assert_eq!(out, []);
    }
    let mut out = Vec::new();
    square.clip(&p(-1e100, 0.0), &p(1e100, 0.0), &mut out);
    square.clip(&p(0.0, 1e-320), &p(1e-320, 0.5), &mut out);
    assert_eq!(out, [Interval::new(0.5, 0.5), Interval::WHOLE]);
}
