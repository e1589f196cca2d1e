//! Corner angles, and what those of a face lack.

use std::f64::consts::PI;

use qmesh::{CornerData, CornerId, FaceData, QuadMesh};

use crate::par_data;
use crate::triangle::angle_between;

/// The angle in space at `corner` between the edges to the next and to the previous vertex, in `[0, π]`.
///
/// An inner angle beyond `π` (a reflex corner) counts as `2π` minus itself: in space there is no telling the two
/// apart. When one of the edges has no length the angle is 0.
#[must_use]
pub fn corner_angle(mesh: &QuadMesh, corner: CornerId) -> f64 {
    let [next, previous] = mesh.corner_vectors(corner);
    angle_between(next, previous)
}

/// All corner angles.
#[must_use]
pub fn corner_angles(mesh: &QuadMesh) -> CornerData<f64> {
    par_data(mesh.corner_count(), |corner| corner_angle(mesh, corner))
}

/// What the corner angles of each face lack of `(n − 2)π`, in radians: 0 for a planar convex face, positive for a
/// skew quad. It is curvature that sits inside the face, and what Gauss-Bonnet misses without it.
#[must_use]
pub fn face_defects(mesh: &QuadMesh) -> FaceData<f64> {
    par_data(mesh.face_count(), |face| {
        let flat = (mesh.degree(face) as f64 - 2.0) * PI;
        flat - mesh.face_corners(face).map(|corner| corner_angle(mesh, corner)).sum::<f64>()
    })
}
