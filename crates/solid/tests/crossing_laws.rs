//! Meetings of triangles against clipping in rational numbers, on small integer coordinates where
//! nearly everything is degenerate.

use num_rational::Ratio;
use num_traits::Zero;
use proptest::prelude::*;
use solid::predicates::is_collinear;
use solid::{Label, Point3, Polyhedron, crossings};

type Q = Ratio<i128>;
type V = [Q; 3];

fn sub(a: &V, b: &V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: &V, b: &V) -> Q {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &V, b: &V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The part of a convex polygon on the inner side of a plane, border included.
fn clip(polygon: &[V], on: &V, outward: &V) -> Vec<V> {
    let height = |p: &V| dot(&sub(p, on), outward);
    let mut kept = Vec::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (hp, hq) = (height(p), height(q));
        if hp <= Q::zero() {
            kept.push(*p);
        }
        if hp * hq < Q::zero() {
            let t = hp / (hp - hq);
            kept.push([0, 1, 2].map(|k| p[k] + (q[k] - p[k]) * t));
        }
    }
    kept
}

/// Corners of what two triangles have in common.
fn common(a: &[V; 3], b: &[V; 3]) -> Vec<V> {
    let normal = cross(&sub(&b[1], &b[0]), &sub(&b[2], &b[0]));
    let against = normal.map(|c| -c);
    let mut left = clip(&clip(a, &b[0], &normal), &b[0], &against);
    for i in 0..3 {
        let outward = cross(&sub(&b[(i + 1) % 3], &b[i]), &normal);
        left = clip(&left, &b[i], &outward);
    }
    left
}

/// Whether the triangles have more in common than their common corners and edge.
fn meets(a: &[V; 3], b: &[V; 3]) -> bool {
    let shared: Vec<&V> = a.iter().filter(|corner| b.contains(corner)).collect();
    let points = common(a, b);
    match shared.as_slice() {
        [] => !points.is_empty(),
        [corner] => points.iter().any(|p| p != *corner),
        [from, to] => points.iter().any(|p| {
            let along = sub(to, from);
            cross(&along, &sub(p, from)) != [Q::zero(); 3]
        }),
        _ => true,
    }
}

fn exact(corners: [[i8; 3]; 3]) -> [V; 3] {
    corners.map(|c| c.map(|x| Q::from(i128::from(x))))
}

fn point(c: [i8; 3]) -> Point3 {
    Point3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2]))
}

fn found(a: [[i8; 3]; 3], b: [[i8; 3]; 3]) -> bool {
    let vertices = a.into_iter().chain(b).map(point).collect();
    let labels = vec![Label::Obstacle; 2];
    let mesh = Polyhedron::try_new(vertices, vec![[0, 1, 2], [3, 4, 5]], labels)
        .expect("indices are in range");
    !crossings(&mesh, 1).is_empty()
}

fn is_flat(t: [[i8; 3]; 3]) -> bool {
    let [a, b, c] = t.map(point);
    is_collinear(&a, &b, &c)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8_000, max_global_rejects: 1 << 20, ..Default::default() })]

    #[test]
    fn triangles_meet_as_clipping_says(
        a in prop::array::uniform3(prop::array::uniform3(-2..=2_i8)),
        b in prop::array::uniform3(prop::array::uniform3(-2..=2_i8)),
        shared in 0..4_usize,
    ) {
        // Common corners would be rare: some of b's corners are taken from a.
        let mut b = b;
        b[..shared.min(3)].copy_from_slice(&a[..shared.min(3)]);
        b.rotate_left(shared);
        prop_assume!(!is_flat(a) && !is_flat(b));
        let expected = meets(&exact(a), &exact(b));
        prop_assert_eq!(found(a, b), expected);
        prop_assert_eq!(found(b, a), expected);
    }

    #[test]
    fn triangles_in_one_plane_meet_as_clipping_says(
        a in prop::array::uniform3(prop::array::uniform2(-3..=3_i8)),
        b in prop::array::uniform3(prop::array::uniform2(-3..=3_i8)),
    ) {
        let lift = |t: [[i8; 2]; 3]| t.map(|[x, y]| [x, y, x - 2 * y]);
        let (a, b) = (lift(a), lift(b));
        prop_assume!(!is_flat(a) && !is_flat(b));
        prop_assert_eq!(found(a, b), meets(&exact(a), &exact(b)));
    }
}
