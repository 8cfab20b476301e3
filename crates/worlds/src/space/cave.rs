//! Chambers and tunnels with uneven walls.

use geometry::{Point3, Vector3};

use super::World3d;
use super::tetrahedra::surface;
use crate::WorldError;
use crate::generate::draw::{Draw, Stream};
use crate::generate::range::{length, refuse};

/// A ring of chambers joined by tunnels.
#[derive(Clone, Debug, PartialEq)]
pub struct Cave3dParams {
    /// Number of chambers, 1 to 64; three and more close a loop.
    pub chambers: usize,
    /// Radius of the ring on which they lie, metres.
    pub ring_m: f64,
    /// Least half-width of a chamber, metres.
    pub chamber_min_m: f64,
    /// Greatest half-width of a chamber, metres.
    pub chamber_max_m: f64,
    /// Height of a chamber as a share of its width.
    pub flatness: f64,
    /// Radius of the tunnels, metres.
    pub tunnel_m: f64,
    /// How far chambers lie above and below each other, metres.
    pub rise_m: f64,
    /// How uneven the walls are, metres.
    pub unevenness_m: f64,
    /// Side of the lattice that cuts the walls into triangles, metres.
    pub cell_m: f64,
    /// The seed.
    pub seed: u64,
}

impl Default for Cave3dParams {
    fn default() -> Self {
        Self {
            chambers: 5,
            ring_m: 6.0,
            chamber_min_m: 1.8,
            chamber_max_m: 2.6,
            flatness: 0.7,
            tunnel_m: 1.0,
            rise_m: 1.0,
            unevenness_m: 0.15,
            cell_m: 0.5,
            seed: 1,
        }
    }
}

impl Cave3dParams {
    /// Checks the fields.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        refuse((1..=64).contains(&self.chambers), "chambers", self.chambers as f64, "1 to 64")?;
        length("ring_m", self.ring_m)?;
        length("chamber_min_m", self.chamber_min_m)?;
        length("chamber_max_m", self.chamber_max_m)?;
        let good = self.chamber_min_m <= self.chamber_max_m;
        refuse(good, "chamber_max_m", self.chamber_max_m, "at least chamber_min_m")?;
        length("flatness", self.flatness)?;
        length("tunnel_m", self.tunnel_m)?;
        let good = self.rise_m.is_finite() && self.rise_m >= 0.0;
        refuse(good, "rise_m", self.rise_m, "a length, or 0")?;
        let good = (0.0..0.5 * self.tunnel_m).contains(&self.unevenness_m);
        refuse(good, "unevenness_m", self.unevenness_m, "from 0 to less than half of tunnel_m")?;
        length("cell_m", self.cell_m)?;
        let cubes = self.counts().iter().map(|count| *count as f64).product::<f64>();
        refuse(cubes <= 4e6, "cell_m", self.cell_m, "at most 4e6 cubes over the cave")
    }

    /// Half of the box around the cave, metres.
    fn reach(&self) -> Vector3 {
        let around = self.ring_m + self.chamber_max_m + self.unevenness_m + 2.0 * self.cell_m;
        let high = 0.5 * self.rise_m
            + (self.flatness * self.chamber_max_m).max(self.tunnel_m)
            + self.unevenness_m
            + 2.0 * self.cell_m;
        Vector3::new(around, around, high)
    }

    fn counts(&self) -> [usize; 3] {
        let reach = self.reach();
        [0, 1, 2].map(|k| (2.0 * reach[k] / self.cell_m).ceil().clamp(1.0, 1e6) as usize)
    }
}

/// A chamber: its centre and its half-width.
type Chamber = (Point3, f64);

/// The cave; the robot starts in the middle of the first chamber and heads along +x.
///
/// # Errors
/// As [`Cave3dParams::check`].
pub fn cave(params: &Cave3dParams) -> Result<World3d, WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Cave3d);
    let chambers: Vec<Chamber> = (0..params.chambers)
        .map(|i| {
            let share = (i as f64 + 0.3 * (draw.uniform() - 0.5)) / params.chambers as f64;
            let angle = std::f64::consts::TAU * share;
            let half = draw.uniform_between(params.chamber_min_m, params.chamber_max_m);
            let z = params.rise_m * (draw.uniform() - 0.5);
            let ring = params.ring_m * draw.uniform_between(0.85, 1.0);
            (Point3::new(ring * angle.cos(), ring * angle.sin(), z), half)
        })
        .collect();
    // Three waves make the walls uneven; sines are smooth, and the same on every machine to rounding.
    let waves: Vec<(Vector3, f64)> = (0..3)
        .map(|_| {
            let along = Vector3::new(
                draw.uniform_between(-1.0, 1.0),
                draw.uniform_between(-1.0, 1.0),
                draw.uniform_between(-1.0, 1.0),
            );
            let pace = draw.uniform_between(1.5, 2.5) / along.norm().max(0.1);
            (along * pace, draw.uniform() * std::f64::consts::TAU)
        })
        .collect();
    let value = |p: &Point3| {
        let uneven: f64 = waves.iter().map(|(k, phase)| (p.coords.dot(k) + phase).sin()).sum();
        hollow(p, &chambers, params) + params.unevenness_m * uneven / 3.0
    };
    let low = Point3::from(-params.reach());
    let (vertices, triangles) = surface(&low, params.cell_m, params.counts(), value);
    World3d::from_mesh("cave", vertices, triangles, Some((chambers[0].0, 0.0)))
}

/// Below zero inside of chambers and tunnels; about the distance to their walls, metres.
fn hollow(p: &Point3, chambers: &[Chamber], params: &Cave3dParams) -> f64 {
    let mut least = f64::INFINITY;
    let mut join = |value: f64| {
        // A smooth minimum over half a metre (a parabola between the two).
        let gap = (0.5 - (least - value).abs()).max(0.0);
        least = least.min(value) - 0.5 * gap * gap;
    };
    for (centre, half) in chambers {
        let mut away = p - centre;
        away.z /= params.flatness;
        join((away.norm() - half) * params.flatness.min(1.0));
    }
    for i in 0..chambers.len() {
        let (a, b) = (chambers[i].0, chambers[(i + 1) % chambers.len()].0);
        let way = b - a;
        let squared = way.norm_squared();
        let share = if squared > 0.0 { ((p - a).dot(&way) / squared).clamp(0.0, 1.0) } else { 0.0 };
        join((p - (a + way * share)).norm() - params.tunnel_m);
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_can_fly_around_the_ring() {
        for seed in 0..10 {
            let params = Cave3dParams { seed, ..Cave3dParams::default() };
            let world = cave(&params).expect("good");
            let start = Point3::from(world.world_from_start().translation);
            assert!(world.caster().distance_to(&start) > 0.8, "seed {seed}");
            // Nothing leaves: rays into all directions hit.
            for i in 0..200 {
                let angle = f64::from(i) * 2.4;
                let z = f64::from(i) / 100.0 - 1.0;
                let flat = (1.0 - z * z).max(0.0).sqrt();
                let direction = Vector3::new(flat * angle.cos(), flat * angle.sin(), z).normalize();
                assert!(world.caster().cast(&start, &direction, 50.0).is_some());
            }
        }
    }
}
