//! Ctrl-C and its like: work that watches stops by itself, a file that is being written is finished or dropped first.

use std::sync::atomic::{AtomicBool, AtomicU8, AtomicUsize, Ordering::SeqCst};

/// What a signal has to respect right now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Phase {
    /// Nothing that has to be cleaned up, and nobody who looks: the process may end at once.
    Free = 0,
    /// An observer looks at the request; a second signal ends the process.
    Watched = 1,
    /// A temporary file exists: the writer looks at the request before and after, and cleans up.
    Writing = 2,
    /// The process is about to end: no work begins any more.
    Ending = 3,
    /// The files are in place, only the report is missing: the first signal comes too late, a second one ends the process.
    Placed = 4,
}

/// The request to stop, shared between the signal handler and the work.
#[derive(Debug)]
pub struct Interrupt {
    requested: AtomicBool,
    phase: AtomicU8,
    /// How often it may still be looked at before it counts as requested.
    looks: AtomicUsize,
}

/// More looks than there will be.
const NEVER: usize = usize::MAX;

impl Default for Interrupt {
    fn default() -> Self {
        Self::new()
    }
}

impl Interrupt {
    /// No request yet.
    #[must_use]
    pub const fn new() -> Self {
        Self::after_looks(NEVER)
    }

    /// A request that comes by itself once the work has looked `looks` times: for tests of what an interruption leaves behind.
    #[must_use]
    pub const fn after_looks(looks: usize) -> Self {
        Self {
            requested: AtomicBool::new(false),
            phase: AtomicU8::new(Phase::Free as u8),
            looks: AtomicUsize::new(looks),
        }
    }

    /// Asks to stop. `true` says that nothing needs to be waited for: the process has to exit now, and no work begins any more.
    pub fn request(&self) -> bool {
        let again = self.requested.swap(true, SeqCst);
        let impatient = [Phase::Watched as u8, Phase::Placed as u8];
        let may_end = |phase| phase == Phase::Free as u8 || (again && impatient.contains(&phase));
        let ending = |phase| may_end(phase).then_some(Phase::Ending as u8);
        self.phase.fetch_update(SeqCst, SeqCst, ending).is_ok()
    }

    /// Ends the work that is observed but has not looked yet: `true` says that the process may exit now, and that nothing will be
    /// written any more. While a file is being written this is refused.
    pub fn end_what_is_observed(&self) -> bool {
        let (from, to) = (Phase::Watched as u8, Phase::Ending as u8);
        self.phase.compare_exchange(from, to, SeqCst, SeqCst).is_ok()
    }

    /// Whether somebody asked to stop.
    pub fn is_requested(&self) -> bool {
        let count = |left: usize| (left != NEVER).then(|| left.saturating_sub(1));
        if self.looks.fetch_update(SeqCst, SeqCst, count) == Ok(0) {
            self.requested.store(true, SeqCst);
        }
        self.requested.load(SeqCst)
    }

    /// Goes over to `phase` and returns the one before; `None` when the process is about to end.
    fn enter(&self, phase: Phase) -> Option<u8> {
        let unless_ending = |now: u8| (now != Phase::Ending as u8).then_some(phase as u8);
        self.phase.fetch_update(SeqCst, SeqCst, unless_ending).ok()
    }

    /// From here on the command comes to its end, whoever asks to stop: its files are in place. To be called while writing.
    pub(crate) fn placed(&self) {
        let _ = self.enter(Phase::Placed);
    }

    /// Runs `work` in `phase`; what has been placed meanwhile stays so.
    pub(crate) fn during<T>(&self, phase: Phase, work: impl FnOnce() -> T) -> T {
        let before = loop {
            match self.enter(phase) {
                Some(before) => break before,
                None => std::thread::park(),
            }
        };
        let result = work();
        let _ = self.phase.compare_exchange(phase as u8, before, SeqCst, SeqCst);
        result
    }
}

#[cfg(test)]
mod tests {
    use super::{Interrupt, Phase};

    #[test]
    fn the_process_may_end_unless_somebody_looks_after_the_request() {
        assert!(Interrupt::new().request());
        let interrupt = Interrupt::new();
        interrupt.during(Phase::Watched, || {
            assert!(!interrupt.request(), "the observer stops the work");
            assert!(interrupt.request(), "impatient: a second ctrl-C");
        });
        let interrupt = Interrupt::new();
        interrupt.during(Phase::Writing, || {
            assert!(!interrupt.request() && !interrupt.request(), "the temporary file has to go first");
            assert!(!interrupt.end_what_is_observed(), "not even the impatient");
        });
        assert!(interrupt.is_requested());
    }

    /// A file in its place cannot be called back: the command says how it went, unless nobody wants to hear it.
    #[test]
    fn what_is_placed_is_reported() {
        let interrupt = Interrupt::new();
        interrupt.during(Phase::Writing, || {
            interrupt.placed();
            assert!(!interrupt.request(), "too late");
        });
        assert!(!interrupt.end_what_is_observed());
        assert!(interrupt.request(), "impatient");
    }

    /// Once the end of observed work is decided, no file is begun any more.
    #[test]
    fn nothing_begins_once_the_end_is_decided() {
        let interrupt = Interrupt::new();
        assert!(!interrupt.end_what_is_observed(), "nobody is at work");
        interrupt.during(Phase::Watched, || {
            interrupt.during(Phase::Writing, || assert!(!interrupt.end_what_is_observed()));
            assert!(interrupt.end_what_is_observed());
            assert!(!interrupt.end_what_is_observed(), "once is enough");
            assert_eq!(interrupt.enter(Phase::Writing), None);
        });
        assert_eq!(interrupt.enter(Phase::Watched), None);
    }
}
