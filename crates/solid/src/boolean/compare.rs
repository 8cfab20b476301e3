//! Step 2: whether results with the second operand moved are of one volume and area with others.

use super::contacts::are_layered;
use super::trials::{Trial, Trials};
use super::{Kernel, Operation};
use crate::SolidError;

/// So many times as far a move passes the layers that others left.
const PAST_LAYERS: f64 = 8.0;

/// By so many times the jitter and the area of both operands volumes may differ.
const SAME_VOLUME: f64 = 16.0;
/// By this share of their sum areas may differ.
const SAME_AREA: f64 = 1e-6;

impl<K: Kernel> Trials<'_, K> {
    /// The trial, or a sound one with the second operand moved past the layers that earlier moves left, where
    /// that has less area: between such a layer and a face that was moved as far a sheet may be left. And how
    /// many trials that took.
    pub(super) fn past_layers(
        &self,
        moved: Trial,
        seed: u64,
    ) -> Result<(Trial, usize), SolidError> {
        let [a, b] = self.operands;
        let past_m = PAST_LAYERS * moved.jitter_m;
        if !are_layered(a, b, past_m) {
            return Ok((moved, 0));
        }
        let other = self.trial(past_m, seed, true)?;
        let (area_m2, less_m2) =
            (moved.mesh.area_by_label().total_m2(), other.mesh.area_by_label().total_m2());
        let off_m3 = (moved.mesh.volume_m3() - other.mesh.volume_m3()).abs();
        let better = other.is_sound()
            && less_m2 < area_m2 - SAME_AREA * self.scale_m2()
            && off_m3 <= SAME_VOLUME * past_m * self.scale_m2();
        Ok((if better { other } else { moved }, 1))
    }

    /// The area of both operands, square metres.
    fn scale_m2(&self) -> f64 {
        self.operands.iter().map(|mesh| mesh.area_by_label().total_m2()).sum()
    }

    /// The area that the result has without walls where operands touch, by a trial with the second operand
    /// moved.
    pub(super) fn area_m2(&self, moved: &Trial) -> Result<f64, SolidError> {
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
    pub(super) fn agree(&self, trial: &Trial, moved: &Trial, area_m2: f64) -> bool {
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
