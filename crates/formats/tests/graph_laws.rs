//! Laws of pose-graph files: what is written reads back, and no bytes make a reader panic.

use formats::pose_graph::{AnyGraph, GraphFormat, read, write};
use formats::{FormatError, sniff, tum};
use nalgebra::{Quaternion, SMatrix, UnitQuaternion};
use pose::{Se2, Se3};
use posegraph::{ErrorKind, Factor, FactorGraph, FactorGraph2, FactorGraph3, Manifold};
use proptest::prelude::*;

/// Numbers of every size, small integers among them.
fn number() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![
        -1e3..1e3_f64,
        (-9..9_i32).prop_map(f64::from),
        any::<f64>().prop_filter("finite", |x| x.is_finite() && x.abs() < 1e100),
    ]
}

/// A pose as a file would give it.
fn pose2() -> impl Strategy<Value = Se2> + Clone {
    let angle = prop_oneof![
        -std::f64::consts::PI..std::f64::consts::PI,
        -1e-9..1e-9_f64,
        Just(std::f64::consts::PI),
        Just(0.0),
    ];
    (number(), number(), angle).prop_map(|(x, y, theta)| Se2::new(x, y, theta))
}

fn pose3() -> impl Strategy<Value = Se3> + Clone {
    let unit = prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("has a direction", |q| q.iter().map(|x| x * x).sum::<f64>() > 1e-3)
        .prop_map(|[x, y, z, w]| UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)));
    (prop::array::uniform3(number()), unit).prop_map(|(t, rotation)| Se3::new(t.into(), rotation))
}

fn information<const D: usize>() -> impl Strategy<Value = SMatrix<f64, D, D>> {
    let entries = prop::collection::vec(number(), D * D);
    prop_oneof![
        Just(SMatrix::identity()),
        entries.prop_map(|entries| {
            let mut matrix = SMatrix::<f64, D, D>::from_iterator(entries);
            matrix.fill_lower_triangle_with_upper_triangle();
            matrix
        })
    ]
}

/// Graphs with ascending ids, vertices without start values, parallel edges and fixed vertices.
fn graph<P: Manifold<D>, const D: usize>(
    pose: impl Strategy<Value = P> + Clone,
) -> impl Strategy<Value = FactorGraph<P, D>> {
    let gaps = prop::collection::vec(prop_oneof![1..3_u64, 1..u64::from(u32::MAX)], 2..12);
    let edge = (any::<prop::sample::Index>(), 1..100_usize, pose.clone(), information::<D>());
    let edges = prop::collection::vec(edge, 0..12);
    let initial = prop::collection::vec(prop::option::weighted(0.8, pose), 12);
    (gaps, initial, edges, any::<u16>()).prop_map(|(gaps, initial, edges, held)| {
        let ids: Vec<u64> = gaps
            .iter()
            .scan(0, |id, gap| {
                *id += gap;
                Some(*id)
            })
            .collect();
        let count = ids.len();
        let factors: Vec<Factor<P, D>> = edges
            .into_iter()
            .map(|(from, hop, from_from_to, information)| {
                let from = from.index(count);
                let to = (from + 1 + hop % (count - 1)) % count;
                Factor { from, to, from_from_to, information }
            })
            .collect();
        let mut initial = initial[..count].to_vec();
        // A vertex that stands nowhere would not be in the file.
        for (index, pose) in initial.iter_mut().enumerate() {
            if !factors.iter().any(|f| f.from == index || f.to == index) {
                pose.get_or_insert(P::identity());
            }
        }
        let fixed = (0..count).filter(|index| held >> index & 1 == 1).collect();
        FactorGraph { ids, initial, fixed, factors }
    })
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
}

fn bits2(pose: &Se2) -> [u64; 4] {
    let (t, r) = (pose.translation, pose.rotation);
    [t.x, t.y, r.re, r.im].map(f64::to_bits)
}

fn bits3(pose: &Se3) -> [u64; 7] {
    let (t, q) = (pose.translation, pose.rotation.coords);
    [t.x, t.y, t.z, q.x, q.y, q.z, q.w].map(f64::to_bits)
}

fn check_same<P: Manifold<D>, const D: usize, const N: usize>(
    a: &FactorGraph<P, D>,
    b: &FactorGraph<P, D>,
    bits: impl Fn(&P) -> [u64; N],
) {
    assert_eq!((&a.ids, &a.fixed), (&b.ids, &b.fixed));
    let poses = |graph: &FactorGraph<P, D>| -> Vec<Option<[u64; N]>> {
        graph.initial.iter().map(|pose| pose.as_ref().map(&bits)).collect()
    };
    assert_eq!(poses(a), poses(b));
    assert_eq!(a.factors.len(), b.factors.len());
    for (a, b) in a.factors.iter().zip(&b.factors) {
        assert_eq!((a.from, a.to, bits(&a.from_from_to)), (b.from, b.to, bits(&b.from_from_to)));
        assert!(a.information.iter().zip(&b.information).all(|(a, b)| same(*a, *b)));
    }
}

fn plane(bytes: &[u8]) -> FactorGraph2 {
    match read(bytes).expect("it was written").graph {
        AnyGraph::Plane(graph) => graph,
        AnyGraph::Space(_) => panic!("not of the plane"),
    }
}

fn space(bytes: &[u8]) -> FactorGraph3 {
    match read(bytes).expect("it was written").graph {
        AnyGraph::Space(graph) => graph,
        AnyGraph::Plane(_) => panic!("not of space"),
    }
}

/// Each reader may refuse the bytes, none may panic, and a message says what is wrong.
fn read_all(bytes: &[u8]) {
    let _ = sniff(bytes, None);
    let graph = read(bytes);
    if let Ok(file) = &graph {
        let count = file.graph.vertices();
        let within = match &file.graph {
            AnyGraph::Plane(g) => g.factors.iter().all(|f| f.from < count && f.to < count),
            AnyGraph::Space(g) => g.factors.iter().all(|f| f.from < count && f.to < count),
        };
        assert!(within, "edges lead to vertices");
        let _ = file.report.messages();
        for format in [GraphFormat::G2o, GraphFormat::Toro] {
            let _ = write(&file.graph, format);
        }
    }
    for error in [graph.err(), tum::read(bytes).err()].into_iter().flatten() {
        let FormatError::Unexpected { found, expected, .. } = &error else {
            panic!("a reader told of {error}");
        };
        assert!(!found.is_empty() && !expected.is_empty(), "{error}");
    }
}

const FILES: [&str; 4] = [
    "# a\nVERTEX_SE2 0 0 0 0\nFIX 0\nVERTEX_SE2 1 1 0 .5\nEDGE_SE2 0 1 1 0 0.5 4 0 0 4 0 9\n",
    "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nEDGE_SE3:QUAT 0 7 1 0 0 0 0 0.6 0.8 \
     1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n",
    "VERTEX2 0 0 0 0\nEQUIV 1 2\nEDGE2 0 1 1 0 0 1 0 1 1 0 0\n\
     EDGE2 1 0 -1 0 0 1 0 1 1 0 0\n",
    "# stamp tx ty tz qx qy qz qw\n0.0 1 2 3 0 0 0 1\n0.1 1 2 3.5 0 0 1 0\n",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn g2o_of_the_plane_reads_back_bit_for_bit(graph in graph::<Se2, 3>(pose2())) {
        let text = write(&AnyGraph::Plane(graph.clone()), GraphFormat::G2o);
        if !text.is_empty() {
            check_same(&graph, &plane(&text), bits2);
        }
    }

    #[test]
    fn g2o_of_space_reads_back_bit_for_bit(graph in graph::<Se3, 6>(pose3())) {
        let text = write(&AnyGraph::Space(graph.clone()), GraphFormat::G2o);
        if !text.is_empty() {
            check_same(&graph, &space(&text), bits3);
        }
    }

    #[test]
    fn toro_keeps_the_cost_of_any_poses(
        graph in graph::<Se2, 3>(pose2()),
        poses in prop::array::uniform12((-9.0..9.0_f64, -9.0..9.0_f64, -3.0..3.0_f64)),
    ) {
        let poses = poses.map(|(x, y, theta)| Se2::new(x, y, theta));
        let text = write(&AnyGraph::Plane(graph.clone()), GraphFormat::Toro);
        if let Some(back) = (!text.is_empty()).then(|| plane(&text)) {
            prop_assert_eq!(&graph.ids, &back.ids);
            for (a, b) in graph.factors.iter().zip(&back.factors) {
                let costs = [a, b].map(|f| {
                    let kind = ErrorKind::G2o;
                    let e = Se2::error(kind, &f.from_from_to, &poses[f.from], &poses[f.to]);
                    e.dot(&(f.information * e))
                });
                let reach = poses[a.from].distance() + poses[a.to].distance()
                    + a.from_from_to.distance() + 4.0;
                let size = a.information.norm() * reach * reach;
                prop_assert!((costs[0] - costs[1]).abs() <= 1e-12 * size, "{:?}", costs);
            }
        }
    }

    #[test]
    fn toro_of_space_reads_back_up_to_rounding(graph in graph::<Se3, 6>(pose3())) {
        let text = write(&AnyGraph::Space(graph.clone()), GraphFormat::Toro);
        if let Some(back) = (!text.is_empty()).then(|| space(&text)) {
            for (a, b) in graph.factors.iter().zip(&back.factors) {
                prop_assert_eq!(a.from_from_to.translation, b.from_from_to.translation);
                prop_assert!(a.from_from_to.rotation.angle_to(&b.from_from_to.rotation) < 1e-7);
                let (m, n) = (a.from_from_to.rotation_matrix(), b.from_from_to.rotation_matrix());
                prop_assert!((m - n).amax() < 1e-14, "{}", m - n);
                let gap = (a.information - b.information).amax();
                prop_assert!(gap <= 1e-13 * a.information.amax(), "{gap}");
            }
        }
    }

    #[test]
    fn trajectories_read_back_bit_for_bit(
        poses in prop::collection::vec((number(), pose3()), 1..20)
    ) {
        let (stamps_secs, poses): (Vec<f64>, Vec<Se3>) = poses.into_iter().unzip();
        let trajectory = tum::Trajectory { stamps_secs, poses };
        prop_assert_eq!(&tum::read(&tum::write(&trajectory)).expect("written"), &trajectory);
    }

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        read_all(&bytes);
    }

    #[test]
    fn random_words(
        text in "(VERTEX_SE2 |EDGE_SE2 |EDGE3 |VERTEX_SE3:QUAT |FIX |EDGE2 |[-+.#e0-9naif \n\t\r]){0,60}"
    ) {
        read_all(text.as_bytes());
    }

    #[test]
    fn mutated_files(
        which in 0..4_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..5), 1..6),
    ) {
        let mut bytes = FILES[which].as_bytes().to_vec();
        for (index, value, action) in changes {
            if bytes.is_empty() {
                break;
            }
            let index = index.index(bytes.len());
            match action {
                0 => bytes[index] = value,
                1 => bytes[index] ^= 1 << (value % 8),
                2 => drop(bytes.remove(index)),
                3 => bytes.truncate(index),
                _ => bytes.insert(index, value % 64),
            }
        }
        read_all(&bytes);
    }
}
