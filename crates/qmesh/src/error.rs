//! Why polygons are no mesh: each refusal names the elements, counted from 0 as in the caller's arrays.

use thiserror::Error;

/// Why [`QuadMesh::build`](crate::QuadMesh::build) refuses polygons. Indices are the caller's, from 0.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// There is no face at all.
    #[error("there are no faces: a mesh needs at least one")]
    NoFaces,
    /// More elements than `u32` ids can count.
    #[error("too large: {count} {what}, at most {limit} are possible", limit = u32::MAX / 2)]
    TooLarge {
        /// What there are too many of.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// The flat arrays contradict each other.
    #[error(
        "face_start must begin with 0, never fall, and end with the number of corners; entry {entry} does not fit"
    )]
    BadFaceStart {
        /// The offending entry of `face_start`.
        entry: usize,
    },
    /// A face with fewer than three corners.
    #[error("face {face} has {corners} corners: a face needs at least three")]
    TooFewCorners {
        /// The face.
        face: u32,
        /// How many corners it has.
        corners: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are only {count} vertices")]
    IndexOutOfRange {
        /// The face.
        face: u32,
        /// The vertex it names.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// A face visits a vertex twice.
    #[error("face {face} visits vertex {vertex} more than once")]
    RepeatedVertex {
        /// The face.
        face: u32,
        /// The vertex.
        vertex: u32,
    },
    /// A position that is not a number, infinite, or beyond [`COORDINATE_LIMIT`](crate::COORDINATE_LIMIT).
    #[error("vertex {vertex} has a coordinate that is not finite, or larger than {limit:e}", limit = crate::COORDINATE_LIMIT)]
    NonFiniteCoordinate {
        /// The vertex.
        vertex: u32,
    },
    /// More than two faces share an edge.
    #[error("edge {}-{} is not manifold: {} faces share it ({})", vertices[0], vertices[1], faces.len(), list(faces))]
    NonManifoldEdge {
        /// The ends of the edge.
        vertices: [u32; 2],
        /// The faces that share it, in ascending order.
        faces: Vec<u32>,
    },
    /// Two faces have the same vertices in the same order.
    #[error("faces {} and {} are the same: remove one of them", faces[0], faces[1])]
    DuplicateFaces {
        /// The two faces.
        faces: [u32; 2],
    },
    /// Two neighbouring faces run along their edge in the same direction.
    #[error("faces {} and {} run the same way along edge {}-{}: one of them is turned over, or the surface has one side only", faces[0], faces[1], vertices[0], vertices[1])]
    InconsistentOrientation {
        /// The edge, in the direction of both faces.
        vertices: [u32; 2],
        /// The two faces.
        faces: [u32; 2],
    },
    /// The faces at a vertex form several fans that meet in that vertex alone.
    #[error("vertex {vertex} is not manifold: its faces form separate fans that touch only there (faces {} and {})", faces[0], faces[1])]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
        /// One face of each of two fans.
        faces: [u32; 2],
    },
}

fn list(faces: &[u32]) -> String {
    const SHOWN: usize = 6;
    let mut text = faces.iter().take(SHOWN).map(ToString::to_string).collect::<Vec<_>>().join(", ");
    if faces.len() > SHOWN {
        text.push_str(", …");
    }
    text
}
