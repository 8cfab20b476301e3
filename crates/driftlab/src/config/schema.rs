//! The JSON Schema of a config, and questions to it.

use std::sync::OnceLock;

use serde_json::Value;

use super::Config;
use super::limits::limit_by_unit;

/// The JSON Schema of a config, draft 2020-12: keys, ranges, and what each means.
pub fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| {
        let mut schema = schemars::schema_for!(Config).to_value();
        unescape(&mut schema);
        limit_by_unit(&mut schema);
        schema
    })
}

/// Takes the backslashes away with which comments keep rustdoc from making links.
fn unescape(node: &mut Value) {
    match node {
        Value::Object(map) => {
            for (key, child) in map {
                match child {
                    Value::String(text) if key == "description" => {
                        *text = text.replace("\\[", "[").replace("\\]", "]");
                    }
                    _ => unescape(child),
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(unescape),
        _ => {}
    }
}

/// The schema behind references and optional values.
pub(super) fn resolved(mut node: &'static Value) -> &'static Value {
    loop {
        let reference = node.get("$ref").and_then(Value::as_str);
        if let Some(target) = reference.and_then(|text| text.strip_prefix("#/$defs/")) {
            node = &schema()["$defs"][target];
            continue;
        }
        let choices = node.get("anyOf").and_then(Value::as_array);
        match choices.and_then(|all| all.iter().find(|one| one["type"] != "null")) {
            Some(choice) => node = choice,
            None => return node,
        }
    }
}

/// One key that a table may hold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Property {
    pub(super) key: &'static str,
    pub(super) node: &'static Value,
    /// What it means; empty if nobody said.
    pub(super) about: &'static str,
}

/// The properties of a table or, for a variant table, those of all its variants.
pub(super) fn properties(node: &'static Value) -> Vec<Property> {
    let node = resolved(node);
    let mut all = Vec::new();
    let mut add = |holder: &'static Value| {
        for (key, node) in holder.get("properties").and_then(Value::as_object).into_iter().flatten()
        {
            let abouts = [described(node), described(holder), described(resolved(node))];
            let about = abouts.into_iter().find(|about| !about.is_empty()).unwrap_or("");
            all.push(Property { key, node, about });
        }
    };
    match node.get("oneOf").and_then(Value::as_array) {
        Some(variants) => variants.iter().for_each(add),
        None => add(node),
    }
    all
}

/// Whether exactly one of the node's properties can be there.
pub(super) fn is_variant_table(node: &'static Value) -> bool {
    let variants = resolved(node).get("oneOf").and_then(Value::as_array);
    variants.is_some_and(|all| all.iter().any(|one| one.get("properties").is_some()))
}

/// The strings that the node allows, where it allows nothing else; each with what it means.
pub(super) fn words(node: &'static Value) -> Vec<(&'static str, &'static str)> {
    let node = resolved(node);
    if let Some(plain) = node.get("enum").and_then(Value::as_array) {
        return plain.iter().filter_map(|word| Some((word.as_str()?, ""))).collect();
    }
    let variants = node.get("oneOf").and_then(Value::as_array).into_iter().flatten();
    variants.filter_map(|one| Some((one["const"].as_str()?, described(one)))).collect()
}

/// The description of a node itself, on one line; empty if it has none.
pub(super) fn described(node: &'static Value) -> &'static str {
    node.get("description").and_then(Value::as_str).unwrap_or("")
}

/// The property at a dotted path.
pub(super) fn property_at(path: &str) -> Option<Property> {
    let mut node = schema();
    let mut last = None;
    for key in path.split('.') {
        let property = properties(node).into_iter().find(|property| property.key == key)?;
        node = property.node;
        last = Some(property);
    }
    last
}

/// What the key at a dotted path means: the first sentence of its description.
pub fn meaning(path: &str) -> Option<String> {
    let text = property_at(path)?.about.replace('\n', " ");
    let end = text.find(". ").unwrap_or(text.len());
    let sentence = text[..end].trim_end_matches('.').trim();
    (!sentence.is_empty()).then(|| sentence.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_says_what_it_means() {
        fn walk(node: &'static Value, path: &str, missing: &mut Vec<String>) {
            for Property { key, node, about } in properties(node) {
                let path = super::super::document::join(path, key);
                if about.is_empty() {
                    missing.push(path.clone());
                }
                walk(node, &path, missing);
            }
        }
        let mut missing = Vec::new();
        walk(schema(), "", &mut missing);
        assert!(missing.is_empty(), "keys without a description: {missing:?}");
    }

    #[test]
    fn a_path_leads_through_variants_and_options() {
        assert!(meaning("world.image.resolution_m").unwrap().contains("pixel"));
        assert!(meaning("map.relative.sliver_m").is_some());
        assert_eq!(meaning("map.nothing"), None);
        let levels = words(property_at("record.level").unwrap().node);
        let levels: Vec<&str> = levels.into_iter().map(|(word, _)| word).collect();
        assert_eq!(levels, ["off", "summary", "full"]);
    }
}
