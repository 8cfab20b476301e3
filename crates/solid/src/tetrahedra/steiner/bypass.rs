//! Taking a point off a segment before there are facets: walls are chosen in their place.

use super::room::Hole;
use super::suppress::{MOST_SEARCHED, STEPS, same_turn};
use crate::tetrahedra::flips::Work;
use crate::tetrahedra::mesh::NONE;
use crate::tetrahedra::reconnect::Region;

/// How many pairs of walls are tried.
const MOST_PAIRS: usize = 8;

/// A wall through the segment: triangles round its point from one end to the other, to be put in whole.
struct Wall {
    /// The vertices that the triangles have with one another, from end to end.
    path: Vec<u32>,
    /// The triangles of the whole wall, turned as the path is with the point before it.
    whole: Vec<[u32; 3]>,
    /// Where it lies, seen along the segment: of length 1.
    direction: [f64; 3],
}

impl Wall {
    /// Whether two corners are neighbours on the path; if so, whether in its order.
    fn passes(&self, x: u32, y: u32) -> Option<bool> {
        self.path.windows(2).find_map(|pair| match *pair {
            [p, q] if (p, q) == (x, y) => Some(true),
            [p, q] if (p, q) == (y, x) => Some(false),
            _ => None,
        })
    }

    /// Whether two walls meet in the segment alone.
    fn is_apart(&self, other: &Self) -> bool {
        let inner = |wall: &Self| wall.path[1..wall.path.len() - 1].to_vec();
        !inner(self).iter().any(|v| inner(other).contains(v))
    }
}

impl Work {
    /// Takes `s`, between `a` and `b`, which it has edges with, off the way from one to the other, which
    /// becomes an edge: without a new point, or with one on each side of a wall that is made of two of
    /// those that run from `a` to `b` through the star. False, with nothing changed, where that cannot be.
    pub(crate) fn bypass(&mut self, s: u32, a: u32, b: u32) -> bool {
        let star = self.mesh.star(s);
        if star.iter().any(|&t| self.mesh.tet(t).is_ghost()) {
            return false;
        }
        let region = Region::of(&self.mesh, &star);
        let done = (region.vertices.len() <= MOST_SEARCHED
            && self.reconnect(&region, &[[a, b]], &[], Some(s), STEPS)
            && self.mesh.find_edge(a, b).is_some())
            || self.put_points_round(s, a, b, &star);
        if done {
            self.mesh.at[s as usize] = NONE;
        }
        done
    }

    /// Fills the two spaces between walls through the edge `a`, `b`; of all pairs of walls those that lie
    /// most nearly opposite come first.
    fn put_points_round(&mut self, s: u32, a: u32, b: u32, star: &[u32]) -> bool {
        let walls = self.walls(s, a, b, star);
        let mut pairs = Vec::new();
        for i in 0..walls.len() {
            for j in i + 1..walls.len() {
                if walls[i].is_apart(&walls[j]) {
                    let (u, v) = (walls[i].direction, walls[j].direction);
                    pairs.push(((0..3).map(|k| u[k] * v[k]).sum::<f64>(), i, j));
                }
            }
        }
        pairs.sort_by(|p, q| p.0.total_cmp(&q.0));
        pairs.into_iter().take(MOST_PAIRS).any(|(_, i, j)| {
            let sectors = self.sectors_between(s, star, [&walls[i], &walls[j]]);
            sectors.len() == 2 && self.put_points_beside(s, star, &sectors)
        })
    }

    /// The walls of two and of three triangles at `s`; the latter in both ways to make them whole.
    fn walls(&self, s: u32, a: u32, b: u32, star: &[u32]) -> Vec<Wall> {
        let mut edges = Vec::new();
        for &t in star {
            let tet = self.mesh.tet(t);
            let [x, y, z] = tet.face(tet.index_of(s).unwrap_or(0));
            for (p, q) in [(x, y), (y, z), (z, x)] {
                edges.extend([(p, q), (q, p)]);
            }
        }
        edges.sort_unstable();
        edges.dedup();
        let near = |end: u32| -> Vec<u32> {
            let from = edges.partition_point(|edge| edge.0 < end);
            edges[from..].iter().take_while(|edge| edge.0 == end).map(|edge| edge.1).collect()
        };
        let (of_a, of_b) = (near(a), near(b));
        let mut walls = Vec::new();
        for &p in of_a.iter().filter(|&&p| p != b) {
            if of_b.binary_search(&p).is_ok() {
                let direction = self.aside(a, b, &[p]);
                walls.push(Wall { path: vec![a, p, b], whole: vec![[a, p, b]], direction });
                continue;
            }
            for q in near(p) {
                if q == a || of_a.binary_search(&q).is_ok() || of_b.binary_search(&q).is_err() {
                    continue;
                }
                let direction = self.aside(a, b, &[p, q]);
                for whole in [vec![[a, p, b], [p, q, b]], vec![[a, p, q], [a, q, b]]] {
                    walls.push(Wall { path: vec![a, p, q, b], whole, direction });
                }
            }
        }
        walls
    }

    /// The direction from the line through `a` and `b` to the middle of some vertices.
    fn aside(&self, a: u32, b: u32, vertices: &[u32]) -> [f64; 3] {
        let (from, to) = (*self.mesh.point(a), *self.mesh.point(b));
        let along = [0, 1, 2].map(|k| to[k] - from[k]);
        let mut off = [0, 1, 2].map(|k| {
            let sum: f64 = vertices.iter().map(|&v| self.mesh.point(v)[k] - from[k]).sum();
            sum / vertices.len() as f64
        });
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let share = dot(off, along) / dot(along, along);
        off = [0, 1, 2].map(|k| off[k] - share * along[k]);
        let length = dot(off, off).sqrt().max(f64::MIN_POSITIVE);
        off.map(|x| x / length)
    }

    /// The spaces round `s` between two walls.
    fn sectors_between(&self, s: u32, star: &[u32], walls: [&Wall; 2]) -> Vec<Hole> {
        self.spaces(s, star, |corners, sector| {
            let at = corners.iter().position(|&v| v == s).unwrap_or(0);
            let (x, y) = (corners[(at + 1) % 3], corners[(at + 2) % 3]);
            let wall = walls.iter().find_map(|wall| Some((wall, wall.passes(x, y)?)));
            let Some((wall, in_order)) = wall else { return false };
            for &[p, q, r] in &wall.whole {
                let seen = if in_order { [p, q, r] } else { [p, r, q] };
                if !sector.near.iter().any(|other| same_turn(*other, seen)) {
                    sector.near.push(seen);
                }
            }
            true
        })
    }
}
