//! What a depth camera sees, as a polyhedron.

use pose::Se3;
use pose::nalgebra::{UnitQuaternion, Vector3};

use super::World;
use super::random::Random;
use crate::{Face, Label, Point3, Polyhedron};

/// Half the width and height of the image at 1 m, metres.
const HALF: [f64; 2] = [0.56, 0.42];
/// Beyond this depth nothing is seen, metres.
const FAR_M: f64 = 4.0;
/// A face whose depths differ by more than this factor is frontier.
const STEP: f64 = 1.25;

/// The kinds of sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Exact poses and depths: faces of different views are coplanar to rounding.
    Coplanar,
    /// 0.3 % of noise on depths, poses off by 1 cm and 0.3 degrees, anywhere in the hall.
    Noisy,
    /// The same noise, poses along a path: views overlap much.
    Path,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Coplanar, Self::Noisy, Self::Path];
}

/// How a view is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the sensor truly is: x ahead, y to the left.
    pub world_from_sensor: Se3,
    /// Where it believes to be.
    pub map_from_sensor: Se3,
    /// Cells of the grid over the image, across and down.
    pub cells: [u32; 2],
    /// Deviation of a depth, as a share of it.
    pub noise: f64,
    /// Where its random numbers start.
    pub seed: u64,
}

/// A view in the map's frame: closed, star-shaped around the sensor.
pub fn view(world: &World, camera: &Camera) -> Polyhedron {
    let mut random = Random::new(camera.seed);
    let [columns, rows] = camera.cells;
    let hole = [0, 1].map(|axis| random.between(-HALF[axis], HALF[axis]));
    let mut vertices = Vec::new();
    let mut depths = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let place = |axis: usize, index: u32, count: u32, random: &mut Random| {
                let inner = index > 0 && index < count;
                // Less than a quarter of a cell: every quadrangle stays convex.
                let jitter = if inner { random.between(-0.24, 0.24) } else { 0.0 };
                HALF[axis] * (2.0 * (f64::from(index) + jitter) / f64::from(count) - 1.0)
            };
            let u = place(0, column, columns, &mut random);
            let v = place(1, row, rows, &mut random);
            let ray = camera.world_from_sensor.rotation * Vector3::new(1.0, u, v);
            let from = Point3::from(camera.world_from_sensor.translation);
            let seen = world.cast(&from, &ray);
            let missing = seen > FAR_M || (u - hole[0]).hypot(v - hole[1]) < 0.06;
            let noise = 1.0 + camera.noise * random.normal();
            let depth = if missing { FAR_M } else { seen * noise };
            depths.push((depth, missing));
            let in_sensor = Point3::new(depth, depth * u, depth * v);
            vertices.push(camera.map_from_sensor.transform(&in_sensor));
        }
    }
    let mut faces: Vec<Face> = Vec::new();
    let mut labels = Vec::new();
    let at = |row: u32, column: u32| row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (at(row, column), at(row, column + 1));
            let (c, d) = (at(row + 1, column + 1), at(row + 1, column));
            let both =
                if random.unit() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            for face in both {
                let corners = face.map(|vertex| depths[vertex as usize]);
                let near = corners.iter().fold(f64::INFINITY, |m, c| m.min(c.0));
                let far = corners.iter().fold(0.0_f64, |m, c| m.max(c.0));
                let blind = corners.iter().any(|c| c.1) || far > STEP * near;
                faces.push(face);
                labels.push(if blind { Label::Frontier } else { Label::Obstacle });
            }
        }
    }
    let sensor = vertices.len() as u32;
    vertices.push(Point3::from(camera.map_from_sensor.translation));
    let bottom = (0..columns).map(|i| (at(0, i), at(0, i + 1)));
    let right = (0..rows).map(|i| (at(i, columns), at(i + 1, columns)));
    let top = (0..columns).map(|i| (at(rows, i + 1), at(rows, i)));
    let left = (0..rows).map(|i| (at(i + 1, 0), at(i, 0)));
    for (from, to) in bottom.chain(right).chain(top).chain(left) {
        faces.push([to, from, sensor]);
        labels.push(Label::Frontier);
    }
    Polyhedron::from_sound_parts(vertices, faces, labels, None)
}

/// A pose at `at`, looking along `yaw` to the left of x and `pitch` upwards.
fn looking(at: Point3, yaw: f64, pitch: f64) -> Se3 {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw)
        * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -pitch);
    Se3::new(at.coords, turn)
}

/// The first `count` views of a set in the hall, each with its number as the origin's view.
pub fn views(kind: Kind, count: usize) -> Vec<Polyhedron> {
    let world = World::hall();
    (0..count)
        .map(|index| {
            let mut random = Random::new(1000 * index as u64 + 17);
            let world_from_sensor = match kind {
                Kind::Coplanar | Kind::Noisy => anywhere(&world, &mut random),
                Kind::Path => along_path(index as f64 / 50.0),
            };
            let drifts = kind != Kind::Coplanar;
            let mut off = |size: f64| {
                let size = if drifts { size } else { 0.0 };
                Vector3::from_fn(|_, _| size * random.normal())
            };
            let drift = Se3::new(off(0.01), UnitQuaternion::from_scaled_axis(off(0.005)));
            let columns = 11 + (random.unit() * 14.0) as u32;
            let camera = Camera {
                world_from_sensor,
                map_from_sensor: world_from_sensor * drift,
                cells: [columns, columns * 3 / 4],
                noise: if drifts { 0.003 } else { 0.0 },
                seed: 100 + index as u64,
            };
            let map_from_sensor =
                if drifts { camera.map_from_sensor } else { camera.world_from_sensor };
            view(&world, &Camera { map_from_sensor, ..camera }).as_view(index as u32)
        })
        .collect()
}

/// A free place in the hall.
fn anywhere(world: &World, random: &mut Random) -> Se3 {
    loop {
        let [low, high] = &world.room;
        let at = Point3::new(
            random.between(low.x, high.x),
            random.between(low.y, high.y),
            random.between(0.8, 1.6),
        );
        if world.is_free(&at, 0.4) {
            let yaw = random.between(0.0, std::f64::consts::TAU);
            return looking(at, yaw, random.between(-0.35, 0.2));
        }
    }
}

/// The pose at a share of the way round the hall.
fn along_path(share: f64) -> Se3 {
    let way = [
        [0.9, 0.9],
        [0.8, 4.6],
        [3.3, 4.4],
        [3.0, 8.3],
        [7.6, 8.0],
        [8.6, 5.2],
        [11.3, 4.4],
        [11.2, 0.7],
        [7.2, 1.4],
        [3.8, 0.9],
    ];
    let length = |leg: &[[f64; 2]]| (leg[1][0] - leg[0][0]).hypot(leg[1][1] - leg[0][1]);
    let whole: f64 = way.windows(2).map(length).sum();
    let mut left = share.clamp(0.0, 1.0) * whole;
    let mut pose = looking(Point3::new(way[0][0], way[0][1], 1.1), 0.0, -0.1);
    for leg in way.windows(2) {
        let (from, to, long) = (leg[0], leg[1], length(leg));
        let t = (left / long).clamp(0.0, 1.0);
        let at = [0, 1].map(|i| from[i] + (to[i] - from[i]) * t);
        let yaw = (to[1] - from[1]).atan2(to[0] - from[0]) + 0.5 * (3.0 * share * whole).sin();
        pose = looking(Point3::new(at[0], at[1], 1.1), yaw, -0.1);
        if left <= long {
            break;
        }
        left -= long;
    }
    pose
}
