//! Meshes of files, each with a copy of itself that is shifted and turned: whether results are valid, how
//! far volumes are from those of the second engine and areas per label from a Monte-Carlo estimate, and
//! what the wrapper costs over the engine.
//!
//! `cargo bench -p solid --bench pairs -- FILE...` (OFF, OBJ, STL); what is no closed 2-manifold is told
//! and left out. Runs alternate, their mean counts; seconds are those of the processor, which the system
//! tells in steps of some milliseconds, so that small meshes take many runs. Neither side's seconds have a look at
//! the result in them but what the boolean itself has.

mod clock;
mod files;

use std::io::Write;

use boolmesh::prelude::{Manifold as Second, OpType as SecondType, compute_boolean};
use clock::secs;
use files::read;
use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, MeshGLP, OpType};
use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};
use solid::boolean::Options;
use solid::validity::check_topology;
use solid::{Label, Operation, Point3, Polyhedron, Side, Solid, boolean, check, crossings};

const ALL: [Operation; 4] = [
    Operation::Union,
    Operation::Intersection,
    Operation::Difference,
    Operation::SymmetricDifference,
];
/// Seconds that the runs of one operation take at least, by each: far more than a step of the clock.
const RUN_SECS: f64 = 0.25;
/// How often both take turns at least.
const TURNS: usize = 8;
/// So many faces are put together in one turn at least, by as many runs as that takes, so that a turn is longer than a
/// step of the clock.
const FACES: usize = 4000;
/// Points on the surface of each operand.
const SAMPLES: usize = 40_000;

/// Half of the faces frontier, in blocks.
fn labelled(mesh: Polyhedron) -> Polyhedron {
    let (low, high) = mesh.bounds().expect("faces");
    let step = (high - low).amax() / 3.0;
    let label = |face: usize| {
        let [a, b, c] = mesh.corners(face).map(|p| (p - low) / step);
        let blocks: f64 = ((a + b + c) / 3.0).iter().map(|x| x.floor()).sum();
        if blocks as i64 % 2 == 0 { Label::Obstacle } else { Label::Frontier }
    };
    let labels = (0..mesh.faces().len()).map(label).collect();
    mesh.with_labels(labels).expect("one for each face")
}

fn moved(mesh: &Polyhedron) -> Polyhedron {
    let (low, high) = mesh.bounds().expect("faces");
    let middle = low.coords + (high - low) / 2.0;
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
    let shift = (high - low) * 0.13;
    mesh.transformed(&Se3::new(middle + shift - turn * middle, turn))
}

/// The same by the engine's own interface, with labels as numbers of faces.
fn engine(a: &Polyhedron, b: &Polyhedron, operation: Operation) -> usize {
    let take = |mesh: &Polyhedron| {
        Manifold::from_mesh_glp(&MeshGLP::<f64, u32> {
            num_prop: 3,
            vert_properties: mesh.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect(),
            tri_verts: mesh.faces().as_flattened().to_vec(),
            run_original_id: vec![0],
            run_index: vec![0, 3 * mesh.faces().len() as u32],
            face_id: mesh.labels().iter().map(|label| u32::from(label.code())).collect(),
            ..Default::default()
        })
    };
    let (a, b) = (take(a), take(b));
    let by = |a: &Manifold, b: &Manifold, operation| {
        let done = a.boolean_with_engine(b, operation, BooleanEngine::Exact);
        let given: MeshGLP<f64, u32> = done.get_mesh_glp(-1);
        given.tri_verts.len() / 3
    };
    match operation {
        Operation::Union => by(&a, &b, OpType::Add),
        Operation::Intersection => by(&a, &b, OpType::Intersect),
        Operation::Difference => by(&a, &b, OpType::Subtract),
        Operation::SymmetricDifference => {
            by(&a, &b, OpType::Subtract) + by(&b, &a, OpType::Subtract)
        }
    }
}

fn second(mesh: &Polyhedron) -> Option<Second<f64>> {
    let places: Vec<f64> = mesh.vertices().iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    let corners: Vec<usize> = mesh.faces().iter().flatten().map(|&v| v as usize).collect();
    Second::new(&places, &corners).ok()
}

/// Volume by the second engine.
fn oracle(a: &Polyhedron, b: &Polyhedron, operation: Operation) -> Option<f64> {
    let about = a.vertices()[0];
    let (first, other) = (second(a)?, second(b)?);
    let of = |p: &Second<f64>, q: &Second<f64>, op| {
        let Ok(mesh) = compute_boolean(p, q, op) else { return 0.0 };
        let corner = |h: usize| {
            let p = mesh.ps[mesh.hs[h].tail];
            Point3::new(p.x, p.y, p.z) - about
        };
        let six = |f: usize| corner(3 * f).dot(&corner(3 * f + 1).cross(&corner(3 * f + 2)));
        (0..mesh.hs.len() / 3).map(six).sum::<f64>() / 6.0
    };
    Some(match operation {
        Operation::Union => of(&first, &other, SecondType::Add),
        Operation::Intersection => of(&first, &other, SecondType::Intersect),
        Operation::Difference => of(&first, &other, SecondType::Subtract),
        Operation::SymmetricDifference => {
            of(&first, &other, SecondType::Subtract) + of(&other, &first, SecondType::Subtract)
        }
    })
}

/// Area of an operand's faces of each label, inside and outside of another solid: estimates, and their
/// variances.
fn sampled(mesh: &Polyhedron, other: &Polyhedron) -> [[(f64, f64); 2]; 2] {
    let other = Solid::new(other);
    let area = mesh.area_by_label();
    let mut counts = [[0_usize; 2]; 2];
    let mut upto = [0.0; 2];
    let mut drawn = [0_usize; 2];
    for face in 0..mesh.faces().len() {
        let label = mesh.labels()[face].code() as usize;
        upto[label] += mesh.face_area_m2(face) / area.of(mesh.labels()[face]);
        let [a, b, c] = mesh.corners(face);
        while (drawn[label] as f64) < upto[label] * SAMPLES as f64 {
            let step = |share: f64| (0.5 + share * (drawn[label] + 1) as f64).fract();
            let (mut s, mut t) = (step(0.754_877_666_246_693), step(0.569_840_290_998_053));
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let inside = other.side(&(a + (b - a) * s + (c - a) * t)) == Side::Inside;
            counts[label][usize::from(inside)] += 1;
            drawn[label] += 1;
        }
    }
    [0, 1].map(|label| {
        let whole = area.of(Label::ALL[label]);
        counts[label].map(|count| {
            let share = count as f64 / drawn[label].max(1) as f64;
            let spread = share * (1.0 - share) + 1e-4;
            (whole * share, whole * whole * spread / drawn[label].max(1) as f64)
        })
    })
}

/// How far areas per label are from the estimates, in standard deviations of these; the larger.
fn sigmas(mesh: &Polyhedron, of_a: &Sampled, of_b: &Sampled, operation: Operation) -> f64 {
    let area = mesh.area_by_label();
    let off = |label: Label| {
        let code = label.code() as usize;
        let ([out_a, in_a], [out_b, in_b]) = (of_a[code], of_b[code]);
        let parts: &[(f64, f64)] = match operation {
            Operation::Union => &[out_a, out_b],
            Operation::Intersection => &[in_a, in_b],
            Operation::Difference => &[out_a, in_b],
            Operation::SymmetricDifference => &[out_a, in_a, out_b, in_b],
        };
        let (sum, variance) =
            parts.iter().fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        (area.of(label) - sum).abs() / (variance.sqrt() + 1e-12 * area.total_m2())
    };
    Label::ALL.into_iter().map(off).fold(0.0, f64::max)
}

type Sampled = [[(f64, f64); 2]; 2];

fn main() {
    let mut out = std::io::stdout();
    let mut say = |line: String| writeln!(out, "{line}").expect("stdout takes text");
    say(format!(
        "{:28} {:20} {:>7} {:>7} {:>9} {:>6} {:>9} {:>6} {:>8} {:>8} {:>6}",
        "mesh",
        "operation",
        "faces",
        "of it",
        "manifold",
        "meets",
        "off by",
        "sigmas",
        "engine s",
        "ours s",
        "ratio"
    ));
    // Of the engine's own operations, and of symmetric differences, which are made of them.
    let mut sums = [[0.0; 2]; 2];
    for path in std::env::args().skip(1).filter(|word| word != "--bench") {
        let name = path.rsplit('/').next().unwrap_or(&path);
        let mesh = read(&path);
        let validity = check(&mesh);
        if !(validity.closed && validity.oriented && validity.manifold) {
            say(format!("{name:28} {}", validity.defects[0]));
            continue;
        }
        let a = labelled(if mesh.volume_m3() < 0.0 { mesh.turned_inside_out() } else { mesh });
        let b = moved(&a);
        let (of_a, of_b) = (sampled(&a, &b), sampled(&b, &a));
        for operation in ALL {
            let (mut theirs, mut ours) = (0.0, 0.0);
            let mut found = Polyhedron::empty();
            let runs = FACES.div_ceil(a.faces().len());
            let mut turns = 0;
            while turns < TURNS || theirs < RUN_SECS {
                theirs += secs(|| (0..runs).map(|_| engine(&a, &b, operation)).sum::<usize>()).1;
                let ours_once = || boolean(&a, &b, operation, &Options::default());
                let (done, took) = secs(|| (1..runs).fold(ours_once(), |_, _| ours_once()));
                found = done.expect("sound operands");
                ours += took;
                turns += 1;
            }
            let times = (runs * turns) as f64;
            (theirs, ours) = (theirs / times, ours / times);
            let sum = &mut sums[usize::from(operation == Operation::SymmetricDifference)];
            *sum = [sum[0] + theirs, sum[1] + ours];
            let volume = oracle(&a, &b, operation);
            let off = volume.map_or(f64::NAN, |volume| {
                (found.volume_m3() - volume).abs() / (a.volume_m3() + b.volume_m3())
            });
            say(format!(
                "{name:28} {:20} {:7} {:7} {:>9} {:>6} {off:9.1e} {:6.2} {theirs:8.4} {ours:8.4} {:6.2}",
                operation.name(),
                a.faces().len(),
                found.faces().len(),
                check_topology(&found).is_valid(),
                if validity.self_intersecting {
                    "input"
                } else if crossings(&found, 1).is_empty() {
                    "no"
                } else {
                    "yes"
                },
                sigmas(&found, &of_a, &of_b, operation),
                ours / theirs,
            ));
        }
    }
    for (what, [theirs, ours]) in ["all but symmetric differences", "these"].iter().zip(sums) {
        say(format!("{what}: engine {theirs:.3} s, ours {ours:.3} s, ratio {:.3}", ours / theirs));
    }
}
