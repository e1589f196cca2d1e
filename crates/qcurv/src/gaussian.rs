//! Gaussian curvature as angle defect.
//!
//! We depart from the paper in that quads need not be planar: what the corner angles of a face lack of `2π` is
//! curvature too, and belongs to the face ([`face_defects`](crate::face_defects)).

use std::f64::consts::{PI, TAU};

use qmesh::{QuadMesh, VertexData};

use crate::angle::corner_angle;
use crate::par_data;
use crate::vertex_area::{VertexArea, vertex_areas};

/// `K̄` of Eq. 1, in radians: `2π − Σθ` inside; at the boundary the turning angle `π − Σθ`.
///
/// 0 where the surface is flat, positive on domes, negative on saddles. Independent of the unit of length.
#[must_use]
pub fn integrated_curvature(mesh: &QuadMesh) -> VertexData<f64> {
    par_data(mesh.vertex_count(), |vertex| {
        let flat = if mesh.is_boundary(vertex) { PI } else { TAU };
        flat - mesh.vertex_corners(vertex).map(|corner| corner_angle(mesh, corner)).sum::<f64>() // Eq. 1
    })
}

/// `K = K̄ / S` of Eq. 2, in 1 / length². At the boundary it mixes the turning of the boundary with the curvature of
/// the surface; only interior values say something about the surface.
///
/// Where the area is 0 the curvature is 0: a vertex whose faces all have no area shapes nothing. A quotient beyond
/// the range of `f64` is cut off at it.
#[must_use]
pub fn gaussian_curvature(mesh: &QuadMesh, area: VertexArea) -> VertexData<f64> {
    let integrated = integrated_curvature(mesh);
    let areas = vertex_areas(mesh, area);
    mesh.vertex_data(|vertex| {
        let area = areas[vertex];
        if area > 0.0 { (integrated[vertex] / area).clamp(f64::MIN, f64::MAX) } else { 0.0 } // Eq. 2
    })
}
