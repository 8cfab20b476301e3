//! `driftlab config`: the resolved config, the defaults, the schema.

use serde_json::json;

use super::args::{ConfigArgs, ConfigCommand, ConfigInput};
use super::failure::Failure;
use super::out::Out;
use crate::config::{
    Loaded, Overrides, defaults_toml, origins, resolved_toml, schema, world_kind_of_file,
};

pub(super) fn config(args: &ConfigArgs, out: &Out) -> Result<(), Failure> {
    match &args.command {
        ConfigCommand::Show(input) => {
            let loaded = load(input, out)?;
            let config = serde_json::to_value(&loaded.config).map_err(Failure::work)?;
            let origins = origins(&loaded);
            out.result(&json!({ "config": config, "origins": origins }), &resolved_toml(&loaded))
        }
        ConfigCommand::Defaults => {
            let text = defaults_toml();
            let table: toml::Table = text.parse().map_err(Failure::work)?;
            out.result(&json!(table), &text)
        }
        ConfigCommand::Schema => {
            let mut text = serde_json::to_string_pretty(schema()).map_err(Failure::work)?;
            text.push('\n');
            out.result(schema(), &text)
        }
    }
}

/// Reads a config with what the command line lays over it.
pub(super) fn load(input: &ConfigInput, out: &Out) -> Result<Loaded, Failure> {
    let world = match &input.world {
        Some(file) => Some((file.clone(), world_kind_of_file(file)?)),
        None => None,
    };
    let overrides = Overrides { sets: input.sets.clone(), world };
    let loaded = Loaded::read(&input.config, &overrides)?;
    loaded.notes().iter().for_each(|note| out.note(&format!("note: {note}")));
    Ok(loaded)
}
