//! First maps of a quad mesh to the plane: sections 2.2 and 2.3 of the paper, and the classic baselines.
//!
//! [`embed`] lays the boundary out ([`BoundaryShape`]), lets the kept vertices of a simplified mesh come to rest as a
//! net of springs (Eq. 5), and puts the removed ones back, all at once, by a mixture of angle-preserving and
//! area-preserving weights (Eqs. 6-10, [`Weights`], [`Mixing`]). [`embed_classic`] runs the methods that the paper
//! compares itself with: Tutte's, Floater's mean value, Eck's harmonic, and Lévy's least squares conformal map.
//!
//! ```
//! use qembed::qmesh::shapes;
//! use qembed::qsimplify::{SimplifyOptions, simplify};
//! use qembed::{EmbedOptions, embed};
//!
//! let mesh = shapes::bump(12, 1.0);
//! let simplified = simplify(&mesh, &SimplifyOptions::default(), &())?;
//! let embedding = embed(&mesh, &simplified, &EmbedOptions::default(), &())?;
//! assert!(embedding.uv.iter().all(|p| p.norm() < 1.0 + 1e-12)); // the unit circle
//! assert!(embedding.solves.iter().all(|solve| solve.record.relative_residual < 1e-8));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Guaranteed: only planar patches (disks, with or without holes) are accepted, others are refused with what they are;
//! holes are filled for the time of the embedding, each by a fan around one more vertex, so that their rims end up around
//! convex gaps of no faces; every linear system is solved to a
//! residual below the caller's bound, or refused; weights are finite, whatever the mesh. Rotating, scaling or
//! renumbering the mesh changes no position by more than about 1e-9 of the map (but for [`Mixing::Raw`], which
//! depends on the unit of length, and for symmetric meshes, where the boundary may start at another of several equal
//! vertices). The same input gives the same bits for any number of threads. With a strictly convex boundary, positive weights, nothing
//! or everything removed (rules `None`, `All`), and no two quads that share the same opposite vertices, every corner
//! turns left: that is Tutte's theorem.
//!
//! Not guaranteed: that no face flips otherwise. Kept vertices that removals leave with two springs lie on straight
//! lines, negative weights ([`Embedding::negative_weights`]) and non-convex boundaries can fold the map, and quads that share two edges
//! have corners without area. `qoptimize` measures and mends that. Nor is distortion low: these maps are linear.

// In reading order.
mod embed;
mod embedding;
mod options;

mod disk;

mod boundary;

mod global;

mod local;

mod weights;

mod classic;

mod dirichlet;
mod error;
mod frame;

pub use boundary::place_boundary;
pub use classic::{Classic, embed_classic};
pub use disk::check_patch;
pub use embed::embed;
pub use embedding::{Embedding, StageSolve};
pub use error::EmbedError;
pub use options::{BoundaryShape, EmbedOptions, Mixing, Weights};
pub use qsolve::{self, qcurv, qmesh, qsimplify};
