//! Why there is no map.

use crate::qmesh::VertexId;

/// Why there is no map. Vertices are those of the mesh; [`QuadMesh::source_vertex`](crate::qmesh::QuadMesh::source_vertex)
/// leads to the caller's.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EmbedError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A linear system had no acceptable answer.
    #[error(transparent)]
    Solve(#[from] qsolve::SolveError),
    /// The mesh has no boundary that could be laid out in the plane.
    #[error("the mesh is closed (genus {genus}): cut it open along seams first")]
    Closed {
        /// Handles of the surface.
        genus: i64,
    },
    /// The mesh has several pieces.
    #[error(
        "the mesh has {components} components, for instance those of vertices {} and {}: map each for itself",
        vertices[0], vertices[1]
    )]
    SeveralComponents {
        /// How many pieces.
        components: usize,
        /// A vertex of each of the first two.
        vertices: [VertexId; 2],
    },
    /// The mesh has a boundary, but also handles.
    #[error("the mesh has a boundary, but also {genus} handle(s): cut each open first")]
    Handles {
        /// How many handles.
        genus: i64,
    },
    /// `q` of Eq. 10 is no share.
    #[error("q = {0} is out of range: it must be between 0 (authalic) and 1 (conformal)")]
    BadMix(f64),
    /// `r` of Eq. 5 is negative or not finite.
    #[error("the exponent {0} is out of range: it must be a number of at least 0")]
    BadExponent(f64),
    /// The simplified mesh was not made from this mesh.
    #[error("the simplified mesh belongs to another mesh: {0}")]
    OtherMesh(&'static str),
    /// A fixed position was given for a vertex that is not on the boundary.
    #[error(
        "a position was given for vertex {vertex}, which does not lie on the boundary: only boundary vertices can be fixed"
    )]
    FixedInside {
        /// The vertex.
        vertex: VertexId,
    },
    /// Two fixed positions were given for one vertex.
    #[error("two positions were given for boundary vertex {vertex}")]
    FixedTwice {
        /// The vertex.
        vertex: VertexId,
    },
    /// A free boundary was asked of a method that needs positions for it.
    #[error("this method needs positions for the boundary: it cannot be free")]
    NoFreeBoundary,
    /// A boundary vertex has no fixed position.
    #[error("no position was given for boundary vertex {vertex}: all {count} boundary vertices need one")]
    FixedMissing {
        /// The first vertex without a position, along the boundary.
        vertex: VertexId,
        /// How many boundary vertices there are.
        count: usize,
    },
    /// A fixed position is not finite, or larger than coordinates may be.
    #[error("the position given for boundary vertex {vertex} is not finite or beyond 1e60")]
    FixedNotFinite {
        /// The vertex.
        vertex: VertexId,
    },
    /// The boundary has too few vertices for its shape.
    #[error("the boundary has {found} vertices, this shape needs {needed}")]
    BoundaryTooShort {
        /// Vertices of the boundary.
        found: usize,
        /// Vertices needed.
        needed: usize,
    },
    /// More boundary vertices have a single face than a square has corners; on a side such a face would lose its area.
    #[error(
        "the square has four corners, but {count} boundary vertices (among them {vertex}) have a single face, which would collapse on a side: use the circle"
    )]
    TooManyCorners {
        /// One of them.
        vertex: VertexId,
        /// How many there are.
        count: usize,
    },
    /// An edge joins two vertices of one side of the square, so that everything behind it would lose its area.
    #[error(
        "the edge {}-{} would lie along a side of the square, with faces between: use the circle",
        edge[0], edge[1]
    )]
    ChordOnSide {
        /// The ends of the edge.
        edge: [VertexId; 2],
    },
    /// The boundary encloses no area in any plane.
    #[error("the boundary has no best-fit plane, since it encloses no area: use the circle")]
    NoPlane,
    /// The boundary crosses or touches itself in its best-fit plane.
    #[error(
        "projected to its best-fit plane, the boundary meets itself at edges {}-{} and {}-{}: use the circle",
        edges[0][0], edges[0][1], edges[1][0], edges[1][1]
    )]
    BoundaryFolds {
        /// The two edges, each as its two vertices.
        edges: [[VertexId; 2]; 2],
    },
    /// All boundary vertices are in one place, so nothing can be pinned.
    #[error("all boundary vertices are in one place, so LSCM has nothing to pin")]
    NothingToPin,
}
