//! Depth images of a log, each with its pose and its camera, one after the other.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use formats::depth::DepthPixels;
use formats::log::{CameraMessage, Content};
use pose::Se3;
use posegraph::Manifold;
use sensing::{Camera, DepthImage};

use super::super::ReplayError;
use crate::config::Replay3d;
use crate::logs::LogSource;

/// Images that may wait for the pose after them.
const MOST_WAITING: usize = 64;

/// A pose farther from the origin of the log is none, metres.
const FARTHEST_M: f64 = 1e6;

/// One depth image and where it was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthFrame {
    /// When it was taken, seconds.
    pub stamp_secs: f64,
    /// The camera in the frame of the log's poses: z ahead, y down.
    pub log_from_camera: Se3,
    /// What was seen.
    pub image: DepthImage,
}

/// The depth images of a folder or a recording, read as they are asked for.
///
/// An image gets the pose that is nearest in time; one without a pose near enough, or with too few readings, is
/// left out, and told. The first topic with depth images and the first with poses are taken.
#[derive(Debug)]
pub struct DepthFrames {
    path: PathBuf,
    source: LogSource,
    settings: Replay3d,
    /// In order of time.
    poses: Vec<(f64, Se3)>,
    waiting: VecDeque<(f64, DepthPixels)>,
    camera: Option<CameraMessage>,
    topics: [Option<usize>; 2],
    seen: u64,
    ended: bool,
    without_pose: u64,
    without_readings: u64,
    guessed: bool,
    told: Vec<String>,
}

impl DepthFrames {
    /// Opens a folder of depth images, or a recording that holds some.
    ///
    /// # Errors
    /// [`ReplayError::Input`] for what is neither.
    pub fn open(path: &Path, settings: &Replay3d) -> Result<Self, ReplayError> {
        let source = LogSource::open(path)?;
        Ok(Self {
            path: path.to_owned(),
            source,
            settings: settings.clone(),
            poses: Vec::new(),
            waiting: VecDeque::new(),
            camera: None,
            topics: [None; 2],
            seen: 0,
            ended: false,
            without_pose: 0,
            without_readings: 0,
            guessed: false,
            told: Vec::new(),
        })
    }

    /// The next image that has a pose; `None` at the end.
    ///
    /// # Errors
    /// [`ReplayError::Input`] for a file that cannot be read, and for a camera that cannot be one.
    pub fn next_frame(&mut self) -> Result<Option<DepthFrame>, ReplayError> {
        loop {
            if let Some(frame) = self.settled()? {
                return Ok(Some(frame));
            }
            if self.ended {
                return Ok(None);
            }
            self.read_on()?;
        }
    }

    /// What was odd so far: of the log, and images that were left out.
    pub fn warnings(&self) -> Vec<String> {
        let mut all = self.source.warnings();
        all.extend(self.told.iter().cloned());
        if self.without_pose > 0 {
            let within = self.settings.pose_within_secs;
            all.push(format!("{} images without a pose within {within} s", self.without_pose));
        }
        if self.without_readings > 0 {
            let least = self.settings.least_readings;
            let at = "`replay3d.least_readings`";
            let count = self.without_readings;
            all.push(format!("{count} images left out, with less than {least} readings ({at})"));
        }
        all
    }

    /// Images that were left out since no pose is near enough, and since they have too few readings.
    pub fn left_out(&self) -> [u64; 2] {
        [self.without_pose, self.without_readings]
    }

    /// The share that was read; 0 where that is not known.
    pub fn share(&self) -> f64 {
        self.source.share().unwrap_or(0.0)
    }

    /// Depth images and poses that the log held so far.
    pub fn counts(&self) -> (u64, usize) {
        (self.seen, self.poses.len())
    }

    /// The log cannot be taken.
    pub(super) fn refused(&self, message: &str) -> ReplayError {
        ReplayError::input(&self.path, message)
    }

    fn read_on(&mut self) -> Result<(), ReplayError> {
        let Some(message) = self.source.next_message()? else {
            self.ended = true;
            return Ok(());
        };
        match message.content {
            Content::Depth(depth)
                if *self.topics[0].get_or_insert(message.topic) == message.topic =>
            {
                let taken = self.seen.is_multiple_of(u64::from(self.settings.every));
                self.seen += 1;
                if taken {
                    self.waiting.push_back((depth.header.stamp.secs(), depth.pixels));
                }
            }
            Content::Pose(pose)
                if *self.topics[1].get_or_insert(message.topic) == message.topic =>
            {
                let stamp_secs = pose.header.stamp.secs();
                let log_from_camera = pose.frame_from_body;
                // So far away doubles tell no millimetres apart.
                let is_near = log_from_camera.translation.amax() <= FARTHEST_M;
                match log_from_camera.is_finite() && is_near {
                    true => {
                        let at = self.poses.partition_point(|(secs, _)| *secs <= stamp_secs);
                        self.poses.insert(at, (stamp_secs, log_from_camera));
                    }
                    false => {
                        let far_m = log_from_camera.translation.norm();
                        let found = format!("found one {far_m:.3e} m from the origin of the log");
                        let expected = format!("expected at most {FARTHEST_M:.0e} m");
                        self.told.push(format!(
                            "the pose at {stamp_secs:.3} s is left out: {found}, {expected}"
                        ));
                    }
                }
            }
            Content::Camera(camera) if self.camera.is_none() => self.camera = Some(camera),
            Content::Depth(_) | Content::Pose(_) => {
                let name = self.source.topics().get(message.topic).map_or("", |t| t.name.as_str());
                let line = format!("{name} is left out: another topic of its kind came first");
                if !self.told.contains(&line) {
                    self.told.push(line);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The first image that waits, once its pose is known.
    fn settled(&mut self) -> Result<Option<DepthFrame>, ReplayError> {
        while let Some((stamp_secs, _)) = self.waiting.front() {
            let stamp_secs = *stamp_secs;
            let last = self.poses.last().is_some_and(|(pose_secs, _)| *pose_secs >= stamp_secs);
            if !last && !self.ended && self.waiting.len() < MOST_WAITING {
                return Ok(None);
            }
            let Some((_, pixels)) = self.waiting.pop_front() else { return Ok(None) };
            match self.pose_at(stamp_secs) {
                Some(_) if self.has_too_few(&pixels) => self.without_readings += 1,
                Some(log_from_camera) => {
                    let camera = self.camera_of(&pixels)?;
                    let image = DepthImage::new(pixels.columns, camera, pixels.depths_m);
                    return Ok(Some(DepthFrame { stamp_secs, log_from_camera, image }));
                }
                None => self.without_pose += 1,
            }
        }
        Ok(None)
    }

    /// The pose that is nearest in time, of two as near the earlier one; `None` where none is near enough.
    fn pose_at(&self, stamp_secs: f64) -> Option<Se3> {
        let after = self.poses.partition_point(|(secs, _)| *secs < stamp_secs);
        let around = &self.poses[after.saturating_sub(1)..(after + 1).min(self.poses.len())];
        let away = |(pose_secs, _): &&(f64, Se3)| (pose_secs - stamp_secs).abs();
        let nearest = around.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(&nearest) <= self.settings.pose_within_secs).then_some(nearest.1)
    }

    /// Whether an image says too little to be a view: what is missing counts as free up to the far plane, so one
    /// of a covered lens would free all that lies before it.
    fn has_too_few(&self, pixels: &DepthPixels) -> bool {
        let is_read = |depth: &&f32| depth.is_finite() && **depth > 0.0;
        let readings = pixels.depths_m.iter().filter(is_read).count();
        (readings as u64) < u64::from(self.settings.least_readings)
    }

    /// The camera of an image: that of the log, else that of the config, at the image's size.
    fn camera_of(&mut self, pixels: &DepthPixels) -> Result<Camera, ReplayError> {
        let (camera, columns) = match &self.camera {
            Some(told) => (told.camera, f64::from(told.columns)),
            None => {
                let [fx, fy, cx, cy] = self.settings.intrinsics;
                (Camera::new(fx, fy, cx, cy), 640.0)
            }
        };
        if self.camera.is_none() && !self.guessed {
            self.guessed = true;
            let [fx, fy, cx, cy] = self.settings.intrinsics;
            let at = "`replay3d.intrinsics`, for 640 columns";
            self.told.push(format!("no camera is named: {fx} {fy} {cx} {cy} is taken ({at})"));
        }
        let scale = match columns > 0.0 {
            true => pixels.columns as f64 / columns,
            false => 1.0,
        };
        let Camera { fx, fy, cx, cy } = camera;
        let centre = |at: f64| (at + 0.5) * scale - 0.5;
        let camera = Camera::new(fx * scale, fy * scale, centre(cx), centre(cy));
        if camera.is_usable() {
            return Ok(camera);
        }
        let found = format!("found a camera of {fx} {fy} {cx} {cy}, expected focal lengths");
        Err(self.refused(&found))
    }
}
