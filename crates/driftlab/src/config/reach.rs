//! Lengths that only make sense beside the range of the sensor.

use explore::RapidParams;

use super::check::{Fault, fault};
use super::{Config, Planner};

/// Most cells of a grid map along one range: a scan then covers some ten million of them.
const CELLS_ALONG_A_RANGE: f64 = 2000.0;

/// Lengths beyond the widest view, two ranges, and cells too small for it.
pub(super) fn faults(config: &Config) -> Vec<Fault> {
    let range_m = config.sensor.range_m;
    // The key itself is refused with its own range.
    if !(range_m.is_finite() && range_m > 0.0) {
        return Vec::new();
    }
    let widest_m = 2.0 * range_m;
    let finest_m = range_m / CELLS_ALONG_A_RANGE;
    let mut faults = Vec::new();
    for (path, length_m) in lengths(config) {
        let is_cell = path.ends_with("cell_m");
        let least_m = if is_cell { finest_m } else { 0.0 };
        if length_m > widest_m {
            let expected = format!("at most {widest_m}, twice `sensor.range_m`");
            faults.push(fault(&path, format!("{length_m:?}"), expected));
        } else if length_m < least_m {
            let expected = format!(
                "at least {least_m}: `sensor.range_m` is to be at most {CELLS_ALONG_A_RANGE} cells"
            );
            faults.push(fault(&path, format!("{length_m:?}"), expected));
        }
    }
    faults
}

/// The lengths of a config that a view bounds, each with its key.
fn lengths(config: &Config) -> Vec<(String, f64)> {
    let maps = &config.map;
    let relative = maps.relative.iter().flat_map(|map| {
        [
            ("relative.wall_closing_m", map.wall_closing_m),
            ("relative.sliver_m", map.sliver_m),
            ("relative.strict_margin_m", map.strict_margin_m),
            ("relative.thin_m", map.thin_m),
        ]
    });
    let grid = maps.grid.iter().map(|map| ("grid.cell_m", map.cell_m));
    let corrected = maps.grid_corrected.iter().map(|map| ("grid_corrected.cell_m", map.cell_m));
    let polygons = maps.corrected_polygons.iter().flat_map(|map| {
        [
            ("corrected_polygons.wall_closing_m", map.wall_closing_m),
            ("corrected_polygons.sliver_m", map.sliver_m),
        ]
    });
    let active = maps.active_area.iter().flat_map(|map| {
        [
            ("active_area.wall_closing_m", map.wall_closing_m),
            ("active_area.sliver_m", map.sliver_m),
            ("active_area.strict_margin_m", map.strict_margin_m),
        ]
    });
    let extended = maps.extended.iter().flat_map(|map| {
        [
            ("extended.wall_closing_m", map.wall_closing_m),
            ("extended.strict_margin_m", map.strict_margin_m),
            ("extended.thin_m", map.thin_m),
        ]
    });
    let of_maps =
        relative.chain(grid).chain(corrected).chain(polygons).chain(active).chain(extended);
    let mut all: Vec<(String, f64)> =
        of_maps.map(|(key, length_m)| (format!("map.{key}"), length_m)).collect();
    let (policy, planner) = match &config.planner {
        Planner::Rapid(planner) => ("rapid", RapidParams::from(planner)),
        Planner::Survey(planner) => ("survey", RapidParams::from(planner)),
    };
    let lists =
        [("clearances_m", &planner.clearances_m), ("normal_point_m", &planner.normal_point_m)];
    let of_policy = |key: &str| format!("planner.{policy}.{key}");
    for (key, lengths_m) in lists {
        all.extend(lengths_m.iter().map(|&length_m| (of_policy(key), length_m)));
    }
    all.push((of_policy("give_up_radius_m"), planner.give_up_radius_m));
    all.push((of_policy("arrival_m"), planner.arrival_m));
    all.push(("robot.radius_m".to_owned(), config.robot.radius_m));
    all
}

#[cfg(test)]
mod tests {
    use super::super::{GridMap, RelativeMap};
    use super::*;

    #[test]
    fn what_no_view_could_hold_is_refused_at_its_key() {
        let mut config = Config::default();
        config.map.relative = Some(RelativeMap { wall_closing_m: 1e5, ..RelativeMap::default() });
        config.map.grid = Some(GridMap { cell_m: 1e-3, ..GridMap::default() });
        config.robot.radius_m = 10.5;
        let told: Vec<(String, String)> =
            faults(&config).into_iter().map(|fault| (fault.path, fault.expected)).collect();
        let expected = [
            ("map.relative.wall_closing_m", "at most 10, twice `sensor.range_m`"),
            ("map.grid.cell_m", "at least 0.0025: `sensor.range_m` is to be at most 2000 cells"),
            ("robot.radius_m", "at most 10, twice `sensor.range_m`"),
        ];
        assert_eq!(told, expected.map(|(path, words)| (path.to_owned(), words.to_owned())));
    }

    #[test]
    fn the_defaults_suit_their_sensor() {
        let mut config = Config::default();
        config.map.relative = Some(RelativeMap::default());
        config.map.grid = Some(GridMap::default());
        assert_eq!(faults(&config), []);
    }
}
