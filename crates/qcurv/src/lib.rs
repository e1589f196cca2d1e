//! How a quad mesh bends, and where to cut it open: Gaussian curvature per vertex (Eqs. 1-4 of the paper), automatic [`seams`].
//!
//! The curvature of a vertex is what its corner angles lack of a full turn ([`integrated_curvature`], Eq. 1),
//! divided by the area that is attributed to it ([`gaussian_curvature`], Eq. 2): the Voronoi cell of the vertex
//! inside its corner triangles ([`voronoi_cell_area`], Eqs. 3 and 4 with the obtuse cases corrected). Everything is
//! computed on the *corner triangles* (previous vertex, corner, next vertex), so no diagonal of a quad is preferred.
//!
//! ```
//! use qcurv::qmesh::{QuadMesh, VertexId};
//! use std::f64::consts::{FRAC_PI_2, TAU};
//!
//! // Three squares around one corner of a cube: three right angles, a quarter turn less than flat.
//! let mesh = QuadMesh::from_slices(
//!     &[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.], [1., 0., 1.]],
//!     [[0, 1, 2, 3], [0, 3, 4, 5], [0, 5, 6, 1]],
//! )?;
//! let curvature = qcurv::integrated_curvature(&mesh);
//! assert!((curvature[VertexId(0)] - FRAC_PI_2).abs() < 1e-12);
//! assert!((curvature.iter().sum::<f64>() - TAU).abs() < 1e-12); // Gauss-Bonnet: the faces are planar
//! # Ok::<(), qcurv::qmesh::BuildError>(())
//! ```
//!
//! [`seams::opening`] finds edges along which to cut a connected mesh so that one planar patch is left: loops for handles, paths from tip
//! to tip for closed surfaces, drawn to edge loops and creases. It takes `O((n + genus) log n)` for `n` edges, whatever the valences,
//! and about 40 bytes an edge beside the mesh; an observer can stop it.
//!
//! Guaranteed of seams: cutting along them leaves one piece of genus 0 with a boundary, of any connected mesh, degenerate ones
//! included; they are the same for any unit of length (a power of two changes no bit) and any number of threads; ties are broken by index.
//! Not guaranteed: that they are the shortest; that would be NP-hard.
//!
//! Guaranteed of curvature: finite values for every mesh that can be built, degenerate faces included (each function says which);
//! the same bits for any number of threads; no cell has negative area; and `Σ_v K̄_v − Σ_f δ_f = 2πχ` up to rounding
//! ([`face_defects`] are the `δ_f` that quads add when they are not planar). Not guaranteed: that the Voronoi cells
//! add up to the surface (they do where quads are rectangles; elsewhere they miss a few percent at most on usual
//! meshes), nor that `K` converges to the curvature of a smooth surface: it does where the quads tend to rectangles;
//! rhombic ones stay skew at any fineness, and `K` is then too large by the faces' share (3.5 % on a cube-sphere).
//! `K̄` and `K` see Gaussian curvature only: along the crease of a developable both are zero.

mod angle;
mod area;
mod gaussian;
pub mod seams;
mod triangle;
mod vertex_area;

pub use angle::{corner_angle, corner_angles, face_defects};
pub use area::{corner_area, face_area, face_areas, surface_area};
pub use gaussian::{gaussian_curvature, integrated_curvature};
pub use qmesh;
pub use triangle::{triangle_area, voronoi_cell_area};
pub use vertex_area::{VertexArea, vertex_areas};

use qmesh::{ElementData, Id};
use rayon::prelude::*;

/// Below this many elements a task is not worth its hand-over to another thread.
const MIN_TASK: usize = 2048;

/// One value per element, computed by index: the result does not depend on the number of threads.
fn par_data<I: Id, T: Send>(count: usize, value: impl Fn(I) -> T + Sync) -> ElementData<I, T> {
    ElementData::from_vec(
        (0..count).into_par_iter().with_min_len(MIN_TASK).map(|i| value(I::from_index(i))).collect(),
    )
}
