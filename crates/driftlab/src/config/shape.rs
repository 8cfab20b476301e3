//! Lists in the place of tables: serde takes their entries for the values of the keys, in order.

use serde_json::Value as Json;
use toml::de::{DeTable, DeValue};

use super::ConfigError;
use super::document::join;
use super::explain::with_meaning;
use super::schema::{is_variant_table, properties, resolved, schema};
use super::source::Sources;

/// Refuses the first list that stands where a table belongs.
///
/// # Errors
/// The place of the list, and the key.
pub(super) fn no_list_for_a_table(
    document: &DeTable<'_>,
    sources: &Sources,
) -> Result<(), ConfigError> {
    within(document, schema(), "", sources)
}

fn within(
    table: &DeTable<'_>,
    node: &'static Json,
    path: &str,
    sources: &Sources,
) -> Result<(), ConfigError> {
    let known = properties(node);
    for (key, value) in table {
        let Some(property) = known.iter().find(|property| property.key == key.get_ref()) else {
            continue;
        };
        let path = join(path, key.get_ref());
        match value.get_ref() {
            DeValue::Table(inner) => within(inner, property.node, &path, sources)?,
            DeValue::Array(_) if is_table(property.node) => {
                return Err(ConfigError::Value {
                    place: sources.place(value.span()),
                    found: format!("a list for `{path}`"),
                    expected: with_meaning("a table", &path),
                });
            }
            _ => {}
        }
    }
    Ok(())
}

fn is_table(node: &'static Json) -> bool {
    resolved(node).get("properties").is_some() || is_variant_table(node)
}
