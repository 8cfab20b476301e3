//! A folder of depth images as a log: read image by image.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use formats::depth::DepthPixels;
use formats::depth_file::{self, DepthFile, DepthFileOptions};
use formats::depth_folder::{self, DepthFolder, DepthFrame, Listing};
use formats::log::{
    CameraMessage, Content, ContentKind, DepthMessage, Header, Message, PoseMessage, Stamp, Topic,
    plain,
};

use super::LogError;

/// The frame of the camera.
const CAMERA: &str = "camera";

/// Files that a folder may list before it is taken for something else.
const MAX_FILES: usize = 1 << 20;

/// The images of a folder, one after the other.
#[derive(Debug)]
pub(super) struct FolderLog {
    path: PathBuf,
    folder: DepthFolder,
    next: usize,
    topics: Vec<Topic>,
    waiting: Vec<Message>,
    frames: [Arc<str>; 2],
    /// Why images cannot be read, as long as none was.
    refused: Vec<LogError>,
    was_read: bool,
}

impl FolderLog {
    /// Finds the images and poses; no image is opened.
    pub(super) fn open(path: &Path) -> Result<Self, LogError> {
        let unreadable = |reason| LogError::Unreadable { path: path.to_owned(), reason };
        let names = names(path).map_err(unreadable)?;
        let listing = Listing { names, read: &|name| fs::read(path.join(name)) };
        let folder = depth_folder::read(&listing)
            .map_err(|error| LogError::Folder { path: path.to_owned(), error })?;
        let encoding = folder.kind.name();
        let mut topics = vec![
            Topic::new("/depth", "depth image", encoding, Some(ContentKind::Depth)),
            Topic::new("/pose", "pose of the camera", encoding, Some(ContentKind::Pose)),
        ];
        if folder.camera.is_some() {
            topics.push(Topic::new("/camera", "intrinsics", encoding, Some(ContentKind::Camera)));
        }
        let frames = [plain::MAP.into(), CAMERA.into()];
        Ok(Self {
            path: path.to_owned(),
            folder,
            next: 0,
            topics,
            waiting: Vec::new(),
            frames,
            refused: Vec::new(),
            was_read: false,
        })
    }

    pub(super) fn topics(&self) -> &[Topic] {
        &self.topics
    }

    pub(super) fn warnings(&self) -> &[String] {
        &self.folder.warnings
    }

    /// Share of the images that were opened.
    pub(super) fn share(&self) -> f64 {
        self.next as f64 / self.folder.frames.len().max(1) as f64
    }

    /// The next message: of each frame its pose, its camera where that is known, its image.
    pub(super) fn next_message(&mut self) -> Result<Option<Message>, LogError> {
        if self.waiting.is_empty() {
            self.open_next()?;
        }
        let message = self.waiting.pop();
        if let Some(message) = &message {
            self.topics[message.topic].count(message.logged);
        }
        Ok(message)
    }

    /// Reads the next image that can be read; its messages wait in reverse order.
    ///
    /// One that cannot be is left out, and told: a log that broke off has its last one cut. It is an error where
    /// none of the folder can be.
    fn open_next(&mut self) -> Result<(), LogError> {
        while let Some(frame) = self.folder.frames.get(self.next).cloned() {
            self.next += 1;
            match self.pixels(&frame) {
                Ok(pixels) => {
                    self.was_read = true;
                    self.tell_refused();
                    self.push(&frame, pixels);
                    return Ok(());
                }
                Err(error) => self.refused.push(error),
            }
        }
        self.tell_refused();
        if self.refused.is_empty() { Ok(()) } else { Err(self.refused.swap_remove(0)) }
    }

    /// Once an image was read, those that cannot be are no more than warnings.
    fn tell_refused(&mut self) {
        if self.was_read {
            let refused = self.refused.drain(..).map(|error| format!("left out: {error}"));
            self.folder.warnings.extend(refused);
        }
    }

    fn pixels(&self, frame: &DepthFrame) -> Result<DepthPixels, LogError> {
        let path = self.path.join(&frame.file);
        let bytes = fs::read(&path)
            .map_err(|reason| LogError::Unreadable { path: path.clone(), reason })?;
        let extension = path.extension().and_then(|extension| extension.to_str());
        let units_per_metre = self.folder.units_per_metre;
        let options = DepthFileOptions { units_per_metre, size: None };
        let read = depth_file::read(&bytes, extension, &options)
            .map_err(|error| LogError::Format { path: path.clone(), error })?;
        match read {
            DepthFile::Image(pixels) => Ok(pixels),
            DepthFile::Cloud(_) => {
                let what = "found a cloud, expected a depth image".to_owned();
                Err(LogError::Nothing { path, what })
            }
        }
    }

    /// The messages of an image, in reverse order.
    fn push(&mut self, frame: &DepthFrame, pixels: DepthPixels) {
        let logged = Stamp::from_secs(frame.stamp_secs);
        let [map, camera] = &self.frames;
        let header = |frame: &Arc<str>| Header::new(logged, Arc::clone(frame));
        let mut push = |topic, content| self.waiting.push(Message { topic, logged, content });
        let size = [pixels.columns, pixels.rows];
        push(0, Content::Depth(DepthMessage { header: header(camera), pixels }));
        if let Some(intrinsics) = self.folder.camera {
            #[expect(clippy::cast_possible_truncation, reason = "images have at most 2^28 pixels")]
            let [columns, rows] = size.map(|count| count as u32);
            let message = CameraMessage {
                header: header(camera),
                columns,
                rows,
                camera: intrinsics,
                distortion_model: "plumb_bob".to_owned(),
                distortion: vec![0.0; 5],
            };
            push(2, Content::Camera(message));
        }
        let frame_from_body = frame.map_from_camera;
        push(1, Content::Pose(PoseMessage { header: header(map), frame_from_body }));
    }
}

/// Names of the files of a folder and of those in the folders in it, with `/`, in order.
fn names(folder: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    let mut walk = |folder: &Path, before: &str| -> io::Result<Vec<(PathBuf, String)>> {
        let mut folders = Vec::new();
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let name = format!("{before}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                folders.push((entry.path(), format!("{name}/")));
            } else {
                names.push(name);
            }
            if names.len() > MAX_FILES {
                return Err(io::Error::other(format!("more than {MAX_FILES} files")));
            }
        }
        Ok(folders)
    };
    for (inner, before) in walk(folder, "")? {
        walk(&inner, &before)?;
    }
    names.sort();
    Ok(names)
}
