//! When time is up before the work is done.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use qembed::qmesh::Observer;

use crate::error::ParameterizeError;

/// Stops the way to a map when time is up, as the wish to cancel does: a descent ends with what it has, all else ends without.
struct Timely<'a> {
    observer: &'a dyn Observer,
    has_stopped: AtomicBool,
}

impl Observer for Timely<'_> {
    fn progress(&self, stage: &'static str, fraction: f64) -> ControlFlow<()> {
        self.observer.progress(stage, fraction)?;
        if !self.is_late() {
            return ControlFlow::Continue(());
        }
        self.has_stopped.store(true, Relaxed);
        ControlFlow::Break(())
    }

    fn is_late(&self) -> bool {
        self.observer.is_late()
    }
}

/// Does `work` with an observer that stops it when time is up, too.
pub(crate) fn within<T>(
    observer: &dyn Observer,
    work: impl FnOnce(&dyn Observer) -> Result<T, ParameterizeError>,
) -> Result<T, ParameterizeError> {
    if observer.is_late() {
        return Err(ParameterizeError::OutOfTime);
    }
    let timely = Timely { observer, has_stopped: AtomicBool::new(false) };
    match work(&timely) {
        Err(ParameterizeError::Cancelled) if timely.has_stopped.into_inner() => {
            Err(ParameterizeError::OutOfTime)
        }
        other => other,
    }
}
