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
//! Files come and go through [`obj`], which changes nothing but UVs; [`shapes`] makes meshes to try things on.
//!
//! Guaranteed: a [`QuadMesh`] is an oriented manifold whose faces and vertices keep the order of the input; faces
//! of any degree from three are kept as they are; polygons that are no such thing are refused with the elements
//! that say so ([`BuildError`]). No input panics, and building takes `O(n)` for meshes with bounded valence,
//! `O(n^1.5)` for any.
//!
//! Not guaranteed: anything about shape; faces may be non-planar, concave or of no area. Nothing is repaired
//! on the way: a vertex where two fans touch, an edge with three faces, or a face that is turned over is for [`charts`],
//! which makes meshes of any polygons.
//! Ids are `u32`: a mesh has fewer than 2³¹ corners.
//!
//! To read the code, begin with `ids`, `data` and `polygons`; `mesh` holds the arrays, `build` fills them, `walk` and
//! `topology` ask them; [`obj`] and [`shapes`] stand beside that.
//!
//! With the feature `serde`, meshes, polygons, per-element data, options and reports can be serialised.

mod build;
pub mod charts;
mod components;
mod data;
mod error;
mod holes;
mod ids;
mod mesh;
pub mod obj;
pub mod observe;
mod polygons;
mod seams;
#[cfg(feature = "serde")]
mod serial;
pub mod shapes;
mod topology;
mod walk;

pub use charts::{Chart, Charts, Found, Repairs};
pub use components::Components;
pub use data::{CornerData, EdgeData, ElementData, FaceData, HalfedgeData, VertexData};
pub use error::BuildError;
pub use ids::{CornerId, EdgeId, FaceId, HalfedgeId, Id, VertexId};
pub use mesh::QuadMesh;
pub use nalgebra;
pub use observe::Observer;
pub use polygons::{PolygonView, Polygons};
pub use seams::Seams;
pub use topology::{FaceCounts, Topology};

/// A position or direction in space.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A position or direction in the parameter plane.
pub type Vec2 = nalgebra::Vector2<f64>;

/// The largest coordinate that is accepted. Beyond it, areas and their squares would leave the range of `f64`.
pub const COORDINATE_LIMIT: f64 = 1e60;

/// Compiles the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
