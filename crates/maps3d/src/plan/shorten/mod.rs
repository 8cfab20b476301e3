//! Step 7: the shortest polyline through a corridor, clear of obstacles, by cone programmes.

mod base;
mod program;
mod pull;
mod rooms;

use probe::Probe;
use solid::{Point3, Vector3};

pub(super) use base::Narrow;
use program::{HalfSpace, Room, shortest};
use pull::{gates_between, is_overlap, pulled};

use super::corridor::{Corridor, Knot, length_m};
use super::events::PlanEvent;
use super::obstacles::crossing;
use super::space::{Exit, Space};

/// Times that half-spaces are laid anew around a polyline that is clear of obstacles.
const ROUNDS: usize = 6;
/// Programmes solved in one round, at most.
const SOLVES: usize = 16;
/// A round that gains less than this share is the last.
const GAIN: f64 = 2e-3;
/// Knots that are put where an obstacle is near keep this share of the radius between them.
const SHORTEST: f64 = 0.35;
/// Knots of one programme, at most.
const MOST_KNOTS: usize = 64;
/// Half-spaces keep this much more than the radius, so that rounding does not eat it.
const PLANNED: f64 = 1.0 + 1e-6;

/// What a corridor came to.
#[derive(Clone, Debug)]
pub(super) struct Shortened {
    pub knots: Vec<Knot>,
    pub programmes: usize,
}

/// What is worked on.
struct Work<'a> {
    space: &'a Space,
    corridor: &'a Corridor,
    radius_m: f64,
}

/// The shortest polyline that was found; it stays in the corridor, exactly, and keeps the radius.
///
/// # Errors
/// [`Narrow`] tells a place where no ball of the radius was found to pass.
pub(super) fn shorten<P>(
    space: &Space,
    corridor: &Corridor,
    radius_m: f64,
    way: &[Knot],
    shortens: bool,
    probe: &mut P,
) -> Result<Shortened, Narrow>
where
    P: for<'e> Probe<PlanEvent<'e>>,
{
    let work = Work { space, corridor, radius_m };
    let clear = if radius_m == 0.0 {
        way.to_vec()
    } else {
        // The way itself stays inside by construction.
        match base::clear(space, corridor, radius_m, way) {
            Err(_) if work.is_clear(way) => way.to_vec(),
            found => found?,
        }
    };
    if !shortens {
        let knots = if radius_m > 0.0 { work.settled(&clear).unwrap_or(clear) } else { clear };
        return Ok(Shortened { knots, programmes: 0 });
    }
    let first = pulled(space, corridor, radius_m, &clear);
    // The way as it came is inside by construction; what was pulled from it is, unless it was undone
    // by a knot beside its face.
    let mut best = work.settled(&first).or_else(|| work.settled(&clear)).unwrap_or(clear);
    let mut programmes = 0;
    for _ in 0..ROUNDS {
        let Some(found) = work.round(&best, &mut programmes, probe) else { break };
        let (before_m, after_m) = (length_m(&best), length_m(&found));
        if after_m < before_m {
            best = found;
            if probe.on() {
                let points: Vec<Point3> = best.iter().map(|knot| knot.at).collect();
                probe.emit(PlanEvent::Verified { points: &points, length_m: after_m });
            }
        }
        // Without obstacles to keep from, one round finds the shortest.
        if radius_m == 0.0 || after_m > before_m * (1.0 - GAIN) {
            break;
        }
    }
    let last = pulled(space, corridor, radius_m, &best);
    if let Some(last) = work.settled(&last)
        && length_m(&last) <= length_m(&best)
    {
        best = last;
    }
    Ok(Shortened { knots: best, programmes })
}

impl Work<'_> {
    /// One polyline of least length, with half-spaces laid around one that is clear.
    fn round<P>(&self, clear: &[Knot], programmes: &mut usize, probe: &mut P) -> Option<Vec<Knot>>
    where
        P: for<'e> Probe<PlanEvent<'e>>,
    {
        // `old` gets more knots on its way, and stays the polyline that it is.
        let mut old: Vec<Knot> = clear.to_vec();
        let mut apart: Vec<(usize, HalfSpace)> = Vec::new();
        let mut last = None;
        for _ in 0..SOLVES {
            let Some(new) = self.solved(&old, &apart, probe) else { break };
            *programmes += 1;
            let missed = self.missed(&new);
            if !missed.is_empty() && old.len() + missed.len() <= MOST_KNOTS {
                for &(segment, gate) in missed.iter().rev() {
                    self.activate(&mut old, &mut apart, segment, gate, probe);
                }
                last = None;
                continue;
            }
            if !missed.is_empty() {
                break;
            }
            let laid = self.separate(&mut old, &mut apart, &new, probe);
            match laid {
                Laid::Clear => return self.settled(&new),
                Laid::HalfSpaces => last = Some(new),
                Laid::Knots => last = None,
            }
        }
        // Part of the way to what was found, if that is clear.
        let new = last?;
        [0.5, 0.25, 0.1].into_iter().find_map(|share| {
            let between = old.iter().zip(&new).map(|(old, new)| {
                rooms::placed(
                    self.space,
                    self.corridor,
                    old.place,
                    old.at + (new.at - old.at) * share,
                )
            });
            let mut between: Vec<Knot> = between.collect();
            let end = between.len() - 1;
            (between[0], between[end]) = (old[0], old[end]);
            let good = self.missed(&between).is_empty() && self.is_clear(&between);
            if good { self.settled(&between) } else { None }
        })
    }

    /// The programme's polyline, each knot put where it belongs.
    fn solved<P>(
        &self,
        old: &[Knot],
        apart: &[(usize, HalfSpace)],
        probe: &mut P,
    ) -> Option<Vec<Knot>>
    where
        P: for<'e> Probe<PlanEvent<'e>>,
    {
        let inner = &old[1..old.len() - 1];
        let (from, to) = (old[0], old[old.len() - 1]);
        if inner.is_empty() {
            return Some(old.to_vec());
        }
        let rooms: Vec<Room> =
            inner.iter().map(|knot| rooms::room(self.space, self.corridor, knot)).collect();
        let points = shortest(&from.at, &to.at, &rooms, apart)?;
        if points.iter().any(|p| !p.coords.iter().all(|c| c.is_finite())) {
            return None;
        }
        let mut new = vec![from];
        new.extend(
            inner
                .iter()
                .zip(points)
                .map(|(knot, at)| rooms::placed(self.space, self.corridor, knot.place, at)),
        );
        new.push(to);
        if probe.on() {
            let points: Vec<Point3> = new.iter().map(|knot| knot.at).collect();
            let (length_m, half_spaces) = (length_m(&new), apart.len());
            probe.emit(PlanEvent::Solved { points: &points, length_m, half_spaces });
        }
        Some(new)
    }

    /// For each segment that misses gates between its ends, the one that it misses by most.
    fn missed(&self, knots: &[Knot]) -> Vec<(usize, u32)> {
        let mut missed = Vec::new();
        for (segment, pair) in knots.windows(2).enumerate() {
            let mut worst: Option<(f64, u32)> = None;
            for gate in gates_between(&pair[0], &pair[1]) {
                if self.corridor.meets(self.space, gate, &pair[0].at, &pair[1].at) {
                    continue;
                }
                let by_m = match self.corridor.exits[gate as usize] {
                    Exit::Face(corners) => {
                        let face = self.space.points(corners);
                        let (p, q) = super::obstacles::between(&pair[0].at, &pair[1].at, &face);
                        (p - q).norm()
                    }
                    Exit::Overlap(_) => f64::INFINITY,
                };
                if worst.is_none_or(|(most, _)| by_m > most) {
                    worst = Some((by_m, gate));
                }
            }
            missed.extend(worst.map(|(_, gate)| (segment, gate)));
        }
        missed
    }

    /// Gives the old polyline a knot where it passes a gate.
    fn activate<P>(
        &self,
        old: &mut Vec<Knot>,
        apart: &mut Vec<(usize, HalfSpace)>,
        segment: usize,
        gate: u32,
        probe: &mut P,
    ) where
        P: for<'e> Probe<PlanEvent<'e>>,
    {
        let [from, to] = [old[segment].at, old[segment + 1].at];
        let at = match self.corridor.exits[gate as usize] {
            Exit::Overlap(at) => at,
            Exit::Face(corners) => {
                let face = self.space.points(corners);
                probe.emit(PlanEvent::Activated { face });
                crossing(&from, &to, &face)
                    .unwrap_or_else(|| super::obstacles::between(&from, &to, &face).0)
            }
        };
        split(old, apart, segment, Knot { place: 2 * gate + 1, at });
    }

    /// Lays half-spaces where the new polyline comes too near, or gives it a knot there.
    fn separate<P>(
        &self,
        old: &mut Vec<Knot>,
        apart: &mut Vec<(usize, HalfSpace)>,
        new: &[Knot],
        probe: &mut P,
    ) -> Laid
    where
        P: for<'e> Probe<PlanEvent<'e>>,
    {
        if self.radius_m == 0.0 {
            return Laid::Clear;
        }
        let obstacles = self.space.obstacles();
        let mut laid = Laid::Clear;
        for segment in (0..new.len() - 1).rev() {
            let (a, b) = (&new[segment].at, &new[segment + 1].at);
            let Some(near) = obstacles.near_segment(a, b, self.radius_m) else { continue };
            // A long segment bends near the obstacle before it moves as a whole.
            let [from, to] = [old[segment], old[segment + 1]];
            let (p, q) = obstacles.pair(&from.at, &to.at, near.face);
            if old.len() < MOST_KNOTS
                && let Some(knot) = self.bend(&from, &to, &p)
            {
                split(old, apart, segment, knot);
                laid = Laid::Knots;
                continue;
            }
            let distance_m = (p - q).norm();
            let Some(away): Option<Vector3> = (p - q).try_normalize(1e-12) else { continue };
            let keep_m = (self.radius_m * PLANNED).min(distance_m);
            let limit = -(away.dot(&q.coords) + keep_m);
            apart.push((segment, HalfSpace { normal: -away, limit }));
            let event = PlanEvent::Separated { from: p, obstacle: q, distance_m: near.distance_m };
            probe.emit(event);
            if laid == Laid::Clear {
                laid = Laid::HalfSpaces;
            }
        }
        laid
    }

    /// A knot on the segment between two, next to a point of it, so that the parts are not short; `None`
    /// where they would be.
    fn bend(&self, from: &Knot, to: &Knot, near: &Point3) -> Option<Knot> {
        let length = (to.at - from.at).norm();
        let least = SHORTEST * self.radius_m;
        if length < 2.0 * least {
            return None;
        }
        let along = (near - from.at).norm().clamp(least, length - least);
        let at = from.at + (to.at - from.at) * (along / length);
        // The gates that are passed before it tell its tetrahedron.
        let gates = gates_between(from, to);
        let mut index = gates.start;
        for gate in gates {
            let Exit::Face(corners) = self.corridor.exits[gate as usize] else { return None };
            let passed = crossing(&from.at, &to.at, &self.space.points(corners))?;
            if (passed - from.at).norm() > along {
                break;
            }
            index = gate + 1;
        }
        Some(Knot { place: 2 * index, at })
    }

    fn is_clear(&self, knots: &[Knot]) -> bool {
        self.radius_m == 0.0
            || knots.windows(2).all(|pair| {
                let obstacles = self.space.obstacles();
                obstacles.near_segment(&pair[0].at, &pair[1].at, self.radius_m).is_none()
            })
    }

    /// The polyline with each knot exactly where it belongs, if it passes the exact walk and is clear.
    fn settled(&self, knots: &[Knot]) -> Option<Vec<Knot>> {
        let mut knots: Vec<Knot> = knots.to_vec();
        let end = knots.len() - 1;
        for knot in &mut knots[1..end] {
            *knot = rooms::placed(self.space, self.corridor, knot.place, knot.at);
        }
        // Each try settles the knots of one gate at least.
        for _ in 0..2 * knots.len() {
            let Some(miss) = self.corridor.leaves(self.space, &knots) else {
                return self.is_clear(&knots).then_some(knots);
            };
            let own = |knot: &Knot| knot.place == 2 * miss.gate + 1;
            let at =
                [miss.knot, miss.knot + 1].into_iter().find(|&i| knots.get(i).is_some_and(own))?;
            if is_overlap(self.corridor, &knots[at]) {
                return None;
            }
            let both = rooms::doubled(self.space, self.corridor, &knots[at])?;
            knots.splice(at..=at, both);
        }
        None
    }
}

/// Puts a knot on a segment; half-spaces of the segment hold for both parts.
fn split(old: &mut Vec<Knot>, apart: &mut Vec<(usize, HalfSpace)>, segment: usize, knot: Knot) {
    old.insert(segment + 1, knot);
    let mut more = Vec::new();
    for (of, half_space) in apart.iter_mut() {
        if *of == segment {
            more.push((segment + 1, *half_space));
        } else if *of > segment {
            *of += 1;
        }
    }
    apart.extend(more);
}

/// What was laid between a polyline and obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Laid {
    Clear,
    HalfSpaces,
    Knots,
}
