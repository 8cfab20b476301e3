//! Grids: which cells changed.

use maps2d::grid::{CellState, GridEvent};
use probe::Probe;

use super::Recorder;
use crate::{Family, palette};

impl Probe<GridEvent<'_>> for Recorder {
    /// Also at `summary`, because the picture of the grid is built from changes.
    fn on(&self) -> bool {
        self.inner.is_some()
    }

    fn emit(&mut self, event: GridEvent<'_>) {
        let Some(inner) = &mut self.inner else { return };
        inner.now.event += 1;
        let now = inner.now;
        match event {
            GridEvent::ScanApplied { changed, grid } => {
                inner.belief.grid(grid, Some(changed));
            }
            GridEvent::Rebuilt { grid, .. } => inner.belief.grid(grid, None),
        }
        if !inner.full(Family::Grid) {
            return;
        }
        let happened = &mut inner.happened;
        let variant = event.variant();
        match event {
            GridEvent::ScanApplied { changed, grid } => {
                let (mut freed, mut occupied) = (0, 0);
                for (cell, _, state) in changed {
                    let colour = match state {
                        CellState::Unknown => palette::NOTHING_CLOSED,
                        CellState::Free => palette::MISS,
                        CellState::Occupied => palette::HIT,
                    };
                    freed += usize::from(*state == CellState::Free);
                    occupied += usize::from(*state == CellState::Occupied);
                    happened.points.point(&grid.cells().centre(*cell), colour);
                }
                let left = grid.frontier_cells().count();
                happened.event(
                    Family::Grid,
                    variant,
                    format_args!(
                        "{freed} cells became free, {occupied} occupied; {left} frontier cells left"
                    ),
                    &now,
                );
            }
            GridEvent::Rebuilt { scans, grid } => {
                let left = grid.frontier_cells().count();
                happened.event(
                    Family::Grid,
                    variant,
                    format_args!("{scans} scans applied again; {left} frontier cells left"),
                    &now,
                );
            }
        }
    }
}
