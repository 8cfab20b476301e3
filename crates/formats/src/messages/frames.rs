//! Names of frames, each kept once.

use std::sync::Arc;

/// The most names that are kept; further ones are still told, each in memory of its own.
const KEPT: usize = 64;

/// The names of frames that were met.
#[derive(Debug, Default)]
pub(crate) struct Frames {
    names: Vec<Arc<str>>,
}

impl Frames {
    /// The name, without the slash that older messages put before it.
    pub(crate) fn name(&mut self, name: &str) -> Arc<str> {
        let name = name.strip_prefix('/').unwrap_or(name);
        if let Some(kept) = self.names.iter().find(|kept| ***kept == *name) {
            return Arc::clone(kept);
        }
        let new: Arc<str> = name.into();
        if self.names.len() < KEPT {
            self.names.push(Arc::clone(&new));
        }
        new
    }
}
