//! Quad meshes: halfedge connectivity, topology, lossless OBJ text, and meshes from formulas.
//!
//! ```
//! use qmesh::QuadMesh;
//!
//! let mesh = QuadMesh::from_slices(
//!     &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5], [2.0, 1.0, 0.0]],
//!     [[0, 1, 4, 3], [1, 2, 5, 4]],
//! )?;
//! assert!(mesh.topology().is_disk());
//! # Ok::<(), qmesh::BuildError>(())
//! ```
//!
//! Guaranteed: a [`QuadMesh`] is an oriented manifold whose faces and vertices keep the order of the input; faces
//! of any degree from three are kept as they are. Not guaranteed: anything about shape; faces may be non-planar,
//! concave or of no area.

mod build;
mod data;
mod error;
mod ids;
mod mesh;
pub mod obj;
pub mod observe;
mod polygons;
pub mod shapes;
mod topology;

pub use data::{CornerData, EdgeData, ElementData, FaceData, HalfedgeData, VertexData};
pub use error::BuildError;
pub use ids::{CornerId, EdgeId, FaceId, HalfedgeId, Id, VertexId};
pub use mesh::QuadMesh;
pub use nalgebra;
pub use observe::Observer;
pub use polygons::{PolygonView, Polygons};
pub use topology::{FaceCounts, Topology};

/// A position or direction in space.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A position or direction in the parameter plane.
pub type Vec2 = nalgebra::Vector2<f64>;

/// The largest coordinate that is accepted. Beyond it, areas and their squares would leave the range of `f64`.
pub const COORDINATE_LIMIT: f64 = 1e60;
