//! A Delaunay triangulation of pixels that grows by one pixel at a time, in whole numbers.

use crate::image::Pixel;
use crate::triangulate::{ImageMesh, orient};

/// No triangle: beyond the border of the image.
pub(super) const NONE: u32 = u32::MAX;

/// Triangles of positive turn over a rectangle, each with its three neighbours.
#[derive(Clone, Debug, Default)]
pub(super) struct Delaunay {
    pub pixels: Vec<Pixel>,
    pub corners: Vec<[u32; 3]>,
    /// Neighbour `i` lies across the side opposite to corner `i`.
    pub neighbours: Vec<[u32; 3]>,
    /// The triangles that the last insertion made or changed: those around the new pixel.
    pub changed: Vec<u32>,
}

/// Positive where `d` lies inside of the circle through `a`, `b`, `c`, which turn positively.
///
/// Exact: differences of pixels are below 2^14, so that no sum exceeds 2^61.
pub(in crate::reduce) fn in_circle(a: Pixel, b: Pixel, c: Pixel, d: Pixel) -> i64 {
    let [dx, dy] = d.map(i64::from);
    let [[ax, ay], [bx, by], [cx, cy]] =
        [a, b, c].map(|[x, y]| [i64::from(x) - dx, i64::from(y) - dy]);
    let (a2, b2, c2) = (ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy);
    a2 * (bx * cy - by * cx) - b2 * (ax * cy - ay * cx) + c2 * (ax * by - ay * bx)
}

impl Delaunay {
    /// Two triangles over a rectangle given by its corners in order of positive turns.
    pub fn new(corners: [Pixel; 4]) -> Self {
        Self {
            pixels: corners.to_vec(),
            corners: vec![[0, 1, 2], [0, 2, 3]],
            neighbours: vec![[NONE, 1, NONE], [NONE, NONE, 0]],
            changed: vec![0, 1],
        }
    }

    /// Links the faces of any planar triangulation; it need not be Delaunay. O(faces log faces).
    pub fn of_mesh(mesh: &ImageMesh) -> Self {
        let mut sides: Vec<(u32, u32, u32, usize)> = Vec::with_capacity(3 * mesh.triangles.len());
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            for side in 0..3 {
                let (a, b) = (corners[(side + 1) % 3], corners[(side + 2) % 3]);
                sides.push((a, b, triangle as u32, side));
            }
        }
        sides.sort_unstable();
        let mut neighbours = vec![[NONE; 3]; mesh.triangles.len()];
        for &(a, b, triangle, side) in &sides {
            if let Ok(at) = sides.binary_search_by_key(&(b, a), |&(a, b, ..)| (a, b)) {
                neighbours[triangle as usize][side] = sides[at].2;
            }
        }
        Self {
            pixels: mesh.pixels.clone(),
            corners: mesh.triangles.clone(),
            neighbours,
            changed: Vec::new(),
        }
    }

    /// The pixels of a triangle's corners.
    #[inline]
    pub fn pixels_of(&self, triangle: u32) -> [Pixel; 3] {
        self.corners[triangle as usize].map(|corner| self.pixels[corner as usize])
    }

    /// Adds a pixel that lies in the closed triangle `inside`, and is none of its corners.
    ///
    /// Amortised O(1) flips for pixels in any reasonable order; `changed` tells what is new.
    pub fn insert(&mut self, pixel: Pixel, inside: u32) -> u32 {
        let p = self.pixels.len() as u32;
        self.pixels.push(pixel);
        self.changed.clear();
        let [a, b, c] = self.corners[inside as usize];
        let [pa, pb, pc] = self.pixels_of(inside);
        match [orient(pb, pc, pixel), orient(pc, pa, pixel), orient(pa, pb, pixel)]
            .iter()
            .position(|&turn| turn == 0)
        {
            None => self.split_face(p, inside, [a, b, c]),
            Some(side) => self.split_side(p, inside, side),
        }
        let mut at = 0;
        while at < self.changed.len() {
            let triangle = self.changed[at];
            if !self.flip_if_needed(triangle) {
                at += 1;
            }
        }
        p
    }

    /// Three triangles from one; the new pixel is corner 0 of each.
    fn split_face(&mut self, p: u32, t: u32, [a, b, c]: [u32; 3]) {
        let [across_a, across_b, across_c] = self.neighbours[t as usize];
        let (u, v) = (self.corners.len() as u32, self.corners.len() as u32 + 1);
        self.corners[t as usize] = [p, a, b];
        self.neighbours[t as usize] = [across_c, u, v];
        self.corners.extend([[p, b, c], [p, c, a]]);
        self.neighbours.extend([[across_a, v, t], [across_b, t, u]]);
        self.relink(across_a, t, u);
        self.relink(across_b, t, v);
        self.changed.extend([t, u, v]);
    }

    /// Two triangles from each that has the side `side` of `t`; the new pixel is corner 0 of each.
    fn split_side(&mut self, p: u32, t: u32, side: usize) {
        let rotated = |list: [u32; 3], first: usize| {
            [list[first], list[(first + 1) % 3], list[(first + 2) % 3]]
        };
        // `t` is c, a, b with the new pixel between a and b.
        let [c, a, b] = rotated(self.corners[t as usize], side);
        let [other, across_a, across_b] = rotated(self.neighbours[t as usize], side);
        let u = self.corners.len() as u32;
        self.corners[t as usize] = [p, b, c];
        self.corners.push([p, c, a]);
        self.neighbours[t as usize] = [across_a, u, NONE];
        self.neighbours.push([across_b, NONE, t]);
        self.relink(across_b, t, u);
        self.changed.extend([t, u]);
        if other == NONE {
            return;
        }
        let opposite = self.side_towards(other, t);
        // `other` is d, b, a.
        let [d, _, _] = rotated(self.corners[other as usize], opposite);
        let [_, beyond_b, beyond_a] = rotated(self.neighbours[other as usize], opposite);
        let w = self.corners.len() as u32;
        // Across from b, in `other`, is the side d-a; across from a the side d-b.
        self.corners[other as usize] = [p, a, d];
        self.corners.push([p, d, b]);
        self.neighbours[other as usize] = [beyond_b, w, u];
        self.neighbours.push([beyond_a, t, other]);
        self.relink(beyond_a, other, w);
        self.neighbours[t as usize][2] = w;
        self.neighbours[u as usize][1] = other;
        self.changed.extend([other, w]);
    }

    /// Exchanges the side opposite to corner 0 where the pixel beyond is inside the circle.
    fn flip_if_needed(&mut self, t: u32) -> bool {
        let other = self.neighbours[t as usize][0];
        if other == NONE {
            return false;
        }
        let [p, b, c] = self.corners[t as usize];
        let opposite = self.side_towards(other, t);
        let q = self.corners[other as usize][opposite];
        let at = |corner: u32| self.pixels[corner as usize];
        if in_circle(at(p), at(b), at(c), at(q)) <= 0 {
            return false;
        }
        self.turn(t, 0);
        self.changed.push(other);
        true
    }

    /// Exchanges the side opposite to corner `side` for the other diagonal of the quadrangle.
    ///
    /// For corners `p b c`, `p` at `side`, and `q` beyond: the triangle becomes `p b q`, its neighbour
    /// `p q c`. The quadrangle must be strictly convex.
    pub fn turn(&mut self, t: u32, side: usize) {
        let rotated = |list: [u32; 3], first: usize| {
            [list[first], list[(first + 1) % 3], list[(first + 2) % 3]]
        };
        let [p, b, c] = rotated(self.corners[t as usize], side);
        let [other, across_b, across_c] = rotated(self.neighbours[t as usize], side);
        let opposite = self.side_towards(other, t);
        // `other` is q, c, b.
        let [q, _, _] = rotated(self.corners[other as usize], opposite);
        let [_, beyond_c, beyond_b] = rotated(self.neighbours[other as usize], opposite);
        self.corners[t as usize] = [p, b, q];
        self.neighbours[t as usize] = [beyond_c, other, across_c];
        self.corners[other as usize] = [p, q, c];
        self.neighbours[other as usize] = [beyond_b, across_b, t];
        self.relink(beyond_c, other, t);
        self.relink(across_b, t, other);
    }

    /// Which side of `triangle` leads to `neighbour`.
    pub fn side_towards(&self, triangle: u32, neighbour: u32) -> usize {
        let sides = &self.neighbours[triangle as usize];
        sides.iter().position(|&side| side == neighbour).unwrap_or(0)
    }

    /// Makes `triangle`, which led to `before`, lead to `now`.
    pub fn relink(&mut self, triangle: u32, before: u32, now: u32) {
        if triangle != NONE {
            let side = self.side_towards(triangle, before);
            self.neighbours[triangle as usize][side] = now;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangulate::check_planar;

    /// The triangle that holds the pixel, by a look at all.
    fn holder(mesh: &Delaunay, p: Pixel) -> u32 {
        let inside = |&t: &u32| {
            let [a, b, c] = mesh.pixels_of(t);
            orient(a, b, p) >= 0 && orient(b, c, p) >= 0 && orient(c, a, p) >= 0
        };
        (0..mesh.corners.len() as u32).find(inside).expect("the image is covered")
    }

    fn grown(columns: u16, rows: u16, count: usize, mut seed: u32) -> Delaunay {
        let (w, h) = (columns - 1, rows - 1);
        let mut mesh = Delaunay::new([[0, 0], [w, 0], [w, h], [0, h]]);
        let mut next = |n: u16| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) as u16 % n
        };
        for _ in 0..count {
            let pixel = [next(columns), next(rows)];
            if !mesh.pixels.contains(&pixel) {
                let inside = holder(&mesh, pixel);
                mesh.insert(pixel, inside);
                for &t in &mesh.changed {
                    assert!(mesh.corners[t as usize].contains(&(mesh.pixels.len() as u32 - 1)));
                }
            }
        }
        mesh
    }

    #[test]
    fn it_is_planar_delaunay_and_linked() {
        for seed in 0..30 {
            let (columns, rows) = (2 + seed as u16 % 9, 2 + seed as u16 % 7);
            let mesh = grown(columns, rows, 90, seed);
            let plain = ImageMesh {
                pixels: mesh.pixels.clone(),
                depths_m: vec![1.0; mesh.pixels.len()],
                triangles: mesh.corners.clone(),
            };
            let (c, r) = (usize::from(columns), usize::from(rows));
            assert_eq!(check_planar(&plain, c, r), Ok(()), "{seed}");
            assert_eq!(Delaunay::of_mesh(&plain).neighbours, mesh.neighbours);
            for t in 0..mesh.corners.len() as u32 {
                let [a, b, c] = mesh.pixels_of(t);
                for side in 0..3 {
                    let other = mesh.neighbours[t as usize][side];
                    if other == NONE {
                        continue;
                    }
                    let back = mesh.side_towards(other, t);
                    assert_eq!(mesh.neighbours[other as usize][back], t);
                    let corners = mesh.corners[t as usize];
                    let others = mesh.corners[other as usize];
                    assert_eq!(corners[(side + 1) % 3], others[(back + 2) % 3]);
                    let q = mesh.pixels[others[back] as usize];
                    assert!(in_circle(a, b, c, q) <= 0, "the circle is empty");
                }
            }
        }
    }

    #[test]
    fn the_circle_is_exact_at_the_largest_size() {
        let far = (1 << 14) - 1;
        let corners = [[0, 0], [far, 0], [far, far]];
        assert_eq!(in_circle(corners[0], corners[1], corners[2], [0, far]), 0);
        assert!(in_circle(corners[0], corners[1], corners[2], [1, far]) > 0);
        assert!(in_circle(corners[0], corners[1], [far, far - 1], [0, far]) < 0);
    }
}
