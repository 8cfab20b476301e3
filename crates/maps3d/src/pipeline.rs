//! From a depth image to a polyhedron, all stages in a row.

use probe::{Off, Probe};
use sensing::DepthImage;
use solid::{Label, Polyhedron};

use crate::image::{FilledImage, PrepareOptions, prepare};
use crate::reduce::{ReduceOptions, reduce_with};
use crate::triangulate::{FrontierSquares, ImageMesh, Occlusion, grid, label};
use crate::view::join;
use crate::{DepthEvent, Maps3dError};

/// Options of all stages.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewOptions {
    /// Crop, far distance, invalid values.
    pub prepare: PrepareOptions,
    /// Depth gaps that hide something; `None` for the thesis's figures, which know none.
    pub occlusion: Option<Occlusion>,
    /// The share of frontier in what a face covers above which it is frontier.
    pub frontier_share: f64,
    /// The reduction; the full grid where `None`.
    pub reduce: Option<ReduceOptions>,
    /// The surface alone, not joined to the camera.
    pub open: bool,
}

impl Default for ViewOptions {
    fn default() -> Self {
        Self {
            prepare: PrepareOptions::default(),
            occlusion: Some(Occlusion::default()),
            frontier_share: 0.0,
            reduce: None,
            open: false,
        }
    }
}

impl ViewOptions {
    /// Checks what can be told without an image.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for what is out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        self.prepare.check()?;
        if let Some(occlusion) = &self.occlusion {
            occlusion.check()?;
        }
        if !(0.0..=1.0).contains(&self.frontier_share) {
            let (found, expected) = (self.frontier_share, "a share from 0 to 1");
            return Err(Maps3dError::Option { option: "frontier_share", found, expected });
        }
        self.reduce.as_ref().map_or(Ok(()), ReduceOptions::check)
    }
}

/// What came of an image.
#[derive(Clone, Debug)]
pub struct Made {
    /// The image, cropped and filled.
    pub image: FilledImage,
    /// The mesh over the image.
    pub mesh: ImageMesh,
    /// Labels of its faces.
    pub labels: Vec<Label>,
    /// The polyhedron, in the frame `camera`.
    pub polyhedron: Polyhedron,
}

/// Makes the polyhedron of a depth image; `docs/depth.md` numbers the steps.
///
/// # Errors
/// [`Maps3dError`] for an image, a camera or an option out of its range.
pub fn polyhedron(image: &DepthImage, options: &ViewOptions) -> Result<Made, Maps3dError> {
    polyhedron_with(image, options, &mut Off)
}

/// [`polyhedron`], watched by a probe.
///
/// # Errors
/// As [`polyhedron`].
pub fn polyhedron_with<P>(
    image: &DepthImage,
    options: &ViewOptions,
    probe: &mut P,
) -> Result<Made, Maps3dError>
where
    P: for<'e> Probe<DepthEvent<'e>>,
{
    options.check()?;
    let image = prepare(image, &options.prepare)?;
    probe.emit(DepthEvent::Prepared { image: &image });
    let squares = FrontierSquares::of(&image, options.occlusion.as_ref());
    probe.emit(DepthEvent::Triangulated { image: &image, squares: &squares });
    let mesh = match &options.reduce {
        Some(reduction) => reduce_with(&image, reduction, probe)?,
        None => {
            let mesh = grid(&image);
            probe.emit(DepthEvent::Reduced { image: &image, mesh: &mesh });
            mesh
        }
    };
    let labels = label(&mesh, &squares, options.frontier_share);
    probe.emit(DepthEvent::Labelled { mesh: &mesh, labels: &labels });
    let polyhedron = join(&mesh, &labels, image.camera(), options.open)?;
    probe.emit(DepthEvent::Joined { polyhedron: &polyhedron });
    Ok(Made { image, mesh, labels, polyhedron })
}
