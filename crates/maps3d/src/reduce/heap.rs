//! A heap whose entries can be found again and given another key.

/// The place of an entry that is not in the heap.
const OUT: u32 = u32::MAX;

/// A heap of numbered entries, smallest key first; keys are never NaN.
///
/// Equal keys come in a scattered order: neighbours that are removed one after the other, as on a
/// plane without noise, would leave single vertices with thousands of neighbours. Four children per
/// node: half the levels of a binary heap, and a node's children share a cache line.
#[derive(Clone, Debug, Default)]
pub(super) struct IndexedHeap {
    nodes: Vec<(f32, u32)>,
    /// Where each entry is.
    places: Vec<u32>,
}

/// Numbers in no order that follows the image: an odd factor keeps them apart.
#[inline]
fn mixed(entry: u32) -> u32 {
    entry.wrapping_mul(0x9e37_79b1)
}

#[inline]
fn before(a: (f32, u32), b: (f32, u32)) -> bool {
    a.0 < b.0 || (a.0 == b.0 && mixed(a.1) < mixed(b.1))
}

impl IndexedHeap {
    /// A heap of given entries. Linear in the entries; `numbers` is one more than the largest.
    pub fn new(nodes: Vec<(f32, u32)>, numbers: usize) -> Self {
        let mut heap = Self { nodes, places: vec![OUT; numbers] };
        for (place, node) in heap.nodes.iter().enumerate() {
            heap.places[node.1 as usize] = place as u32;
        }
        for place in (0..heap.nodes.len().div_ceil(4)).rev() {
            heap.sink(place);
        }
        heap
    }

    /// Number of entries.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The smallest key and its entry.
    pub fn first(&self) -> Option<(f32, u32)> {
        self.nodes.first().copied()
    }

    /// Takes out the entry of the smallest key. O(log n).
    pub fn pop(&mut self) -> Option<(f32, u32)> {
        let first = self.first()?;
        self.take(0);
        Some(first)
    }

    /// Takes out an entry, if it is in. O(log n).
    pub fn remove(&mut self, entry: u32) {
        if let Some(&place) = self.places.get(entry as usize)
            && place != OUT
        {
            self.take(place as usize);
        }
    }

    fn take(&mut self, place: usize) {
        let taken = self.nodes.swap_remove(place);
        self.places[taken.1 as usize] = OUT;
        if place < self.nodes.len() {
            self.places[self.nodes[place].1 as usize] = place as u32;
            self.settle(place);
        }
    }

    /// Gives an entry a key, whether or not it is in. O(log n), O(1) for small changes.
    pub fn set(&mut self, entry: u32, key: f32) {
        if entry as usize >= self.places.len() {
            self.places.resize(entry as usize + 1, OUT);
        }
        let mut place = self.places[entry as usize];
        if place == OUT {
            place = self.nodes.len() as u32;
            self.places[entry as usize] = place;
            self.nodes.push((key, entry));
        } else {
            self.nodes[place as usize].0 = key;
        }
        self.settle(place as usize);
    }

    fn settle(&mut self, place: usize) {
        let node = self.nodes[place];
        if place > 0 && before(node, self.nodes[(place - 1) / 4]) {
            self.rise(place);
        } else {
            self.sink(place);
        }
    }

    fn rise(&mut self, mut place: usize) {
        let node = self.nodes[place];
        while place > 0 {
            let parent = (place - 1) / 4;
            if !before(node, self.nodes[parent]) {
                break;
            }
            self.put(place, self.nodes[parent]);
            place = parent;
        }
        self.put(place, node);
    }

    fn sink(&mut self, mut place: usize) {
        if place >= self.nodes.len() {
            return;
        }
        let node = self.nodes[place];
        loop {
            let first = 4 * place + 1;
            if first >= self.nodes.len() {
                break;
            }
            let last = (first + 4).min(self.nodes.len());
            let mut least = first;
            for child in first + 1..last {
                if before(self.nodes[child], self.nodes[least]) {
                    least = child;
                }
            }
            if !before(self.nodes[least], node) {
                break;
            }
            self.put(place, self.nodes[least]);
            place = least;
        }
        self.put(place, node);
    }

    #[inline]
    fn put(&mut self, place: usize, node: (f32, u32)) {
        self.nodes[place] = node;
        self.places[node.1 as usize] = place as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn it_agrees_with_a_sorted_map() {
        let mut seed = 5_u32;
        let mut next = move |n: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) % n
        };
        let mut keys: BTreeMap<u32, f32> = (0..60).map(|e| (e, (e * 7 % 13) as f32)).collect();
        let mut heap = IndexedHeap::new(keys.iter().map(|(&e, &k)| (k, e)).collect(), 60);
        for _ in 0..20_000 {
            let least = keys
                .iter()
                .map(|(&e, &k)| (k, e))
                .min_by(|a, b| a.0.total_cmp(&b.0).then(mixed(a.1).cmp(&mixed(b.1))));
            assert_eq!(heap.first(), least);
            assert_eq!(heap.len(), keys.len());
            match next(4) {
                0 => {
                    assert_eq!(heap.pop(), least);
                    least.map(|(_, entry)| keys.remove(&entry));
                }
                1 => {
                    let entry = next(90);
                    heap.remove(entry);
                    keys.remove(&entry);
                }
                _ => {
                    let (entry, key) = (next(90), next(20) as f32 - 3.0);
                    heap.set(entry, key);
                    keys.insert(entry, key);
                }
            }
        }
    }
}
