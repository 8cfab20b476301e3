//! What of a face lies inside another volume: its fan of tetrahedra sliced by the plane of the face.
//!
//! 1. The face is seen from the other camera: the cells of the image that it covers name the tetrahedra
//!    that it can meet. Where all of it is nearer than everything in these cells, it lies inside.
//! 2. Each vertex of the volume is above or below the plane of the face; one that is on it counts as above.
//!    An edge between an upper and a lower vertex crosses the plane in one corner, rounded to the grid of
//!    the face once, whichever tetrahedron asks.
//! 3. So a tetrahedron gives nothing, or a slice of three or four corners; neighbours share their sides
//!    exactly, and the slices leave no gap between them.
//! 4. What lies beyond the sides of the other image, or beyond the face, is cut off. Of a face that is closed but for
//!    a part, only what reaches into the box around that part is sliced.

use geometry::planar::overlay::StepRings;
use nalgebra::{Point3, Vector3};

use super::grid::{self, FaceGrid};
use super::volume::{LocalVolume, Shape};

/// Parts of a face that are nearer to the other camera's plane than this do not look for tetrahedra, metres.
const NEAR_M: f64 = 1e-3;

/// By how much rounding may move what is seen of a face, pixels.
const FOOTPRINT_SLACK_PX: f64 = 1e-3;

/// What came of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Covered {
    Nothing,
    Everything,
    /// What the rings wind around.
    Slices,
}

/// The volume at hand, and memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Slicer {
    /// Vertices of the shape at hand.
    corners: Vec<Point3<f64>>,
    /// The side of the plane, and the place on the grid, of vertices that were asked for.
    values: Vec<[f64; 3]>,
    valued: Vec<u32>,
    sliced: Vec<u32>,
    now: u32,
    cells: Vec<u32>,
    /// What is asked for of the face at hand: the rest of it is not sliced.
    bounds: [[i32; 2]; 2],
    /// Sides of the image that the face crosses, as functions of places on its grid, not negative inside.
    lines: Vec<[f64; 3]>,
    chain: Vec<[i64; 2]>,
    spare: Vec<[i64; 2]>,
    /// Slices of the face asked for last.
    pub slices: StepRings,
}

impl Slicer {
    /// Takes a volume in hand, in a shape.
    pub fn load(&mut self, volume: &LocalVolume, shape: Shape) {
        self.corners.clear();
        let count = volume.corner_count() as u16;
        self.corners.extend((0..count).map(|corner| volume.shaped(corner, shape)));
        self.values.resize(self.corners.len(), [0.0; 3]);
        self.valued.clear();
        self.valued.resize(self.corners.len(), 0);
        self.sliced.clear();
        self.sliced.resize(volume.surface_count(), 0);
        self.now = 0;
    }

    /// What of a face, given in the frame `camera` of the volume, lies inside of the shape that was loaded; only what
    /// reaches into the box `bounds` of its grid is sliced, so little is left costs little.
    ///
    /// With `only`, of the tetrahedra under the faces of the surface that it holds.
    pub fn slice(
        &mut self,
        volume: &LocalVolume,
        shape: Shape,
        face: &FaceGrid,
        bounds: [[i32; 2]; 2],
        only: Option<&dyn Fn(u16) -> bool>,
    ) -> Covered {
        self.slices.clear();
        self.bounds = bounds;
        let (corners, corner_count) = face.patch(bounds);
        let corners = &corners[..corner_count];
        let nearest_m = corners.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        let farthest_m = corners.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
        if farthest_m <= NEAR_M || nearest_m > volume.deepest_m() + shape.shift_m {
            return Covered::Nothing;
        }
        let (mut polygon, mut count) = ([[0.0; 2]; 5], 0);
        let within = self.footprint(volume, shape, corners, &mut polygon, &mut count);
        let Some(within) = within else { return Covered::Nothing };
        let polygon = &polygon[..count];
        let cells = volume.cells();
        self.cells.clear();
        let mut least_m = f64::INFINITY;
        cells.walk(polygon, FOOTPRINT_SLACK_PX, |cell| {
            let [least, most] = cells.depths_m(cell);
            least_m = least_m.min(least);
            if nearest_m <= most + shape.shift_m {
                self.cells.push(cell as u32);
            }
        });
        if self.cells.is_empty() {
            return Covered::Nothing;
        }
        let least_m = (least_m + shape.shift_m).max(0.5 * least_m);
        if only.is_none() && within && nearest_m > NEAR_M && farthest_m < least_m {
            return Covered::Everything;
        }
        self.lines.clear();
        if !within {
            self.take_lines(volume, shape, face);
        }
        self.slice_cells(volume, face, only)
    }

    /// Where the sides of the image of the shape cross the plane of a face.
    fn take_lines(&mut self, volume: &LocalVolume, shape: Shape, face: &FaceGrid) {
        let camera = volume.camera();
        let [last_column, last_row] = volume.extent().map(|last| f64::from(last) - shape.inset_px);
        let sides = [
            Vector3::new(camera.fx, 0.0, camera.cx - shape.inset_px),
            Vector3::new(-camera.fx, 0.0, last_column - camera.cx),
            Vector3::new(0.0, camera.fy, camera.cy - shape.inset_px),
            Vector3::new(0.0, -camera.fy, last_row - camera.cy),
        ];
        let [origin, along_x, along_y] = face.corners();
        let step = 1.0 / f64::from(grid::STEPS);
        for side in sides {
            let at = [origin, along_x, along_y].map(|corner| side.dot(&corner.coords));
            if at.iter().any(|of_corner| *of_corner < 0.0) {
                self.lines.push([(at[1] - at[0]) * step, (at[2] - at[0]) * step, at[0]]);
            }
        }
    }

    /// Slices the tetrahedra of the cells that were found.
    fn slice_cells(
        &mut self,
        volume: &LocalVolume,
        face: &FaceGrid,
        only: Option<&dyn Fn(u16) -> bool>,
    ) -> Covered {
        let Some(functions) = face.functions() else { return Covered::Nothing };
        self.now += 1;
        let apex = (self.corners.len() - 1) as u16;
        let cells = std::mem::take(&mut self.cells);
        for &cell in &cells {
            for &triangle in volume.cells().faces(cell as usize) {
                let sliced = &mut self.sliced[triangle as usize];
                if std::mem::replace(sliced, self.now) == self.now
                    || only.is_some_and(|only| !only(triangle))
                {
                    continue;
                }
                let [a, b, c] = volume.triangle(triangle);
                let tetrahedron = [a, b, c, apex];
                for corner in tetrahedron {
                    let at = corner as usize;
                    if self.valued[at] != self.now {
                        self.valued[at] = self.now;
                        self.values[at] = functions.map(|f| f.at(&self.corners[at]));
                    }
                }
                self.slice_one(tetrahedron);
            }
        }
        self.cells = cells;
        if self.slices.is_empty() { Covered::Nothing } else { Covered::Slices }
    }

    /// The polygon of the image that a face covers; whether it lies within the image of the shape. `None`
    /// where it lies beside it.
    fn footprint(
        &self,
        volume: &LocalVolume,
        shape: Shape,
        corners: &[Point3<f64>],
        polygon: &mut [[f64; 2]; 5],
        count: &mut usize,
    ) -> Option<bool> {
        let camera = volume.camera();
        let mut put = |p: &Point3<f64>| {
            polygon[*count] =
                [camera.cx + camera.fx * p.x / p.z, camera.cy + camera.fy * p.y / p.z];
            *count += 1;
        };
        let mut a = &corners[corners.len() - 1];
        for b in corners {
            if (a.z < NEAR_M) != (b.z < NEAR_M) {
                let mut cut = a + (b - a) * ((NEAR_M - a.z) / (b.z - a.z));
                cut.z = NEAR_M;
                put(&cut);
            }
            if b.z >= NEAR_M {
                put(b);
            }
            a = b;
        }
        let polygon = &polygon[..*count];
        let mut within = true;
        for axis in 0..2 {
            let last = f64::from(volume.extent()[axis]) - shape.inset_px;
            let least = polygon.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
            let most = polygon.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
            if !(most >= shape.inset_px && least <= last) {
                return None;
            }
            within &= least >= shape.inset_px && most <= last;
        }
        Some(within)
    }

    /// Adds the slice of one tetrahedron.
    fn slice_one(&mut self, [a, b, c, apex]: [u16; 4]) {
        let is_above = |corner: u16| self.values[corner as usize][0] >= 0.0;
        let mut above = [0; 4];
        let mut below = [0; 4];
        let (mut up, mut down) = (0, 0);
        for corner in [a, b, c, apex] {
            if is_above(corner) {
                above[up] = corner;
                up += 1;
            } else {
                below[down] = corner;
                down += 1;
            }
        }
        // A slice lies between the corners, on the grid as in space.
        if up == 0 || down == 0 || !self.may_reach_bounds([a, b, c, apex]) {
            return;
        }
        self.chain.clear();
        match (up, down) {
            (1, 3) => {
                for other in below.into_iter().take(3) {
                    let cut = self.cut(above[0], other);
                    self.chain.push(cut);
                }
            }
            (3, 1) => {
                for other in above.into_iter().take(3) {
                    let cut = self.cut(other, below[0]);
                    self.chain.push(cut);
                }
            }
            (2, 2) => {
                for (i, j) in [(0, 0), (0, 1), (1, 1), (1, 0)] {
                    let cut = self.cut(above[i], below[j]);
                    self.chain.push(cut);
                }
            }
            _ => return,
        }
        grid::tidy(&mut self.chain);
        for line in &self.lines {
            if self.chain.is_empty() {
                return;
            }
            let inside = |[x, y]: [i64; 2]| line[0] * x as f64 + line[1] * y as f64 + line[2];
            grid::clip_line(&mut self.chain, &mut self.spare, inside);
        }
        if self.chain.is_empty() {
            return;
        }
        grid::clip(&mut self.chain, &mut self.spare);
        let Some(&[ox, oy]) = self.chain.first() else { return };
        let turns: i64 = self
            .chain
            .windows(2)
            .map(|pair| {
                let [p, q] = [pair[0], pair[1]];
                (p[0] - ox) * (q[1] - oy) - (p[1] - oy) * (q[0] - ox)
            })
            .sum();
        let place = |p: &[i64; 2]| p.map(|step| step as i32);
        if turns > 0 {
            self.slices.push(self.chain.iter().map(place));
        } else if turns < 0 {
            self.slices.push(self.chain.iter().rev().map(place));
        }
    }

    /// Whether what lies between corners of the volume may take something of what is asked for.
    fn may_reach_bounds(&self, corners: [u16; 4]) -> bool {
        let [low, high] = self.bounds;
        (0..2).all(|axis| {
            let at = corners.map(|corner| self.values[corner as usize][1 + axis]);
            let (low, high) = (f64::from(low[axis]) - 1.0, f64::from(high[axis]) + 1.0);
            at.iter().any(|x| *x > low) && at.iter().any(|x| *x < high)
        })
    }

    /// Where the edge between a vertex above the plane and one below crosses it, on the grid of the face.
    fn cut(&self, above: u16, below: u16) -> [i64; 2] {
        let (p, q) = (&self.values[above as usize], &self.values[below as usize]);
        let along = p[0] / (p[0] - q[0]);
        [1, 2].map(|axis| {
            let at = p[axis] + along * (q[axis] - p[axis]);
            at.round().clamp(-FARTHEST_STEPS, FARTHEST_STEPS) as i64
        })
    }
}

/// Where a slice leaves the face by more than this, its corners are drawn in, steps: a million faces away.
const FARTHEST_STEPS: f64 = (1_u64 << 40) as f64;
