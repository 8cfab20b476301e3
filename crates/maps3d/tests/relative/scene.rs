//! Rooms to look at, random volumes, and maps fed with them.

use maps3d::reduce::{InverseDepth, Method, ReduceOptions, Stop};
use maps3d::relative::{RelativeMap, RelativeParams};
use maps3d::{Look, Map3d, ViewOptions};
use nalgebra::{UnitQuaternion, Vector3};
use pose::Se3;
use posegraph::{EdgeKind, PoseGraph};
use probe::{EdgeId, Off, VertexId};
use sensing::{Camera, DepthImage};

/// A small generator of numbers from 0 to 1.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(2).wrapping_add(0x9E37_79B9_7F4A_7C15))
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub fn pose(&mut self, reach_m: f64, turn_rad: f64) -> Se3 {
        let mut three = |most: f64| {
            Vector3::new(
                self.within(-most, most),
                self.within(-most, most),
                self.within(-most, most),
            )
        };
        Se3::new(three(reach_m), UnitQuaternion::from_scaled_axis(three(turn_rad)))
    }
}

pub fn reduced_to(vertices: usize) -> ViewOptions {
    let method = Method::InverseDepth(InverseDepth::default());
    let reduce = Some(ReduceOptions::new(method, Stop::Vertices(vertices)));
    ViewOptions { reduce, ..ViewOptions::default() }
}

/// Volumes as they are: neither smaller, nor with walls around them, and never in doubt.
pub fn bare(vertices: usize) -> RelativeParams {
    RelativeParams {
        view: reduced_to(vertices),
        shrink_m: 0.0,
        inset_px: 0.0,
        wall_closing_m: 0.0,
        contradiction_share: 1.0,
        sliver_m2: 0.0,
        ..RelativeParams::default()
    }
}

/// An image of slanted walls, boxes, and pixels without a reading.
pub fn random_image(numbers: &mut Numbers) -> DepthImage {
    let columns = 6 + (numbers.next() * 12.0) as usize;
    let rows = 5 + (numbers.next() * 10.0) as usize;
    let focal = columns as f64 * numbers.within(0.4, 1.2);
    let camera = Camera::new(
        focal,
        focal * numbers.within(0.9, 1.1),
        0.5 * (columns as f64 - 1.0),
        0.5 * (rows as f64 - 1.0),
    );
    let (base, across, down) =
        (numbers.within(0.3, 1.5), numbers.within(-0.05, 0.05), numbers.within(-0.05, 0.05));
    let box_at = [numbers.next() * columns as f64, numbers.next() * rows as f64];
    let (box_m, missing) = (numbers.within(0.4, 1.5), numbers.within(0.0, 0.1));
    let depths_m = (0..columns * rows).map(|at| {
        let (column, row) = ((at % columns) as f64, (at / columns) as f64);
        let in_box = (column - box_at[0]).abs() < 3.0 && (row - box_at[1]).abs() < 2.0;
        let wall_m = 1.0 / (base + across * column + down * row).max(0.15);
        let depth_m = if in_box { wall_m.min(box_m) } else { wall_m };
        if numbers.next() < missing { f32::NAN } else { depth_m as f32 }
    });
    DepthImage::new(columns, camera, depths_m.collect())
}

/// A camera of 100 by 90 degrees in a body that looks along x.
pub fn wide_camera() -> (Camera, usize, usize) {
    let (columns, rows) = (60_usize, 52_usize);
    let focal =
        |side: usize, half_deg: f64| 0.5 * (side as f64 - 1.0) / half_deg.to_radians().tan();
    let camera = Camera::new(
        focal(columns, 50.0),
        focal(rows, 45.0),
        0.5 * (columns as f64 - 1.0),
        0.5 * (rows as f64 - 1.0),
    );
    (camera, columns, rows)
}

/// The camera in a body that is turned by a yaw: z ahead, y down.
pub fn vertex_from_camera(yaw_rad: f64) -> Se3 {
    let upright = nalgebra::Matrix3::new(0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0);
    let upright = nalgebra::Rotation3::from_matrix_unchecked(upright);
    let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rad);
    Se3::new(Vector3::zeros(), turned * UnitQuaternion::from_rotation_matrix(&upright))
}

/// A box: its least and its greatest corner, metres.
pub type Block = ([f64; 3], [f64; 3]);

/// A room of 8 by 6 by 3 m about the origin, with a pillar in it.
pub fn room_image(world_from_camera: &Se3) -> DepthImage {
    image_of(
        &[([-4.0, -3.0, -1.5], [4.0, 3.0, 1.5]), ([1.0, 0.5, -1.5], [1.6, 1.1, 1.5])],
        world_from_camera,
    )
}

/// What is seen in a box that holds boxes: the first is that around.
pub fn image_of(boxes: &[Block], world_from_camera: &Se3) -> DepthImage {
    let (camera, columns, rows) = wide_camera();
    let from = world_from_camera.translation;
    let depths_m = (0..columns * rows).map(|at| {
        let [x, y] = camera.slope_of((at % columns) as f64, (at / columns) as f64);
        let way = world_from_camera.rotation * Vector3::new(x, y, 1.0);
        let mut depth_m = f64::INFINITY;
        for (number, (low, high)) in boxes.iter().enumerate() {
            let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
            for axis in 0..3 {
                let [a, b] =
                    [low, high].map(|side: &[f64; 3]| (side[axis] - from[axis]) / way[axis]);
                (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
            }
            // The walls are seen from within, the pillar from without.
            let meets_m = if number == 0 { leave } else { enter };
            if enter <= leave && meets_m > 0.0 {
                depth_m = depth_m.min(meets_m);
            }
        }
        if depth_m < 8.0 { depth_m as f32 } else { f32::NAN }
    });
    DepthImage::new(columns, camera, depths_m.collect())
}

/// A map with its graph, fed as an exploration feeds it.
pub struct Fed {
    pub map: RelativeMap,
    pub graph: PoseGraph<Se3>,
}

impl Fed {
    pub fn new(params: RelativeParams) -> Self {
        Self { map: RelativeMap::new(params).expect("parameters"), graph: PoseGraph::new() }
    }

    pub fn vertex(&mut self) -> VertexId {
        self.graph.add_vertex()
    }

    pub fn edge(&mut self, a: VertexId, b: VertexId, a_from_b: Se3, kind: EdgeKind) -> EdgeId {
        let edge = self.graph.add_edge(a, b, a_from_b, kind).expect("an edge");
        self.map.edges_added(&self.graph, &[edge], &mut Off);
        edge
    }

    pub fn look(&mut self, vertex: VertexId, vertex_from_camera: Se3, image: &DepthImage) {
        let look = Look { vertex, vertex_from_camera, image };
        self.map.looked(&look, &mut Off).expect("a view");
    }
}
