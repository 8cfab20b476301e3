//! What work costs: by the wall, and by the processor alone, which a busy machine does not change.

use std::ops::Add;
use std::time::Instant;

/// Milliseconds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    pub wall_ms: f64,
    /// Of this thread.
    pub cpu_ms: f64,
}

impl Cost {
    pub fn of<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let (wall, cpu) = (Instant::now(), cpu_ms());
        let done = work();
        (done, Self { wall_ms: wall.elapsed().as_secs_f64() * 1e3, cpu_ms: cpu_ms() - cpu })
    }
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { wall_ms: self.wall_ms + other.wall_ms, cpu_ms: self.cpu_ms + other.cpu_ms }
    }
}

fn cpu_ms() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 * 1e-6
}

/// The value that a share of all do not exceed.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    sorted.get((q * last as f64).round() as usize).copied().unwrap_or(f64::NAN)
}

/// Prints what keyframes cost.
pub fn tell(what: &str, costs: &[Cost]) {
    let wall: Vec<f64> = costs.iter().map(|cost| cost.wall_ms).collect();
    let cpu: Vec<f64> = costs.iter().map(|cost| cost.cpu_ms).collect();
    let tenth = (cpu.len() / 10).max(1);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    println!(
        "{what}, ms per keyframe: processor median {:.2}, p99 {:.2}, most {:.2}; wall median {:.2}, p99 {:.2}, most {:.2}; mean of the first tenth {:.2}, of the last {:.2}",
        quantile(&cpu, 0.5),
        quantile(&cpu, 0.99),
        quantile(&cpu, 1.0),
        quantile(&wall, 0.5),
        quantile(&wall, 0.99),
        quantile(&wall, 1.0),
        mean(&cpu[..tenth.min(cpu.len())]),
        mean(&cpu[cpu.len().saturating_sub(tenth)..]),
    );
}
