//! What a sweep varies: the table `[sweep]` of an experiment.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What `driftlab sweep` varies; nobody else asks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RunSweep {
    /// Runs of each combination, with the seeds `seed`, `seed` + 1, and so on.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub seeds: u64,
    /// Keys of this config, each with the list of the values that it takes. Every combination is
    /// run; rows come in the order of the alphabet by key, then in the order of the values.
    #[schemars(with = "BTreeMap<String, Vec<serde_json::Value>>")]
    pub axes: Axes,
}

impl Default for RunSweep {
    fn default() -> Self {
        Self { seeds: 10, axes: Axes::default() }
    }
}

/// Keys and the values that each takes, in the order of the alphabet by key.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axes(BTreeMap<String, Vec<toml::Value>>);

impl Axes {
    /// Each key with its values, of which there is at least one.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[toml::Value])> {
        self.0.iter().map(|(key, values)| (key.as_str(), values.as_slice()))
    }
}

impl<const N: usize> From<[(&str, Vec<toml::Value>); N]> for Axes {
    fn from(axes: [(&str, Vec<toml::Value>); N]) -> Self {
        Self(axes.into_iter().map(|(key, values)| (key.to_owned(), values)).collect())
    }
}

impl Serialize for Axes {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(out)
    }
}

impl<'de> Deserialize<'de> for Axes {
    /// Quoted keys, and dotted ones, which TOML reads as tables in tables.
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        let mut axes = BTreeMap::new();
        let table = toml::Table::deserialize(input)?;
        flatten(table, "", &mut axes).map_err(D::Error::custom)?;
        Ok(Self(axes))
    }
}

/// Whether two values are the same; a whole number is, whether it has a point or not.
fn is_same(a: &toml::Value, b: &toml::Value) -> bool {
    let number = |value: &toml::Value| value.as_float().or(value.as_integer().map(|i| i as f64));
    a == b || number(a).is_some_and(|a| number(b) == Some(a))
}

fn flatten(
    table: toml::Table,
    prefix: &str,
    axes: &mut BTreeMap<String, Vec<toml::Value>>,
) -> Result<(), String> {
    for (key, value) in table {
        let path = super::document::join(prefix, &key);
        match value {
            toml::Value::Table(inner) => flatten(inner, &path, axes)?,
            toml::Value::Array(values) if values.is_empty() => {
                return Err(format!("an empty list for `{path}`, expected at least one value"));
            }
            toml::Value::Array(values) => {
                // Each run would be counted as often.
                let is_known = |at: usize| values[..at].iter().any(|v| is_same(v, &values[at]));
                if let Some(at) = (1..values.len()).find(|&at| is_known(at)) {
                    let twice = &values[at];
                    return Err(format!("{twice} twice for `{path}`, expected each value once"));
                }
                if axes.insert(path.clone(), values).is_some() {
                    return Err(format!("the axis `{path}` twice, expected each key once"));
                }
            }
            other => {
                return Err(format!("{other} for the axis `{path}`, expected a list of values"));
            }
        }
    }
    Ok(())
}
