//! Steps 2 to 5, until a result is sound: as the operands are, and with the second moved a little.

use probe::{Off, Probe};

use super::attempt::{apart, attempt, failed};
use super::changed::{changed, thin, unmatched};
use super::combine::{labelled, refused, settled};
use super::contacts::{Contacts, are_layered, contacts, rounding_m};
use super::jitter::{JITTER_M, grown, mixed};
use super::leaves::tidied;
use super::tags::Tags;
use super::{BooleanEvent, Kernel, Operation, Options};
use crate::validity::{any_is_crossed, flat_faces};
use crate::{Polyhedron, SolidError, crossings};

/// What is tried in turn where a jitter is asked for: that many times as far, by another chance each time.
/// Layers that another jitter left, as thin as this one, are passed sooner by a smaller one.
const TIMES: [f64; 12] = [1.0, 1.0, 0.3, 2.0, 0.1, 4.0, 0.03, 8.0, 20.0, 50.0, 100.0, 1000.0];

/// What is tried in turn where none is asked for and faces are in one plane up to rounding: that many times
/// what is rounding, at most [`JITTER_M`], or what is rounding where that is more.
const ROUNDINGS: [f64; 7] = [4.0, 4.0, 16.0, 64.0, 256.0, 1024.0, 4096.0];

/// Faces coincide within so many times the jitter at least.
const COINCIDENT_JITTERS: f64 = 10.0;

/// So many times as far a move passes the layers that others left.
const PAST_LAYERS: f64 = 8.0;

/// So many times the jitter parts by that what is left of two operands that touch is moved to meet.
const JOINING: f64 = 4.0;

/// By so many times the jitter and the area of both operands volumes may differ.
const SAME_VOLUME: f64 = 16.0;
/// By this share of their sum areas may differ.
const SAME_AREA: f64 = 1e-6;

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
    /// Whether nothing meets that should not.
    sound: bool,
}

/// The trial that is the result, and how many others there were.
pub(super) struct Taken {
    pub(super) trial: Trial,
    pub(super) again: usize,
}

/// Two operands, and all that can be tried on them.
pub(super) struct Trials<'a, K> {
    kernel: &'a K,
    operands: [&'a Polyhedron; 2],
    operation: Operation,
    options: &'a Options,
    looking: &'a [(&'a Polyhedron, f64)],
    contacts: Contacts,
    /// Whether results are kept as they were before step 5.
    tell: bool,
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
    /// none is sound the first is the result: whoever checks it is told.
    pub(super) fn taken(&self) -> Result<Taken, SolidError> {
        let contact = self.contacts != Contacts::None;
        let mut again = 0;
        let mut first = None;
        if self.options.jitter_m == 0.0 {
            let plain = self.trial(0.0, self.options.seed, contact)?;
            if plain.sound && self.contacts != Contacts::Rounded {
                return Ok(Taken { trial: plain, again });
            }
            if !plain.sound && !contact {
                again += 1;
                let tidied = self.trial(0.0, self.options.seed, true)?;
                if tidied.sound {
                    return Ok(Taken { trial: tidied, again });
                }
            }
            first = Some(plain);
        }
        for (turn, jitter_m) in self.jitters().into_iter().enumerate() {
            let seed = match turn {
                0 => self.options.seed,
                _ => mixed(self.options.seed.wrapping_add(turn as u64)),
            };
            let moved = self.trial(jitter_m, seed, true)?;
            if moved.sound {
                let (moved, more) = self.past_layers(moved, seed)?;
                again += more;
                let Some(plain) = first else { return Ok(Taken { trial: moved, again }) };
                let area_m2 = self.area_m2(&moved)?;
                if plain.sound && self.agree(&plain, &moved, area_m2) {
                    return Ok(Taken { trial: plain, again });
                }
                again += 1;
                if self.operation == Operation::SymmetricDifference
                    && !self.agree(&moved, &moved, area_m2)
                {
                    let joined = self.joined(jitter_m, seed)?;
                    if joined.sound && self.agree(&joined, &moved, area_m2) {
                        return Ok(Taken { trial: joined, again: again + 1 });
                    }
                }
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

    /// The trial, or a sound one with the second operand moved past the layers that earlier moves left, where
    /// that has less area: between such a layer and a face that was moved as far a sheet may be left. And how
    /// many trials that took.
    fn past_layers(&self, moved: Trial, seed: u64) -> Result<(Trial, usize), SolidError> {
        let [a, b] = self.operands;
        let past_m = PAST_LAYERS * moved.jitter_m;
        if !are_layered(a, b, past_m) {
            return Ok((moved, 0));
        }
        let other = self.trial(past_m, seed, true)?;
        let (area_m2, less_m2) =
            (moved.mesh.area_by_label().total_m2(), other.mesh.area_by_label().total_m2());
        let off_m3 = (moved.mesh.volume_m3() - other.mesh.volume_m3()).abs();
        let better = other.sound
            && less_m2 < area_m2 - SAME_AREA * self.scale_m2()
            && off_m3 <= SAME_VOLUME * past_m * self.scale_m2();
        Ok((if better { other } else { moved }, 1))
    }

    /// How far the second operand is moved, in the order tried, metres.
    fn jitters(&self) -> Vec<f64> {
        if self.options.jitter_m > 0.0 {
            return TIMES.map(|times| times * self.options.jitter_m).to_vec();
        }
        let rounding_m = rounding_m(self.operands);
        let least_m = 4.0 * rounding_m;
        let mut all =
            ROUNDINGS.map(|times| (times * rounding_m).min(JITTER_M.max(least_m))).to_vec();
        all.retain(|&jitter_m| jitter_m > 0.0);
        all
    }

    /// One trial, with the second operand moved by `jitter_m`.
    fn trial(&self, jitter_m: f64, seed: u64, contact: bool) -> Result<Trial, SolidError> {
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
            return Ok(self.looked_at(combined, jitter_m, contact, &used));
        }
        let (smaller_b, smaller) = self.second(&tags_b, seed, -jitter_m)?;
        let pairs = [(&taken_a, &taken_b), (&smaller_b, &taken_a)];
        let combined = tidied(apart(self.kernel, pairs, &tags, self.operation)?);
        let used = [a, moved.as_ref().unwrap_or(b), smaller.as_ref().unwrap_or(b)];
        Ok(self.looked_at(combined, jitter_m, contact, &used))
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
        Ok(self.looked_at(tidied(combined), jitter_m, true, &[a]))
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

    /// Step 5 of a trial, and whether it is sound; `used` are the meshes that the engine was given.
    fn looked_at(
        &self,
        combined: Polyhedron,
        jitter_m: f64,
        contact: bool,
        used: &[&Polyhedron],
    ) -> Trial {
        let before = self.tell.then(|| combined.clone());
        let mesh = self.settled(combined, jitter_m, contact, &mut Off);
        let sound = if self.contacts == Contacts::Rounded && jitter_m == 0.0 {
            // Faces that the engine left as they were may meet, too.
            flat_faces(&mesh).is_empty() && crossings(&mesh, 1).is_empty()
        } else if contact {
            !any_is_crossed(&mesh, &changed(&mesh, used))
        } else {
            let mut some = thin(&mesh);
            if self.operation == Operation::SymmetricDifference {
                some.extend(unmatched(&mesh, used));
                some.sort_unstable();
                some.dedup();
            }
            !any_is_crossed(&mesh, &some)
        };
        Trial { combined: before, mesh, jitter_m, contact, sound }
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

    /// The area of both operands, square metres.
    fn scale_m2(&self) -> f64 {
        self.operands.iter().map(|mesh| mesh.area_by_label().total_m2()).sum()
    }

    /// The area that the result has without walls where operands touch, by a trial with the second operand
    /// moved.
    fn area_m2(&self, moved: &Trial) -> Result<f64, SolidError> {
        let mut area_m2 = moved.mesh.area_by_label().total_m2();
        if self.operation == Operation::SymmetricDifference {
            // What both operands have alike is in the union and in the intersection and in no difference; what
            // touches is in both differences alone.
            area_m2 -= self.scale_m2();
            for operation in [Operation::Union, Operation::Intersection] {
                let other = Trials { operation, ..*self };
                let other = other.trial(moved.jitter_m, self.options.seed, true)?;
                area_m2 += other.mesh.area_by_label().total_m2();
            }
        }
        Ok(area_m2)
    }

    /// Whether a trial has this area, and the volume and the areas of one with the second operand moved, but for
    /// what the move takes.
    fn agree(&self, trial: &Trial, moved: &Trial, area_m2: f64) -> bool {
        let scale_m2 = self.scale_m2();
        let off_m3 = (trial.mesh.volume_m3() - moved.mesh.volume_m3()).abs();
        let same = |x: f64, y: f64| (x - y).abs() <= SAME_AREA * scale_m2;
        let (found, other) = (trial.mesh.area_by_label(), moved.mesh.area_by_label());
        // The walls that a symmetric difference may have or not are of any label.
        off_m3 <= SAME_VOLUME * moved.jitter_m * scale_m2
            && same(found.total_m2(), area_m2)
            && (self.operation == Operation::SymmetricDifference
                || same(found.obstacle_m2, other.obstacle_m2))
    }
}
