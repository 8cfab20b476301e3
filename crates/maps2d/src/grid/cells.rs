//! A grid of cells that grows with what is seen.

use geometry::Point2;

/// A cell by column (x) and row (y); cell (0, 0) has its lower-left corner at the odometry origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cell {
    /// Column.
    pub column: i32,
    /// Row.
    pub row: i32,
}

impl Cell {
    /// The four cells that share a side.
    pub fn sides(self) -> [Cell; 4] {
        let Cell { column, row } = self;
        [
            Cell { column: column + 1, row },
            Cell { column, row: row + 1 },
            Cell { column: column - 1, row },
            Cell { column, row: row - 1 },
        ]
    }
}

/// What is believed of a cell (\[ISRR19\] eq. 6 with probabilities 0, 0.5 and 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum CellState {
    /// Never seen.
    #[default]
    Unknown,
    /// Lay fully inside a scan polygon, and was not hit since.
    Free,
    /// Was hit, and did not lie fully inside a scan polygon since.
    Occupied,
}

/// Cells in one block of memory that grows by doubling.
#[derive(Clone, Debug)]
pub struct Cells {
    cell_m: f64,
    min: Cell,
    columns: usize,
    rows: usize,
    states: Vec<CellState>,
    given_up: Vec<bool>,
}

impl Cells {
    /// No cells yet, of the given side in metres.
    pub fn new(cell_m: f64) -> Self {
        Self {
            cell_m,
            min: Cell { column: 0, row: 0 },
            columns: 0,
            rows: 0,
            states: Vec::new(),
            given_up: Vec::new(),
        }
    }

    /// Side of a cell, metres.
    pub fn cell_m(&self) -> f64 {
        self.cell_m
    }

    /// The cell that holds a point of the odometry frame.
    pub fn at(&self, point: &Point2) -> Cell {
        let index = |v: f64| (v / self.cell_m).floor().clamp(-1e9, 1e9) as i32;
        Cell { column: index(point.x), row: index(point.y) }
    }

    /// The centre of a cell in the odometry frame, metres.
    pub fn centre(&self, cell: Cell) -> Point2 {
        Point2::new(
            (f64::from(cell.column) + 0.5) * self.cell_m,
            (f64::from(cell.row) + 0.5) * self.cell_m,
        )
    }

    /// Position in the block, or `None` outside it.
    pub fn slot(&self, cell: Cell) -> Option<usize> {
        let column = i64::from(cell.column) - i64::from(self.min.column);
        let row = i64::from(cell.row) - i64::from(self.min.row);
        let inside =
            column >= 0 && row >= 0 && column < self.columns as i64 && row < self.rows as i64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// The cell at a position in the block.
    pub fn cell(&self, slot: usize) -> Cell {
        Cell {
            column: self.min.column + (slot % self.columns) as i32,
            row: self.min.row + (slot / self.columns) as i32,
        }
    }

    /// Number of positions in the block.
    pub fn slots(&self) -> usize {
        self.states.len()
    }

    /// What is believed of a cell.
    pub fn state(&self, cell: Cell) -> CellState {
        self.slot(cell).map_or(CellState::Unknown, |slot| self.states[slot])
    }

    /// Whether a cell does not count as frontier any more.
    pub fn is_given_up(&self, cell: Cell) -> bool {
        self.slot(cell).is_some_and(|slot| self.given_up[slot])
    }

    /// Believes something of a cell; returns what was believed before.
    pub fn set(&mut self, cell: Cell, state: CellState) -> CellState {
        self.grow_to(cell);
        match self.slot(cell) {
            Some(slot) => std::mem::replace(&mut self.states[slot], state),
            None => CellState::Unknown,
        }
    }

    /// Lets a cell not count as frontier from now on.
    pub fn give_up(&mut self, cell: Cell) {
        self.grow_to(cell);
        if let Some(slot) = self.slot(cell) {
            self.given_up[slot] = true;
        }
    }

    /// Forgets every state; what was given up stays.
    pub fn clear(&mut self) {
        self.states.fill(CellState::Unknown);
    }

    /// Whether a cell is free and has an unknown neighbour, given up or not.
    pub fn is_frontier(&self, cell: Cell) -> bool {
        self.state(cell) == CellState::Free
            && cell.sides().into_iter().any(|side| self.state(side) == CellState::Unknown)
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        self.states.len() * (size_of::<CellState>() + size_of::<bool>())
    }

    /// Makes room for a cell.
    pub(super) fn grow_to(&mut self, cell: Cell) {
        if self.slot(cell).is_some() {
            return;
        }
        if self.states.is_empty() {
            self.min = Cell { column: cell.column - 8, row: cell.row - 8 };
            (self.columns, self.rows) = (16, 16);
            self.states = vec![CellState::Unknown; 256];
            self.given_up = vec![false; 256];
            return;
        }
        let (min_column, columns) = span(self.min.column, self.columns, cell.column);
        let (min_row, rows) = span(self.min.row, self.rows, cell.row);
        let mut grown = Self {
            cell_m: self.cell_m,
            min: Cell { column: min_column, row: min_row },
            columns,
            rows,
            states: vec![CellState::Unknown; columns * rows],
            given_up: vec![false; columns * rows],
        };
        for slot in 0..self.states.len() {
            if let Some(to) = grown.slot(self.cell(slot)) {
                grown.states[to] = self.states[slot];
                grown.given_up[to] = self.given_up[slot];
            }
        }
        *self = grown;
    }
}

/// A range of indices that holds `index`, grown by at least its own length where it has to.
fn span(min: i32, len: usize, index: i32) -> (i32, usize) {
    let end = min + len as i32;
    if index < min {
        let grown_min = index.min(min - len as i32);
        (grown_min, (end - grown_min) as usize)
    } else if index >= end {
        (min, ((index + 1).max(end + len as i32) - min) as usize)
    } else {
        (min, len)
    }
}
