//! Chains of 50 views: what the wrapper costs over the engine, and how large and valid the maps are;
//! then how long they take to be checked and reduced.
//!
//! `cargo bench -p solid --bench booleans [VIEWS] [RUNS]`; runs alternate, the smallest counts.

mod clock;

use std::io::Write;

use boolmesh::prelude::{Manifold as Second, OpType, compute_boolean};
use clock::secs;
use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, MeshGLP};
use solid::boolean::{JITTER_M, Options, Provenance};
use solid::reduce::Goal;
use solid::synthetic::{Kind, views};
use solid::{Point3, Polyhedron, check, jittered, reduce, unite};

/// The same chain by the engine's own interface, with labels as numbers of faces.
fn engine(views: &[Polyhedron], origins: bool) -> usize {
    let mut map: Option<Manifold> = None;
    let mut first = 0;
    for view in views {
        let faces = view.faces().len() as u32;
        let labels = view.labels().iter().map(|label| u32::from(label.code()));
        let taken = MeshGLP::<f64, u32> {
            num_prop: 3,
            vert_properties: view.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect(),
            tri_verts: view.faces().as_flattened().to_vec(),
            run_original_id: vec![0],
            run_index: vec![0, 3 * faces],
            face_id: if origins { (first..first + faces).collect() } else { labels.collect() },
            ..Default::default()
        };
        first += faces;
        let taken = Manifold::from_mesh_glp(&taken);
        map = Some(match map {
            None => taken,
            Some(so_far) => so_far.union_with_engine(&taken, BooleanEngine::Exact),
        });
    }
    let given: MeshGLP<f64, u32> = map.expect("a view").get_mesh_glp(-1);
    given.tri_verts.len() / 3
}

/// Volume of the same chain by the second engine, and how long it took.
fn second(views: &[Polyhedron]) -> (f64, f64) {
    let take = |view: &Polyhedron| {
        let places: Vec<f64> = view.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect();
        let corners: Vec<usize> = view.faces().iter().flatten().map(|&v| v as usize).collect();
        Second::new(&places, &corners).expect("a closed 2-manifold")
    };
    let (map, took) = secs(|| {
        let mut map = take(&views[0]);
        for view in &views[1..] {
            map = compute_boolean(&map, &take(view), OpType::Add).expect("a union");
        }
        map
    });
    let about = views[0].vertices()[0];
    let corner = |h: usize| {
        let p = map.ps[map.hs[h].tail];
        Point3::new(p.x, p.y, p.z) - about
    };
    let six = |f: usize| corner(3 * f).dot(&corner(3 * f + 1).cross(&corner(3 * f + 2)));
    ((0..map.hs.len() / 3).map(six).sum::<f64>() / 6.0, took)
}

fn main() {
    let numbers: Vec<usize> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let count = numbers.first().copied().unwrap_or(50);
    let runs = numbers.get(1).copied().unwrap_or(3);
    let mut out = std::io::stdout();
    let mut say = |line: String| writeln!(out, "{line}").expect("stdout takes text");
    say(format!(
        "{:10} {:8} {:>8} {:>8} {:>7} {:>7} {:>9} {:>6} {:>7} {:>9} {:>8} {:>8}",
        "kind",
        "faces of",
        "engine s",
        "ours s",
        "ratio",
        "faces",
        "off by",
        "valid",
        "check s",
        "reduced",
        "error m",
        "reduce s"
    ));
    for kind in Kind::ALL {
        let mut taken = views(kind, count);
        if kind == Kind::Coplanar {
            let moved =
                taken.iter().enumerate().map(|(i, view)| jittered(view, i as u64, JITTER_M));
            taken = moved.collect();
        }
        let (volume, took) = second(&taken);
        say(format!("{kind:?}: boolmesh {took:.3} s, volume {volume:.9} m3"));
        for provenance in [Provenance::Labels, Provenance::Origins] {
            let options = Options { provenance, ..Options::default() };
            let (mut theirs, mut ours) = (f64::INFINITY, f64::INFINITY);
            let mut map = Polyhedron::empty();
            for _ in 0..runs {
                let (_, took) = secs(|| engine(&taken, provenance == Provenance::Origins));
                theirs = theirs.min(took);
                let (united, took) = secs(|| unite(&taken, &options));
                ours = ours.min(took);
                map = united.expect("sound views");
            }
            let (validity, checked) = secs(|| check(&map));
            let (reduced, took) = secs(|| reduce(&map, &Goal { error_m: 0.02, faces: 0 }));
            let sound = validity.is_valid() && check(&reduced.mesh).is_valid();
            say(format!(
                "{:10} {:8} {theirs:8.3} {ours:8.3} {:7.3} {:7} {:9.1e} {sound:>6} {checked:7.3} {:9} \
                 {:8.4} {took:8.3}",
                format!("{kind:?}"),
                format!("{provenance:?}"),
                ours / theirs,
                map.faces().len(),
                (map.volume_m3() - volume).abs() / volume,
                reduced.mesh.faces().len(),
                reduced.error_m,
            ));
        }
    }
}
