//! Cells in blocks of 16 by 16 by 16, made where something is known.

use std::collections::BTreeMap;

/// Cells along the side of a block.
pub(super) const SIDE: i32 = 16;
/// Cells of a block.
pub(super) const CELLS: usize = (SIDE * SIDE * SIDE) as usize;
/// Log odds of a cell that no ray went through.
const UNKNOWN: i8 = i8::MIN;

/// A cell, by its place along each axis.
pub type Cell = [i32; 3];

/// A block, by the place of its first cell divided by the side.
pub(super) type BlockKey = [i32; 3];

/// The log odds of the cells of a block, hundredths.
#[derive(Clone, Debug)]
struct Block {
    odds: Box<[i8; CELLS]>,
}

/// All that is known of cells.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    blocks: BTreeMap<BlockKey, Block>,
}

/// The block of a cell, and the place of the cell in it.
#[inline]
pub(super) fn split(cell: Cell) -> (BlockKey, usize) {
    let within = cell.map(|at| at & (SIDE - 1));
    let place = (within[2] * SIDE + within[1]) * SIDE + within[0];
    (cell.map(|at| at.div_euclid(SIDE)), place as usize)
}

/// The cell at a place of a block.
pub(super) fn cell_at(key: BlockKey, place: usize) -> Cell {
    let place = place as i32;
    let within = [place % SIDE, place / SIDE % SIDE, place / (SIDE * SIDE)];
    std::array::from_fn(|axis| key[axis] * SIDE + within[axis])
}

impl Blocks {
    /// Log odds of a cell, hundredths; `None` for one that is not known.
    pub fn odds(&self, cell: Cell) -> Option<i8> {
        let (key, place) = split(cell);
        self.blocks.get(&key).map(|block| block.odds[place]).filter(|odds| *odds != UNKNOWN)
    }

    /// Adds to the log odds of cells of one block, within limits; returns whether any changed between
    /// unknown, free and occupied.
    pub fn add(
        &mut self,
        key: BlockKey,
        limits: [i8; 2],
        changes: impl Iterator<Item = (usize, i8)>,
    ) -> bool {
        let fresh = || Block { odds: Box::new([UNKNOWN; CELLS]) };
        let block = self.blocks.entry(key).or_insert_with(fresh);
        let mut turned = false;
        for (place, by) in changes {
            let odds = &mut block.odds[place];
            let before = *odds;
            let from = if before == UNKNOWN { 0 } else { before };
            *odds = from.saturating_add(by).clamp(limits[0], limits[1]);
            turned |= before == UNKNOWN || (before > 0) != (*odds > 0);
        }
        turned
    }

    /// Number of cells that are known. Linear.
    pub fn known_count(&self) -> usize {
        let of = |block: &Block| block.odds.iter().filter(|odds| **odds != UNKNOWN).count();
        self.blocks.values().map(of).sum()
    }

    /// The known cells of a block with their log odds.
    pub fn cells(&self, key: BlockKey) -> impl Iterator<Item = (Cell, i8)> + '_ {
        let odds = self.blocks.get(&key).map_or(&[][..], |block| &block.odds[..]);
        let known = odds.iter().enumerate().filter(|(_, odds)| **odds != UNKNOWN);
        known.map(move |(place, odds)| (cell_at(key, place), *odds))
    }

    /// The keys of all blocks, ascending.
    pub fn keys(&self) -> impl Iterator<Item = BlockKey> + '_ {
        self.blocks.keys().copied()
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }

    /// Memory held on the heap, bytes.
    pub fn heap_bytes(&self) -> usize {
        self.blocks.len() * (CELLS + size_of::<BlockKey>() + size_of::<Block>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_cells_agree() {
        for cell in [[0, 0, 0], [-1, 15, 16], [-16, -17, 1000], [i32::MIN, 7, i32::MAX]] {
            let (key, place) = split(cell);
            assert_eq!(cell_at(key, place), cell);
        }
    }

    #[test]
    fn odds_are_added_within_limits() {
        let mut blocks = Blocks::default();
        let (key, place) = split([-3, 2, 40]);
        assert_eq!(blocks.odds([-3, 2, 40]), None);
        assert!(blocks.add(key, [-100, 120], [(place, 85)].into_iter()));
        assert!(!blocks.add(key, [-100, 120], [(place, 85)].into_iter()));
        assert_eq!(blocks.odds([-3, 2, 40]), Some(120));
        for _ in 0..9 {
            blocks.add(key, [-100, 120], [(place, -40)].into_iter());
        }
        assert_eq!(blocks.odds([-3, 2, 40]), Some(-100));
        assert_eq!((blocks.known_count(), blocks.cells(key).count()), (1, 1));
    }
}
