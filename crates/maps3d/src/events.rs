//! What can be watched on the way from a depth image to a polyhedron.

use probe::Probe;
use solid::{Label, Polyhedron};

use crate::global_union::UnionEvent;
use crate::image::{FilledImage, Pixel};
use crate::plan::PlanEvent;
use crate::relative::ConsolidationEvent;
use crate::triangulate::{FrontierSquares, ImageMesh};

/// Something that happened, told to a probe; the steps are those of `docs/depth.md`.
#[derive(Clone, Copy, Debug)]
pub enum DepthEvent<'a> {
    /// The image was cropped and filled (\[Mos15\] 5.4).
    Prepared {
        /// The image.
        image: &'a FilledImage,
    },
    /// Missing data and depth gaps were found (\[Mos15\] 5.7.1).
    Triangulated {
        /// The image.
        image: &'a FilledImage,
        /// Which faces of the grid are frontier.
        squares: &'a FrontierSquares,
    },
    /// A vertex was removed and its hole triangulated (\[Mos15\] 3.5, 3.6).
    Removed {
        /// The vertex.
        pixel: Pixel,
        /// What it contributed, metres.
        contribution_m: f64,
        /// The hole, in order of positive turns.
        hole: &'a [Pixel],
        /// Its triangles, as places in `hole`.
        pieces: &'a [[u16; 3]],
        /// Vertices that are left.
        vertices: usize,
    },
    /// A pixel became a vertex.
    Inserted {
        /// The pixel.
        pixel: Pixel,
        /// How far it was from its face, metres.
        error_m: f64,
        /// Vertices that there are now.
        vertices: usize,
    },
    /// A number of vertices that was asked for was reached.
    Reached {
        /// The image.
        image: &'a FilledImage,
        /// The mesh at that moment.
        mesh: &'a ImageMesh,
    },
    /// Vertices were taken out again, down to the number that was asked for.
    Thinned {
        /// The mesh.
        mesh: &'a ImageMesh,
    },
    /// Sides were turned to the other diagonal of their quadrangle.
    Flipped {
        /// The round, from 0.
        round: usize,
        /// Number of sides.
        sides: usize,
    },
    /// Depths of vertices were fitted to all pixels.
    Fitted {
        /// The mesh with its new depths.
        mesh: &'a ImageMesh,
    },
    /// Vertices were drawn towards the camera, so that nothing unseen counts as free.
    Withheld {
        /// The mesh with its new depths.
        mesh: &'a ImageMesh,
        /// Number of vertices that moved.
        vertices: usize,
    },
    /// The reduction ended; without one, the mesh is that of all pixels.
    Reduced {
        /// The image.
        image: &'a FilledImage,
        /// The mesh.
        mesh: &'a ImageMesh,
    },
    /// Faces were labelled.
    Labelled {
        /// The mesh.
        mesh: &'a ImageMesh,
        /// A label per face.
        labels: &'a [Label],
    },
    /// The surface was joined to the camera (\[Mos15\] 3.8).
    Joined {
        /// The polyhedron, in the frame `camera`.
        polyhedron: &'a Polyhedron,
    },
}

probe::variants!(DepthEvent<'_>: Prepared, Triangulated, Removed, Inserted, Reached, Thinned, Flipped, Fitted,
    Withheld, Reduced, Labelled, Joined);

/// A listener of all events of this crate; implemented by whatever listens to each family.
pub trait Map3dProbe:
    for<'a> Probe<DepthEvent<'a>>
    + for<'a> Probe<ConsolidationEvent<'a>>
    + for<'a> Probe<UnionEvent<'a>>
    + for<'a> Probe<PlanEvent<'a>>
{
}

impl<P> Map3dProbe for P where
    P: for<'a> Probe<DepthEvent<'a>>
        + for<'a> Probe<ConsolidationEvent<'a>>
        + for<'a> Probe<UnionEvent<'a>>
        + for<'a> Probe<PlanEvent<'a>>
        + ?Sized
{
}

/// Hands the events of a view, or of a plan, on to whoever listens to a map.
pub(crate) struct Relay<'a>(pub &'a mut dyn Map3dProbe);

impl Probe<DepthEvent<'_>> for Relay<'_> {
    fn on(&self) -> bool {
        Probe::<DepthEvent<'_>>::on(self.0)
    }

    fn emit(&mut self, event: DepthEvent<'_>) {
        self.0.emit(event);
    }
}

impl Probe<PlanEvent<'_>> for Relay<'_> {
    fn on(&self) -> bool {
        Probe::<PlanEvent<'_>>::on(self.0)
    }

    fn emit(&mut self, event: PlanEvent<'_>) {
        self.0.emit(event);
    }
}
