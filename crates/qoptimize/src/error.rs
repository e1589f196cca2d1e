//! Why there is no map.

use qembed::qmesh::VertexId;
use qembed::{EmbedError, qsimplify::SimplifyError};

use crate::distortion::MeasureError;

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterizeError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// λ1, λ2 of Eq. 11 out of range.
    #[error("λ1 = {lambda1} and λ2 = {lambda2}, but neither may be negative and 0 < λ1 + λ2 < 1 is needed")]
    BadLambda {
        /// λ1.
        lambda1: f64,
        /// λ2.
        lambda2: f64,
    },
    /// The bound on the moves of overlap removal is negative or not a number.
    #[error("at most {0} moves per vertex are allowed, but this must be a number of at least 0")]
    BadMoveLimit(f64),
    /// Not one UV per vertex.
    #[error("there are {found} UVs for {expected} vertices: one per vertex is needed")]
    UvCount {
        /// Vertices of the mesh.
        expected: usize,
        /// UVs given.
        found: usize,
    },
    /// A UV is not finite.
    #[error("vertex {vertex} has a UV that is not finite")]
    NonFiniteUv {
        /// The vertex.
        vertex: VertexId,
    },
    /// Simplification failed.
    #[error(transparent)]
    Simplify(SimplifyError),
    /// The mesh is no disk, an option of the embedding is out of range, or embedding failed.
    #[error(transparent)]
    Embed(EmbedError),
    /// Measuring failed.
    #[error(transparent)]
    Measure(#[from] MeasureError),
}

impl From<SimplifyError> for ParameterizeError {
    fn from(error: SimplifyError) -> Self {
        if error == SimplifyError::Cancelled { Self::Cancelled } else { Self::Simplify(error) }
    }
}

impl From<EmbedError> for ParameterizeError {
    fn from(error: EmbedError) -> Self {
        if error == EmbedError::Cancelled { Self::Cancelled } else { Self::Embed(error) }
    }
}
