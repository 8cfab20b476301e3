//! Which free cells hang together.

use crate::CellMap;

/// The free cells of a map in groups that hang together over cell sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// For each cell, row-major as in the map, the number of its component; [`Self::SOLID`] for
    /// solid cells.
    pub labels: Vec<u32>,
    /// Cells of each component, in the order of their first cells.
    pub sizes: Vec<usize>,
}

impl Components {
    /// The label of solid cells.
    pub const SOLID: u32 = u32::MAX;

    /// The component with the most cells, the first where two are equal; none where all is solid.
    pub fn largest(&self) -> Option<u32> {
        let most = self.sizes.iter().max()?;
        self.sizes.iter().position(|size| size == most).map(|label| label as u32)
    }
}

/// Labels the free cells by component (4-neighbours). Linear in the cells, without recursion.
pub fn components(cells: &CellMap) -> Components {
    const FREE: u32 = Components::SOLID - 1;
    let columns = cells.columns;
    let mut labels: Vec<u32> =
        cells.solid.iter().map(|&solid| if solid { Components::SOLID } else { FREE }).collect();
    let mut sizes = Vec::new();
    let mut waiting = Vec::new();
    for first in 0..labels.len() {
        if labels[first] != FREE {
            continue;
        }
        let label = sizes.len() as u32;
        let mut size = 0;
        labels[first] = label;
        waiting.push(first);
        while let Some(index) = waiting.pop() {
            size += 1;
            let column = index % columns;
            let neighbours = [
                (column > 0).then(|| index - 1),
                (column + 1 < columns).then(|| index + 1),
                index.checked_sub(columns),
                Some(index + columns).filter(|&above| above < labels.len()),
            ];
            for neighbour in neighbours.into_iter().flatten() {
                if labels[neighbour] == FREE {
                    labels[neighbour] = label;
                    waiting.push(neighbour);
                }
            }
        }
        sizes.push(size);
    }
    Components { labels, sizes }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_do_not_join() {
        // Row 0: free, solid; row 1: solid, free; row 2: free, free.
        let solid = vec![false, true, true, false, false, false];
        let found = components(&CellMap { solid, ..CellMap::free(2, 3, 1.0) });
        let solid = Components::SOLID;
        assert_eq!(found.labels, [0, solid, solid, 1, 1, 1]);
        assert_eq!(found.sizes, [1, 3]);
        assert_eq!(found.largest(), Some(1));
    }

    #[test]
    fn of_equals_the_first_is_largest() {
        let solid = vec![false, true, false, true];
        assert_eq!(components(&CellMap { solid, ..CellMap::free(4, 1, 1.0) }).largest(), Some(0));
        let solid = vec![true; 4];
        assert_eq!(components(&CellMap { solid, ..CellMap::free(4, 1, 1.0) }).largest(), None);
    }
}
