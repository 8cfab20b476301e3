//! Wall time, and the time that a thread was given to compute.

use std::time::Instant;

/// Time that something took.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spent {
    /// Seconds on the wall.
    pub secs: f64,
    /// Seconds on the processor, of the thread that asks: what other work on the machine makes no
    /// longer. `None` where the system does not tell.
    pub cpu_secs: Option<f64>,
}

impl Spent {
    /// What is left without a part of it.
    pub(crate) fn less(self, part: Self) -> Self {
        let left = |whole: f64, part: f64| (whole - part).max(0.0);
        let cpu_secs = self.cpu_secs.zip(part.cpu_secs).map(|(whole, part)| left(whole, part));
        Self { secs: left(self.secs, part.secs), cpu_secs }
    }
}

/// Started when it is made.
pub(crate) struct Stopwatch {
    began: Instant,
    cpu_began: Option<f64>,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        // In this order, so that asking for the one does not count for the other.
        let cpu_began = cpu_secs();
        Self { cpu_began, began: Instant::now() }
    }

    /// Time since the start.
    pub(crate) fn spent(&self) -> Spent {
        let secs = self.began.elapsed().as_secs_f64();
        let cpu_secs = cpu_secs().zip(self.cpu_began).map(|(now, began)| now - began);
        Spent { secs, cpu_secs }
    }
}

/// Seconds that this thread has computed for, by Linux.
fn cpu_secs() -> Option<f64> {
    // The count is brought up to date where the scheduler is entered.
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanos: f64 = text.split(' ').next()?.parse().ok()?;
    Some(nanos * 1e-9)
}
