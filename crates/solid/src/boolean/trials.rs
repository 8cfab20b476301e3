//! Steps 2 to 5, until a result is sound: as the operands are, and with the second moved a little.

use probe::{Off, Probe};

use super::attempt::{apart, attempt, failed};
use super::changed::{changed, thin};
use super::combine::{labelled, refused, settled};
use super::contacts::{Contacts, contacts, rounding_m};
use super::jitter::{FARTHEST, distances, grown, mixed};
use super::leaves::tidied;
use super::matching::matched;
use super::tags::Tags;
use super::{BooleanEvent, Kernel, Operation, Options};
use crate::validity::{crossed, flat_faces, meets_itself_at};
use crate::{Point3, Polyhedron, SolidError, crossings};

/// So many places where faces meet are looked at first.
const MOST_CROSSED: usize = 16;
/// So many are looked at in all before another trial.
const ALL_CROSSED: usize = 1000;
/// Within so many times what is rounding faces of an operand meet where those of a result do.
const INHERITED: f64 = 8.0;

/// Faces coincide within so many times the jitter at least.
const COINCIDENT_JITTERS: f64 = 10.0;

/// So many times the jitter parts by that what is left of two operands that touch is moved to meet.
const JOINING: f64 = 4.0;

/// One result of the engine.
pub(super) struct Trial {
    /// After step 4, where a probe wants to know.
    pub(super) combined: Option<Polyhedron>,
    /// After step 5.
    pub(super) mesh: Polyhedron,
    /// How far the second operand was moved, metres.
    pub(super) jitter_m: f64,
    /// Whether contacts were looked after.
    pub(super) contact: bool,
    /// Where faces meet that should not, or one is flat: some of the places where there are any.
    crossed: Vec<Point3>,
}

impl Trial {
    pub(super) fn is_sound(&self) -> bool {
        self.crossed.is_empty()
    }
}

/// Where faces of a mesh meet that should not, or one is flat: at most `limit` places.
pub(super) fn all_crossed(mesh: &Polyhedron, limit: usize) -> Vec<Point3> {
    let flat = flat_faces(mesh).into_iter().map(|face| *mesh.corners(face as usize)[0]);
    let meeting = crossings(mesh, limit).into_iter().map(|pair| pair.at);
    flat.chain(meeting).take(limit).collect()
}

/// Whether a result meets itself at `some` places or any others where an operand, moved by up to `by_m`, does.
pub(super) fn is_inherited(
    mesh: &Polyhedron,
    some: &[Point3],
    operands: &[&Polyhedron],
    by_m: f64,
) -> bool {
    let within_m = FARTHEST * by_m + INHERITED * rounding_m(operands);
    let by_one = |places: &[Point3]| {
        operands.iter().any(|operand| meets_itself_at(operand, places, within_m))
    };
    by_one(some) || by_one(&all_crossed(mesh, ALL_CROSSED))
}

/// The trial that is the result, and how many others there were.
pub(super) struct Taken {
    pub(super) trial: Trial,
    pub(super) again: usize,
}

/// Two operands, and all that can be tried on them.
pub(super) struct Trials<'a, K> {
    pub(super) kernel: &'a K,
    pub(super) operands: [&'a Polyhedron; 2],
    pub(super) operation: Operation,
    pub(super) options: &'a Options,
    pub(super) looking: &'a [(&'a Polyhedron, f64)],
    pub(super) contacts: Contacts,
    /// Whether results are kept as they were before step 5.
    pub(super) tell: bool,
}

impl<'a, K: Kernel> Trials<'a, K> {
    pub(super) fn new(
        kernel: &'a K,
        operands: [&'a Polyhedron; 2],
        operation: Operation,
        options: &'a Options,
        looking: &'a [(&'a Polyhedron, f64)],
        tell: bool,
    ) -> Self {
        let contacts = if options.jitter_m > 0.0 {
            Contacts::Sharp
        } else {
            contacts(operands[0], operands[1], options.coincident_m)
        };
        Self { kernel, operands, operation, options, looking, contacts, tell }
    }

    /// The first trial that is sound.
    ///
    /// Where faces of both operands are in one plane but for rounding, the engine takes each pair of them for
    /// what it is: results may be sound and yet have leaves, or lack a part. There the plain result has
    /// to have the volume and the areas of one with the second operand moved, or that one is taken. Where
    /// none is sound the first is the result, and where it meets itself as an operand does none is tried: whoever
    /// checks it is told.
    pub(super) fn taken(&self) -> Result<Taken, SolidError> {
        let contact = self.contacts != Contacts::None;
        let mut again = 0;
        let mut first = None;
        if self.options.jitter_m == 0.0 {
            let plain = self.trial(0.0, self.options.seed, contact)?;
            if plain.is_sound() && self.contacts != Contacts::Rounded {
                return Ok(Taken { trial: plain, again });
            }
            if self.inherits(&plain) {
                return Ok(Taken { trial: plain, again });
            }
            if !plain.is_sound() && !contact {
                again += 1;
                let tidied = self.trial(0.0, self.options.seed, true)?;
                if tidied.is_sound() {
                    return Ok(Taken { trial: tidied, again });
                }
            }
            first = Some(plain);
        }
        for (turn, jitter_m) in
            distances(self.options.jitter_m, rounding_m(&self.operands)).into_iter().enumerate()
        {
            let seed = match turn {
                0 => self.options.seed,
                _ => mixed(self.options.seed.wrapping_add(turn as u64)),
            };
            let moved = self.trial(jitter_m, seed, true)?;
            if moved.is_sound() {
                let (moved, more) = self.past_layers(moved, seed)?;
                again += more;
                let Some(plain) = first else { return Ok(Taken { trial: moved, again }) };
                let area_m2 = self.area_m2(&moved)?;
                if plain.is_sound() && self.agree(&plain, &moved, area_m2) {
                    return Ok(Taken { trial: plain, again });
                }
                again += 1;
                if self.operation == Operation::SymmetricDifference
                    && !self.agree(&moved, &moved, area_m2)
                {
                    let joined = self.joined(jitter_m, seed)?;
                    if joined.is_sound() && self.agree(&joined, &moved, area_m2) {
                        return Ok(Taken { trial: joined, again: again + 1 });
                    }
                }
                return Ok(Taken { trial: moved, again });
            }
            if first.is_none() && self.inherits(&moved) {
                return Ok(Taken { trial: moved, again });
            }
            again += 1;
            first = first.or(Some(moved));
        }
        // Only where nothing is tried is there no first one.
        let trial = match first {
            Some(trial) => trial,
            None => self.trial(0.0, self.options.seed, contact)?,
        };
        Ok(Taken { trial, again })
    }

    /// Whether faces of a trial meet where faces of an operand do: then so do those of every other.
    fn inherits(&self, trial: &Trial) -> bool {
        !trial.is_sound()
            && is_inherited(&trial.mesh, &trial.crossed, &self.operands, trial.jitter_m)
    }

    /// One trial, with the second operand moved by `jitter_m`.
    pub(super) fn trial(
        &self,
        jitter_m: f64,
        seed: u64,
        contact: bool,
    ) -> Result<Trial, SolidError> {
        let [a, b] = self.operands;
        let mut tags = Tags::new(self.options.provenance);
        let (tags_a, tags_b) = (tags.of(a), tags.of(b));
        let taken_a = self.first(&tags_a)?;
        // So that what coincides is on one side all over, and what only touches does not, or overlaps
        // where that leaves no sheet.
        let by_m = if self.operation == Operation::Intersection { -jitter_m } else { jitter_m };
        let (taken_b, moved) = self.second(&tags_b, seed, by_m)?;
        if self.operation != Operation::SymmetricDifference || jitter_m == 0.0 {
            let combined =
                attempt(self.kernel, &taken_a, &taken_b, self.operation, &tags, contact)?;
            let used = [a, moved.as_ref().unwrap_or(b)];
            let (combined, at) = if self.operation == Operation::SymmetricDifference && !contact {
                matched(combined, &used, rounding_m(&self.operands))
            } else {
                (combined, Vec::new())
            };
            return Ok(self.looked_at(combined, jitter_m, contact, &used, &at));
        }
        let (smaller_b, smaller) = self.second(&tags_b, seed, -jitter_m)?;
        let pairs = [(&taken_a, &taken_b), (&smaller_b, &taken_a)];
        let combined = tidied(apart(self.kernel, pairs, &tags, self.operation)?);
        let used = [a, moved.as_ref().unwrap_or(b), smaller.as_ref().unwrap_or(b)];
        Ok(self.looked_at(combined, jitter_m, contact, &used, &[]))
    }

    /// A trial of a symmetric difference that has no walls where operands touch: what is left of the second
    /// grows until it meets what is left of the first.
    fn joined(&self, jitter_m: f64, seed: u64) -> Result<Trial, SolidError> {
        let [a, b] = self.operands;
        let mut tags = Tags::new(self.options.provenance);
        let (tags_a, tags_b) = (tags.of(a), tags.of(b));
        let taken_a = self.first(&tags_a)?;
        let failed = failed(self.operation);
        let difference = |p: &K::Solid, q: &K::Solid| {
            self.kernel.combine(p, q, Operation::Difference).map_err(&failed)
        };
        let left_of_a = difference(&taken_a, &self.second(&tags_b, seed, jitter_m)?.0)?;
        let left_of_b = difference(&self.second(&tags_b, seed, -jitter_m)?.0, &taken_a)?;
        let given = self.kernel.give(&left_of_b);
        let numbers = given.tags.clone();
        let left_of_b = labelled(given, &tags, self.operation.name())?;
        let grown = grown(&left_of_b, seed, JOINING * jitter_m);
        let grown = self.kernel.take(&grown, &numbers).map_err(&failed)?;
        let combined =
            self.kernel.combine(&left_of_a, &grown, Operation::Union).map_err(&failed)?;
        let combined = labelled(self.kernel.give(&combined), &tags, self.operation.name())?;
        Ok(self.looked_at(tidied(combined), jitter_m, true, &[a], &[]))
    }

    fn first(&self, tags: &[u32]) -> Result<K::Solid, SolidError> {
        let a = self.operands[0];
        self.kernel.take(a, tags).map_err(|why| refused("first", a, why))
    }

    /// The second operand, its faces moved outwards by `by_m`, and its mesh where it was.
    fn second(
        &self,
        tags: &[u32],
        seed: u64,
        by_m: f64,
    ) -> Result<(K::Solid, Option<Polyhedron>), SolidError> {
        let b = self.operands[1];
        let moved = (by_m != 0.0).then(|| grown(b, seed, by_m));
        let taken = self.kernel.take(moved.as_ref().unwrap_or(b), tags);
        taken.map(|taken| (taken, moved)).map_err(|why| refused("second", b, why))
    }

    /// Step 5 of a trial, and whether it is sound; `used` are the meshes that the engine was given, `at` faces to be
    /// looked at in any case.
    fn looked_at(
        &self,
        combined: Polyhedron,
        jitter_m: f64,
        contact: bool,
        used: &[&Polyhedron],
        at: &[u32],
    ) -> Trial {
        let before = self.tell.then(|| combined.clone());
        let mesh = self.settled(combined, jitter_m, contact, &mut Off);
        let crossed = if self.contacts == Contacts::Rounded && jitter_m == 0.0 {
            // Faces that the engine left as they were may meet, too.
            all_crossed(&mesh, MOST_CROSSED)
        } else {
            let mut some = if contact { changed(&mesh, used) } else { thin(&mesh) };
            some.extend(at);
            some.sort_unstable();
            some.dedup();
            crossed(&mesh, &some, MOST_CROSSED)
        };
        Trial { combined: before, mesh, jitter_m, contact, crossed }
    }

    /// Step 5.
    pub(super) fn settled(
        &self,
        mesh: Polyhedron,
        jitter_m: f64,
        contact: bool,
        probe: &mut impl for<'x> Probe<BooleanEvent<'x>>,
    ) -> Polyhedron {
        if !contact {
            probe.emit(BooleanEvent::Settled { mesh: &mesh, faces: &[] });
            return mesh;
        }
        let coincident_m = self.options.coincident_m.max(COINCIDENT_JITTERS * jitter_m);
        settled(mesh, self.looking, coincident_m, probe)
    }
}
