//! `driftlab sweep`: the same work over many inputs.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, anyhow};
use serde_json::{Value, json};

use super::args::SweepArgs;
use super::failure::Failure;
use super::out::Out;
use super::progress::Bar;
use crate::config::Sweep;
use crate::sweep::{OutlierRow, SweepError, markdown, outlier_rows, to_csv, to_parquet};

/// The variable that names the folder of real data.
const DATA: &str = "DRIFTLAB_DATA";

pub(super) fn sweep(args: &SweepArgs, out: &Out) -> Result<(), Failure> {
    let sweep = Sweep::read(&args.config)?.graph.outliers;
    let name = args.config.file_stem().unwrap_or_default();
    let dir = args.out.clone().unwrap_or_else(|| PathBuf::from("recordings").join(name));
    let results = dir.join("results.parquet");
    if results.exists() && !args.force {
        let found = results.display();
        return Err(Failure::Input(anyhow!(
            "{found}: found results of an earlier sweep, expected none; --force replaces them"
        )));
    }
    fs::create_dir_all(&dir)
        .with_context(|| format!("{}: cannot be made", dir.display()))
        .map_err(Failure::Work)?;
    let data = std::env::var_os(DATA).map(PathBuf::from);
    let graphs = (sweep.files.len() + sweep.synthetic.len()) as u64;
    let all = graphs * sweep.seeds * (sweep.shares.len() * sweep.methods.len()) as u64;
    let mut bar = Bar::new("sweep", out);
    let mut count = 0;
    let missing = |file: &str| {
        out.note(&format!("warning: {file}: not in the folder that ${DATA} names; left out"));
    };
    let rows = outlier_rows(&sweep, data.as_deref(), missing, |row| {
        count += 1;
        bar.update(count as f64 / all as f64, || format!("{} {}", row.graph, row.method));
        out.detail(&format!(
            "{} {} {} {}: RMSE {:.3} %, precision {:.3}, recall {:.3}, {:.2} s",
            row.graph,
            row.share,
            row.seed,
            row.method,
            100.0 * row.rmse,
            row.precision,
            row.recall,
            row.secs
        ));
    });
    bar.clear();
    let rows = rows.map_err(|error| match error {
        SweepError::Graph { .. } => Failure::Input(error.into()),
        _ => Failure::work(error),
    })?;
    let mut files = vec![("results.parquet", to_parquet(&rows).map_err(Failure::work)?)];
    if args.csv {
        files.push(("results.csv", to_csv(&rows).into_bytes()));
    }
    for (file, bytes) in files {
        let path = dir.join(file);
        fs::write(&path, bytes)
            .with_context(|| format!("{}: cannot be written", path.display()))
            .map_err(Failure::Work)?;
    }
    let rows_json: Vec<Value> = rows.iter().map(told).collect();
    out.result(&json!({ "out": dir.display().to_string(), "rows": rows_json }), &markdown(&rows))
}

fn told(row: &OutlierRow) -> Value {
    json!({
        "graph": row.graph,
        "share": row.share,
        "seed": row.seed,
        "method": row.method,
        "success": row.success,
        "rmse": row.rmse,
        "precision": row.precision,
        "recall": row.recall,
        "wrong": row.wrong,
        "rejected": row.rejected,
        "noise_scale": row.noise_scale,
        "iterations": row.iterations,
        "secs": row.secs,
    })
}
