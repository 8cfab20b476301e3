//! The relative map of space: areas, membership, monotony, withdrawal, and the policy's questions.

mod asked;
mod oracle;
mod pairs;
mod scene;
mod ways;
mod withdrawal;
