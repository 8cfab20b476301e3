//! What each stage of a map of space takes: told apart by the events at their ends.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use maps3d::global_union::UnionEvent;
use maps3d::relative::ConsolidationEvent;
use maps3d::{DepthEvent, Map3dProbe, PlanEvent};
use probe::Probe;
use serde::Serialize;

use crate::run::quantile;

/// What one stage of a map cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StageTiming {
    /// How often it was done.
    pub times: u64,
    /// Median, microseconds.
    pub micros_median: f64,
    /// 99th percentile, microseconds.
    pub micros_p99: f64,
    /// All together, seconds.
    pub secs: f64,
}

/// The times of all stages of one map; shared with the map.
#[derive(Clone, Debug, Default)]
pub(super) struct Stages(Arc<Mutex<BTreeMap<&'static str, Vec<f64>>>>);

impl Stages {
    fn note(&self, stage: &'static str, from: Instant) {
        let micros = from.elapsed().as_secs_f64() * 1e6;
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .entry(stage)
            .or_default()
            .push(micros);
    }

    /// Does a piece of work that is one stage.
    pub(super) fn timed<T>(&self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let from = Instant::now();
        let result = work();
        self.note(stage, from);
        result
    }

    /// Does a piece of work whose stages end with events; what is left after the last is `rest`.
    pub(super) fn by_events<T>(
        &self,
        rest: &'static str,
        probe: &mut dyn Map3dProbe,
        work: impl FnOnce(&mut dyn Map3dProbe) -> T,
    ) -> T {
        let mut heard = Heard { probe, stages: self, from: Instant::now() };
        let result = work(&mut heard);
        self.note(rest, heard.from);
        result
    }

    /// What each stage cost, by name.
    pub(super) fn timing(&self) -> BTreeMap<&'static str, StageTiming> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let timing = |micros: &Vec<f64>| StageTiming {
            times: micros.len() as u64,
            micros_median: quantile(micros, 0.5),
            micros_p99: quantile(micros, 0.99),
            secs: micros.iter().fold(0.0, |sum, one| sum + one * 1e-6),
        };
        all.iter().map(|(&stage, micros)| (stage, timing(micros))).collect()
    }
}

/// Most memory that this process held so far, bytes; `None` where the system does not tell.
pub(super) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? * 1024)
}

/// A listener that notes when a stage ends; what it takes to listen is of no stage.
struct Heard<'a> {
    probe: &'a mut dyn Map3dProbe,
    stages: &'a Stages,
    from: Instant,
}

impl Heard<'_> {
    fn hear(&mut self, stage: Option<&'static str>, emit: impl FnOnce(&mut dyn Map3dProbe)) {
        if let Some(stage) = stage {
            self.stages.note(stage, self.from);
        }
        let from = Instant::now();
        emit(self.probe);
        self.from = match stage {
            Some(_) => Instant::now(),
            None => self.from + from.elapsed(),
        };
    }
}

impl<'e> Probe<DepthEvent<'e>> for Heard<'_> {
    fn on(&self) -> bool {
        Probe::<DepthEvent<'e>>::on(self.probe)
    }

    fn emit(&mut self, event: DepthEvent<'e>) {
        let stage = match event {
            DepthEvent::Prepared { .. } => Some("prepare"),
            DepthEvent::Triangulated { .. } => Some("triangulate"),
            DepthEvent::Reduced { .. } => Some("reduce"),
            DepthEvent::Joined { .. } => Some("join"),
            _ => None,
        };
        self.hear(stage, |probe| probe.emit(event));
    }
}

impl<'e> Probe<ConsolidationEvent<'e>> for Heard<'_> {
    fn on(&self) -> bool {
        Probe::<ConsolidationEvent<'e>>::on(self.probe)
    }

    fn emit(&mut self, event: ConsolidationEvent<'e>) {
        self.hear(None, |probe| probe.emit(event));
    }
}

impl<'e> Probe<UnionEvent<'e>> for Heard<'_> {
    fn on(&self) -> bool {
        Probe::<UnionEvent<'e>>::on(self.probe)
    }

    fn emit(&mut self, event: UnionEvent<'e>) {
        let stage = match event {
            UnionEvent::United { .. } | UnionEvent::Refused { .. } => Some("unite"),
            UnionEvent::Cleaned { .. } => Some("clean"),
            UnionEvent::Corrected { .. } | UnionEvent::NotCorrected { .. } => Some("optimise"),
            UnionEvent::Rebuilt { .. } => Some("rebuild"),
            UnionEvent::Filled { .. } | UnionEvent::Fanned { .. } => Some("tetrahedralize"),
            UnionEvent::Planned { .. } => Some("plan"),
            _ => None,
        };
        self.hear(stage, |probe| probe.emit(event));
    }
}

impl<'e> Probe<PlanEvent<'e>> for Heard<'_> {
    fn on(&self) -> bool {
        Probe::<PlanEvent<'e>>::on(self.probe)
    }

    fn emit(&mut self, event: PlanEvent<'e>) {
        self.hear(None, |probe| probe.emit(event));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_end_with_events_and_the_rest_is_told_apart() {
        let stages = Stages::default();
        let mut off = probe::Off;
        for _ in 0..3 {
            stages.by_events("rest", &mut off, |probe| {
                let why = solid::SolidError::LabelCount { faces: 1, labels: 0 };
                probe.emit(UnionEvent::Fanned { why: &why, fans: 1 });
            });
        }
        let timing = stages.timing();
        assert_eq!(timing.keys().copied().collect::<Vec<_>>(), ["rest", "tetrahedralize"]);
        assert!(timing.values().all(|stage| stage.times == 3 && stage.secs >= 0.0));
    }
}
