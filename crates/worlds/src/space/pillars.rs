//! A hall with pillars.

use geometry::Point3;

use super::World3d;
use super::blocks::{Blocks, prism};
use crate::WorldError;
use crate::generate::draw::{Draw, Stream};
use crate::generate::range::{length, refuse, share};

/// Places tried for each pillar before the hall counts as crowded.
const TRIES: usize = 200;

/// A hall with round pillars up to the ceiling, and stumps that end below it.
#[derive(Clone, Debug, PartialEq)]
pub struct Pillars3dParams {
    /// Inner side along x, metres.
    pub width_m: f64,
    /// Inner side along y, metres.
    pub depth_m: f64,
    /// Height, metres.
    pub height_m: f64,
    /// Pillars and stumps together.
    pub pillars: usize,
    /// Share of them that are stumps, 0 to 1.
    pub stumps: f64,
    /// Least radius, metres.
    pub radius_min_m: f64,
    /// Greatest radius, metres.
    pub radius_max_m: f64,
    /// Least gap between two of them, and to the walls, metres.
    pub gap_m: f64,
    /// Sides of each, 3 to 64.
    pub sides: usize,
    /// The seed.
    pub seed: u64,
}

impl Default for Pillars3dParams {
    /// Nine of them in 560 m³.
    fn default() -> Self {
        Self {
            width_m: 14.0,
            depth_m: 10.0,
            height_m: 4.0,
            pillars: 9,
            stumps: 0.4,
            radius_min_m: 0.3,
            radius_max_m: 0.6,
            gap_m: 1.2,
            sides: 10,
            seed: 1,
        }
    }
}

impl Pillars3dParams {
    /// Checks the fields.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        length("width_m", self.width_m)?;
        length("depth_m", self.depth_m)?;
        length("height_m", self.height_m)?;
        refuse(self.pillars <= 10_000, "pillars", self.pillars as f64, "0 to 10000")?;
        share("stumps", self.stumps)?;
        length("radius_min_m", self.radius_min_m)?;
        length("radius_max_m", self.radius_max_m)?;
        let good = self.radius_min_m <= self.radius_max_m;
        refuse(good, "radius_max_m", self.radius_max_m, "at least radius_min_m")?;
        length("gap_m", self.gap_m)?;
        refuse((3..=64).contains(&self.sides), "sides", self.sides as f64, "3 to 64")
    }
}

/// The hall; the robot starts in the corner nearest to the origin, a gap away from both walls, halfway
/// up, and heads along +x.
///
/// # Errors
/// As [`Pillars3dParams::check`]; [`WorldError::Crowded`] where the pillars do not fit.
pub fn pillars(params: &Pillars3dParams) -> Result<World3d, WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Pillars3d);
    let mut blocks = Blocks::default();
    blocks.carve([0.0; 3], [params.width_m, params.depth_m, params.height_m]);
    let mut soup = blocks.border();
    let corner = 0.5 * params.gap_m;
    let start = Point3::new(corner, corner, 0.5 * params.height_m);
    // The start keeps a gap of its own.
    let mut placed: Vec<(Point3, f64)> = vec![(Point3::new(corner, corner, 0.0), 0.0)];
    for pillar in 0..params.pillars {
        let radius = draw.uniform_between(params.radius_min_m, params.radius_max_m);
        let margin = radius + params.gap_m;
        let span = |side: f64| (side - 2.0 * margin).max(0.0);
        let fits = params.width_m >= 2.0 * margin && params.depth_m >= 2.0 * margin;
        let foot = (0..TRIES).filter(|_| fits).find_map(|_| {
            let x = margin + draw.uniform() * span(params.width_m);
            let y = margin + draw.uniform() * span(params.depth_m);
            let foot = Point3::new(x, y, 0.0);
            let is_free = placed.iter().all(|(other, r)| (foot - other).norm() >= margin + r);
            is_free.then_some(foot)
        });
        let Some(foot) = foot else {
            return Err(WorldError::Crowded { placed: pillar, wanted: params.pillars });
        };
        let is_stump = draw.uniform() < params.stumps;
        let share = draw.uniform_between(0.25, 0.6);
        let turn = draw.uniform() * std::f64::consts::TAU;
        let height = if is_stump { share * params.height_m } else { params.height_m };
        prism(&mut soup, &foot, (radius, height), (params.sides, turn), is_stump);
        placed.push((foot, radius));
    }
    World3d::from_mesh("pillars", soup.0, soup.1, Some((start, 0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pillars_keep_their_gaps() {
        for seed in 0..20 {
            let params = Pillars3dParams { seed, ..Pillars3dParams::default() };
            let world = pillars(&params).expect("they fit");
            let start = Point3::from(world.world_from_start().translation);
            assert!(world.caster().distance_to(&start) > 0.59, "seed {seed}");
            assert_eq!(world.bounds(), (Point3::origin(), Point3::new(14.0, 10.0, 4.0)));
        }
        let crowd = Pillars3dParams { pillars: 500, ..Pillars3dParams::default() };
        assert!(matches!(pillars(&crowd), Err(WorldError::Crowded { wanted: 500, .. })));
    }
}
