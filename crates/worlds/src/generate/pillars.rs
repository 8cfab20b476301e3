//! A hall with pillars.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use geometry::{Point2, Vector2};
use pose::Se2;

use super::draw::{Draw, Stream};
use super::range::{length, refuse};
use crate::start::world_of_rings;
use crate::{World2d, WorldError};

/// What pillars look like from above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PillarShape {
    /// Squares with their sides along the walls.
    #[default]
    Square,
    /// Squares turned at random.
    Turned,
    /// Circles, as polygons of 24 corners.
    Round,
    /// Each pillar has one of the other three shapes.
    Mixed,
}

/// A rectangular hall with pillars that keep a distance from each other and from the walls.
#[derive(Clone, Debug, PartialEq)]
pub struct PillarsParams {
    /// Inner extent of the hall along x, metres.
    pub width_m: f64,
    /// Inner extent of the hall along y, metres.
    pub height_m: f64,
    /// How many pillars; up to 100,000.
    pub count: usize,
    /// Least side or diameter of a pillar, metres.
    pub size_min_m: f64,
    /// Greatest side or diameter of a pillar, metres; at least `size_min_m`.
    pub size_max_m: f64,
    /// Least gap between the circles around two pillars, and between them and the walls, metres.
    pub gap_m: f64,
    /// Their shape.
    pub shape: PillarShape,
    /// The seed.
    pub seed: u64,
}

impl Default for PillarsParams {
    fn default() -> Self {
        Self {
            width_m: 30.0,
            height_m: 30.0,
            count: 12,
            size_min_m: 1.0,
            size_max_m: 2.0,
            gap_m: 1.5,
            shape: PillarShape::Square,
            seed: 1,
        }
    }
}

impl PillarsParams {
    /// Checks the fields; whether all pillars fit is known only when they are placed.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        length("width_m", self.width_m)?;
        length("height_m", self.height_m)?;
        refuse(self.count <= MOST, "count", self.count as f64, "at most 100000")?;
        length("size_min_m", self.size_min_m)?;
        length("size_max_m", self.size_max_m)?;
        let good = self.size_min_m <= self.size_max_m;
        refuse(good, "size_max_m", self.size_max_m, "at least size_min_m")?;
        length("gap_m", self.gap_m)?;
        let room_m = self.width_m.min(self.height_m) - 2.0 * self.gap_m;
        let good = 2.0 * self.reach_max_m() < room_m;
        let expected = "small enough for the hall with gap_m on both sides, corners included";
        refuse(good, "size_max_m", self.size_max_m, expected)
    }

    /// Greatest radius of a circle around a pillar.
    fn reach_max_m(&self) -> f64 {
        self.size_max_m * if self.shape == PillarShape::Round { 0.5 } else { FRAC_1_SQRT_2 }
    }
}

const MOST: usize = 100_000;
/// Places tried for a pillar before the hall is called too full.
const TRIES: usize = 400;
const ROUND_CORNERS: usize = 24;

/// The hall, its lower-left corner at the world's origin; the robot starts at the most open place
/// and heads along +x.
///
/// Each pillar is put where its circle keeps `gap_m` from those before it and from the walls. So
/// free space hangs together, even for a robot as wide as the gap: every circle can be walked
/// around. n log n in the pillars.
///
/// # Errors
/// As [`PillarsParams::check`]; [`WorldError::Crowded`] where 400 random places did not do for a
/// pillar.
pub fn pillars(params: &PillarsParams) -> Result<World2d, WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Pillars);
    let mut placed = Placed::new(2.0 * params.reach_max_m() + params.gap_m);
    let mut rings = vec![vec![
        Point2::origin(),
        Point2::new(params.width_m, 0.0),
        Point2::new(params.width_m, params.height_m),
        Point2::new(0.0, params.height_m),
    ]];
    for number in 0..params.count {
        let size_m = draw.uniform_between(params.size_min_m, params.size_max_m);
        let shape = match params.shape {
            PillarShape::Mixed => {
                [PillarShape::Square, PillarShape::Turned, PillarShape::Round][draw.below(3)]
            }
            shape => shape,
        };
        let turn_rad = draw.uniform() * TAU;
        let reach_m = size_m * if shape == PillarShape::Round { 0.5 } else { FRAC_1_SQRT_2 };
        let off_m = reach_m + params.gap_m;
        let middle = (0..TRIES).find_map(|_| {
            let x = draw.uniform_between(off_m, params.width_m - off_m);
            let y = draw.uniform_between(off_m, params.height_m - off_m);
            placed.try_put(Point2::new(x, y), reach_m, params.gap_m)
        });
        let Some(middle) = middle else {
            return Err(WorldError::Crowded { placed: number, wanted: params.count });
        };
        rings.push(match shape {
            PillarShape::Round => polygon(&middle, ROUND_CORNERS, reach_m, 0.0),
            PillarShape::Turned => polygon(&middle, 4, reach_m, turn_rad),
            PillarShape::Square | PillarShape::Mixed => square(&middle, size_m / 2.0),
        });
    }
    world_of_rings("pillars", rings, None)
}

fn square(middle: &Point2, half_m: f64) -> Vec<Point2> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    corners.map(|(x, y)| middle + Vector2::new(x, y) * half_m).to_vec()
}

fn polygon(middle: &Point2, corners: usize, reach_m: f64, turn_rad: f64) -> Vec<Point2> {
    let angle = |corner: usize| turn_rad + TAU * corner as f64 / corners as f64;
    (0..corners)
        .map(|corner| middle + Se2::from_angle(angle(corner)).rotation * Vector2::new(reach_m, 0.0))
        .collect()
}

/// The circles put so far, sorted into squares of a side that no two circles in conflict exceed.
struct Placed {
    square_m: f64,
    circles: BTreeMap<(i64, i64), Vec<(Point2, f64)>>,
}

impl Placed {
    fn new(square_m: f64) -> Self {
        Self { square_m, circles: BTreeMap::new() }
    }

    fn try_put(&mut self, middle: Point2, reach_m: f64, gap_m: f64) -> Option<Point2> {
        let square = |metres: f64| (metres / self.square_m).floor() as i64;
        let (column, row) = (square(middle.x), square(middle.y));
        for near_column in column - 1..=column + 1 {
            let near = (near_column, row - 1)..=(near_column, row + 1);
            for (other, other_reach_m) in self.circles.range(near).flat_map(|(_, list)| list) {
                if (middle - other).norm() < reach_m + other_reach_m + gap_m {
                    return None;
                }
            }
        }
        self.circles.entry((column, row)).or_default().push((middle, reach_m));
        Some(middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Solid;
    use proptest::prelude::*;

    fn rings(world: &World2d) -> Vec<Vec<Point2>> {
        let Solid::Rings(rings) = world.solid() else { panic!("drawn as rings") };
        rings.clone()
    }

    #[test]
    fn bad_fields_are_named() {
        let good = PillarsParams::default();
        let fields = [
            ("width_m", PillarsParams { width_m: 0.0, ..good.clone() }),
            ("height_m", PillarsParams { height_m: f64::NAN, ..good.clone() }),
            ("count", PillarsParams { count: MOST + 1, ..good.clone() }),
            ("size_min_m", PillarsParams { size_min_m: 0.0, ..good.clone() }),
            ("size_max_m", PillarsParams { size_max_m: 0.5, ..good.clone() }),
            ("size_max_m", PillarsParams { size_max_m: 20.0, ..good.clone() }),
            ("gap_m", PillarsParams { gap_m: 0.0, ..good.clone() }),
        ];
        for (name, params) in fields {
            let Err(WorldError::Parameter { field, .. }) = pillars(&params).map(drop) else {
                panic!("{name} was let pass")
            };
            assert_eq!(field, name);
        }
        let crowded = PillarsParams { count: 1000, ..good };
        let Err(WorldError::Crowded { placed, wanted: 1000 }) = pillars(&crowded).map(drop) else {
            panic!("a thousand do not fit")
        };
        assert!(placed > 12 && placed < 1000);
    }

    #[test]
    fn an_empty_hall_is_a_hall() {
        let world = pillars(&PillarsParams { count: 0, ..PillarsParams::default() });
        assert_eq!(world.map(|world| world.obstacles().len()), Ok(4));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn pillars_keep_their_distance(
            count in 1..12_usize,
            size_min_m in 0.2..1.0_f64,
            spread_m in 0.0..1.0_f64,
            gap_m in 0.3..1.2_f64,
            shape in prop::sample::select(vec![
                PillarShape::Square, PillarShape::Turned, PillarShape::Round, PillarShape::Mixed,
            ]),
            seed in any::<u64>(),
        ) {
            let size_max_m = size_min_m + spread_m;
            let params =
                PillarsParams { count, size_min_m, size_max_m, gap_m, shape, seed, ..Default::default() };
            let world = pillars(&params).expect("few pillars fit");
            let rings = rings(&world);
            prop_assert_eq!(&rings, &self::rings(&pillars(&params).expect("few pillars fit")));
            prop_assert_eq!(rings.len(), count + 1);
            let middle = |ring: &Vec<Point2>| {
                let sum = ring.iter().fold(Vector2::zeros(), |sum, corner| sum + corner.coords);
                Point2::from(sum / ring.len() as f64)
            };
            for (index, ring) in rings[1..].iter().enumerate() {
                let centre = middle(ring);
                prop_assert!(!world.is_free(&centre));
                for corner in ring {
                    prop_assert!(corner.x >= gap_m - 1e-9 && corner.x <= 30.0 - gap_m + 1e-9);
                    prop_assert!(corner.y >= gap_m - 1e-9 && corner.y <= 30.0 - gap_m + 1e-9);
                    let reach_m = (corner - centre).norm();
                    prop_assert!(reach_m <= size_max_m * FRAC_1_SQRT_2 + 1e-9);
                    for other in rings[1..].iter().skip(index + 1).flatten() {
                        prop_assert!((corner - other).norm() >= gap_m - 1e-9);
                    }
                }
            }
            let start = Point2::from(world.world_from_start().translation);
            prop_assert!(world.caster().distance_to(&start) > gap_m / 2.0);
        }
    }
}
