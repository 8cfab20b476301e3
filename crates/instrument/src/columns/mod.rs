//! Rows held back per entity and sent together as columns: a row costs a push, not a message.

mod growing;
mod labels;
mod lines;
mod numbers;
mod points;
mod poses;
mod send;
mod sleeve;
mod texts;
mod tiles;
mod times;

pub(crate) use growing::Growing;
pub(crate) use labels::Labels;
pub(crate) use lines::Lines;
pub(crate) use numbers::Numbers;
pub(crate) use points::Points;
pub(crate) use poses::{Poses, eye, fixed_pose};
pub(crate) use send::{fixed, send};
pub(crate) use texts::{EventTexts, VARIANT};
pub(crate) use tiles::Tiles;
pub(crate) use times::{Now, Times};

/// Colours as the viewer wants them: red, green, blue, opacity.
pub(crate) type Rgba = u32;

/// The number for a colour that hides what is under it.
pub(crate) const fn rgb(red: u8, green: u8, blue: u8) -> Rgba {
    rgba(red, green, blue, 255)
}

/// The number for a colour of some opacity.
pub(crate) const fn rgba(red: u8, green: u8, blue: u8, opacity: u8) -> Rgba {
    u32::from_be_bytes([red, green, blue, opacity])
}
