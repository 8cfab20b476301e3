//! How certain one keyframe is of another: the least uncertain ways through the graph.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use pose::nalgebra::Matrix3;
use pose::{Se2, covariance_of_compose, covariance_of_inverse};

/// A measured relative pose with its covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The keyframe in whose frame the other is given.
    pub from: usize,
    /// The keyframe that was measured.
    pub to: usize,
    /// Frame of `to` in the frame of `from`.
    pub from_from_to: Se2,
    /// Covariance of it, in the frame of `to`.
    pub covariance: Matrix3<f64>,
}

/// Where a keyframe lies, seen from another along the least uncertain way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The keyframe.
    pub keyframe: usize,
    /// Its frame in the frame of the root.
    pub root_from_keyframe: Se2,
    /// Covariance of that, in the keyframe's own frame.
    pub covariance: Matrix3<f64>,
}

impl Seen {
    /// Standard deviation of the position along its worst axis, metres.
    pub fn sigma_m(&self) -> f64 {
        worst_axis(&self.covariance)
    }

    /// Standard deviation of the heading, radians.
    pub fn sigma_rad(&self) -> f64 {
        self.covariance[(2, 2)].max(0.0).sqrt()
    }
}

/// Standard deviation of a position along its worst axis.
pub fn worst_axis(covariance: &Matrix3<f64>) -> f64 {
    let (xx, xy, yy) = (covariance[(0, 0)], covariance[(0, 1)], covariance[(1, 1)]);
    let spread = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    (0.5 * (xx + yy) + spread).max(0.0).sqrt()
}

/// Metres that a radian of heading counts for, where ways are compared.
const LEVER_M: f64 = 5.0;

#[derive(Clone, Copy, Debug)]
struct Link {
    to: usize,
    step: Se2,
    covariance: Matrix3<f64>,
    weight: f64,
}

/// Keyframes and what was measured between them.
#[derive(Clone, Debug, Default)]
pub struct Links {
    links: Vec<Vec<Link>>,
}

impl Links {
    /// Makes room for a keyframe.
    pub fn push(&mut self) {
        self.links.push(Vec::new());
    }

    /// Takes what was measured between two keyframes that are there.
    pub fn add(&mut self, measured: &Measured) {
        let covariance = measured.covariance;
        let weight = weight_of(&covariance);
        let step = measured.from_from_to;
        self.links[measured.from].push(Link { to: measured.to, step, covariance, weight });
        let back = covariance_of_inverse(&step, &covariance);
        let link = Link { to: measured.from, step: step.inverse(), covariance: back, weight };
        self.links[measured.to].push(link);
    }

    /// All keyframes whose least uncertain way from `root` is no less certain than `sigma_limit_m`, the
    /// most certain first.
    ///
    /// Dijkstra's search over variances, which add up along a way; the covariance is that of the way, its
    /// lever arms included. Cost: n log n in what is reached.
    pub fn around(&self, root: usize, sigma_limit_m: f64, reached: &mut Vec<Seen>) {
        reached.clear();
        let limit = sigma_limit_m * sigma_limit_m;
        let mut best = vec![f64::INFINITY; self.links.len()];
        let mut place: Vec<Option<Seen>> = vec![None; self.links.len()];
        let mut heap = BinaryHeap::new();
        best[root] = 0.0;
        place[root] = Some(Seen {
            keyframe: root,
            root_from_keyframe: Se2::identity(),
            covariance: Matrix3::zeros(),
        });
        heap.push(Reverse((Ordered(0.0), root)));
        while let Some(Reverse((Ordered(weight), at))) = heap.pop() {
            if weight > best[at] {
                continue;
            }
            let Some(seen) = place[at] else { continue };
            reached.push(seen);
            for link in &self.links[at] {
                let next = weight + link.weight;
                if next < best[link.to] && next <= limit {
                    best[link.to] = next;
                    place[link.to] = Some(Seen {
                        keyframe: link.to,
                        root_from_keyframe: seen.root_from_keyframe * link.step,
                        covariance: covariance_of_compose(
                            &seen.covariance,
                            &link.step,
                            &link.covariance,
                        ),
                    });
                    heap.push(Reverse((Ordered(next), link.to)));
                }
            }
        }
    }

    /// Memory held, bytes.
    pub fn bytes(&self) -> usize {
        let links: usize =
            self.links.iter().map(|links| links.capacity() * size_of::<Link>()).sum();
        links + self.links.capacity() * size_of::<Vec<Link>>()
    }
}

fn weight_of(covariance: &Matrix3<f64>) -> f64 {
    covariance[(0, 0)] + covariance[(1, 1)] + LEVER_M * LEVER_M * covariance[(2, 2)]
}

/// A number that is never NaN, with its order.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ordered(f64);

impl Eq for Ordered {}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
