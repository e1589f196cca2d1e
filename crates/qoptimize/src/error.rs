//! Why there is no map.

use qembed::qmesh::{CornerId, VertexId};
use qembed::{EmbedError, qsimplify::SimplifyError};

use crate::certificate::Certificate;
use crate::direct::{DescentError, StartError};
use crate::distortion::MeasureError;
use crate::symmetry::SymmetryError;

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterizeError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// The observer said that time was up before there was a map.
    #[error("time was up before there was a map")]
    OutOfTime,
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
    /// The weight of the symmetric Dirichlet term is negative or not a finite number.
    #[error("shape is {0}, but must be a finite number of at least 0")]
    BadShape(f64),
    /// A tolerance of the descent is negative or not a number.
    #[error("the relative decrease at which the descent stops is {0}, but must be a number of at least 0")]
    BadTolerance(f64),
    /// Something was asked of a method that cannot heed it.
    #[error("{0} are for the methods direct and conformal only")]
    OtherMethod(&'static str),
    /// Two edges of a boundary that is to be held meet.
    #[error("the boundary meets itself at the edges {} - {} and {} - {}", edges[0][0], edges[0][1], edges[1][0], edges[1][1])]
    BoundaryMeets {
        /// The edges.
        edges: [[VertexId; 2]; 2],
    },
    /// A boundary that is to be held encloses its area clockwise, or none.
    #[error("the boundary runs clockwise or encloses no area, but has to run counter-clockwise")]
    BoundaryClockwise,
    /// A face corner between three vertices of a held boundary does not turn left there.
    #[error(
        "{corner} lies between three vertices of the boundary, which do not turn left where they are held"
    )]
    FlatCorner {
        /// The corner.
        corner: CornerId,
    },
    /// A pin names no vertex, or its place is not finite.
    #[error("the pin of {vertex} is no place for a vertex of the mesh")]
    BadPin {
        /// The vertex.
        vertex: VertexId,
    },
    /// Two pins for one vertex.
    #[error("{vertex} is pinned twice")]
    PinTwice {
        /// The vertex.
        vertex: VertexId,
    },
    /// Two vertices are pinned to the same place.
    #[error("{} and {} are pinned to the same place", vertices[0], vertices[1])]
    PinsMeet {
        /// The vertices.
        vertices: [VertexId; 2],
    },
    /// A pin on a boundary that is held elsewhere.
    #[error("{vertex} is pinned, but lies on the boundary, which is held already")]
    PinOnHeldBoundary {
        /// The vertex.
        vertex: VertexId,
    },
    /// A symmetric map was asked for together with pins or a held boundary.
    #[error("symmetric maps have a free boundary and no pins")]
    SymmetricAndHeld,
    /// The mesh has no mirror symmetry.
    #[error(transparent)]
    Symmetry(SymmetryError),
    /// A pin cannot be brought to its place without a flip.
    #[error("the pin of {vertex} stays {distance} short of its place: on the way there a corner would flip")]
    PinOutOfReach {
        /// The vertex.
        vertex: VertexId,
        /// How far it stays from its place.
        distance: f64,
    },
    /// No first map without flipped corners was found.
    #[error(transparent)]
    Start(StartError),
    /// The descent failed.
    #[error(transparent)]
    Descent(#[from] DescentError),
    /// Simplification failed.
    #[error(transparent)]
    Simplify(SimplifyError),
    /// The mesh is no disk, an option of the embedding is out of range, or embedding failed.
    #[error(transparent)]
    Embed(EmbedError),
    /// The map is proven free of overlaps, but not after rounding to single precision, and could not be mended; the certificate of
    /// the rounded map names the places.
    #[error("in single precision the map would overlap itself: its certificate {0}")]
    Rounding(Box<Certificate>),
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

impl From<StartError> for ParameterizeError {
    fn from(error: StartError) -> Self {
        if error == StartError::Cancelled { Self::Cancelled } else { Self::Start(error) }
    }
}
