//! Searches that end early.

use qmesh::Observer;

/// Why a search for seams ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Interrupted {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// The observer said that time was up.
    #[error("time was up")]
    OutOfTime,
}

/// Tells the observer how far the search is, and asks whether to go on.
pub(super) fn look(observer: &dyn Observer, fraction: f64) -> Result<(), Interrupted> {
    if observer.progress("seams", fraction).is_break() {
        Err(Interrupted::Cancelled)
    } else if observer.is_late() {
        Err(Interrupted::OutOfTime)
    } else {
        Ok(())
    }
}
