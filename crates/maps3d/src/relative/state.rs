//! One view with what has become of its frontier.

use geometry::planar::overlay::StepRings;
use nalgebra::{Point3, Vector3};
use pose::Se3;
use probe::{PathId, VertexId};

use super::book::ClosingId;
use super::grid::FaceGrid;
use super::ledger::OpenPart;
use super::parts::{FrontierPart, parts, rings_of};
use super::samples::{middle, pieces};
use super::volume::LocalVolume;

/// Pieces that stand for frontier are no longer than this, metres.
const SAMPLE_M: f64 = 0.4;

/// A view of the map: its volume, what of its frontier is open, and what that comes to.
#[derive(Clone, Debug)]
pub struct ViewState {
    /// The vertex that it hangs on.
    pub vertex: VertexId,
    /// Where the camera was.
    pub vertex_from_camera: Se3,
    /// The geometry; it never changes.
    pub volume: LocalVolume,
    /// For each frontier face, what is open.
    pub open: Box<[OpenPart]>,
    /// Closings that took part of a frontier face, in order: index into the frontier faces, and which.
    pub closings: Vec<(u16, ClosingId)>,
    /// The frontier that hangs together and counts.
    pub parts: Vec<FrontierPart>,
    /// Area of the parts that count, square metres.
    pub open_m2: f64,
    /// Area of the parts that do not, square metres.
    pub sliver_m2: f64,
    /// The largest of those, square metres.
    pub largest_sliver_m2: f64,
    /// Area given up, square metres.
    pub given_up_m2: f64,
    /// A ball around all that is open, in the frame `camera`: centre and radius, metres.
    pub open_ball: (Point3<f64>, f64),
    /// Balls in which frontier was given up.
    pub given_up: Vec<GivenUp>,
    /// Whether it is out of later comparisons.
    pub retired: bool,
}

/// A ball in which frontier of a view was given up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenUp {
    /// Its centre, in the frame `camera`, metres.
    pub place_in_camera: Point3<f64>,
    /// Its radius, metres.
    pub radius_m: f64,
    /// The path along which another vertex told of it, and the number of what it told; `None` for what was given up
    /// at the vertex of the view.
    pub over: Option<(PathId, u32)>,
}

/// A small piece of open frontier, in the frame `camera`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// The face of the volume that it lies on.
    pub face: u16,
    /// Its corners, metres.
    pub corners: [Point3<f64>; 3],
    /// Its middle, which stands for it.
    pub at: Point3<f64>,
    pub area_m2: f64,
    /// Unit vector across the frontier, into the unknown.
    pub outward: Vector3<f64>,
}

impl ViewState {
    pub(super) fn new(vertex: VertexId, vertex_from_camera: Se3, volume: LocalVolume) -> Self {
        // A face without area has no frontier.
        let whole_or_none = |&face: &u16| match FaceGrid::new(volume.points(face)).functions() {
            Some(_) => OpenPart::default(),
            None => OpenPart::closed(),
        };
        let open = volume.frontier().iter().map(whole_or_none).collect();
        Self {
            vertex,
            vertex_from_camera,
            volume,
            open,
            closings: Vec::new(),
            parts: Vec::new(),
            open_m2: 0.0,
            sliver_m2: 0.0,
            largest_sliver_m2: 0.0,
            given_up_m2: 0.0,
            open_ball: (Point3::origin(), 0.0),
            given_up: Vec::new(),
            retired: false,
        }
    }

    /// Whether frontier is left that counts.
    pub fn counts(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The grid of a frontier face, by its index, in the frame `camera`.
    pub fn grid(&self, index: usize) -> FaceGrid {
        FaceGrid::new(self.volume.points(self.volume.frontier()[index]))
    }

    /// Calls with the small pieces of a part, in the order of its faces. Leaves out what was given up.
    pub(super) fn samples(&self, part: &FrontierPart, mut call: impl FnMut(&Sample)) {
        let (mut all, mut rings) = (StepRings::new(), StepRings::new());
        for &piece in &part.pieces {
            let index = usize::from(piece.face);
            rings_of(&self.open[index], piece, &mut all, &mut rings);
            let grid = self.grid(index);
            let outward = grid.outward();
            let face = self.volume.frontier()[index];
            pieces(&grid, &rings, SAMPLE_M, |corners, area_m2| {
                let at = middle(&corners);
                if !self.is_given_up(&at) {
                    call(&Sample { face, corners, at, area_m2, outward });
                }
            });
        }
    }

    fn is_given_up(&self, point_in_camera: &Point3<f64>) -> bool {
        let is_near =
            |ball: &GivenUp| (point_in_camera - ball.place_in_camera).norm() <= ball.radius_m;
        self.given_up.iter().any(is_near)
    }

    /// Measures what is open anew.
    pub(super) fn measure(&mut self, sliver_m2: f64) {
        let areas_m2: Vec<f64> =
            (0..self.open.len()).map(|index| self.grid(index).area_m2()).collect();
        let all = parts(&self.volume, &self.open, &areas_m2);
        (self.open_m2, self.sliver_m2, self.largest_sliver_m2) = (0.0, 0.0, 0.0);
        self.given_up_m2 = 0.0;
        self.parts.clear();
        let (mut low, mut high) = (Point3::from([f64::MAX; 3]), Point3::from([f64::MIN; 3]));
        for part in all {
            let mut left_m2 = part.area_m2;
            if !self.given_up.is_empty() {
                left_m2 = 0.0;
                self.samples(&part, |sample| left_m2 += sample.area_m2);
            }
            let given_up_m2 = (part.area_m2 - left_m2).max(0.0);
            self.given_up_m2 += given_up_m2;
            if left_m2 >= sliver_m2 && left_m2 > 0.0 {
                self.open_m2 += left_m2;
                for piece in &part.pieces {
                    for corner in self.grid(piece.face.into()).corners() {
                        (low, high) = (low.inf(&corner), high.sup(&corner));
                    }
                }
                self.parts.push(part);
            } else {
                self.sliver_m2 += left_m2;
                self.largest_sliver_m2 = self.largest_sliver_m2.max(left_m2);
            }
        }
        self.parts.shrink_to_fit();
        self.open_ball = if low.x <= high.x {
            (nalgebra::center(&low, &high), 0.5 * (high - low).norm())
        } else {
            (Point3::origin(), 0.0)
        };
    }

    /// Memory held on the heap, bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let open: usize = self.open.iter().map(OpenPart::heap_bytes).sum();
        let parts: usize = self.parts.iter().map(|p| size_of_val(&*p.pieces)).sum();
        self.volume.heap_bytes()
            + self.open.len() * size_of::<OpenPart>()
            + open
            + self.closings.capacity() * size_of::<(u16, ClosingId)>()
            + self.parts.capacity() * size_of::<FrontierPart>()
            + parts
            + self.given_up.capacity() * size_of::<GivenUp>()
    }
}
