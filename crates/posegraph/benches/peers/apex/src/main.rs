//! Optimises a g2o file with apex-solver's Gauss-Newton: run_apex IN OUT; prints one line of JSON.

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};

use apex_solver::JacobianMode;
use apex_solver::apex_io::{G2oLoader, GraphLoader};
use apex_solver::apex_manifolds::ManifoldType;
use apex_solver::core::noise::RepairStrategy;
use apex_solver::core::problem::Problem;
use apex_solver::factors::pose::{BetweenFactor, PriorFactor};
use apex_solver::optimizer::GaussNewton;
use apex_solver::optimizer::gauss_newton::GaussNewtonConfig;
use cpu_time::ProcessTime;
use nalgebra::{DMatrix, dvector};

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = std::env::args().skip(1);
    let (Some(source), Some(target)) = (paths.next(), paths.next()) else {
        return Err("run_apex IN OUT".into());
    };
    let graph = G2oLoader::load(&source)?;
    let plane = !graph.vertices_se2.is_empty();
    let count = if plane { graph.vertices_se2.len() } else { graph.vertices_se3.len() };
    let mut problem = Problem::new(JacobianMode::Sparse);
    let keys: Vec<_> = (0..count)
        .map(|id| {
            if plane {
                let pose = &graph.vertices_se2[&id];
                problem.add_variable(ManifoldType::SE2, dvector![pose.x(), pose.y(), pose.theta()])
            } else {
                let pose = &graph.vertices_se3[&id].pose;
                let (t, q) = (pose.translation(), pose.rotation_quaternion());
                problem.add_variable(ManifoldType::SE3, dvector![t.x, t.y, t.z, q.w, q.i, q.j, q.k])
            }
        })
        .collect();
    // Indefinite matrices are made definite, as the peer itself offers.
    let repair = RepairStrategy::from_name("clamp")?;
    if plane {
        let first = PriorFactor::new(graph.vertices_se2[&0].pose.clone());
        problem.add_residual_block(&keys[..1], Box::new(first), None);
    } else {
        let first = PriorFactor::new(graph.vertices_se3[&0].pose.clone());
        problem.add_residual_block(&keys[..1], Box::new(first), None);
    }
    for edge in &graph.edges_se2 {
        let information = DMatrix::from_column_slice(3, 3, edge.information.as_slice());
        let between = Box::new(BetweenFactor::new(edge.measurement.clone()));
        let ends = [keys[edge.from], keys[edge.to]];
        problem.add_residual_block_with_noise(&ends, between, None, repair.build(information)?.0);
    }
    for edge in &graph.edges_se3 {
        let information = DMatrix::from_column_slice(6, 6, edge.information.as_slice());
        let between = Box::new(BetweenFactor::new(edge.measurement.clone()));
        let ends = [keys[edge.from], keys[edge.to]];
        problem.add_residual_block_with_noise(&ends, between, None, repair.build(information)?.0);
    }
    let config = GaussNewtonConfig::new()
        .with_max_iterations(100)
        .with_cost_tolerance(1e-6)
        .with_parameter_tolerance(1e-8)
        .with_gradient_tolerance(1e-10);
    let clock = ProcessTime::now();
    let found = GaussNewton::with_config(config).optimize(&mut problem)?;
    let secs = clock.elapsed().as_secs_f64();
    let mut out = BufWriter::new(File::create(target)?);
    for (id, key) in keys.iter().enumerate() {
        let v = found.parameters[*key].to_dvector();
        if plane {
            writeln!(out, "VERTEX_SE2 {id} {} {} {}", v[0], v[1], v[2])?;
        } else {
            let [x, y, z, w, i, j, k] = std::array::from_fn(|at| v[at]);
            writeln!(out, "VERTEX_SE3:QUAT {id} {x} {y} {z} {i} {j} {k} {w}")?;
        }
    }
    out.flush()?;
    println!("{{\"secs\": {secs}, \"iterations\": {}}}", found.iterations);
    Ok(())
}
