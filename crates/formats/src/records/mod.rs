//! What readers of recorded files share: bytes as they come, packed chunks, and channels.

mod channels;
mod parts;
mod source;
mod unpack;

pub(crate) use channels::{Channels, NewChannel};
pub(crate) use parts::Parts;
pub(crate) use source::{Source, Stopped};
pub(crate) use unpack::{MAX_UNPACKED, Packing, Unpacker};
