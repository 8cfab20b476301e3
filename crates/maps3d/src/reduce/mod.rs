//! Fewer vertices: five methods over one kind of mesh.
//!
//! | folder or file | what |
//! |---|---|
//! | `removal/` | `centroid`, `least_squares` and its vertical form: vertices taken out (\[Mos15\] 3.5) |
//! | `hole/` | triangulation of the holes (\[Mos15\] 3.6) |
//! | `quadric.rs` | edges collapsed by error quadrics |
//! | `inverse_depth/` | the project's own: vertices put in |
//! | `conservative/` | the one-sided bound, for each of them |
//! | `heap.rs` | the indexed heap (\[Mos15\] 5.3) |

mod conservative;
mod heap;
mod hole;
mod inverse_depth;
mod quadric;
mod removal;

use probe::{Off, Probe};

pub use conservative::outside_max_m;
pub use hole::HoleMethod;
pub use inverse_depth::InverseDepth;
pub(crate) use inverse_depth::LiftedPlane;
pub use removal::Contribution;

use crate::image::{FARTHEST_M, FilledImage, LARGEST_SIDE};
use crate::triangulate::ImageMesh;
use crate::{DepthEvent, Maps3dError};

/// How vertices are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// The vertex that contributes least is removed, its hole triangulated.
    Removal {
        /// How contributions are measured.
        contribution: Contribution,
        /// How holes are triangulated.
        hole: HoleMethod,
    },
    /// Edges are collapsed by error quadrics.
    Quadric,
    /// Vertices are put in where faces are worst.
    InverseDepth(InverseDepth),
}

impl Method {
    /// What the methods are called.
    pub const NAMES: [&str; 5] =
        ["centroid", "least-squares", "least-squares-vertical", "quadric", "inverse-depth"];

    /// The method of a name, with its usual options.
    pub fn named(name: &str, hole: HoleMethod) -> Option<Self> {
        let removal = |contribution| Some(Self::Removal { contribution, hole });
        match name {
            "centroid" => removal(Contribution::Centroid),
            "least-squares" => removal(Contribution::LeastSquares),
            "least-squares-vertical" => removal(Contribution::LeastSquaresVertical),
            "quadric" => Some(Self::Quadric),
            "inverse-depth" => Some(Self::InverseDepth(InverseDepth::default())),
            _ => None,
        }
    }
}

/// When a reduction ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// At so many vertices, at least 4; at once where the image has fewer pixels.
    Vertices(usize),
    /// Before a vertex contributes more than this, or with `inverse_depth` when no pixel is farther
    /// from its face; metres, above 0.
    Error(f64),
}

impl Stop {
    /// The count of vertices, if that is the end.
    pub fn vertices(&self) -> Option<usize> {
        if let Self::Vertices(count) = self { Some(*count) } else { None }
    }

    /// The bound, if that is the end, metres.
    pub fn error_m(&self) -> Option<f64> {
        if let Self::Error(error_m) = self { Some(*error_m) } else { None }
    }
}

/// What a reduction is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct ReduceOptions {
    /// How vertices are chosen.
    pub method: Method,
    /// When it ends.
    pub stop: Stop,
    /// The surface lies at most so far beyond the measured one, along any ray of the image, metres; any
    /// distance where `None`.
    pub conservative_m: Option<f64>,
    /// Numbers of vertices at which the mesh is shown to the probe.
    pub ladder: Vec<usize>,
}

impl ReduceOptions {
    /// Plain options: a method and its end.
    pub fn new(method: Method, stop: Stop) -> Self {
        Self { method, stop, conservative_m: None, ladder: Vec::new() }
    }

    /// Checks what can be told without an image.
    ///
    /// # Errors
    /// [`Maps3dError::Option`] for what is out of its range.
    pub fn check(&self) -> Result<(), Maps3dError> {
        let refuse = |option, found, expected| Err(Maps3dError::Option { option, found, expected });
        // What the largest image holds, and no camera sees farther.
        let (most, far_m) = (LARGEST_SIDE * LARGEST_SIDE, f64::from(FARTHEST_M));
        let is_count = |count: usize| (4..=most).contains(&count);
        match self.stop {
            Stop::Vertices(count) if !is_count(count) => {
                let expected = "at least the 4 corners of the image, at most 2^28 vertices";
                return refuse("vertices", count as f64, expected);
            }
            Stop::Error(error_m) if !(error_m > 0.0 && error_m <= far_m) => {
                return refuse("error", error_m, "a distance above 0 m, up to 1e6 m");
            }
            _ => {}
        }
        if let Some(&count) = self.ladder.iter().find(|&&count| !is_count(count)) {
            return refuse("ladder", count as f64, "numbers of 4 to 2^28 vertices");
        }
        if let Some(bound_m) = self.conservative_m
            && !(0.0..=far_m).contains(&bound_m)
        {
            return refuse("conservative", bound_m, "a distance from 0 to 1e6 m");
        }
        match &self.method {
            Method::InverseDepth(own) => own.check(),
            _ => Ok(()),
        }
    }
}

/// Reduces the full grid of an image to a mesh over the same image.
///
/// The result is a planar triangulation of the image ([`check_planar`](crate::triangulate::check_planar)
/// proves it) whose vertices are pixels; the corners of the image are among them, so that nothing is
/// left uncovered. Vertices keep their depth, but for `inverse_depth` with a count, which fits depths,
/// and for the conservative mode, which draws vertices towards the camera.
///
/// # Errors
/// [`Maps3dError::Option`] as [`ReduceOptions::check`].
pub fn reduce(image: &FilledImage, options: &ReduceOptions) -> Result<ImageMesh, Maps3dError> {
    reduce_with(image, options, &mut Off)
}

/// [`reduce`], watched by a probe.
///
/// # Errors
/// As [`reduce`].
pub fn reduce_with<P>(
    image: &FilledImage,
    options: &ReduceOptions,
    probe: &mut P,
) -> Result<ImageMesh, Maps3dError>
where
    P: for<'e> Probe<DepthEvent<'e>>,
{
    options.check()?;
    let mut mesh = match &options.method {
        Method::InverseDepth(own) => {
            inverse_depth::grow(image, own, &options.stop, &options.ladder, probe)
        }
        method => {
            let mut steps = options.ladder.clone();
            steps.sort_unstable();
            let watch = |removal: removal::Removal<'_>| {
                let vertices = removal.rings.alive();
                if probe.on() {
                    let removal::Removal { pixel, contribution_m, hole, pieces, .. } = removal;
                    let event =
                        DepthEvent::Removed { pixel, contribution_m, hole, pieces, vertices };
                    probe.emit(event);
                    if steps.binary_search(&vertices).is_ok() {
                        let mesh = &removal.rings.mesh(image);
                        probe.emit(DepthEvent::Reached { image, mesh });
                    }
                }
            };
            let rings = match *method {
                Method::Removal { contribution, hole } => {
                    removal::remove(image, contribution, hole, &options.stop, watch)
                }
                _ => quadric::collapse(image, &options.stop, watch),
            };
            rings.mesh(image)
        }
    };
    if let Some(bound_m) = options.conservative_m {
        let vertices = conservative::withhold(image, &mut mesh, bound_m);
        probe.emit(DepthEvent::Withheld { mesh: &mesh, vertices });
    }
    probe.emit(DepthEvent::Reduced { image, mesh: &mesh });
    Ok(mesh)
}
