//! `driftlab graph info`: what a graph holds, and how well it is posed.

use std::collections::BTreeMap;

use formats::pose_graph::AnyGraph;
use pose::nalgebra::DMatrix;
use posegraph::initial::{Components, given};
use posegraph::{ErrorKind, FactorGraph, Manifold, factors::chi2};
use serde_json::{Value, json};

use super::super::failure::Failure;
use super::super::out::Out;
use super::args::InfoArgs;
use super::input;
use super::numbers::{listed, shown};

pub(super) fn info(args: &InfoArgs, out: &Out) -> Result<(), Failure> {
    let input::Timed { read: file, secs } = input::graph(&args.file, out)?;
    let facts = match &file.graph {
        AnyGraph::Plane(graph) => Facts::of(graph),
        AnyGraph::Space(graph) => Facts::of(graph),
    };
    let (unknown_tags, warnings) = input::report_json(&file.report);
    let mut json = facts.to_json();
    json["file"] = args.file.display().to_string().into();
    json["format"] = file.report.format.name().into();
    json["dimensions"] = file.graph.dimensions().into();
    json["unknown_tags"] = unknown_tags;
    json["warnings"] = warnings;
    json["secs_read"] = secs.into();
    let head = format!(
        "{}: {} in {}D\n\n",
        args.file.display(),
        file.report.format.name(),
        file.graph.dimensions()
    );
    out.result(&json, &(head + &facts.to_text()))
}

/// Smallest, middle and largest of some numbers.
#[derive(Default)]
struct Spread {
    min: f64,
    median: f64,
    max: f64,
}

impl Spread {
    fn of(mut numbers: Vec<f64>) -> Option<Self> {
        numbers.sort_unstable_by(f64::total_cmp);
        let (min, max) = (*numbers.first()?, *numbers.last()?);
        Some(Self { min, median: numbers[numbers.len() / 2], max })
    }

    fn to_json(&self) -> Value {
        json!({ "min": self.min, "median": self.median, "max": self.max })
    }
}

struct Facts {
    poses: usize,
    poses_given: usize,
    fixed: usize,
    edges: usize,
    odometry_edges: usize,
    parallel_edges: usize,
    components: usize,
    largest_component: usize,
    degree: Option<Spread>,
    length_m: f64,
    degrees_of_freedom: i64,
    chi2_of_file: Option<f64>,
    indefinite: usize,
    smallest_eigenvalue: f64,
    largest_eigenvalue: f64,
    /// Largest over smallest eigenvalue of each positive definite matrix.
    condition: Option<Spread>,
}

impl Facts {
    fn of<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Self {
        let poses = graph.ids.len();
        let pairs = graph.factors.iter().map(|factor| (factor.from, factor.to));
        let components = Components::new(poses, pairs.clone());
        let mut sizes = vec![0; components.count()];
        for &component in components.of() {
            sizes[component] += 1;
        }
        let mut degree = vec![0.0; poses];
        let mut between: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (from, to) in pairs {
            degree[from] += 1.0;
            degree[to] += 1.0;
            *between.entry((from.min(to), from.max(to))).or_default() += 1;
        }
        let poses_given = graph.initial.iter().flatten().count();
        let complete = poses_given == poses && poses > 0;
        // The first edge between each pose and the next, whichever way it points.
        let mut steps = vec![None; poses];
        for factor in graph.factors.iter().filter(|f| f.from.abs_diff(f.to) == 1) {
            let step = &mut steps[factor.from.min(factor.to)];
            step.get_or_insert_with(|| length(&factor.from_from_to));
        }
        let conditioning = Conditioning::of(graph);
        Self {
            poses,
            poses_given,
            fixed: graph.fixed.len(),
            edges: graph.factors.len(),
            odometry_edges: between.keys().filter(|(a, b)| a + 1 == *b).count(),
            parallel_edges: graph.factors.len() - between.len(),
            components: components.count(),
            largest_component: sizes.into_iter().max().unwrap_or(0),
            degree: Spread::of(degree),
            length_m: steps.into_iter().flatten().fold(0.0, |sum, step| sum + step),
            degrees_of_freedom: D as i64
                * (graph.factors.len() as i64 - poses as i64 + components.count() as i64),
            chi2_of_file: complete.then(|| chi2(graph, &given(graph), ErrorKind::G2o)),
            indefinite: conditioning.indefinite,
            smallest_eigenvalue: conditioning.smallest,
            largest_eigenvalue: conditioning.largest,
            condition: Spread::of(conditioning.numbers),
        }
    }

    fn to_json(&self) -> Value {
        json!({
            "poses": self.poses,
            "poses_given": self.poses_given,
            "fixed": self.fixed,
            "edges": self.edges,
            "odometry_edges": self.odometry_edges,
            "loop_closures": self.edges - self.odometry_edges,
            "parallel_edges": self.parallel_edges,
            "components": self.components,
            "largest_component": self.largest_component,
            "degree": self.degree.as_ref().map(Spread::to_json),
            "degrees_of_freedom": self.degrees_of_freedom,
            "odometry_length_m": self.length_m,
            "chi2": self.chi2_of_file,
            "information": {
                "indefinite": self.indefinite,
                "eigenvalue_min": self.smallest_eigenvalue,
                "eigenvalue_max": self.largest_eigenvalue,
                "condition": self.condition.as_ref().map(Spread::to_json),
            },
        })
    }

    fn to_text(&self) -> String {
        let spread = |spread: &Option<Spread>| {
            spread.as_ref().map_or("-".to_owned(), |s| {
                format!("{} to {}, median {}", shown(s.min), shown(s.max), shown(s.median))
            })
        };
        let chi2 = match (self.chi2_of_file, self.poses_given) {
            (Some(chi2), _) => shown(chi2),
            (None, 0) => "- (the file has edges only)".to_owned(),
            (None, given) => format!("- ({} poses have no line)", self.poses - given),
        };
        listed(&[
            (
                "poses",
                format!("{} ({} with a line, {} held)", self.poses, self.poses_given, self.fixed),
            ),
            (
                "edges",
                format!(
                    "{} ({} from one pose to the next, {} loop closures, {} parallel to another)",
                    self.edges,
                    self.odometry_edges,
                    self.edges - self.odometry_edges,
                    self.parallel_edges
                ),
            ),
            (
                "components",
                format!("{}, the largest of {} poses", self.components, self.largest_component),
            ),
            ("edges per pose", spread(&self.degree)),
            ("degrees of freedom", self.degrees_of_freedom.to_string()),
            ("odometry", format!("{} m", shown(self.length_m))),
            ("chi2 of the file", chi2),
            (
                "information",
                format!(
                    "eigenvalues {} to {}, {} of {} matrices not positive definite",
                    shown(self.smallest_eigenvalue),
                    shown(self.largest_eigenvalue),
                    self.indefinite,
                    self.edges
                ),
            ),
            ("condition numbers", spread(&self.condition)),
        ])
    }
}

/// Length of the translation of a measurement, metres.
fn length<P: Manifold<D>, const D: usize>(motion: &P) -> f64 {
    // The first numbers of the error from the identity are the translation, in every dimension.
    let identity = P::identity();
    let error = P::error(ErrorKind::G2o, &identity, &identity, motion);
    let translation = if D == 3 { 2 } else { 3 };
    error.iter().take(translation).map(|x| x * x).sum::<f64>().sqrt()
}

/// Eigenvalues of the information matrices.
struct Conditioning {
    indefinite: usize,
    smallest: f64,
    largest: f64,
    numbers: Vec<f64>,
}

impl Conditioning {
    fn of<P: Manifold<D>, const D: usize>(graph: &FactorGraph<P, D>) -> Self {
        let mut all = Self {
            indefinite: 0,
            smallest: f64::INFINITY,
            largest: f64::NEG_INFINITY,
            numbers: Vec::with_capacity(graph.factors.len()),
        };
        // Most files repeat one matrix.
        let mut known = None;
        for factor in &graph.factors {
            let (low, high) = match known {
                Some((matrix, ends)) if matrix == factor.information => ends,
                _ => {
                    let matrix = DMatrix::from_fn(D, D, |row, column| {
                        f64::midpoint(
                            factor.information[(row, column)],
                            factor.information[(column, row)],
                        )
                    });
                    let values = matrix.symmetric_eigenvalues();
                    let ends = (values.min(), values.max());
                    known = Some((factor.information, ends));
                    ends
                }
            };
            (all.smallest, all.largest) = (all.smallest.min(low), all.largest.max(high));
            if factor.information.cholesky().is_none() {
                all.indefinite += 1;
            } else if low > 0.0 {
                all.numbers.push(high / low);
            }
        }
        if graph.factors.is_empty() {
            (all.smallest, all.largest) = (0.0, 0.0);
        }
        all
    }
}
