//! Logs of robots: messages with time stamps, whatever file they come from.
//!
//! A [`Log`] is what every reader of a log ends with: [`Topic`]s, [`Message`]s in the order of the
//! file, and what was damaged. Readers of files that do not fit into memory give the messages one
//! by one instead.

mod message;
mod options;
pub mod plain;
mod reader;
mod scene;
mod stamp;
mod topic;

pub use message::{
    CameraMessage, CloudMessage, Content, Decision, DecisionMessage, DepthMessage, EdgeMessage,
    Header, Message, OdometryMessage, PoseMessage, ScanMessage, StandingMessage, Transform, planar,
    spatial,
};
pub use options::ReadOptions;
pub use reader::{LogReader, Rest};
pub use scene::{EdgeLabel, SceneDot, SceneEntity, SceneLines};
pub use stamp::Stamp;
pub use topic::{ContentKind, Damage, Log, Topic};
