//! Folders of depth images with the poses that they were taken from.
//!
//! | kind | images | poses | camera | units per metre |
//! |---|---|---|---|---|
//! | 7-Scenes, TSDF fusion | `frame-N.depth.png` | `frame-N.pose.txt`, 4 by 4, one for each | `camera-intrinsics.txt` | 1000 |
//! | TUM RGB-D | named by `depth.txt`, or by time in `depth/` | `groundtruth.txt`, with times | | 5000 |
//! | numbered | `depth_N.*`, `N_depth.*`, `depth/N.*` | `pose.txt`, `poses.txt` or `trajectory.txt`, one line for each in order; by number where images are missing | `camera-intrinsics.txt` | 1000, or 5000 for `N_depth.*` |
//!
//! All poses are those of the camera in one global frame, z ahead, y down. A pose that is not one (some
//! 7-Scenes poses are NaN) leaves its image out; so does a pose file of its own that cannot be understood, and
//! in a TUM folder a time that no pose is near enough to. All are told. The last line of a file of poses may be cut. A folder without any poses has its images at one place, told too.
//!
//! Nothing here opens a file: the caller lists names and reads bytes.

mod names;
mod numbered;
mod poses;
mod seven_scenes;
mod tum;

use std::io;

use pose::Se3;
use sensing::Camera;

use crate::FormatError;

/// How images and poses lie in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FolderKind {
    /// A pose file beside each image.
    SevenScenes,
    /// Images and poses with times.
    Tum,
    /// Images with numbers, poses in the same order.
    Numbered,
}

impl FolderKind {
    /// Its name, for messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SevenScenes => "7-Scenes",
            Self::Tum => "TUM RGB-D",
            Self::Numbered => "numbered",
        }
    }
}

/// One depth image of a folder.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthFrame {
    /// The image, relative to the folder.
    pub file: String,
    /// When it was taken, seconds; where nothing says so, the frames count them.
    pub stamp_secs: f64,
    /// The camera in the frame of the folder's poses.
    pub map_from_camera: Se3,
}

/// A folder of depth images.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthFolder {
    /// How it was laid out.
    pub kind: FolderKind,
    /// The images that have a pose, in order of time or number.
    pub frames: Vec<DepthFrame>,
    /// The camera, where a file tells it.
    pub camera: Option<Camera>,
    /// Levels of an image per metre, as such folders usually count.
    pub units_per_metre: f64,
    /// What was left out or taken for granted, one line each.
    pub warnings: Vec<String>,
}

/// Why a folder is not one of depth images.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DepthFolderError {
    /// A file of it could not be understood.
    #[error("{file}: {error}")]
    File {
        /// The file, relative to the folder.
        file: String,
        /// What is wrong with it.
        error: FormatError,
    },
    /// A file of it could not be read.
    #[error("{file}: cannot be read ({reason})")]
    Unreadable {
        /// The file, relative to the folder.
        file: String,
        /// What the system said.
        reason: io::Error,
    },
    /// There are fewer poses than images.
    #[error("{file}: found {found} poses, expected {expected}, one for each depth image")]
    TooFewPoses {
        /// The file of the poses.
        file: String,
        /// Poses in it.
        found: usize,
        /// Depth images in the folder.
        expected: usize,
    },
    /// No image is there, or none that has a pose.
    #[error(
        "found {found}, expected depth images with poses: frame-N.depth.png beside frame-N.pose.txt \
         (7-Scenes), depth.txt beside groundtruth.txt (TUM RGB-D), or depth_N.pgm beside pose.txt"
    )]
    NoFrames {
        /// What was found instead.
        found: String,
    },
}

/// What a folder holds: names, relative to it and with `/`, of its files and of those in the folders in it.
pub struct Listing<'a> {
    /// The names, in any order.
    pub names: Vec<String>,
    /// Reads a file.
    pub read: &'a dyn Fn(&str) -> io::Result<Vec<u8>>,
}

impl Listing<'_> {
    fn has(&self, name: &str) -> bool {
        self.names.iter().any(|known| known == name)
    }

    fn bytes(&self, name: &str) -> Result<Vec<u8>, DepthFolderError> {
        (self.read)(name)
            .map_err(|reason| DepthFolderError::Unreadable { file: name.to_owned(), reason })
    }

    /// Reads a file and makes something of it.
    fn parsed<T>(
        &self,
        name: &str,
        parse: impl FnOnce(&[u8]) -> Result<T, FormatError>,
    ) -> Result<T, DepthFolderError> {
        let bytes = self.bytes(name)?;
        parse(&bytes).map_err(|error| DepthFolderError::File { file: name.to_owned(), error })
    }

    /// The camera that a file of its matrix tells.
    fn camera(&self) -> Result<Option<Camera>, DepthFolderError> {
        const FILE: &str = "camera-intrinsics.txt";
        self.has(FILE).then(|| self.parsed(FILE, poses::camera)).transpose()
    }
}

/// Finds the images and poses of a folder; no image is opened.
///
/// # Errors
/// [`DepthFolderError`] with the file that is wrong.
pub fn read(listing: &Listing<'_>) -> Result<DepthFolder, DepthFolderError> {
    let folder = if let Some(folder) = seven_scenes::read(listing)? {
        folder
    } else if let Some(folder) = tum::read(listing)? {
        folder
    } else {
        numbered::read(listing)?
    };
    if folder.frames.is_empty() {
        let found = match folder.warnings.first() {
            Some(first) => format!("no depth image with a pose ({first})"),
            None => format!("{} files, none of them a depth image", listing.names.len()),
        };
        return Err(DepthFolderError::NoFrames { found });
    }
    Ok(folder)
}
