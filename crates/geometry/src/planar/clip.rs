//! Clipping a segment: a walk over the bearings that it spans.
//!
//! Exact predicates decide how many stretches there are and which edges end them; floats only
//! measure where along the segment that is.

use super::membership::{bounded, flushed};
use super::{Interval, StarPolygon};
use crate::Point2;
use crate::predicates::{
    cross, cross_precise, nearer_on_ray, orient, orient_precise, same_direction,
};

/// Below this share of the terms it is the difference of, a determinant is measured again, precisely.
const ILL_CONDITIONED: f64 = 1e-2;

impl StarPolygon {
    /// Appends the maximal stretches of the segment `a` to `b` that lie strictly inside, in order.
    ///
    /// The stretches are open and disjoint; two may share an end point where the segment touches
    /// the boundary. A segment of no length is whole or absent. How many there are, and which edges
    /// bound them, is exact; their parameters are rounded, and kept in order. O(log n + bearings
    /// spanned); allocates in `out` only. A segment with a coordinate beyond the envelope or NaN
    /// has no stretch inside.
    pub fn clip(&self, a: &Point2, b: &Point2, out: &mut Vec<Interval>) {
        if !(bounded(a) && bounded(b)) {
            return;
        }
        let (a, b) = (flushed(a), flushed(b));
        if self.surely_clear_of(&a, &b) {
            return;
        }
        let begin = out.len();
        let turn = cross(&a, &b);
        if turn > 0.0 {
            self.walk(&Walk { p: a, q: b, a, b }, out);
        } else if turn < 0.0 {
            self.walk(&Walk { p: b, q: a, a, b }, out);
            for stretch in &mut out[begin..] {
                *stretch = Interval::new(stretch.to, stretch.from);
            }
            out[begin..].reverse();
        } else {
            self.clip_radial(&a, &b, out);
        }
        let mut reached = 0.0_f64;
        for stretch in &mut out[begin..] {
            stretch.from = stretch.from.clamp(reached, 1.0);
            stretch.to = stretch.to.clamp(stretch.from, 1.0);
            reached = stretch.to;
        }
    }

    /// Whether the segment certainly keeps out of the circle through the farthest vertex.
    #[inline]
    fn surely_clear_of(&self, a: &Point2, b: &Point2) -> bool {
        let limit = self.outer_radius * self.outer_radius * (1.0 + 1e-9);
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        if a.x * dx + a.y * dy >= 0.0 {
            return a.x * a.x + a.y * a.y > limit;
        }
        if b.x * dx + b.y * dy <= 0.0 {
            return b.x * b.x + b.y * b.y > limit;
        }
        let (left, right) = (a.x * dy, a.y * dx);
        let area = (left - right).abs() - 1e-14 * (left.abs() + right.abs());
        area > 0.0 && area * area > limit * (dx * dx + dy * dy)
    }

    /// Clips a segment that turns counter-clockwise around the origin from `p` to `q`.
    fn walk(&self, s: &Walk, out: &mut Vec<Interval>) {
        let Some(sector) = self.sector_of(&s.p) else { return };
        let n = self.vertices.len();
        let mut k = sector.index;
        let mut rays_left = n;
        // Whether the segment enters wedge k on the near side of chord k, and whether the stretch
        // that is being followed began before.
        let mut entry = Entry::AtStart;
        let mut inside_since: Option<f64> = None;
        loop {
            let next = self.next(k);
            let (v, w) = (&self.vertices[k], &self.vertices[next]);
            let leaves = rays_left > 0 && cross(w, &s.q) > 0.0 && cross(&s.p, w) > 0.0;
            // The ray through w is crossed strictly nearer than w when w lies to the right.
            let leaves_near = leaves && orient(&s.p, &s.q, w) < 0.0;
            if !self.gap_after[k] {
                let entry_inside = match entry {
                    Entry::AtStart => orient(v, w, &s.p) > 0.0,
                    Entry::OverRay { near } => near,
                };
                let exit_inside = if leaves { leaves_near } else { orient(v, w, &s.q) > 0.0 };
                if entry_inside && inside_since.is_none() {
                    inside_since = Some(match entry {
                        Entry::AtStart => s.start(),
                        Entry::OverRay { .. } => s.crossing_ray(v),
                    });
                }
                if entry_inside != exit_inside {
                    let at = s.crossing_chord(v, w);
                    match inside_since.take() {
                        Some(since) => out.push(Interval::new(since, at)),
                        None => inside_since = Some(at),
                    }
                }
                if exit_inside
                    && (!leaves || self.gap_after[next])
                    && let Some(since) = inside_since.take()
                {
                    let at = if leaves { s.crossing_ray(w) } else { s.end() };
                    out.push(Interval::new(since, at));
                }
            }
            if !leaves {
                return;
            }
            entry = Entry::OverRay { near: leaves_near };
            k = next;
            rays_left -= 1;
        }
    }

    /// Clips a segment on a line through the origin, or of no length.
    fn clip_radial(&self, a: &Point2, b: &Point2, out: &mut Vec<Interval>) {
        if a == b {
            if self.contains(a) {
                out.push(Interval::WHOLE);
            }
            return;
        }
        let zero = Point2::origin();
        if *a == zero {
            out.extend(self.reach_on_ray(b, &zero, (a, b)).map(|end| Interval::new(0.0, end)));
        } else if *b == zero {
            out.extend(self.reach_on_ray(a, &zero, (a, b)).map(|end| Interval::new(end, 1.0)));
        } else if same_direction(a, b) {
            if nearer_on_ray(a, b) {
                out.extend(self.reach_on_ray(b, a, (a, b)).map(|end| Interval::new(0.0, end)));
            } else {
                out.extend(self.reach_on_ray(a, b, (a, b)).map(|end| Interval::new(end, 1.0)));
            }
        } else {
            let middle = parameter_on_line(&zero, a, b);
            let first = self.reach_on_ray(a, &zero, (a, b));
            let second = self.reach_on_ray(b, &zero, (a, b));
            match (first, second) {
                // Without a gap both are there, and the origin between them is inside.
                (Some(from), Some(to)) if !self.has_gap => out.push(Interval::new(from, to)),
                _ => {
                    out.extend(first.map(|from| Interval::new(from, middle)));
                    out.extend(second.map(|to| Interval::new(middle, to)));
                }
            }
        }
    }

    /// Where, as a parameter of the segment `on`, the inside ends on the ray towards `far`, at
    /// most at `far`; none if it does not reach beyond `near`.
    fn reach_on_ray(&self, far: &Point2, near: &Point2, on: (&Point2, &Point2)) -> Option<f64> {
        let sector = self.sector_of(far)?;
        let i = sector.index;
        let v = &self.vertices[i];
        if self.gap_after[i] || (sector.on_ray && self.gap_after[self.previous(i)]) {
            return None;
        }
        let (a, b) = on;
        let at_far = if far == a { 0.0 } else { 1.0 };
        if sector.on_ray {
            if !nearer_on_ray(near, v) {
                return None;
            }
            let short = nearer_on_ray(far, v);
            return Some(if short { at_far } else { parameter_on_line(v, a, b) });
        }
        let w = &self.vertices[self.next(i)];
        if orient(v, w, near) <= 0.0 {
            return None;
        }
        let short = orient(v, w, far) > 0.0;
        Some(if short { at_far } else { crossing_chord(v, w, a, b) })
    }
}

/// A segment walked from `p` to `q`, which are `a` and `b` or `b` and `a`.
struct Walk {
    p: Point2,
    q: Point2,
    a: Point2,
    b: Point2,
}

/// How the walk came into a wedge.
enum Entry {
    AtStart,
    OverRay { near: bool },
}

impl Walk {
    fn start(&self) -> f64 {
        if self.p == self.a { 0.0 } else { 1.0 }
    }

    fn end(&self) -> f64 {
        1.0 - self.start()
    }

    fn crossing_chord(&self, v: &Point2, w: &Point2) -> f64 {
        crossing_chord(v, w, &self.a, &self.b)
    }

    /// The parameter where the segment crosses the ray through `v`.
    fn crossing_ray(&self, v: &Point2) -> f64 {
        let (at_a, at_b) = (cross(v, &self.a), cross(v, &self.b));
        let scale = v.x.abs().max(v.y.abs())
            * (self.a.x.abs().max(self.a.y.abs()) + self.b.x.abs().max(self.b.y.abs()));
        if (at_a - at_b).abs() > ILL_CONDITIONED * scale {
            at_a / (at_a - at_b)
        } else {
            ratio(cross_precise(v, &self.a), cross_precise(v, &self.b))
        }
    }
}

/// The parameter where the segment `a` to `b` crosses the line through `v` and `w`.
fn crossing_chord(v: &Point2, w: &Point2, a: &Point2, b: &Point2) -> f64 {
    let (at_a, at_b) = (orient(v, w, a), orient(v, w, b));
    let reach = |p: &Point2| {
        ((v.x - p.x).abs() + (v.y - p.y).abs()) * ((w.x - p.x).abs() + (w.y - p.y).abs())
    };
    if (at_a - at_b).abs() > ILL_CONDITIONED * (reach(a) + reach(b)) {
        at_a / (at_a - at_b)
    } else {
        ratio(orient_precise(v, w, a), orient_precise(v, w, b))
    }
}

/// The root of a linear function from its values at parameters 0 and 1.
fn ratio(at_0: f64, at_1: f64) -> f64 {
    let drop = at_0 - at_1;
    if drop == 0.0 { 0.0 } else { at_0 / drop }
}

/// The parameter of a point exactly on the line through the origin, `a` and `b`.
fn parameter_on_line(p: &Point2, a: &Point2, b: &Point2) -> f64 {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    if dx.abs() >= dy.abs() { (p.x - a.x) / dx } else { (p.y - a.y) / dy }
}
