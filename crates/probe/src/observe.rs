//! The probe: one trait, and the probe that is not there.

/// Receives the events of a running algorithm; it cannot stop or steer it.
pub trait Probe<E> {
    /// Whether anybody listens: asked before an event that is costly to build.
    fn on(&self) -> bool {
        true
    }

    /// Takes one event. Events are facts in the past tense.
    fn emit(&mut self, event: E);
}

/// The probe of a run that nobody watches; calls to it compile to nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Off;

impl<E> Probe<E> for Off {
    #[inline(always)]
    fn on(&self) -> bool {
        false
    }

    #[inline(always)]
    fn emit(&mut self, _event: E) {}
}

/// Collects owned copies, so that a test can look at what happened.
impl<E, T: From<E>> Probe<E> for Vec<T> {
    fn emit(&mut self, event: E) {
        self.push(T::from(event));
    }
}
