//! Which map of a robot is at work, and what it cost.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Which map is at work, and how long each was: shared with the maps themselves.
#[derive(Clone, Debug)]
pub struct AtWork {
    current: Arc<AtomicUsize>,
    nanos: Arc<[AtomicU64]>,
    corrections: Arc<[Mutex<Vec<Duration>>]>,
    looks: Arc<[Mutex<Vec<Duration>>]>,
}

impl AtWork {
    /// So many maps, none of them at work.
    pub(crate) fn new(maps: usize) -> Self {
        Self {
            current: Arc::new(AtomicUsize::new(usize::MAX)),
            nanos: (0..maps).map(|_| AtomicU64::new(0)).collect(),
            corrections: (0..maps).map(|_| Mutex::default()).collect(),
            looks: (0..maps).map(|_| Mutex::default()).collect(),
        }
    }

    /// The index of the map that is at work, if one is.
    pub fn current(&self) -> Option<usize> {
        let index = self.current.load(Ordering::Relaxed);
        (index != usize::MAX).then_some(index)
    }

    /// The time that a map was at work since this was asked last.
    pub(crate) fn take(&self, map: usize) -> Duration {
        Duration::from_nanos(self.nanos[map].swap(0, Ordering::Relaxed))
    }

    /// What each correction of a map has cost since this was asked last: the optimisation, and all
    /// that the map did anew for it.
    pub(crate) fn take_corrections(&self, map: usize) -> Vec<Duration> {
        taken(&self.corrections[map])
    }

    /// What it took a map to take each of its depth images in, since this was asked last.
    pub(crate) fn take_looks(&self, map: usize) -> Vec<Duration> {
        taken(&self.looks[map])
    }

    /// Does the work of a map, and takes the time of it.
    pub(crate) fn timed<T>(&self, map: usize, work: impl FnOnce() -> T) -> T {
        self.current.store(map, Ordering::Relaxed);
        let start = Instant::now();
        let result = work();
        let nanos = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.nanos[map].fetch_add(nanos, Ordering::Relaxed);
        self.current.store(usize::MAX, Ordering::Relaxed);
        result
    }

    /// Notes what a correction of a map has cost.
    pub(crate) fn note_correction(&self, map: usize, spent: Duration) {
        self.corrections[map].lock().unwrap_or_else(PoisonError::into_inner).push(spent);
    }

    /// Notes what it took a map to take in a depth image.
    pub(crate) fn note_look(&self, map: usize, spent: Duration) {
        self.looks[map].lock().unwrap_or_else(PoisonError::into_inner).push(spent);
    }
}

fn taken(all: &Mutex<Vec<Duration>>) -> Vec<Duration> {
    std::mem::take(&mut *all.lock().unwrap_or_else(PoisonError::into_inner))
}
