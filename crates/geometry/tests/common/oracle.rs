//! Membership and clipping by brute force over all boundary edges, in exact integer arithmetic.
//!
//! Deliberately another method than the library's: crossing numbers instead of bearings, all
//! crossings sorted instead of a walk. Rationals are pairs of integers that are never reduced.

use std::cmp::Ordering;

use num_integer::Integer;
use num_traits::Signed;

/// What numbers are made of: `i128` for small grids, `BigInt` for any float.
pub trait Whole: Integer + Signed + Clone {}
impl<T: Integer + Signed + Clone> Whole for T {}

/// An exact point or vector.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    pub x: T,
    pub y: T,
}

impl<T: Whole> At<T> {
    pub fn origin() -> Self {
        Self { x: T::zero(), y: T::zero() }
    }

    fn minus(&self, other: &Self) -> Self {
        Self { x: self.x.clone() - other.x.clone(), y: self.y.clone() - other.y.clone() }
    }

    fn times(&self, k: &T) -> Self {
        Self { x: self.x.clone() * k.clone(), y: self.y.clone() * k.clone() }
    }

    pub fn cross(&self, other: &Self) -> T {
        self.x.clone() * other.y.clone() - self.y.clone() * other.x.clone()
    }

    pub fn dot(&self, other: &Self) -> T {
        self.x.clone() * other.x.clone() + self.y.clone() * other.y.clone()
    }
}

/// A rational number with a positive denominator.
#[derive(Clone, Debug)]
pub struct Fraction<T> {
    pub over: T,
    pub under: T,
}

impl<T: Whole> Fraction<T> {
    fn new(over: T, under: T) -> Self {
        if under.is_negative() { Self { over: -over, under: -under } } else { Self { over, under } }
    }

    fn compare(&self, other: &Self) -> Ordering {
        (self.over.clone() * other.under.clone()).cmp(&(other.over.clone() * self.under.clone()))
    }

    fn is_within_segment(&self) -> bool {
        !self.over.is_negative() && self.over <= self.under
    }

    fn halfway(&self, other: &Self) -> Self {
        let two = T::one() + T::one();
        Self {
            over: self.over.clone() * other.under.clone() + other.over.clone() * self.under.clone(),
            under: two * self.under.clone() * other.under.clone(),
        }
    }
}

/// Straight boundary edges that form closed chains.
pub struct Outline<T> {
    pub edges: Vec<(At<T>, At<T>)>,
}

impl<T: Whole> Outline<T> {
    /// The outline of a star polygon, built from its definition.
    pub fn new(vertices: &[At<T>], gap_after: &[bool]) -> Self {
        let mut edges = Vec::new();
        for (i, v) in vertices.iter().enumerate() {
            let w = &vertices[(i + 1) % vertices.len()];
            if gap_after[i] {
                edges.push((v.clone(), At::origin()));
                edges.push((At::origin(), w.clone()));
            } else {
                edges.push((v.clone(), w.clone()));
            }
        }
        Self { edges }
    }

    /// Whether a point lies strictly inside.
    pub fn contains(&self, p: &At<T>) -> bool {
        self.contains_scaled(p, &T::one())
    }

    /// Whether `p / scale` lies strictly inside, by the parity of crossings to the right of it.
    fn contains_scaled(&self, p: &At<T>, scale: &T) -> bool {
        let mut odd = false;
        for (c, d) in &self.edges {
            let along = d.minus(c);
            let (from_c, from_d) = (p.minus(&c.times(scale)), p.minus(&d.times(scale)));
            let side = along.cross(&from_c);
            let beside = !from_c.dot(&along).is_negative() && !from_d.dot(&along).is_positive();
            if side.is_zero() && beside {
                return false;
            }
            if from_c.y.is_negative() != from_d.y.is_negative() {
                let upward = from_c.y > from_d.y;
                odd ^= if upward { side.is_positive() } else { side.is_negative() };
            }
        }
        odd
    }

    /// The maximal open stretches of `a` to `b` strictly inside, as exact parameters.
    pub fn clip(&self, a: &At<T>, b: &At<T>) -> Vec<(Fraction<T>, Fraction<T>)> {
        let zero = Fraction { over: T::zero(), under: T::one() };
        let one = Fraction { over: T::one(), under: T::one() };
        if a == b {
            return if self.contains(a) { vec![(zero, one)] } else { Vec::new() };
        }
        let inside = |t: &Fraction<T>| {
            let (near, far) = (a.times(&t.under), b.minus(a).times(&t.over));
            self.contains_scaled(&At { x: near.x + far.x, y: near.y + far.y }, &t.under)
        };
        let mut cuts = vec![zero, one];
        for (c, d) in &self.edges {
            cuts.extend(crossings(a, b, c, d));
        }
        cuts.retain(Fraction::is_within_segment);
        cuts.sort_by(Fraction::compare);
        cuts.dedup_by(|s, t| s.compare(t).is_eq());
        let mut stretches: Vec<(Fraction<T>, Fraction<T>)> = Vec::new();
        let mut goes_on = false;
        for pair in cuts.windows(2) {
            if !inside(&pair[0].halfway(&pair[1])) {
                goes_on = false;
                continue;
            }
            match stretches.last_mut() {
                Some(last) if goes_on && inside(&pair[0]) => last.1 = pair[1].clone(),
                _ => stretches.push((pair[0].clone(), pair[1].clone())),
            }
            goes_on = true;
        }
        stretches
    }
}

/// The parameters of `a` to `b` where it meets the segment `c` to `d`, or where an overlap ends.
fn crossings<T: Whole>(a: &At<T>, b: &At<T>, c: &At<T>, d: &At<T>) -> Vec<Fraction<T>> {
    let (along, edge, to_c) = (b.minus(a), d.minus(c), c.minus(a));
    let slope = along.cross(&edge);
    if slope.is_zero() {
        if !along.cross(&to_c).is_zero() {
            return Vec::new();
        }
        let length = along.dot(&along);
        return [c, d].map(|p| Fraction::new(p.minus(a).dot(&along), length.clone())).to_vec();
    }
    if !Fraction::new(to_c.cross(&along), slope.clone()).is_within_segment() {
        return Vec::new();
    }
    vec![Fraction::new(to_c.cross(&edge), slope)]
}
