//! The place of space: one table under `[world3d]`, whose key is the kind of place.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Cave3dWorld, Office3dWorld, Pillars3dWorld, Rooms3dWorld};

/// Which place of space the robot explores.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum World3d {
    /// A mesh file: OBJ, STL, PLY or OFF, closed or a soup.
    Mesh(MeshWorld),
    /// Generated from a seed: rooms on both sides of a corridor, with doors, windows and furniture.
    Rooms(Rooms3dWorld),
    /// Generated from a seed: storeys over each other, joined by stairs.
    Office(Office3dWorld),
    /// Generated from a seed: a hall with pillars and stumps.
    Pillars(Pillars3dWorld),
    /// Generated from a seed: chambers and tunnels with uneven walls.
    Cave(Cave3dWorld),
}

impl World3d {
    /// The key of the variant.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Mesh(_) => "mesh",
            Self::Rooms(_) => "rooms",
            Self::Office(_) => "office",
            Self::Pillars(_) => "pillars",
            Self::Cave(_) => "cave",
        }
    }

    /// The file that the place is read from.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::Mesh(world) => Some(&world.file),
            _ => None,
        }
    }

    /// Puts `base` in front of a relative file name.
    pub fn anchor_file(&mut self, base: &Path) {
        if let Self::Mesh(world) = self {
            world.file = base.join(&world.file);
        }
    }
}

/// Parameters of `[world3d.mesh]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshWorld {
    /// The mesh file, relative to the config; z points up.
    pub file: PathBuf,
    /// Metres per unit of the file.
    #[serde(default = "one")]
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0.0))]
    pub unit_m: f64,
}

impl Default for MeshWorld {
    fn default() -> Self {
        Self { file: PathBuf::new(), unit_m: one() }
    }
}

fn one() -> f64 {
    1.0
}
