//! What a piece of work takes.

use std::sync::OnceLock;
use std::time::Instant;

/// Seconds of this thread on a processor, which a busy machine does not stretch; of the clock where
/// the system does not tell.
pub fn now() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanos = told.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    nanos.map_or_else(
        || START.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |nanos| nanos * 1e-9,
    )
}

/// What the work gives, and what it took: seconds of this thread on a processor.
pub fn secs<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = now();
    let done = work();
    (done, now() - start)
}
