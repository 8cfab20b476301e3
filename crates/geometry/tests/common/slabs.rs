//! Areas of overlays by horizontal slabs: between two corners or crossings nothing changes but
//! linearly, so the width half-way up tells the area. Another method than the library's.

use geometry::Point2;
use geometry::planar::overlay::Region;

/// A directed segment.
pub type Segment = (Point2, Point2);

/// The areas of both operands' overlays, square metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Areas {
    pub union: f64,
    pub intersection: f64,
    pub difference: f64,
}

pub fn segments<T: Copy>(region: &Region<T>) -> Vec<Segment> {
    region.edges().map(|edge| (edge.from, edge.to)).collect()
}

pub fn areas(a: &[Segment], b: &[Segment]) -> Areas {
    let all: Vec<(Segment, bool)> =
        a.iter().map(|s| (*s, true)).chain(b.iter().map(|s| (*s, false))).collect();
    let mut heights: Vec<f64> = all.iter().flat_map(|((p, q), _)| [p.y, q.y]).collect();
    for (i, (s, _)) in all.iter().enumerate() {
        for (t, _) in &all[..i] {
            heights.extend(crossing(s, t));
        }
    }
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let mut sums = Areas { union: 0.0, intersection: 0.0, difference: 0.0 };
    let mut walls: Vec<(f64, i32, bool)> = Vec::new();
    for pair in heights.windows(2) {
        let (height, y) = (pair[1] - pair[0], 0.5 * (pair[0] + pair[1]));
        walls.clear();
        for ((p, q), first) in &all {
            if (p.y <= y) != (q.y <= y) {
                let x = p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x);
                // What runs down has its inside to the right of it on the page.
                walls.push((x, if q.y < p.y { 1 } else { -1 }, *first));
            }
        }
        walls.sort_by(|v, w| v.0.total_cmp(&w.0));
        let (mut in_a, mut in_b) = (0, 0);
        for (i, &(x, turn, first)) in walls.iter().enumerate() {
            *(if first { &mut in_a } else { &mut in_b }) += turn;
            let Some(next) = walls.get(i + 1) else { break };
            let area = (next.0 - x) * height;
            if in_a != 0 || in_b != 0 {
                sums.union += area;
            }
            if in_a != 0 && in_b != 0 {
                sums.intersection += area;
            }
            if in_a != 0 && in_b == 0 {
                sums.difference += area;
            }
        }
    }
    sums
}

/// The height of the point that two segments share, if they cross.
fn crossing((p, q): &Segment, (r, s): &Segment) -> Option<f64> {
    if p.x.max(q.x) < r.x.min(s.x) || r.x.max(s.x) < p.x.min(q.x) {
        return None;
    }
    if p.y.max(q.y) < r.y.min(s.y) || r.y.max(s.y) < p.y.min(q.y) {
        return None;
    }
    let (d, e) = (q - p, s - r);
    let slope = d.perp(&e);
    let (t, u) = ((r - p).perp(&e) / slope, (r - p).perp(&d) / slope);
    let meets = (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u);
    meets.then(|| p.y + t * d.y)
}
