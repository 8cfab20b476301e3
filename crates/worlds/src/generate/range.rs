//! Checks that the generators share.

use crate::WorldError;
use crate::raster::check_grid;

/// A length above 0, and finite.
pub(crate) fn length(field: &'static str, found: f64) -> Result<(), WorldError> {
    let good = found.is_finite() && found > 0.0;
    refuse(good, field, found, "a length above 0")
}

/// A share from 0 to 1.
pub(crate) fn share(field: &'static str, found: f64) -> Result<(), WorldError> {
    refuse((0.0..=1.0).contains(&found), field, found, "0 to 1")
}

/// At least one.
pub(crate) fn count(field: &'static str, found: usize) -> Result<(), WorldError> {
    refuse(found >= 1, field, found as f64, "1 or more")
}

/// The error unless the value is good.
pub(crate) fn refuse(
    good: bool,
    field: &'static str,
    found: f64,
    expected: &'static str,
) -> Result<(), WorldError> {
    if good { Ok(()) } else { Err(WorldError::Parameter { field, found, expected }) }
}

/// A length in whole cells, at least one.
pub(crate) fn in_cells(length_m: f64, cell_m: f64) -> usize {
    ((length_m / cell_m).round() as usize).max(1)
}

/// Checks the size of a map whose sides were added up in floating point, so as not to overflow.
pub(crate) fn map_size(columns: f64, rows: f64, cell_m: f64) -> Result<(), WorldError> {
    // Casts from floating point saturate, so a side that is far too long stays far too long.
    check_grid(columns as usize, rows as usize, cell_m, "cell_m")
}
