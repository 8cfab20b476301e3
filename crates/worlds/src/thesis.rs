//! The three polygon maps of \[Zie18\] (sec. 3.2), as recovered from its vector figures.
//!
//! Metres from the lower-left corner of the outer wall. The published start of the first map is
//! kept. Those of the others are lost; ours, chosen in open ground and away from every wall:
//! second (7.5, 20), third (12, 22). All head along +x. The three boxes in the third map's room
//! are drawn 1 m by 1 m around their recovered middles, and the walls of that room lie inside its
//! recovered outline.

use geometry::Point2;
use pose::Se2;

use crate::World2d;

/// Names of the thesis's places, as [`by_name`] takes them.
pub const NAMES: [&str; 3] = ["first", "second", "third"];

/// The place of that name, one of [`NAMES`].
pub fn by_name(name: &str) -> Option<World2d> {
    match name {
        "first" => Some(first()),
        "second" => Some(second()),
        "third" => Some(third()),
        _ => None,
    }
}

/// 30 m by 30 m with two square blocks.
pub fn first() -> World2d {
    let rings = vec![
        block(0.0..30.0, 0.0..30.0),
        block(5.0..10.0, 20.0..25.0),
        block(20.0..25.0, 20.0..25.0),
    ];
    build("first", rings, (7.5, 7.5))
}

/// 40 m by 40 m with four blocks, and a triangle whose right corner touches the outer wall.
pub fn second() -> World2d {
    let rings = vec![
        block(0.0..40.0, 0.0..40.0),
        block(5.0..10.0, 30.0..35.0),
        block(30.0..35.0, 30.0..35.0),
        block(15.0..20.0, 20.0..25.0),
        block(5.0..15.0, 5.0..10.0),
        ring(&[(30.0, 15.0), (40.0, 15.0), (35.0, 20.0)]),
    ];
    build("second", rings, (7.5, 20.0))
}

/// 55.5 m by 43.5 m with eleven blocks, one of them shaped like an L, and a room with three boxes
/// whose thin walls are open in the middle of its left and of its right side.
pub fn third() -> World2d {
    const WALL_M: f64 = 0.3;
    let (left, right, bottom, top) = (24.5, 34.5, 24.5, 38.0);
    let (door_bottom, door_top) = (28.5, 34.0);
    // Each half of the room's wall is one ring that goes around outside and back inside.
    let half = |outer_y: f64, inner_y: f64, door_y: f64| {
        ring(&[
            (left, door_y),
            (left, outer_y),
            (right, outer_y),
            (right, door_y),
            (right - WALL_M, door_y),
            (right - WALL_M, inner_y),
            (left + WALL_M, inner_y),
            (left + WALL_M, door_y),
        ])
    };
    let crate_around = |x: f64, y: f64| block(x - 0.5..x + 0.5, y - 0.5..y + 0.5);
    let rings = vec![
        block(0.0..55.5, 0.0..43.5),
        block(5.5..19.0, 34.0..38.0),
        block(40.0..50.0, 34.0..38.0),
        block(5.5..9.5, 24.5..28.5),
        block(15.0..19.0, 24.5..28.5),
        block(40.0..44.0, 24.5..28.5),
        block(15.0..19.0, 15.0..19.0),
        block(24.5..34.5, 15.0..19.0),
        block(40.0..50.0, 15.0..19.0),
        block(24.5..34.5, 5.5..9.5),
        block(40.0..50.0, 5.5..9.5),
        ring(&[(5.5, 5.5), (19.0, 5.5), (19.0, 9.5), (9.5, 9.5), (9.5, 19.0), (5.5, 19.0)]),
        half(bottom, bottom + WALL_M, door_bottom),
        half(top, top - WALL_M, door_top),
        crate_around(26.2, 27.0),
        crate_around(28.2, 28.0),
        crate_around(33.0, 28.0),
    ];
    build("third", rings, (12.0, 22.0))
}

fn ring(corners: &[(f64, f64)]) -> Vec<Point2> {
    corners.iter().map(|&(x, y)| Point2::new(x, y)).collect()
}

fn block(x: std::ops::Range<f64>, y: std::ops::Range<f64>) -> Vec<Point2> {
    ring(&[(x.start, y.start), (x.end, y.start), (x.end, y.end), (x.start, y.end)])
}

fn build(name: &str, rings: Vec<Vec<Point2>>, start_in_world: (f64, f64)) -> World2d {
    let world_from_start = Se2::new(start_in_world.0, start_in_world.1, 0.0);
    World2d::from_polygons(name, rings, world_from_start)
        .expect("the thesis's maps have an area and their starts are free")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Solid;
    use crate::raster::cells_of_tiles;
    use crate::start::components;

    /// Area by the shoelace formula: the outer ring less all others.
    fn free_area(world: &World2d) -> f64 {
        let Solid::Rings(rings) = world.solid() else { panic!("drawn as rings") };
        let area = |ring: &Vec<Point2>| {
            let next = |i: usize| ring[(i + 1) % ring.len()];
            let twice: f64 =
                (0..ring.len()).map(|i| ring[i].x * next(i).y - next(i).x * ring[i].y).sum();
            twice.abs() / 2.0
        };
        area(&rings[0]) - rings[1..].iter().map(area).sum::<f64>()
    }

    #[test]
    fn areas_are_those_of_the_drawings() {
        assert!((free_area(&first()) - (900.0 - 50.0)).abs() < 1e-9);
        assert!((free_area(&second()) - (1600.0 - 75.0 - 50.0 - 25.0)).abs() < 1e-9);
        // By hand: ten blocks, the L, the two halves of the room's wall, three boxes.
        let blocks = 54.0 + 40.0 + 16.0 * 3.0 + 16.0 + 40.0 * 4.0;
        let l_block = 13.5 * 4.0 + 4.0 * 9.5;
        let walls = 2.0 * 10.0 * 0.3 + 2.0 * 0.3 * (3.7 + 3.7);
        let expected = 55.5 * 43.5 - blocks - l_block - walls - 3.0;
        assert!((free_area(&third()) - expected).abs() < 1e-9);
    }

    #[test]
    fn all_free_space_hangs_together_and_no_two_blocks_overlap() {
        for name in NAMES {
            let world = by_name(name).expect("known");
            let (low, high) = world.bounds();
            let cell_m = 0.1;
            let (columns, rows) =
                (((high.x - low.x) / cell_m).round(), ((high.y - low.y) / cell_m).round());
            let mut blocked = Vec::new();
            for row in (0..rows as usize).rev() {
                for column in 0..columns as usize {
                    let at = |index: usize| (index as f64 + 0.5) * cell_m;
                    blocked.push(!world.is_free(&Point2::new(at(column), at(row))));
                }
            }
            let cells = cells_of_tiles(columns as usize, rows as usize, &blocked, cell_m);
            let parts = components(&cells.expect("a map"));
            assert_eq!(parts.sizes.len(), 1, "{name}");
            // Where two rings overlapped, their common part would count as free.
            let area = parts.sizes[0] as f64 * cell_m * cell_m;
            assert!((area - free_area(&world)).abs() < 1.0, "{name}: {area}");
            let start = Point2::from(world.world_from_start().translation);
            assert!(world.caster().distance_to(&start) >= 2.0, "{name}");
        }
        assert!(by_name("fourth").is_none());
    }
}
