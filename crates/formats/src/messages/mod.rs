//! Messages of logs, from the bytes of the encodings that robots write.

mod blocks;
mod decoder;
mod foxglove_json;
mod foxglove_proto;
mod frames;
mod json;
mod own_proto;
mod packed;
pub(crate) mod proto;
mod ros;
pub(crate) mod schemas;
mod wire;
pub(crate) mod write_cdr;
pub(crate) mod write_proto;

pub(crate) use blocks::Malformed;
pub(crate) use decoder::{COPY_OF, Decoder};
pub(crate) use frames::Frames;
