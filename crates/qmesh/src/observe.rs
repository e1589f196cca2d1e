//! Watching long work, and stopping it.
//!
//! Libraries of this workspace never print. They tell an [`Observer`] how far they are, and stop when it
//! says so. `&()` observes nothing and never stops; a closure `Fn(&str, f64) -> ControlFlow<()>` is an observer too.

use std::ops::ControlFlow;

/// Somebody who watches long work.
pub trait Observer: Sync {
    /// `fraction` (0 to 1) of `stage` is done. `Break` asks to stop: the work ends with a `Cancelled` error
    /// at the next safe place.
    fn progress(&self, stage: &'static str, fraction: f64) -> ControlFlow<()>;

    /// Whether time is up. Work that has a result at hand then ends with that result, and work that has none yet fails; what
    /// makes a result fit for use (layout, measures, certificates) is still done. Asked as often as `progress` is called.
    fn is_late(&self) -> bool {
        false
    }
}

impl Observer for () {
    fn progress(&self, _: &'static str, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: Fn(&'static str, f64) -> ControlFlow<()> + Sync> Observer for F {
    fn progress(&self, stage: &'static str, fraction: f64) -> ControlFlow<()> {
        self(stage, fraction)
    }
}
