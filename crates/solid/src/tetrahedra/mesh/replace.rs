//! Exchanging some tetrahedra for others that fill the same space, and taking it back.

use super::complex::Mesh;
use super::tet::{Tet, sorted3};

/// What an exchange did, so that it can be undone.
#[derive(Clone, Debug, Default)]
pub(crate) struct Exchange {
    /// The slots that were emptied, with what they held.
    pub(crate) old: Vec<(u32, Tet)>,
    /// The slots that were filled, with what they hold.
    pub(crate) new: Vec<(u32, [u32; 4])>,
    /// The length of the slot list before.
    slots_before: usize,
    /// The slots taken from the free list, in the order taken.
    taken: Vec<u32>,
    /// How many old slots went to the free list.
    freed: usize,
}

/// A face of the region, by which halves are matched: its corners, ascending, then its number among the
/// faces outside, in the order found, or among those of the new tetrahedra, of which the lowest bit tells.
type Half = u128;

#[inline]
fn half(face: [u32; 3], number: usize, is_new: bool) -> Half {
    let [a, b, c] = sorted3(face).map(u128::from);
    (a << 96) | (b << 64) | (c << 32) | ((number as u128) << 1) | u128::from(is_new)
}

/// Whether two halves are of one face.
#[inline]
fn match_up(a: Half, b: Half) -> bool {
    (a ^ b) >> 32 == 0
}

impl Mesh {
    /// Exchanges the tetrahedra `old` for `new`; `None`, and nothing changed, where the new ones do
    /// not have exactly the old ones' outer faces as their own.
    ///
    /// The caller sees to it that the new ones are positive. That they then fill the same space, once,
    /// follows: the surface is the same, and each has its volume counted positively. O(m log m).
    pub(crate) fn exchange(&mut self, old: &[u32], new: &[[u32; 4]]) -> Option<Exchange> {
        let mut halves = std::mem::take(&mut self.halves);
        let log = self.exchange_by(old, new, &mut halves);
        self.halves = halves;
        log
    }

    fn exchange_by(
        &mut self,
        old: &[u32],
        new: &[[u32; 4]],
        halves: &mut Vec<Half>,
    ) -> Option<Exchange> {
        halves.clear();
        let mut outside = std::mem::take(&mut self.queue);
        outside.clear();
        let epoch = self.next_epoch();
        for &t in old {
            self.stamp[t as usize] = epoch;
        }
        for &t in old {
            let tet = *self.tet(t);
            for f in 0..4 {
                let code = tet.n[f];
                if self.stamp[(code >> 2) as usize] != epoch {
                    halves.push(half(tet.face(f), outside.len(), false));
                    outside.push(code);
                }
            }
        }
        for (i, &v) in new.iter().enumerate() {
            let tet = Tet { v, n: [0; 4] };
            for f in 0..4 {
                halves.push(half(tet.face(f), 4 * i + f, true));
            }
        }
        halves.sort_unstable();
        let fits = halves.len().is_multiple_of(2)
            && halves
                .chunks_exact(2)
                .all(|pair| match_up(pair[0], pair[1]) && (pair[0] | pair[1]) & 1 == 1)
            && halves.windows(3).all(|three| !match_up(three[0], three[2]));
        if !fits {
            self.queue = outside;
            return None;
        }

        let mut log = self.spare.pop().unwrap_or_default();
        log.slots_before = self.tets.len();
        log.old.extend(old.iter().map(|&t| (t, *self.tet(t))));
        for &slot in old.iter().skip(new.len()) {
            self.tets[slot as usize] = Tet::FREE;
            self.free.push(slot);
            log.freed += 1;
        }
        for (i, &v) in new.iter().enumerate() {
            let slot = match old.get(i) {
                Some(&slot) => slot,
                None => {
                    let slot = self.take_slot();
                    if (slot as usize) < log.slots_before {
                        log.taken.push(slot);
                    }
                    slot
                }
            };
            self.tets[slot as usize].v = v;
            for vertex in v {
                self.at[vertex as usize] = slot;
            }
            log.new.push((slot, v));
        }
        let code_of = |half: Half| {
            let number = (half as u32) >> 1;
            if half & 1 == 1 {
                4 * log.new[(number >> 2) as usize].0 + (number & 3)
            } else {
                outside[number as usize]
            }
        };
        for pair in halves.chunks_exact(2) {
            self.join(code_of(pair[0]), code_of(pair[1]));
        }
        self.queue = outside;
        Some(log)
    }

    /// Keeps the buffers of an exchange that is not to be taken back any more.
    pub(crate) fn recycle(&mut self, mut log: Exchange) {
        log.old.clear();
        log.new.clear();
        log.taken.clear();
        log.freed = 0;
        self.spare.push(log);
    }

    /// Takes an exchange back, bit for bit; exchanges are taken back in reverse order.
    pub(crate) fn undo(&mut self, log: &Exchange) {
        for &(slot, _) in &log.new {
            self.tets[slot as usize] = Tet::FREE;
        }
        self.free.truncate(self.free.len() - log.freed);
        self.tets.truncate(log.slots_before);
        self.stamp.truncate(log.slots_before);
        for &slot in log.taken.iter().rev() {
            self.free.push(slot);
        }
        for &(slot, tet) in &log.old {
            self.tets[slot as usize] = tet;
            for vertex in tet.v {
                self.at[vertex as usize] = slot;
            }
        }
        for &(slot, tet) in &log.old {
            for (f, &code) in tet.n.iter().enumerate() {
                self.tets[(code >> 2) as usize].n[(code & 3) as usize] = 4 * slot + f as u32;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::tetrahedra::delaunay::delaunay_of;
    use crate::tetrahedra::mesh::Mesh;

    fn some_mesh() -> Mesh {
        let points = (0..200u32)
            .map(|i| {
                let f = f64::from(i);
                [(f * 0.37).sin(), (f * 0.73).cos(), (f * 1.31).sin() * (f * 0.2).cos()]
            })
            .collect();
        delaunay_of(points, &mut probe::Off).expect("they span a volume").0
    }

    #[test]
    fn what_is_undone_never_was() {
        let mut mesh = some_mesh();
        assert_eq!(mesh.flaw(), None);
        let before = mesh.clone();
        let mut flips = 0;
        let mut log = Vec::new();
        for t in 0..before.tets.len() as u32 {
            let tet = *mesh.tet(t);
            if !tet.is_live() || tet.is_ghost() {
                continue;
            }
            let far = *mesh.tet(tet.n[0] >> 2);
            if far.is_ghost() {
                continue;
            }
            let [x, y, z] = tet.face(0);
            let (u, v) = (tet.v[0], far.v[(tet.n[0] & 3) as usize]);
            let new = [[x, y, v, u], [y, z, v, u], [z, x, v, u]];
            if new.iter().all(|&[a, b, c, d]| mesh.orient(a, b, c, d) > 0.0) {
                log.push(mesh.exchange(&[t, tet.n[0] >> 2], &new).expect("it fits"));
                flips += 1;
            }
        }
        assert!(flips > 20, "{flips}");
        assert_eq!(mesh.flaw(), None);
        for exchange in log.iter().rev() {
            mesh.undo(exchange);
        }
        assert_eq!(mesh.tets, before.tets);
        assert_eq!(mesh.free, before.free);
        assert_eq!(mesh.flaw(), None);
    }

    #[test]
    fn what_does_not_fit_is_not_made() {
        let mut mesh = some_mesh();
        let before = mesh.tets.clone();
        let t = mesh.finite().next().expect("there is one");
        let [a, b, c, d] = mesh.tet(t).v;
        assert!(mesh.exchange(&[t], &[]).is_none());
        let stranger = (0..200).find(|v| ![a, b, c, d].contains(v)).expect("another");
        assert!(mesh.exchange(&[t], &[[a, b, c, stranger]]).is_none());
        assert_eq!(mesh.tets, before);
    }
}
