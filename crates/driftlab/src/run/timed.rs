//! Stopwatches around what is not the algorithm: the simulator and the recording.

use std::time::{Duration, Instant};

use probe::{Probe, VertexId};
use sensing::{Odometry, PlaceMatch, Repeated, Robot, Scan};

use super::AtWork;

/// A robot whose own time is taken.
pub(super) struct TimedRobot<'a> {
    robot: &'a mut dyn Robot,
    pub(super) spent: Duration,
}

impl<'a> TimedRobot<'a> {
    pub(super) fn new(robot: &'a mut dyn Robot) -> Self {
        Self { robot, spent: Duration::ZERO }
    }

    fn timed<T>(&mut self, work: impl FnOnce(&mut dyn Robot) -> T) -> T {
        let start = Instant::now();
        let result = work(self.robot);
        self.spent += start.elapsed();
        result
    }
}

impl Robot for TimedRobot<'_> {
    fn turn(&mut self, angle_rad: f64) -> Odometry {
        self.timed(|robot| robot.turn(angle_rad))
    }

    fn forward(&mut self, distance_m: f64) -> Odometry {
        self.timed(|robot| robot.forward(distance_m))
    }

    fn repeat(&mut self, to: VertexId, length_m: f64) -> Repeated {
        self.timed(|robot| robot.repeat(to, length_m))
    }

    fn scan(&mut self) -> Scan {
        self.timed(|robot| robot.scan())
    }

    fn mark(&mut self, vertex: VertexId) {
        self.timed(|robot| robot.mark(vertex));
    }

    fn recognize(&mut self) -> Vec<PlaceMatch> {
        self.timed(|robot| robot.recognize())
    }
}

/// A listener whose own time is taken; one that is off takes none.
pub(crate) struct TimedProbe<'a, P: ?Sized> {
    probe: &'a mut P,
    at_work: &'a AtWork,
    pub(crate) spent: Duration,
    /// The part of it that each map gave cause to.
    pub(crate) spent_on: Vec<Duration>,
}

impl<'a, P: ?Sized> TimedProbe<'a, P> {
    pub(crate) fn new(probe: &'a mut P, at_work: &'a AtWork, maps: usize) -> Self {
        Self { probe, at_work, spent: Duration::ZERO, spent_on: vec![Duration::ZERO; maps] }
    }
}

impl<E, P: Probe<E> + ?Sized> Probe<E> for TimedProbe<'_, P> {
    fn on(&self) -> bool {
        self.probe.on()
    }

    fn emit(&mut self, event: E) {
        if self.probe.on() {
            let start = Instant::now();
            self.probe.emit(event);
            let spent = start.elapsed();
            self.spent += spent;
            if let Some(map) = self.at_work.current()
                && let Some(of_map) = self.spent_on.get_mut(map)
            {
                *of_map += spent;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_that_is_off_is_not_called_and_takes_no_time() {
        struct Deaf;
        impl Probe<u8> for Deaf {
            fn on(&self) -> bool {
                false
            }
            fn emit(&mut self, _event: u8) {
                panic!("called though off");
            }
        }
        let mut deaf = Deaf;
        let at_work = AtWork::new(1);
        let mut timed = TimedProbe::new(&mut deaf, &at_work, 1);
        timed.emit(1);
        assert_eq!(timed.spent, Duration::ZERO);
        let mut heard: Vec<u8> = Vec::new();
        TimedProbe::new(&mut heard, &at_work, 1).emit(3);
        assert_eq!(heard, [3]);
    }
}
