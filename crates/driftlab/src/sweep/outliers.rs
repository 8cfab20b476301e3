//! Robust methods against wrong loop closures.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use formats::FormatError;
use formats::pose_graph::{AnyGraph, read};
use pose::{Se2, Se3};
use posegraph::initial::odometry;
use posegraph::synchronize::Rigid;
use posegraph::synthetic::{Lattice, Sphere, city, lattice, manhattan, sphere, with_outliers};
use posegraph::{FactorGraph, Options, Robust, default_start, optimize_robust};
use probe::Off;

use super::job::{Job, Outcome, Plan};
use crate::config::{OutlierSweep, SyntheticGraph};
use crate::run::Input;
use crate::stopwatch::Stopwatch;
use crate::table::Cell;

/// A graph file that is not what it should be.
#[derive(Debug, thiserror::Error)]
#[error("{}: {reason}", path.display())]
pub struct GraphFileError {
    /// The file.
    pub path: PathBuf,
    /// What the reader said.
    pub reason: FormatError,
}

/// An outlier sweep, ready to run.
pub(crate) struct Outliers {
    /// Its jobs: every method on every graph, share and seed.
    pub(crate) plan: Plan,
    /// Files that are not there; their jobs are left out.
    pub(crate) missing: Vec<String>,
    graphs: Vec<Option<Graph>>,
    methods: Vec<Robust>,
    shares: Vec<f64>,
    seeds: u64,
}

/// A graph without wrong closures.
struct Graph {
    name: String,
    source: Source,
    /// Made when the first job asks for it.
    clean: OnceLock<Clean>,
}

enum Source {
    Made(SyntheticGraph),
    File(AnyGraph),
}

/// A graph with its optimum.
enum Clean {
    Plane(FactorGraph<Se2, 3>, Vec<Se2>),
    Space(FactorGraph<Se3, 6>, Vec<Se3>),
}

impl Outliers {
    /// Reads the graph files; `data` is their folder.
    ///
    /// # Errors
    /// A file that is there and cannot be read as a graph.
    pub(crate) fn new(
        name: &str,
        sweep: &OutlierSweep,
        data: Option<&Path>,
    ) -> Result<Self, GraphFileError> {
        let mut graphs: Vec<Option<Graph>> = Vec::new();
        let mut missing = Vec::new();
        let mut parts = vec![format!("{sweep:?}")];
        for &made in &sweep.synthetic {
            let name = format!("{} (made up)", made.name());
            let source = Source::Made(made);
            graphs.push(Some(Graph { name, source, clean: OnceLock::new() }));
        }
        for file in &sweep.files {
            let path = data.map(|data| data.join(file));
            let Some((path, Ok(bytes))) = path.map(|path| (path.clone(), std::fs::read(&path)))
            else {
                missing.push(file.clone());
                graphs.push(None);
                continue;
            };
            parts.push(Input::new(Path::new(file), &bytes).sha256);
            let graph = read(&bytes).map_err(|reason| GraphFileError { path, reason })?.graph;
            let name = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
            let source = Source::File(graph);
            graphs.push(Some(Graph { name: name.into_owned(), source, clean: OnceLock::new() }));
        }
        let methods: Vec<Robust> = (sweep.methods.iter())
            .filter_map(|name| Robust::ALL.into_iter().find(|robust| robust.name() == name))
            .collect();
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        let plan = Plan { name: name.to_owned(), identity: Plan::identity(&parts), jobs: vec![] };
        let (shares, seeds) = (sweep.shares.clone(), sweep.seeds);
        let mut sweep = Self { plan, missing, graphs, methods, shares, seeds };
        sweep.plan.jobs = sweep.jobs();
        Ok(sweep)
    }

    /// Every job of the graphs that are there; numbers count those of missing graphs, too.
    fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for number in 0..self.graphs.len() * self.per_graph() {
            let (graph, share, seed, method) = self.parts(number);
            let Some(graph) = graph else { continue };
            let labels = vec![
                ("graph".to_owned(), Cell::Text(graph.name.clone())),
                ("dimension".to_owned(), graph.dimension().into()),
                ("share".to_owned(), share.into()),
                ("seed".to_owned(), seed.into()),
                ("method".to_owned(), method.name().into()),
            ];
            jobs.push(Job { number, labels });
        }
        jobs
    }

    fn per_graph(&self) -> usize {
        self.shares.len() * self.seeds as usize * self.methods.len()
    }

    /// What a job's number stands for: methods count fastest, then seeds, shares, graphs.
    fn parts(&self, number: usize) -> (Option<&Graph>, f64, u64, Robust) {
        let method = self.methods[number % self.methods.len()];
        let rest = number / self.methods.len();
        let seed = (rest as u64 % self.seeds) + 1;
        let rest = rest / self.seeds as usize;
        let share = self.shares[rest % self.shares.len()];
        (self.graphs[rest / self.shares.len()].as_ref(), share, seed, method)
    }

    /// Does one job of the plan.
    pub(crate) fn run(&self, job: &Job) -> Outcome {
        let (graph, share, seed, method) = self.parts(job.number);
        match graph.map(|graph| graph.clean.get_or_init(|| graph.source.clean())) {
            Some(Clean::Plane(graph, poses)) => judged(graph, poses, share, seed, method),
            Some(Clean::Space(graph, poses)) => judged(graph, poses, share, seed, method),
            None => Outcome::default(),
        }
    }
}

impl Graph {
    fn dimension(&self) -> u64 {
        match &self.source {
            Source::Made(SyntheticGraph::Manhattan | SyntheticGraph::City) => 2,
            Source::Made(SyntheticGraph::Sphere | SyntheticGraph::Lattice) => 3,
            Source::File(AnyGraph::Plane(_)) => 2,
            Source::File(AnyGraph::Space(_)) => 3,
        }
    }
}

impl Source {
    fn clean(&self) -> Clean {
        match self {
            Self::Made(SyntheticGraph::Manhattan) => plane(manhattan(3500, 1).graph),
            Self::Made(SyntheticGraph::City) => plane(city(3000, 1).graph),
            Self::Made(SyntheticGraph::Sphere) => space(sphere(&Sphere::default()).graph),
            Self::Made(SyntheticGraph::Lattice) => {
                space(lattice(&Lattice { side: 10, ..Lattice::default() }).graph)
            }
            Self::File(AnyGraph::Plane(graph)) => plane(graph.clone()),
            Self::File(AnyGraph::Space(graph)) => space(graph.clone()),
        }
    }
}

fn plane(graph: FactorGraph<Se2, 3>) -> Clean {
    let poses = default_start(&graph, &Options::default()).solution.poses;
    Clean::Plane(graph, poses)
}

fn space(graph: FactorGraph<Se3, 6>) -> Clean {
    let poses = default_start(&graph, &Options::default()).solution.poses;
    Clean::Space(graph, poses)
}

/// One method on one graph with wrong closures, judged as [`posegraph::synthetic::Judgement`] says.
///
/// `noise_scale` is the variance of the errors in units of what the information matrices say; `secs`
/// are those that the job's thread computed for, where the system tells, else those of the wall.
fn judged<P: Rigid<D>, const D: usize>(
    graph: &FactorGraph<P, D>,
    clean: &[P],
    share: f64,
    seed: u64,
    method: Robust,
) -> Outcome {
    let made = with_outliers(graph, clean, share, seed);
    let clock = Stopwatch::start();
    let start = odometry(&made.graph);
    let found = optimize_robust(&made.graph, &start, method, &Options::default(), &mut Off);
    let spent = clock.spent();
    // Of other work on the machine only the wall clock knows.
    let secs = spent.cpu_secs.unwrap_or(spent.secs);
    let judgement = made.judge(&found, clean);
    let results = vec![
        ("success".to_owned(), judgement.success().into()),
        ("rmse".to_owned(), judgement.rmse.into()),
        ("precision".to_owned(), judgement.precision.into()),
        ("recall".to_owned(), judgement.recall.into()),
        ("wrong".to_owned(), (made.wrong.len() as u64).into()),
        ("rejected".to_owned(), (found.rejected.len() as u64).into()),
        ("noise_scale".to_owned(), found.noise_scale.into()),
        ("iterations".to_owned(), (found.iterations as u64).into()),
    ];
    let timing = vec![("secs".to_owned(), secs.into())];
    Outcome { results: vec![results], timing: vec![timing], curves: vec![] }
}
