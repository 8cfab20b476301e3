//! Place along a Hilbert curve.

/// Bits per axis of the grid that the curve runs through.
const BITS: u32 = 20;

/// The box round some points, as an origin and the factor that stretches it to the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    origin: [f64; 3],
    scale: f64,
}

impl Grid {
    /// The grid that holds all `points`.
    pub(crate) fn new(points: &[[f64; 3]]) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for point in points {
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let extent = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        let scale = if extent > 0.0 { f64::from((1u32 << BITS) - 1) / extent } else { 0.0 };
        Self { origin: low, scale }
    }

    /// The distance along the curve to the cell of `point`.
    pub(crate) fn key(&self, point: &[f64; 3]) -> u64 {
        let cell = |axis: usize| ((point[axis] - self.origin[axis]) * self.scale) as u32;
        hilbert([cell(0), cell(1), cell(2)])
    }
}

/// The distance along the three-dimensional Hilbert curve of a cell (\[Ski04\]: the transpose of the
/// distance is made in place, by undoing the rotations from the coarsest level down).
fn hilbert(mut x: [u32; 3]) -> u64 {
    let most = 1u32 << (BITS - 1);
    let mut q = most;
    while q > 1 {
        let p = q - 1;
        for i in 0..3 {
            if x[i] & q != 0 {
                x[0] ^= p;
            } else {
                let t = (x[0] ^ x[i]) & p;
                x[0] ^= t;
                x[i] ^= t;
            }
        }
        q >>= 1;
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut t = 0;
    let mut q = most;
    while q > 1 {
        if x[2] & q != 0 {
            t ^= q - 1;
        }
        q >>= 1;
    }
    for v in &mut x {
        *v ^= t;
    }
    (spread(x[0]) << 2) | (spread(x[1]) << 1) | spread(x[2])
}

/// The lower 21 bits with two zeros between each.
fn spread(v: u32) -> u64 {
    let mut v = u64::from(v) & 0x1f_ffff;
    v = (v | (v << 32)) & 0x001f_0000_0000_ffff;
    v = (v | (v << 16)) & 0x001f_0000_ff00_00ff;
    v = (v | (v << 8)) & 0x100f_00f0_0f00_f00f;
    v = (v | (v << 4)) & 0x10c3_0c30_c30c_30c3;
    (v | (v << 2)) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_space() {
        // On a grid of 8 x 8 x 8 cells the coarse part of the curve visits each cell once, in steps of one.
        let step = 1u32 << (BITS - 3);
        let mut cells = Vec::new();
        for x in 0..8 {
            for y in 0..8 {
                for z in 0..8 {
                    cells.push((
                        hilbert([x * step, y * step, z * step]) >> (3 * (BITS - 3)),
                        [x, y, z],
                    ));
                }
            }
        }
        cells.sort_unstable();
        for (place, pair) in cells.windows(2).enumerate() {
            assert_eq!(pair[0].0, place as u64);
            let apart: u32 = (0..3).map(|i| pair[0].1[i].abs_diff(pair[1].1[i])).sum();
            assert_eq!(apart, 1, "{pair:?}");
        }
    }
}
