//! Jobs on several threads, their results in one.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// How often `tick` is called while no job ends.
const TICK: Duration = Duration::from_millis(200);

/// Does `work` for each of `todo` on so many threads, and hands each result to `done` on this one,
/// in the order in which they come.
///
/// `tick` is called now and then in between. The first error, of either, lets the jobs at hand end
/// and no other begin.
///
/// # Errors
/// The first error.
pub(crate) fn each<I: Sync, T: Send, E: Send>(
    todo: &[I],
    threads: usize,
    work: impl Fn(&I) -> Result<T, E> + Sync,
    mut done: impl FnMut(&I, T) -> Result<(), E>,
    mut tick: impl FnMut(),
) -> Result<(), E> {
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, results) = channel();
    let worker = |sender: std::sync::mpsc::Sender<_>| {
        while !stopped.load(Ordering::Relaxed) {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = todo.get(at) else { break };
            // Nobody receives any more after an error.
            if sender.send((at, work(job))).is_err() {
                break;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, todo.len().max(1)) {
            let sender = sender.clone();
            scope.spawn(|| worker(sender));
        }
        drop(sender);
        loop {
            let result = match results.recv_timeout(TICK) {
                Ok((at, result)) => result.and_then(|result| done(&todo[at], result)),
                Err(RecvTimeoutError::Timeout) => Ok(()),
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            };
            if let Err(error) = result {
                stopped.store(true, Ordering::Relaxed);
                return Err(error);
            }
            tick();
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_job_is_done_once_on_any_number_of_threads() {
        let todo: Vec<u64> = (0..100).collect();
        for threads in [0, 1, 2, 7, 200] {
            let mut all = Vec::new();
            let result = each(
                &todo,
                threads,
                |&job| Ok::<u64, ()>(job * job),
                |&job, square| {
                    all.push((job, square));
                    Ok(())
                },
                || (),
            );
            assert_eq!(result, Ok(()));
            all.sort_unstable();
            assert!(
                all.iter().map(|&(job, square)| (job, square)).eq((0..100).map(|k| (k, k * k)))
            );
        }
        assert_eq!(each(&[] as &[u8], 2, |_| Err::<(), ()>(()), |_, ()| Ok(()), || ()), Ok(()));
    }

    #[test]
    fn an_error_ends_the_sweep() {
        let todo: Vec<u64> = (0..1000).collect();
        let mut count = 0;
        let work = |&job: &u64| if job == 3 { Err("job 3") } else { Ok(()) };
        let count_up = |_: &u64, ()| {
            count += 1;
            Ok(())
        };
        assert_eq!(each(&todo, 2, work, count_up, || ()), Err("job 3"));
        assert!(count < 1000, "{count}");
        let refuse = |_: &u64, ()| Err("no room");
        assert_eq!(each(&todo, 2, |_| Ok::<(), &str>(()), refuse, || ()), Err("no room"));
    }
}
