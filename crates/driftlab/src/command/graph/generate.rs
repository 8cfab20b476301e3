//! `driftlab graph generate`: made-up graphs.

use anyhow::anyhow;
use formats::pose_graph::AnyGraph;
use posegraph::synthetic::{
    Lattice, Noise, Ring, Sphere, Synthetic, Torus, Walk, lattice, ring, sphere, torus, walk,
};
use serde_json::json;

use super::super::failure::Failure;
use super::super::out::Out;
use super::args::{GenerateArgs, Shape};
use super::output::Target;

/// More poses than this are a typing error.
const MAX_POSES: usize = 10_000_000;

pub(super) fn generate(args: &GenerateArgs, out: &Out) -> Result<(), Failure> {
    let target = Target::new(&args.output, args.to, args.force)?;
    let truth = args.truth.as_ref().map(|path| Target::new(path, args.to, args.force));
    let truth = truth.transpose()?;
    if args.poses.is_some_and(|poses| !(2..=MAX_POSES).contains(&poses)) {
        return Err(Failure::Input(anyhow!("--poses: expected 2 to {MAX_POSES}")));
    }
    for (name, value) in [("--noise-m", args.noise_m), ("--noise-deg", args.noise_deg)] {
        if value.is_some_and(|value| !(value.is_finite() && value >= 0.0)) {
            return Err(Failure::Input(anyhow!("{name}: expected a finite number from 0")));
        }
    }
    let noise = |default: Noise| Noise {
        translation_m: args.noise_m.unwrap_or(default.translation_m),
        rotation_rad: args.noise_deg.map_or(default.rotation_rad, f64::to_radians),
    };
    let seed = args.seed;
    let (graph, true_poses) = match args.shape {
        Shape::Sphere => {
            let usual = Sphere::default();
            // As many rounds as poses per round, as in the default.
            let round = args.poses.map_or(usual.rounds, |poses| ceil_root(poses, 2));
            let (rounds, poses_per_round, noise) = (round, round, noise(usual.noise));
            space(sphere(&Sphere { rounds, poses_per_round, noise, seed, ..usual }))
        }
        Shape::Torus => {
            let usual = Torus::default();
            let round =
                args.poses.map_or(usual.poses_per_round, |poses| ceil_root(poses.div_ceil(2), 2));
            let (rounds, poses_per_round, noise) = (2 * round, round, noise(usual.noise));
            space(torus(&Torus { rounds, poses_per_round, noise, seed, ..usual }))
        }
        Shape::Lattice => {
            let usual = Lattice::default();
            let side = args.poses.map_or(usual.side, |poses| ceil_root(poses, 3));
            space(lattice(&Lattice { side, noise: noise(usual.noise), seed, ..usual }))
        }
        Shape::Ring => {
            let usual = Ring::default();
            let poses = args.poses.unwrap_or(usual.poses);
            plane(ring(&Ring { poses, noise: noise(usual.noise), seed, ..usual }))
        }
        shape @ (Shape::Manhattan | Shape::City) => {
            let usual = if shape == Shape::City { Walk::city() } else { Walk::manhattan() };
            let poses = args.poses.unwrap_or(usual.poses);
            plane(walk(&Walk { poses, noise: noise(usual.noise), seed, ..usual }))
        }
    };
    target.write(&graph)?;
    if let Some(truth) = truth {
        truth.write(&true_poses)?;
    }
    let (poses, edges) = (graph.vertices(), graph.edges());
    let file = args.output.display().to_string();
    let text = format!("{file}: {poses} poses, {edges} edges\n");
    out.result(&json!({ "file": file, "poses": poses, "edges": edges, "seed": seed }), &text)
}

/// The smallest number whose power is at least `value`.
fn ceil_root(value: usize, power: u32) -> usize {
    let mut root = (value as f64).powf(1.0 / f64::from(power)).floor() as usize;
    while root.saturating_pow(power) < value {
        root += 1;
    }
    root
}

/// The graph, and the same with its true poses.
fn plane(made: Synthetic<pose::Se2, 3>) -> (AnyGraph, AnyGraph) {
    let mut truth = made.graph.clone();
    truth.initial = made.truth.into_iter().map(Some).collect();
    (AnyGraph::Plane(made.graph), AnyGraph::Plane(truth))
}

/// The graph, and the same with its true poses.
fn space(made: Synthetic<pose::Se3, 6>) -> (AnyGraph, AnyGraph) {
    let mut truth = made.graph.clone();
    truth.initial = made.truth.into_iter().map(Some).collect();
    (AnyGraph::Space(made.graph), AnyGraph::Space(truth))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_rounded_up() {
        assert_eq!((ceil_root(1, 2), ceil_root(2500, 2), ceil_root(2501, 2)), (1, 50, 51));
        assert_eq!((ceil_root(1000, 3), ceil_root(1001, 3)), (10, 11));
    }
}
