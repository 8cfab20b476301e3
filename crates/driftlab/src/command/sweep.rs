//! `driftlab sweep`: the same work over many inputs.

use std::fs;
use std::path::PathBuf;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

use anyhow::anyhow;
use serde_json::{Map, Value, json};

use super::args::{ConfigInput, SweepArgs};
use super::config::load;
use super::failure::Failure;
use super::out::Out;
use super::progress::Bar;
use super::table::table;
use crate::config::{Level, Sweep, is_graph_sweep, plain_toml};
use crate::report::{self, Study, TextTable, groups};
use crate::sweep::{
    Experiments, Folder, Job, Outcome, Outliers, Plan, RunFailure, SweepError, each, file_names,
    markdown,
};
use crate::table::{Cell, Table};

/// The variable that names the folder of real data.
const DATA: &str = "DRIFTLAB_DATA";

pub(super) fn sweep(args: &SweepArgs, out: &Out) -> Result<(), Failure> {
    let text = fs::read_to_string(&args.input.config).unwrap_or_default();
    if is_graph_sweep(&text) { over_graphs(args, out) } else { over_experiments(args, out) }
}

fn over_graphs(args: &SweepArgs, out: &Out) -> Result<(), Failure> {
    let ConfigInput { config, sets, world } = &args.input;
    if !sets.is_empty() || world.is_some() || args.record.is_some() {
        let found = "found --set, --world or --record with a sweep over pose graphs";
        return Err(Failure::Input(anyhow!("{found}, expected none: edit the config")));
    }
    let sweep = Sweep::read(config)?.graph.outliers;
    let name = config.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let data = std::env::var_os(DATA).map(PathBuf::from);
    let outliers = Outliers::new(&name, &sweep, data.as_deref());
    let outliers = outliers.map_err(|error| Failure::Input(error.into()))?;
    for file in &outliers.missing {
        out.note(&format!("warning: {file}: not in the folder that ${DATA} names; left out"));
    }
    let plan = &outliers.plan;
    let Some(folder) = conduct(args, plan, out, |job| Ok(outliers.run(job)))? else {
        return Ok(());
    };
    let [(_, results), (_, timing), _] = folder.tables(plan);
    out.summary(&told(args, plan, &results, &timing), &markdown(&results, &timing))
}

fn over_experiments(args: &SweepArgs, out: &Out) -> Result<(), Failure> {
    let loaded = load(&args.input, out)?;
    if let Some(folder) = &args.record {
        if loaded.config.record.level == Level::Off {
            let hint = "expected record.level \"summary\" or \"full\" with --record";
            return Err(Failure::Input(anyhow!("record.level is \"off\"; {hint}")));
        }
        fs::create_dir_all(folder).map_err(|reason| {
            let hint = "expected a folder for recordings";
            let folder = folder.display();
            Failure::Input(anyhow!("{folder}: cannot be written ({reason}); {hint}"))
        })?;
    }
    let experiments = Experiments::new(&loaded, args.record.clone())?;
    experiments.warnings.iter().for_each(|warning| out.note(&format!("warning: {warning}")));
    let plan = &experiments.plan;
    let Some(folder) = conduct(args, plan, out, |job| Ok(experiments.run(job)?))? else {
        return Ok(());
    };
    let mut config = String::new();
    for line in loaded.header().lines() {
        config.push_str(format!("# {line}").trim_end());
        config.push('\n');
    }
    config.push('\n');
    config.push_str(&plain_toml(&loaded.anchored()).map_err(Failure::work)?);
    folder.write(file_names::CONFIG, config.as_bytes())?;
    let provenance = experiments.provenance().map_err(Failure::work)?;
    folder.write(file_names::PROVENANCE, provenance.as_bytes())?;
    let [(_, results), (_, timing), (_, curves)] = folder.tables(plan);
    let groups = groups(&results, &timing, &curves);
    let study = Study { name: plan.name.clone(), groups, ..Study::default() };
    let TextTable { header, rows, names } = report::results(&study);
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    out.summary(&told(args, plan, &results, &timing), &table(&header, &rows, names))
}

/// The folder of the results.
fn folder_of(args: &SweepArgs, plan: &Plan) -> PathBuf {
    args.out.clone().unwrap_or_else(|| PathBuf::from("recordings").join(&plan.name))
}

/// Does what is left of a plan and writes the tables; `None` where other shards have to end first.
fn conduct(
    args: &SweepArgs,
    plan: &Plan,
    out: &Out,
    work: impl Fn(&Job) -> Result<Outcome, Failure> + Sync,
) -> Result<Option<Folder>, Failure> {
    let dir = folder_of(args, plan);
    let mut folder = Folder::open(&dir, plan, args.shard, args.force)?;
    for other in args.merge.iter().flatten() {
        folder.merge(other, plan)?;
    }
    let left = |folder: &Folder| plan.jobs.iter().filter(|job| !folder.is_done(job)).count();
    if args.merge.is_some() {
        if left(&folder) > 0 {
            let (left, all) = (left(&folder), plan.jobs.len());
            let hint = "run the shards that are missing, or sweep without --merge";
            let dir = dir.display();
            return Err(Failure::Work(anyhow!("{dir}: {left} of {all} jobs are not done; {hint}")));
        }
    } else {
        let mine = |job: &&Job| args.shard.is_none_or(|shard| shard.has(job));
        let todo: Vec<&Job> =
            plan.jobs.iter().filter(mine).filter(|job| !folder.is_done(job)).collect();
        let before = plan.jobs.iter().filter(mine).count() - todo.len();
        if before > 0 {
            out.note(&format!("{before} of {} jobs were done before", before + todo.len()));
        }
        work_on(args, &mut folder, &todo, out, work)?;
    }
    if let (Some(shard), waiting @ 1..) = (args.shard, left(&folder)) {
        let (index, count) = (shard.index, shard.count);
        let text = format!(
            "shard {index} of {count} is done; {waiting} jobs of other shards are not: sweep with \
             --merge when they are\n"
        );
        let json = json!({ "out": dir.display().to_string(), "jobs_left": waiting });
        out.summary(&json, &text)?;
        return Ok(None);
    }
    folder.write_tables(plan, args.csv)?;
    out.note(&format!("wrote {}", dir.display()));
    Ok(Some(folder))
}

fn work_on(
    args: &SweepArgs,
    folder: &mut Folder,
    todo: &[&Job],
    out: &Out,
    work: impl Fn(&Job) -> Result<Outcome, Failure> + Sync,
) -> Result<(), Failure> {
    let cores = available_parallelism().map_or(1, usize::from);
    let threads = args.threads.map_or(cores, usize::from);
    let began = Instant::now();
    let finished = std::cell::Cell::new(0_usize);
    let mut bar = Bar::new("sweep", out);
    let done = |job: &&Job, outcome: Outcome| -> Result<(), Failure> {
        out.detail(&describe(job, &outcome));
        folder.add(job, outcome)?;
        finished.set(finished.get() + 1);
        Ok(())
    };
    let tick = || {
        let (finished, all) = (finished.get(), todo.len());
        bar.update(finished as f64 / all as f64, || {
            format!("{finished} of {all}, {}", time_left(began.elapsed(), finished, all))
        });
    };
    let result = each(todo, threads, |job| work(job), done, tick);
    bar.clear();
    result
}

/// How long the rest takes at the speed so far.
fn time_left(elapsed: Duration, finished: usize, all: usize) -> String {
    if finished == 0 {
        return "no job done yet".to_owned();
    }
    let secs = elapsed.as_secs_f64() / finished as f64 * (all - finished) as f64;
    match secs.round() as u64 {
        secs @ 0..100 => format!("{secs} s left"),
        secs @ 100..6000 => format!("{} min left", secs / 60),
        secs => format!("{} h {} min left", secs / 3600, secs % 3600 / 60),
    }
}

/// A finished job on one line.
fn describe(job: &Job, outcome: &Outcome) -> String {
    let cells = |row: &[(String, Cell)]| {
        let cells = row.iter().map(|(name, cell)| format!("{name} {}", cell.shown()));
        cells.collect::<Vec<_>>().join(", ")
    };
    let rows: Vec<String> = outcome.results.iter().map(|row| cells(row)).collect();
    format!("{}: {}", cells(&job.labels), rows.join("; "))
}

/// The result of a sweep in JSON: its rows, with the times beside what was measured.
fn told(args: &SweepArgs, plan: &Plan, results: &Table, timing: &Table) -> Value {
    let rows = results.rows.iter().zip(&timing.rows).map(|(result, timed)| {
        let cells = |names: &[String], row: &[Cell]| -> Vec<(String, Value)> {
            names.iter().cloned().zip(row.iter().map(Cell::to_json)).collect()
        };
        let mut all = Map::new();
        all.extend(cells(&results.names, result));
        all.extend(cells(&timing.names, timed));
        Value::Object(all)
    });
    let rows: Vec<Value> = rows.collect();
    json!({ "out": folder_of(args, plan).display().to_string(), "rows": rows })
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Contradiction { .. } | SweepError::Table { .. } => Self::work(error),
            _ => Self::Input(error.into()),
        }
    }
}

impl From<RunFailure> for Failure {
    fn from(failure: RunFailure) -> Self {
        match failure {
            RunFailure::Config(error) => error.into(),
            RunFailure::Run(error) => Self::work(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_follows_from_the_speed_so_far() {
        let left = |secs, finished| time_left(Duration::from_secs(secs), finished, 100);
        assert_eq!(left(5, 0), "no job done yet");
        assert_eq!(left(10, 50), "10 s left");
        assert_eq!(left(600, 50), "10 min left");
        assert_eq!(left(7260, 50), "2 h 1 min left");
        assert_eq!(left(7, 100), "0 s left");
    }
}
