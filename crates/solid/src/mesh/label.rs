//! What a face is, and where it came from.

use std::fmt;

/// What a face of a free volume is; the words are those of the plane.
///
/// The order is the rule for faces that coincide: of two, the smaller label wins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Label {
    /// Something stands there.
    Obstacle = 0,
    /// Nobody looked beyond.
    Frontier = 1,
}

impl Label {
    /// All labels, in order.
    pub const ALL: [Self; 2] = [Self::Obstacle, Self::Frontier];

    /// The label's word, in small letters.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Obstacle => "obstacle",
            Self::Frontier => "frontier",
        }
    }

    /// The label that a number in a file stands for: 0 obstacle, 1 frontier.
    pub const fn from_code(code: u8) -> Option<Self> {
        match code {
            0 => Some(Self::Obstacle),
            1 => Some(Self::Frontier),
            _ => None,
        }
    }

    /// The number that stands for the label in files.
    pub const fn code(self) -> u8 {
        self as u8
    }
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The face of a view from which a face came.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Origin {
    /// The view; whoever makes views numbers them.
    pub view: u32,
    /// The face of that view.
    pub face: u32,
}
