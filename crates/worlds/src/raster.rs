//! From pictures to cells: which pixels are solid.

use geometry::Point2;

use crate::{CellMap, WorldError};

/// The most cells of a map, 2^28.
pub(crate) const MAX_CELLS: usize = 1 << 28;

/// A grey image as readers of files hand it over: row 0 is the top row.
#[derive(Clone, Copy, Debug)]
pub struct Raster<'a> {
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Shades from 0 (black) to 255 (white), row-major from the top row.
    pub shades: &'a [u8],
    /// Pixels that say nothing, row-major from the top row; empty when there are none.
    pub transparent: &'a [bool],
}

/// How a shade becomes solid, free or unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ShadeRule {
    /// Told from the image itself by [`automatic_rule`].
    #[default]
    Automatic,
    /// Pixels darker than a share of white are solid, all others free.
    Dark {
        /// The share of white, 0 to 1.
        solid_below: f64,
    },
    /// ROS's map_server, modes `trinary` and `scale`: with p = (255 - shade) / 255 (or shade / 255
    /// when negated), solid where p > `occupied_thresh`, free where p < `free_thresh`, unknown
    /// between. Mode `scale` calls what lies between a probability; a robot may not count on it.
    MapServer {
        /// Above this a pixel is solid, 0 to 1.
        occupied_thresh: f64,
        /// Below this a pixel is free, 0 to 1.
        free_thresh: f64,
        /// Whether white means solid.
        negate: bool,
    },
    /// ROS's map_server, mode `raw`: the shade is the occupancy in percent, above 100 unknown; the
    /// thresholds apply to shade / 100.
    MapServerRaw {
        /// Above this a pixel is solid, 0 to 1.
        occupied_thresh: f64,
        /// Below this a pixel is free, 0 to 1.
        free_thresh: f64,
    },
}

impl ShadeRule {
    /// map_server's default: `occupied_thresh` 0.65, `free_thresh` 0.196, not negated.
    pub const MAP_SERVER: Self =
        Self::MapServer { occupied_thresh: 0.65, free_thresh: 0.196, negate: false };
}

/// How an image becomes a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RasterParams {
    /// Side of a pixel, metres.
    pub resolution_m: f64,
    /// Lower-left corner of the image in the world frame, metres.
    pub origin_in_world: Point2,
    /// How a shade is read.
    pub rule: ShadeRule,
    /// Whether unknown ground is solid, as a robot cannot explore what nobody measured.
    pub unknown_is_solid: bool,
}

impl Default for RasterParams {
    fn default() -> Self {
        Self {
            resolution_m: 0.05,
            origin_in_world: Point2::origin(),
            rule: ShadeRule::Automatic,
            unknown_is_solid: true,
        }
    }
}

/// The cells of an image; one pixel, one cell. Linear in the pixels.
///
/// # Errors
/// [`WorldError::NoArea`], [`WorldError::CellCount`] and [`WorldError::Parameter`] for sizes and
/// parameters that make no map; [`WorldError::OneShade`] where the automatic rule finds no contrast.
pub fn cells_of_image(raster: &Raster<'_>, params: &RasterParams) -> Result<CellMap, WorldError> {
    let Raster { columns, rows, shades, transparent } = *raster;
    check_grid(columns, rows, params.resolution_m, "resolution_m")?;
    check_count(shades.len(), columns * rows)?;
    if !transparent.is_empty() {
        check_count(transparent.len(), columns * rows)?;
    }
    let rule = match params.rule {
        ShadeRule::Automatic => automatic_rule(shades)?,
        rule => rule,
    };
    let unknown = params.unknown_is_solid;
    let mut solid_by_shade = [unknown; 256];
    for (shade, solid) in solid_by_shade.iter_mut().enumerate() {
        *solid = is_solid(shade as f64, &rule)?.unwrap_or(unknown);
    }
    let mut cells = CellMap {
        columns,
        rows,
        cell_m: params.resolution_m,
        origin_in_world: params.origin_in_world,
        solid: Vec::with_capacity(columns * rows),
    };
    for row in (0..rows).rev() {
        for index in row * columns..(row + 1) * columns {
            let clear = transparent.get(index).copied().unwrap_or(false);
            cells.solid.push(if clear { unknown } else { solid_by_shade[shades[index] as usize] });
        }
    }
    Ok(cells)
}

/// The cells of a map of tiles that block or not, row-major from the top row; lower-left corner at
/// the world's origin. Linear in the tiles.
///
/// # Errors
/// [`WorldError::NoArea`], [`WorldError::CellCount`] and [`WorldError::Parameter`] for sizes that
/// make no map.
pub fn cells_of_tiles(
    columns: usize,
    rows: usize,
    blocked: &[bool],
    cell_m: f64,
) -> Result<CellMap, WorldError> {
    check_grid(columns, rows, cell_m, "cell_m")?;
    check_count(blocked.len(), columns * rows)?;
    let solid = blocked.chunks(columns).rev().flatten().copied().collect();
    Ok(CellMap { columns, rows, cell_m, origin_in_world: Point2::origin(), solid })
}

/// The rule for an image of which nothing is known.
///
/// Where more than 1 % of the pixels have the shade 205, which map_saver writes for unknown ground,
/// and more than 1 % are nearly white (254, 255), the image is read as map_server would by default.
/// Else dark is solid: the threshold is Otsu's (the split with the greatest variance between its two
/// classes), halfway between the shades on its two sides. Stage's bitmaps, grey-walled dungeons and
/// scanned plans come out right by this; an image whose walls are lighter than its floors does not.
///
/// # Errors
/// [`WorldError::OneShade`] where all pixels are alike.
pub fn automatic_rule(shades: &[u8]) -> Result<ShadeRule, WorldError> {
    let mut counts = [0_u64; 256];
    for &shade in shades {
        counts[shade as usize] += 1;
    }
    let percent = shades.len() as u64 / 100;
    if counts[205] > percent && counts[254] + counts[255] > percent {
        return Ok(ShadeRule::MAP_SERVER);
    }
    let present: Vec<usize> = (0..256).filter(|&shade| counts[shade] > 0).collect();
    let total = shades.len() as f64;
    let sum: f64 = present.iter().map(|&shade| shade as f64 * counts[shade] as f64).sum();
    let (mut dark_count, mut dark_sum) = (0.0, 0.0);
    let mut best: Option<(f64, f64)> = None;
    for pair in present.windows(2) {
        dark_count += counts[pair[0]] as f64;
        dark_sum += pair[0] as f64 * counts[pair[0]] as f64;
        let bright_count = total - dark_count;
        let apart = dark_sum / dark_count - (sum - dark_sum) / bright_count;
        let variance = dark_count * bright_count * apart * apart;
        if best.is_none_or(|(most, _)| variance > most) {
            best = Some((variance, (pair[0] + pair[1]) as f64 / 2.0 / 255.0));
        }
    }
    match best {
        Some((_, solid_below)) => Ok(ShadeRule::Dark { solid_below }),
        None => Err(WorldError::OneShade { shade: shades.first().copied().unwrap_or(0) }),
    }
}

/// Whether a shade is solid; `None` is unknown ground.
fn is_solid(shade: f64, rule: &ShadeRule) -> Result<Option<bool>, WorldError> {
    let by_thresholds = |p: f64, occupied_thresh: f64, free_thresh: f64| {
        check_share("occupied_thresh", occupied_thresh)?;
        check_share("free_thresh", free_thresh)?;
        Ok(if p > occupied_thresh {
            Some(true)
        } else if p < free_thresh {
            Some(false)
        } else {
            None
        })
    };
    match *rule {
        ShadeRule::Automatic => Ok(None),
        ShadeRule::Dark { solid_below } => {
            check_share("solid_below", solid_below)?;
            Ok(Some(shade / 255.0 < solid_below))
        }
        ShadeRule::MapServer { occupied_thresh, free_thresh, negate } => {
            let p = if negate { shade / 255.0 } else { (255.0 - shade) / 255.0 };
            by_thresholds(p, occupied_thresh, free_thresh)
        }
        ShadeRule::MapServerRaw { occupied_thresh, free_thresh } => {
            let known = by_thresholds(shade / 100.0, occupied_thresh, free_thresh)?;
            Ok(if shade > 100.0 { None } else { known })
        }
    }
}

fn check_share(field: &'static str, found: f64) -> Result<(), WorldError> {
    if (0.0..=1.0).contains(&found) {
        return Ok(());
    }
    Err(WorldError::Parameter { field, found, expected: "0 to 1" })
}

fn check_count(found: usize, expected: usize) -> Result<(), WorldError> {
    if found == expected { Ok(()) } else { Err(WorldError::CellCount { found, expected }) }
}

/// Checks that a grid has cells, not too many, and that their side is a length.
pub(crate) fn check_grid(
    columns: usize,
    rows: usize,
    cell_m: f64,
    field: &'static str,
) -> Result<(), WorldError> {
    if !cell_m.is_finite() || cell_m <= 0.0 {
        return Err(WorldError::Parameter { field, found: cell_m, expected: "a length above 0" });
    }
    if columns == 0 || rows == 0 {
        let (width_m, height_m) = (columns as f64 * cell_m, rows as f64 * cell_m);
        return Err(WorldError::NoArea { width_m, height_m });
    }
    if columns.checked_mul(rows).is_none_or(|count| count > MAX_CELLS) {
        let found = columns as f64 * rows as f64;
        let expected = "at most 2^28: a coarser or smaller map";
        return Err(WorldError::Parameter { field: "number of cells", found, expected });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solid(shades: &[u8], rule: ShadeRule) -> Vec<bool> {
        let raster = Raster { columns: shades.len(), rows: 1, shades, transparent: &[] };
        let params = RasterParams { rule, ..RasterParams::default() };
        cells_of_image(&raster, &params).expect("valid").solid
    }

    #[test]
    fn the_top_row_of_the_image_is_the_highest() {
        let raster = Raster { columns: 2, rows: 3, shades: &[0, 9, 9, 9, 9, 9], transparent: &[] };
        let cells = cells_of_image(&raster, &RasterParams::default()).expect("valid");
        let at = |column, row| cells.is_solid(column, row);
        assert!(at(0, 2) && !at(1, 2) && !at(0, 0));
        let tiles = cells_of_tiles(2, 3, &[true, false, false, false, false, false], 1.0);
        assert_eq!(tiles.expect("valid").solid, cells.solid);
    }

    #[test]
    fn map_servers_thresholds() {
        // 205 is p = 50/255 = 0.19608, just not below 0.196: unknown, thus solid; 206 is free.
        assert_eq!(
            solid(&[0, 89, 90, 205, 206, 254], ShadeRule::MAP_SERVER),
            [true, true, true, true, false, false]
        );
        let rule = ShadeRule::MapServer { occupied_thresh: 0.65, free_thresh: 0.196, negate: true };
        assert_eq!(solid(&[0, 49, 50, 255], rule), [false, false, true, true]);
        let rule = ShadeRule::MapServerRaw { occupied_thresh: 0.65, free_thresh: 0.25 };
        assert_eq!(
            solid(&[0, 24, 25, 100, 101, 255], rule),
            [false, false, true, true, true, true]
        );
    }

    #[test]
    fn unknown_ground_may_be_free() {
        let transparent = [true, false, false];
        let raster =
            Raster { columns: 3, rows: 1, shades: &[0, 205, 0], transparent: &transparent };
        let mut params = RasterParams { rule: ShadeRule::MAP_SERVER, ..RasterParams::default() };
        assert_eq!(cells_of_image(&raster, &params).expect("valid").solid, [true; 3]);
        params.unknown_is_solid = false;
        assert_eq!(cells_of_image(&raster, &params).expect("valid").solid, [false, false, true]);
    }

    #[test]
    fn the_automatic_rule_on_the_usual_pictures() {
        let counted = |levels: &[(u8, usize)]| -> Vec<u8> {
            levels.iter().flat_map(|&(shade, count)| std::iter::repeat_n(shade, count)).collect()
        };
        let dark = |levels: &[(u8, usize)]| match automatic_rule(&counted(levels)) {
            Ok(ShadeRule::Dark { solid_below }) => solid_below * 255.0,
            other => panic!("{other:?}"),
        };
        // Stage's cave; a dungeon with its start block; an office with unknown ground in grey.
        assert_eq!(dark(&[(255, 24473), (0, 527)]), 127.5);
        assert_eq!(dark(&[(127, 22835), (195, 7859), (203, 26)]), 161.0);
        assert_eq!(dark(&[(128, 17565), (255, 5943), (0, 1573)]), 191.5);
        let saved = counted(&[(205, 14659), (254, 11136), (0, 100)]);
        assert_eq!(automatic_rule(&saved), Ok(ShadeRule::MAP_SERVER));
        assert_eq!(automatic_rule(&[7; 9]), Err(WorldError::OneShade { shade: 7 }));
    }

    #[test]
    fn bad_sizes_and_parameters_are_named() {
        let raster = Raster { columns: 2, rows: 2, shades: &[0; 3], transparent: &[] };
        let params = RasterParams::default();
        let error = cells_of_image(&raster, &params);
        assert_eq!(error, Err(WorldError::CellCount { found: 3, expected: 4 }));
        for resolution_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let raster = Raster { columns: 2, rows: 1, shades: &[0, 255], transparent: &[] };
            let params = RasterParams { resolution_m, ..params };
            let error = cells_of_image(&raster, &params).expect_err("no length");
            assert!(error.to_string().starts_with("`resolution_m` is"), "{error}");
        }
        let raster = Raster { columns: usize::MAX, rows: 2, shades: &[], transparent: &[] };
        assert!(cells_of_image(&raster, &params).is_err());
        let rule = ShadeRule::Dark { solid_below: 1.5 };
        let raster = Raster { columns: 2, rows: 1, shades: &[0, 255], transparent: &[] };
        assert!(cells_of_image(&raster, &RasterParams { rule, ..params }).is_err());
    }
}
