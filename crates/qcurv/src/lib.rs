//! How a quad mesh bends: Gaussian curvature per vertex (Eqs. 1-4 of the paper).
//!
//! TODO-docs: purpose, compiled example, guarantees and limits.

pub use qmesh;
use qmesh::{CornerData, CornerId, FaceData, QuadMesh, VertexData};

/// Which area is attributed to a vertex (Eq. 2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VertexArea {
    /// The Voronoi cell of the vertex inside its corner triangles (Eqs. 3 and 4, corrected).
    #[default]
    Voronoi,
    /// The plain sum of the adjacent faces' areas, as the text under Eq. 2 says.
    FaceSum,
}

/// The angle in space at `corner`, in `[0, π]`.
#[must_use]
pub fn corner_angle(_mesh: &QuadMesh, _corner: CornerId) -> f64 {
    unimplemented!()
}
/// The area of the corner triangle (previous, here, next).
#[must_use]
pub fn corner_area(_mesh: &QuadMesh, _corner: CornerId) -> f64 {
    unimplemented!()
}
/// All corner angles.
#[must_use]
pub fn corner_angles(_mesh: &QuadMesh) -> CornerData<f64> {
    unimplemented!()
}
/// All corner areas.
#[must_use]
pub fn corner_areas(_mesh: &QuadMesh) -> CornerData<f64> {
    unimplemented!()
}
/// Area of the surface; a quad counts the mean of its two diagonal splits.
#[must_use]
pub fn surface_area(_mesh: &QuadMesh) -> f64 {
    unimplemented!()
}
/// S of Eq. 2.
#[must_use]
pub fn vertex_areas(_mesh: &QuadMesh, _area: VertexArea) -> VertexData<f64> {
    unimplemented!()
}
/// K̄ of Eq. 1; at the boundary π − Σθ.
#[must_use]
pub fn integrated_curvature(_mesh: &QuadMesh) -> VertexData<f64> {
    unimplemented!()
}
/// K of Eq. 2.
#[must_use]
pub fn gaussian_curvature(_mesh: &QuadMesh, _area: VertexArea) -> VertexData<f64> {
    unimplemented!()
}
/// What the corner angles of each face lack of (n − 2)π.
#[must_use]
pub fn face_defects(_mesh: &QuadMesh) -> FaceData<f64> {
    unimplemented!()
}
