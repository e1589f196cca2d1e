//! The best-fit plane of the boundary.

use crate::qmesh::{QuadMesh, Vec2, Vec3, VertexId};

use super::check_count;
use super::polygon::meeting_edges;
use crate::EmbedError;
use crate::disk::{centroid, pairs};

/// Areas below this fraction of the squared extent count as none.
const NO_AREA: f64 = 1e-12;

/// The plane is normal to the vector area of the boundary: there the enclosed area is largest, and positive. The `x`
/// axis points from the centroid to the first vertex, so that rotating the mesh does not rotate the map.
pub(super) fn project(mesh: &QuadMesh, rim: &[VertexId]) -> Result<Vec<Vec2>, EmbedError> {
    check_count(rim, 3)?;
    let center = centroid(mesh, rim);
    let arms: Vec<Vec3> = rim.iter().map(|&vertex| mesh.position(vertex) - center).collect();
    let extent = arms.iter().map(Vec3::norm).fold(0.0, f64::max);
    let arms: Vec<Vec3> = arms.iter().map(|arm| arm / extent).collect();
    let area: Vec3 = pairs(&arms).map(|[a, b]| 0.5 * a.cross(&b)).sum();
    // Where all vertices are in one place, nothing is a number from here on.
    if area.norm() <= NO_AREA || extent <= 0.0 {
        return Err(EmbedError::NoPlane);
    }
    let normal = area.normalize();
    let in_plane = |arm: &Vec3| arm - normal * normal.dot(arm);
    // The first vertex is the farthest, but it may lie straight above the centroid.
    let flattest = arms.iter().map(in_plane).find(|arm| arm.norm() > 1e-6).ok_or(EmbedError::NoPlane)?;
    let x = flattest.normalize();
    let y = normal.cross(&x);
    let flat: Vec<Vec2> = arms.iter().map(|arm| extent * Vec2::new(x.dot(arm), y.dot(arm))).collect();
    match meeting_edges(&flat) {
        Some(edges) => {
            Err(EmbedError::BoundaryFolds { edges: edges.map(|k| [rim[k], rim[(k + 1) % rim.len()]]) })
        }
        None => Ok(flat),
    }
}
