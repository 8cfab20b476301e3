//! Limits that a key has by its unit, where its type names none: they keep slips of the keyboard
//! (`1e300`, a cell of a nanometre) from starting a run that cannot end.

use serde_json::{Map, Value, json};

/// The longest length that makes sense here, metres.
const LENGTH_MOST_M: f64 = 1e6;
/// The shortest length that must not be zero, metres.
const LENGTH_LEAST_M: f64 = 1e-6;
/// How far from the origin a coordinate may be, metres: maps in UTM coordinates are read as well.
const COORDINATE_MOST_M: f64 = 1e8;
/// The widest angle, degrees.
const ANGLE_MOST_DEG: f64 = 360.0;
/// The narrowest angle that must not be zero, degrees.
const ANGLE_LEAST_DEG: f64 = 1e-6;

/// Gives every number in a schema whose key ends in a unit the limits of that unit.
///
/// A limit that the type names stays. Above 0 becomes at least the smallest value that makes sense.
pub(super) fn limit_by_unit(node: &mut Value) {
    match node {
        Value::Object(map) => {
            if let Some(Value::Object(properties)) = map.get_mut("properties") {
                for (key, property) in properties.iter_mut() {
                    if let Value::Object(property) = property {
                        limit(key, property);
                    }
                }
            }
            map.values_mut().for_each(limit_by_unit);
        }
        Value::Array(items) => items.iter_mut().for_each(limit_by_unit),
        _ => {}
    }
}

fn limit(key: &str, property: &mut Map<String, Value>) {
    let (least, most, coordinate) = if key.ends_with("_m") {
        (LENGTH_LEAST_M, LENGTH_MOST_M, COORDINATE_MOST_M)
    } else if key.ends_with("_deg") {
        (ANGLE_LEAST_DEG, ANGLE_MOST_DEG, ANGLE_MOST_DEG)
    } else {
        return;
    };
    // A list of lengths: each of them.
    let node = match property.get_mut("items") {
        Some(Value::Object(items)) => items,
        _ => property,
    };
    let signed = !node.contains_key("minimum") && !node.contains_key("exclusiveMinimum");
    if node.get("exclusiveMinimum").and_then(Value::as_f64) == Some(0.0) {
        node.remove("exclusiveMinimum");
        node.insert("minimum".into(), json!(least));
    }
    if signed {
        node.insert("minimum".into(), json!(-coordinate));
    }
    if !node.contains_key("maximum") {
        node.insert("maximum".into(), json!(if signed { coordinate } else { most }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_give_limits_and_named_ones_stay() {
        let mut schema = json!({ "properties": {
            "step_m": { "type": "number", "exclusiveMinimum": 0.0 },
            "gap_m": { "type": "number", "minimum": 0.0, "maximum": 2.0 },
            "x_m": { "type": "number" },
            "clearances_m": { "type": "array", "items": { "type": "number", "minimum": 0.0 } },
            "share": { "type": "number" },
        }});
        limit_by_unit(&mut schema);
        let expected = json!({ "properties": {
            "step_m": { "type": "number", "minimum": 1e-6, "maximum": 1e6 },
            "gap_m": { "type": "number", "minimum": 0.0, "maximum": 2.0 },
            "x_m": { "type": "number", "minimum": -1e8, "maximum": 1e8 },
            "clearances_m": {
                "type": "array",
                "items": { "type": "number", "minimum": 0.0, "maximum": 1e6 },
            },
            "share": { "type": "number" },
        }});
        assert_eq!(schema, expected);
    }

    #[test]
    fn no_number_of_a_config_is_unbounded() {
        fn walk(node: &Value, path: &str, open: &mut Vec<String>) {
            let is_float = match &node["type"] {
                Value::String(kind) => kind == "number",
                Value::Array(kinds) => kinds.contains(&json!("number")),
                _ => false,
            };
            // Corners of polygons are checked with the world that they make.
            if is_float
                && node.get("maximum").is_none()
                && !path.contains("outline")
                && !path.contains("blocks")
            {
                open.push(path.to_owned());
            }
            match node {
                Value::Object(map) => {
                    map.iter().for_each(|(key, child)| walk(child, &format!("{path}/{key}"), open));
                }
                Value::Array(items) => items.iter().for_each(|child| walk(child, path, open)),
                _ => {}
            }
        }
        let mut open = Vec::new();
        walk(super::super::schema(), "", &mut open);
        assert_eq!(open, Vec::<String>::new());
    }
}
