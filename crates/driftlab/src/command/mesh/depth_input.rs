//! Reading a depth image or an organised cloud.

use std::path::Path;
use std::time::Instant;

use anyhow::anyhow;
use formats::depth_file::{self, DepthFile, DepthFileOptions};
use maps3d::Maps3dError;
use maps3d::image::{CloudOptions, Duplicates, PrepareOptions, depth_image_of};
use sensing::{Camera, DepthImage};

use super::super::failure::Failure;
use super::super::out::Out;
use super::depth_args::{self, DepthFileArgs, DuplicatesName};

/// The focal length of the first Kinect, pixels, for an image of 640 columns.
const KINECT_FOCAL_PX: f64 = 525.0;

/// Levels per metre where nothing else is told: as depth cameras mostly count.
pub(super) const UNITS_PER_METRE: f64 = 1000.0;

/// What levels of 8 bits reach to then, metres.
const EIGHT_BITS_M: f32 = 0.255;

/// A depth image, and how it was taken.
pub(super) struct DepthInput {
    pub image: DepthImage,
    pub secs: f64,
    /// The camera was neither given nor told by the file.
    camera_is_usual: bool,
    /// Levels of an image were taken for millimetres, without being told.
    scale_is_usual: bool,
}

/// Says what was taken for granted, once nothing that was typed is in the way of the image.
pub(super) fn note(
    read: &DepthInput,
    options: &PrepareOptions,
    path: &Path,
    out: &Out,
) -> Result<(), Failure> {
    let image = &read.image;
    let left = options.size_left(image.columns, image.rows());
    let [columns, rows] = left.map_err(|error| depth_args::refused(&path.display(), &error))?;
    if read.camera_is_usual {
        let Camera { fx, fy, cx, cy } = image.camera;
        out.note(&format!("warning: no --camera: a Kinect's is taken, {fx},{fy},{cx},{cy}"));
    }
    let measured = image.depths_m.iter().filter(|depth_m| options.measures(**depth_m));
    match measured.copied().reduce(f32::max) {
        None => out.note("warning: no pixel has a reading: all of the view is frontier"),
        Some(most_m) if read.scale_is_usual && most_m <= EIGHT_BITS_M => out.note(&format!(
            "warning: no --depth-scale, and no reading beyond {most_m} m at {UNITS_PER_METRE} units per \
             metre: expected a depth image of 16 bits"
        )),
        Some(_) => {}
    }
    if columns.min(rows) == 1 {
        out.note(
            "note: a single line of pixels encloses nothing: it is taken as wide as its pixels",
        );
    }
    Ok(())
}

/// Reads the file.
pub(super) fn depth(path: &Path, args: &DepthFileArgs, out: &Out) -> Result<DepthInput, Failure> {
    let start = Instant::now();
    let bytes = std::fs::read(path).map_err(|error| {
        Failure::Input(anyhow!("{}: {error}; expected a depth image", path.display()))
    })?;
    let extension = path.extension().and_then(|extension| extension.to_str());
    if let Some([columns, rows]) = args.size.filter(|_| !holds_floats(path)) {
        return Err(Failure::Input(anyhow!(
            "--size: found {columns},{rows} for {}, expected it for floats without a header only \
             (.raw, .f32, .bin, .dat)",
            path.display()
        )));
    }
    let usual_scale = if holds_floats(path) { 1.0 } else { UNITS_PER_METRE };
    let options = DepthFileOptions {
        units_per_metre: args.depth_scale.unwrap_or(usual_scale),
        size: args.size,
    };
    let input =
        |error: &dyn std::fmt::Display| Failure::Input(anyhow!("{}: {error}", path.display()));
    let file = depth_file::read(&bytes, extension, &options).map_err(|e| input(&e))?;
    let camera = args.camera.map(|[fx, fy, cx, cy]| Camera::new(fx, fy, cx, cy));
    let is_image = matches!(file, DepthFile::Image(_));
    let camera_is_usual = camera.is_none() && is_image;
    let scale_is_usual = args.depth_scale.is_none() && is_image && !holds_floats(path);
    let image = match file {
        DepthFile::Image(pixels) => {
            let camera = camera.unwrap_or_else(|| {
                let f = KINECT_FOCAL_PX * pixels.columns as f64 / 640.0;
                let middle = |side: usize| (side as f64 - 1.0) / 2.0;
                let (cx, cy) = (middle(pixels.columns), middle(pixels.rows));
                Camera::new(f, f, cx, cy)
            });
            DepthImage::new(pixels.columns, camera, pixels.depths_m)
        }
        DepthFile::Cloud(cloud) => {
            let duplicates = match args.duplicates {
                DuplicatesName::Refuse => Duplicates::Refuse,
                DuplicatesName::Missing => Duplicates::Missing,
            };
            let options = CloudOptions { duplicates, ..CloudOptions::default() };
            let image = depth_image_of(cloud.columns, &cloud.points_in_sensor, camera, &options)
                .map_err(|error| match error {
                    Maps3dError::Duplicates { .. } => {
                        input(&format!("{error} (--duplicates missing)"))
                    }
                    Maps3dError::NoCamera { .. } => input(&format!("{error} (--camera)")),
                    other => input(&other),
                })?;
            if args.camera.is_none() {
                let Camera { fx, fy, cx, cy } = image.camera;
                out.detail(&format!("the camera of the cloud: {fx:.2},{fy:.2},{cx:.2},{cy:.2}"));
            }
            image
        }
    };
    Ok(DepthInput { image, secs: start.elapsed().as_secs_f64(), camera_is_usual, scale_is_usual })
}

/// Whether a file is floats without a header, by its name; they are metres.
fn holds_floats(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension
        .is_some_and(|e| ["raw", "f32", "bin", "dat"].iter().any(|raw| e.eq_ignore_ascii_case(raw)))
}
