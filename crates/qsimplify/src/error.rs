//! Why nothing was simplified.

/// Why nothing was simplified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimplifyError {
    /// The threshold is not a number, negative, or a fraction above one.
    #[error("the threshold {0} is out of range: a value must be at least 0, a fraction between 0 and 1")]
    BadThreshold(f64),
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}
