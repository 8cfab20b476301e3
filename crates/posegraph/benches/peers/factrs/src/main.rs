//! Optimises a g2o file with factrs' Gauss-Newton: run_factrs IN OUT; prints one line of JSON.

use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write};

use cpu_time::ProcessTime;
use factrs::assign_symbols;
use factrs::core::{GaussNewton, SE2, SE3};
use factrs::optimizers::BaseOptParams;
use factrs::traits::Optimizer;
use factrs::utils::load_g20;

assign_symbols!(X: SE2, SE3);

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = std::env::args().skip(1);
    let (Some(source), Some(target)) = (paths.next(), paths.next()) else {
        return Err("run_factrs IN OUT".into());
    };
    let (graph, start) = load_g20(&source);
    let options = BaseOptParams {
        max_iterations: 100,
        error_tol_relative: 1e-6,
        error_tol_absolute: 1e-6,
        error_tol: 0.0,
    };
    let clock = ProcessTime::now();
    let mut optimizer = GaussNewton::new(options, graph);
    let poses = optimizer.optimize(start).map_err(|_| "factrs failed")?;
    let secs = clock.elapsed().as_secs_f64();
    let mut out = BufWriter::new(File::create(target)?);
    let plane = poses.filter::<SE2>().count() > 0;
    for id in 0..poses.len() as u32 {
        if plane {
            let pose: &SE2 = poses.get(X(id)).ok_or("a pose is missing")?;
            writeln!(out, "VERTEX_SE2 {id} {} {} {}", pose.x(), pose.y(), pose.theta())?;
        } else {
            let pose: &SE3 = poses.get(X(id)).ok_or("a pose is missing")?;
            let (t, q) = (pose.xyz(), pose.rot());
            writeln!(
                out,
                "VERTEX_SE3:QUAT {id} {} {} {} {} {} {} {}",
                t[0], t[1], t[2], q.x(), q.y(), q.z(), q.w()
            )?;
        }
    }
    out.flush()?;
    println!("{{\"secs\": {secs}}}");
    Ok(())
}
