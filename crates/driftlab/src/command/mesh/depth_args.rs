//! What can be typed about a depth image and its reduction.

use std::path::PathBuf;
use std::str::FromStr;

use anyhow::anyhow;
use clap::{ArgGroup, Args, ValueEnum};
use maps3d::image::PrepareOptions;
use maps3d::reduce::{HoleMethod, InverseDepth, Method, ReduceOptions, Stop};
use maps3d::triangulate::Occlusion;
use maps3d::{Maps3dError, ViewOptions};

use super::super::failure::Failure;
use super::super::graph::numbers::shown;

/// What happens to points of a cloud that share a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DuplicatesName {
    /// The cloud is refused
    Refuse,
    /// They are missing
    Missing,
}

/// How vertices are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MethodName {
    /// Remove what is nearest to the centroid of its neighbours
    Centroid,
    /// Remove what is nearest to the plane of its neighbours, along its normal
    LeastSquares,
    /// The same, with distances along the optical axis, as the thesis does
    LeastSquaresVertical,
    /// Collapse edges by error quadrics
    Quadric,
    /// Insert where faces are worst, judged in metres over inverse depth
    InverseDepth,
}

impl MethodName {
    /// The name, as it is typed.
    pub fn name(self) -> String {
        typed(self)
    }
}

/// A value's name, as it is typed.
fn typed(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// How holes are triangulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum HoleName {
    /// Ear clipping, shortest diagonal first
    EarClipping,
    /// Least total length of diagonals
    OptimalEdgeLength,
    /// Partition into monotone polygons, as the thesis does
    Monotone,
    /// Constrained Delaunay
    ConstrainedDelaunay,
}

/// How a depth image's file is to be taken.
#[derive(Debug, Args)]
pub(in crate::command) struct DepthFileArgs {
    /// Focal lengths and centre of the camera, pixels [default: a Kinect's; of clouds, fitted]
    #[arg(
        long,
        value_name = "FX,FY,CX,CY",
        value_parser = numbers::<f64, 4>,
        allow_hyphen_values = true,
        requires = "depth"
    )]
    pub(super) camera: Option<[f64; 4]>,
    /// Units of the file per metre, 1e-9 to 1e9 [default: 1000; 1 for .raw]; clouds are in metres
    #[arg(long, value_name = "UNITS", requires = "depth")]
    pub(super) depth_scale: Option<f64>,
    /// Columns and rows of floats without a header
    #[arg(
        long,
        value_name = "COLUMNS,ROWS",
        value_parser = numbers::<usize, 2>,
        requires = "depth"
    )]
    pub(super) size: Option<[usize; 2]>,
    /// What happens to points of a cloud that share a place
    #[arg(long, value_enum, default_value = "refuse")]
    pub(super) duplicates: DuplicatesName,
}

#[derive(Debug, Args)]
#[command(group(ArgGroup::new("end").args(["vertices", "error"])))]
pub(in crate::command) struct DepthArgs {
    /// The depth image: grey PNG of 16 bits, PGM, TIFF, PCD, PLY, or floats without a header as .raw
    pub(super) depth: PathBuf,
    #[command(flatten)]
    pub(super) file: DepthFileArgs,
    /// Pixels cut off on each side; at least one column and one row must be left
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) crop: usize,
    /// Depth at which missing data is placed, metres from 0.001 to 1e6
    #[arg(long, value_name = "M", default_value_t = 8.0)]
    pub(super) far: f64,
    /// Readings beyond this depth are missing, metres
    #[arg(long, value_name = "M")]
    pub(super) max: Option<f64>,
    /// Take faces across depth gaps for surfaces, as the thesis does, instead of frontier
    #[arg(long)]
    pub(super) no_occlusion: bool,
    /// A face is frontier when more than this share of what it covers is
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub(super) frontier_share: f64,
    /// How to reduce; nothing is reduced without --vertices or --error
    #[arg(
        long,
        value_name = "METHOD",
        value_enum,
        default_value = "inverse-depth",
        requires = "end"
    )]
    pub(super) reduce: MethodName,
    /// Reduce to so many vertices, from 4 up; images with fewer pixels keep them all
    #[arg(long, value_name = "N")]
    pub(super) vertices: Option<usize>,
    /// Reduce as far as no vertex that is removed contributes more, or with inverse-depth as far as no
    /// pixel is farther from its face; metres, above 0 up to 1e6
    #[arg(long, value_name = "M")]
    pub(super) error: Option<f64>,
    /// How holes are triangulated
    #[arg(
        long,
        value_name = "METHOD",
        value_enum,
        default_value = "ear-clipping",
        requires = "end"
    )]
    pub(super) hole: HoleName,
    /// Let the reduced volume reach at most so far beyond the measured one, along any ray, metres from 0
    /// to 1e6
    #[arg(long, value_name = "M", requires = "end")]
    pub(super) conservative: Option<f64>,
    /// Show the mesh at these numbers of vertices in the recording
    #[arg(long, value_name = "N,N,...", value_delimiter = ',', requires = "end")]
    pub(super) ladder: Vec<usize>,
    /// Leave the surface open, not joined to the camera
    #[arg(long)]
    pub(super) open: bool,
}

/// What is wrong with the image, or with what was typed.
pub(super) fn refused(from: &dyn std::fmt::Display, error: &Maps3dError) -> Failure {
    match error {
        Maps3dError::Option { option, found, expected } => {
            let flag = option.trim_end_matches("_m").replace('_', "-");
            Failure::Input(anyhow!("--{flag}: found {}, expected {expected}", shown(*found)))
        }
        other => Failure::Input(anyhow!("{from}: {other}")),
    }
}

/// The least and the most units per metre: a million kilometres, and a millionth of a millimetre.
const SCALES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// Focal lengths of cameras that may exist, without their sign, pixels.
const FOCAL_LENGTHS_PX: std::ops::RangeInclusive<f64> = 1e-3..=1e7;

impl DepthFileArgs {
    /// Refuses numbers that fit no file.
    pub fn check(&self) -> Result<(), Failure> {
        let refuse = |text: String| Err(Failure::Input(anyhow!(text)));
        if let Some([fx, fy, cx, cy]) = self.camera
            && !([fx, fy].iter().all(|f| FOCAL_LENGTHS_PX.contains(&f.abs()))
                && [cx, cy].iter().all(|c| c.abs() <= *FOCAL_LENGTHS_PX.end()))
        {
            let [fx, fy, cx, cy] = [fx, fy, cx, cy].map(shown);
            return refuse(format!(
                "--camera: found fx {fx}, fy {fy}, cx {cx}, cy {cy}, expected pixels up to 1e7, \
                 fx and fy at least 1e-3"
            ));
        }
        if let Some(scale) = self.depth_scale.filter(|scale| !SCALES.contains(scale)) {
            return refuse(format!(
                "--depth-scale: found a scale of {}, expected 1e-9 to 1e9 units per metre",
                shown(scale)
            ));
        }
        if let Some([columns, rows]) = self.size.filter(|size| size.contains(&0)) {
            return refuse(format!("--size: found {columns},{rows}, expected at least 1,1"));
        }
        Ok(())
    }
}

/// So many numbers with commas between.
pub(super) fn numbers<T: FromStr, const N: usize>(text: &str) -> Result<[T; N], String> {
    let numbers: Option<Vec<T>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| format!("expected {N} numbers with commas between"))
}

impl DepthArgs {
    /// The options of all stages.
    pub fn options(&self) -> ViewOptions {
        let hole = HoleMethod::named(&typed(self.hole)).unwrap_or_default();
        // Every name of the list is one of the crate's.
        let method = Method::named(&self.reduce.name(), hole)
            .unwrap_or(Method::InverseDepth(InverseDepth::default()));
        let stop = match (self.vertices, self.error) {
            (Some(count), _) => Some(Stop::Vertices(count)),
            (None, Some(error_m)) => Some(Stop::Error(error_m)),
            (None, None) => None,
        };
        ViewOptions {
            prepare: PrepareOptions {
                crop: self.crop,
                far_m: self.far,
                max_m: self.max.unwrap_or(f64::INFINITY),
            },
            occlusion: (!self.no_occlusion).then(Occlusion::default),
            frontier_share: self.frontier_share,
            reduce: stop.map(|stop| ReduceOptions {
                conservative_m: self.conservative,
                ladder: self.ladder.clone(),
                ..ReduceOptions::new(method, stop)
            }),
            open: self.open,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_known_below() {
        for name in MethodName::value_variants() {
            assert!(Method::named(&name.name(), HoleMethod::default()).is_some(), "{name:?}");
        }
        assert_eq!(MethodName::value_variants().len(), Method::NAMES.len());
        for name in HoleName::value_variants() {
            assert!(HoleMethod::named(&typed(*name)).is_some(), "{name:?}");
        }
    }
}
