//! Good UV maps of quad meshes: overlap removal, every measure of distortion, and the whole way in one call.
//!
//! [`parameterize()`] maps a disk to the plane by minimising angle and area errors over maps without flips ([`direct`], the
//! default), by the stages of "A Parameterization Approach for Quadrilateral Mesh", whose section 2.4 ([`overlap`]) lives
//! here, or by a classic method to compare with. [`measure()`] tells how good any UVs are, whoever made them.
//!
//! ```
//! use qoptimize::{Options, parameterize, qmesh::shapes};
//!
//! let mesh = shapes::cap(6, 1.2);
//! let map = parameterize(&mesh, &Options { q: 1.0, ..Options::default() }, &())?;
//! assert_eq!(map.uv.len(), mesh.corner_count());
//! assert!(map.certificate.holds);
//! println!("angles {:.1}, areas {:.1}", map.distortion.angle_error, map.distortion.area_error);
//! # Ok::<(), qoptimize::ParameterizeError>(())
//! ```
//!
//! # Guarantees
//! - A map comes with its measures and a verdict: a [`Certificate`] that holds is a proof, on the map's exact coordinates, that
//!   nothing overlaps ([`certificate`]).
//! - Same input, same bytes, for any number of threads; a caller's rayon pool is used.
//! - No input panics; every measure is finite or `None`.
//! - Scaling the mesh changes no normalised UV beyond rounding, except with raw mixing.
//!
//! # Limits
//! - [`parameterize()`] maps planar patches: one component, no handles, a boundary, perhaps holes. Others are refused by name;
//!   [`atlas::unwrap`] takes any polygons.
//! - Overlap removal may leave overlaps, above all on boundaries that are not convex; the report counts them.
//!
//! # Modules, in reading order
//! [`parameterize`](mod@parameterize) (the whole way) → [`overlap`] (Eqs. 11 and 12) → [`direct`] → [`distortion`] (Eqs. 13 and 14, and
//! the field's measures) → [`certificate`] (the proof) → [`rounding`] (single precision) → [`atlas`] (any polygons) → [`pack`].

pub mod atlas;
pub mod certificate;
mod convexity;
pub mod direct;
pub mod distortion;
mod error;
mod lanes;
pub mod overlap;
pub mod pack;
pub mod parameterize;
mod plane;
mod preset;
pub mod rounding;
pub mod symmetry;
mod timely;
pub mod worst;

pub use atlas::{Atlas, AtlasError, AtlasOptions, Density, Island, UpAxis};
pub use certificate::{Certificate, Violation, ViolationKind, certify, judge};
pub use convexity::Exempt;
pub use direct::{
    AngleTerm, BoundaryRepair, Continuation, Descent, DirectOptions, DirectReport, ScaffoldEnd, StartMethod,
    Stop, SymmetryReport,
};
pub use distortion::{
    Benchmark, Distortion, FaceMeasure, FaceMeasures, MeasureError, measure, measure_faces,
    measure_worst_faces,
};
pub use error::ParameterizeError;
pub use overlap::{MoveOrder, OverlapOptions, OverlapReport, remove_overlaps};
pub use parameterize::{Method, Options, Parameterization, RunRecord, parameterize, parameterize_from};
pub use preset::Preset;
pub use qembed::{self, qcurv, qmesh, qsimplify, qsolve};
pub use rounding::{Rounding, round_to_single};
pub use symmetry::{Mirror, SymmetryError};
pub use worst::{Cause, Circumstances, WorstFace, worst_faces};
