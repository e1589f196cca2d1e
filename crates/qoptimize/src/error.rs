//! Why there is no map.

use qembed::qmesh::{Topology, VertexId};
use qembed::{EmbedError, qsimplify::SimplifyError};

use crate::distortion::MeasureError;

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterizeError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// The mesh has no boundary.
    #[error(
        "the mesh is closed (genus {genus}): it has no boundary to spread out, so it must be cut open along seams first"
    )]
    Closed {
        /// Handles.
        genus: i64,
    },
    /// The mesh falls apart.
    #[error("the mesh has {0} components: map each of them on its own")]
    SeveralComponents(usize),
    /// The mesh has holes.
    #[error("the mesh has {0} boundary loops, but a disk has one: fill the holes, or cut the loops together")]
    SeveralLoops(usize),
    /// One boundary loop, but handles as well.
    #[error("the mesh has one boundary loop, but genus {genus}: its handles must be cut open first")]
    Handles {
        /// Handles.
        genus: i64,
    },
    /// `q` is outside [0, 1], or not a number.
    #[error("q is {0}, but must lie between 0 (area-true) and 1 (angle-true)")]
    BadQ(f64),
    /// `r` of Eq. 5 is not a finite number.
    #[error("the exponent r of Eq. 5 is {0}, but must be a finite number")]
    BadExponent(f64),
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
    /// Embedding failed.
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

impl ParameterizeError {
    /// What keeps a mesh from being a disk; `None` for a disk.
    pub(crate) fn of_topology(topology: Topology) -> Option<Self> {
        match topology {
            _ if topology.is_disk() => None,
            t if t.components != 1 => Some(Self::SeveralComponents(t.components)),
            t if t.boundary_loops == 0 => Some(Self::Closed { genus: t.genus }),
            t if t.boundary_loops > 1 => Some(Self::SeveralLoops(t.boundary_loops)),
            t => Some(Self::Handles { genus: t.genus }),
        }
    }
}
