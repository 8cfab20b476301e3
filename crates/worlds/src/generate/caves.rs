//! Caves with ragged walls.

use super::draw::{Draw, Stream};
use super::range::{length, map_size, refuse, share};
use crate::start::{components, world_of_cells};
use crate::{CellMap, World2d, WorldError};

/// Caves that grow out of noise.
#[derive(Clone, Debug, PartialEq)]
pub struct CavesParams {
    /// Extent along x, metres, the solid border included; rounded up to whole cells.
    pub width_m: f64,
    /// Extent along y, metres, the solid border included; rounded up to whole cells.
    pub height_m: f64,
    /// Share of cells that are solid at first, 0 to 1; above about 0.5 the caves fall apart.
    pub solid_share: f64,
    /// How often the noise is smoothed; up to 100.
    pub rounds: usize,
    /// Side of a cell of the map, metres.
    pub cell_m: f64,
    /// The seed.
    pub seed: u64,
}

impl Default for CavesParams {
    fn default() -> Self {
        Self { width_m: 40.0, height_m: 30.0, solid_share: 0.43, rounds: 5, cell_m: 0.5, seed: 1 }
    }
}

impl CavesParams {
    /// Checks the fields and the size of the map.
    ///
    /// # Errors
    /// [`WorldError::Parameter`] with the first field that is wrong.
    pub fn check(&self) -> Result<(), WorldError> {
        length("width_m", self.width_m)?;
        length("height_m", self.height_m)?;
        share("solid_share", self.solid_share)?;
        refuse(self.rounds <= 100, "rounds", self.rounds as f64, "at most 100")?;
        length("cell_m", self.cell_m)?;
        map_size(self.side(self.width_m), self.side(self.height_m), self.cell_m)
    }

    fn side(&self, length_m: f64) -> f64 {
        (length_m / self.cell_m - 1e-6).ceil().max(1.0)
    }
}

/// The caves; the robot starts at the most open place and heads along +x.
///
/// # Errors
/// As [`caves_cells`].
pub fn caves(params: &CavesParams) -> Result<World2d, WorldError> {
    world_of_cells("caves", caves_cells(params)?, None)
}

/// The cells of the caves: noise, smoothed by majority among each cell and its eight neighbours;
/// then all but the largest cave is filled. Linear in the cells times the rounds.
///
/// # Errors
/// As [`CavesParams::check`]; [`WorldError::NoFreeSpace`] where no cave is left.
pub fn caves_cells(params: &CavesParams) -> Result<CellMap, WorldError> {
    params.check()?;
    let mut draw = Draw::new(params.seed, Stream::Caves);
    let (columns, rows) = (params.side(params.width_m), params.side(params.height_m));
    let mut cells = CellMap::free(columns as usize, rows as usize, params.cell_m);
    let (columns, rows) = (cells.columns, cells.rows);
    let border = |index: usize| {
        let (column, row) = (index % columns, index / columns);
        column == 0 || row == 0 || column + 1 == columns || row + 1 == rows
    };
    for (index, solid) in cells.solid.iter_mut().enumerate() {
        *solid = (draw.uniform() < params.solid_share) | border(index);
    }
    for _ in 0..params.rounds {
        let before = cells.clone();
        for (index, solid) in cells.solid.iter_mut().enumerate() {
            let (column, row) = ((index % columns) as i64, (index / columns) as i64);
            let around =
                (0..9).filter(|step| before.is_solid(column - 1 + step % 3, row - 1 + step / 3));
            *solid = around.count() >= 5 || border(index);
        }
    }
    let parts = components(&cells);
    let largest = parts.largest().ok_or(WorldError::NoFreeSpace)?;
    for (solid, &label) in cells.solid.iter_mut().zip(&parts.labels) {
        *solid |= label != largest;
    }
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn bad_fields_are_named() {
        let good = CavesParams::default();
        let fields = [
            ("width_m", CavesParams { width_m: 0.0, ..good.clone() }),
            ("height_m", CavesParams { height_m: f64::INFINITY, ..good.clone() }),
            ("solid_share", CavesParams { solid_share: 2.0, ..good.clone() }),
            ("rounds", CavesParams { rounds: 101, ..good.clone() }),
            ("cell_m", CavesParams { cell_m: f64::NAN, ..good.clone() }),
            ("number of cells", CavesParams { cell_m: 1e-9, ..good.clone() }),
        ];
        for (name, params) in fields {
            let Err(WorldError::Parameter { field, .. }) = caves_cells(&params) else {
                panic!("{name} was let pass")
            };
            assert_eq!(field, name);
        }
        let full = CavesParams { solid_share: 1.0, ..good };
        assert_eq!(caves_cells(&full), Err(WorldError::NoFreeSpace));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn one_closed_cave(seed in any::<u64>(), rounds in 0..6_usize, solid_share in 0.2..0.45_f64) {
            let params = CavesParams { seed, rounds, solid_share, ..CavesParams::default() };
            let cells = caves_cells(&params).expect("room for a cave");
            prop_assert_eq!(&cells, &caves_cells(&params).expect("room for a cave"));
            prop_assert_eq!(components(&cells).sizes.len(), 1);
            for column in 0..cells.columns as i64 {
                prop_assert!(cells.is_solid(column, 0) && cells.is_solid(column, cells.rows as i64 - 1));
            }
            prop_assert!(caves(&params).is_ok());
        }
    }
}
