//! The config of a sweep over pose graphs: the same work over many inputs.

use std::path::Path;

use serde::Deserialize;
use toml::de::DeTable;

use super::ConfigError;
use super::typed::{self, Checked};

/// A sweep; one table says of what.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// Sweeps over pose graphs.
    pub graph: GraphSweep,
}

/// Sweeps over pose graphs.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GraphSweep {
    /// Robust methods against wrong loop closures.
    pub outliers: OutlierSweep,
}

/// Every method on every graph, with wrong loop closures added.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutlierSweep {
    /// Graph files, relative to `$DRIFTLAB_DATA`; left out where they are not there.
    #[serde(default)]
    pub files: Vec<String>,
    /// Made-up graphs.
    #[serde(default)]
    pub synthetic: Vec<SyntheticGraph>,
    /// What deals with wrong closures, as `driftlab graph optimize --robust` names it.
    pub methods: Vec<String>,
    /// Shares of wrong closures among all closures, above 0 and at most 0.9.
    pub shares: Vec<f64>,
    /// Seeds of the wrong closures: 1 up to this.
    pub seeds: u64,
}

/// A made-up graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SyntheticGraph {
    /// 2D: a random walk with a crossing every two steps, 3500 poses.
    Manhattan,
    /// 2D: long streets, 3000 poses.
    City,
    /// 3D: a spiral from pole to pole, 2500 poses.
    Sphere,
    /// 3D: back and forth through a cube, 1000 poses.
    Lattice,
}

impl SyntheticGraph {
    /// The name in configs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Manhattan => "manhattan",
            Self::City => "city",
            Self::Sphere => "sphere",
            Self::Lattice => "lattice",
        }
    }
}

/// Whether a text is the config of a sweep over pose graphs: it has a table `[graph]` and is no
/// experiment.
pub fn is_graph_sweep(text: &str) -> bool {
    DeTable::parse(text).is_ok_and(|parsed| {
        let table = parsed.get_ref();
        table.contains_key("graph") && !table.contains_key("world") && !table.contains_key("map")
    })
}

impl Sweep {
    /// Reads and checks the config of a sweep.
    ///
    /// # Errors
    /// The first thing wrong, with file, line and column.
    pub fn read(path: &Path) -> Result<Self, ConfigError> {
        typed::read(path)
    }

    /// As [`read`](Self::read), from the text of the file.
    ///
    /// # Errors
    /// As there.
    pub fn from_text(path: &Path, text: &str) -> Result<Self, ConfigError> {
        typed::from_text(path, text)
    }

    /// The key of the first value out of range, what was found and what was expected.
    fn first_fault(&self) -> Option<(&'static str, String, String)> {
        let sweep = &self.graph.outliers;
        let known = || posegraph::Robust::ALL.map(posegraph::Robust::name);
        if sweep.files.is_empty() && sweep.synthetic.is_empty() {
            return Some(("synthetic", "no graph".into(), "a graph here or in `files`".into()));
        }
        if sweep.methods.is_empty() {
            return Some(("methods", "an empty list".into(), "at least one method".into()));
        }
        if let Some(name) = sweep.methods.iter().find(|name| !known().contains(&name.as_str())) {
            return Some((
                "methods",
                format!("{name:?}"),
                format!("some of {}", known().join(", ")),
            ));
        }
        let off = |share: &&f64| !(**share > 0.0 && **share <= 0.9);
        if let Some(share) = sweep.shares.iter().find(off) {
            let expected = "numbers above 0 and at most 0.9";
            return Some(("shares", format!("{share:?}"), expected.into()));
        }
        if sweep.shares.is_empty() {
            return Some(("shares", "an empty list".into(), "at least one share".into()));
        }
        (sweep.seeds == 0).then(|| ("seeds", "0".into(), "a whole number of at least 1".into()))
    }
}

impl Checked for Sweep {
    const WHAT: &'static str = "the TOML config of a sweep";

    fn fault(&self) -> Option<(String, String, String)> {
        let (key, found, expected) = self.first_fault()?;
        Some((format!("graph.outliers.{key}"), found, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "[graph.outliers]\nsynthetic = [\"sphere\"]\nmethods = [\"gnc-tls\"]\n\
                        shares = [0.1]\nseeds = 2\n";

    fn message(text: &str) -> String {
        Sweep::from_text(Path::new("a.toml"), text).expect_err("a mistake").to_string()
    }

    #[test]
    fn a_sweep_is_read() {
        let sweep = Sweep::from_text(Path::new("a.toml"), GOOD).expect("a good config");
        assert_eq!(sweep.graph.outliers.synthetic, [SyntheticGraph::Sphere]);
        assert_eq!(sweep.graph.outliers.seeds, 2);
    }

    #[test]
    fn mistakes_are_told_with_their_line() {
        let unknown = message(&GOOD.replace("seeds", "sedes"));
        assert!(unknown.starts_with("a.toml:5:1: found unknown key"), "{unknown}");
        let method = message(&GOOD.replace("gnc-tls", "ransac"));
        assert!(method.starts_with("a.toml:3:11: found \"ransac\""), "{method}");
        let share = message(&GOOD.replace("0.1", "1.5"));
        assert!(share.starts_with("a.toml:4:10: found 1.5"), "{share}");
        let seeds = message(&GOOD.replace("= 2", "= 0"));
        assert!(seeds.starts_with("a.toml:5:9: found 0"), "{seeds}");
        let none = message(&GOOD.replace("[\"sphere\"]", "[]"));
        assert!(none.starts_with("a.toml:2:13: found no graph"), "{none}");
    }
}
