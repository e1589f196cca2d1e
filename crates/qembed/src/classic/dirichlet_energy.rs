//! The Dirichlet energy of maps of a polygon mesh, no diagonal preferred.
//!
//! Each polygon is cut into triangles from one corner, and the energies are averaged over all corners: for a quad the
//! mean of its two cuts (Eck et al. 1995 give the weights for one triangle). Exact for linear maps of flat convex polygons.

use crate::qmesh::{FaceId, QuadMesh, Vec3, VertexId};

use crate::EmbedError;
use crate::embed::mean_edge;
use crate::weights::SHORTEST_EDGE;

/// Twice the area of a triangle counts as at least this fraction of its longest edge squared. The energy stays that
/// of some positive form, so the system stays positive definite.
const THINNEST: f64 = 1e-9;
/// Polygons with more corners are cut from one corner only, the one farthest from the mean of all.
const MANY_CORNERS: usize = 16;

/// Weights `w` with `½ Σ w |uᵢ − uⱼ|²` the Dirichlet energy `½ ∫ |∇u|²` of a map `u`; each pair once, sorted.
pub(super) fn springs(mesh: &QuadMesh) -> Result<Vec<([VertexId; 2], f64)>, EmbedError> {
    let shortest = SHORTEST_EDGE * mean_edge(mesh);
    let mut triplets =
        qsolve::Triplets::with_capacity(mesh.vertex_count(), mesh.vertex_count(), 3 * mesh.corner_count());
    for face in mesh.faces() {
        let corners: Vec<VertexId> = mesh.face_vertices(face).collect();
        let apexes = apexes(mesh, face, &corners);
        let share = 1.0 / apexes.len() as f64;
        for apex in apexes {
            for k in 1..corners.len() - 1 {
                let at = |step: usize| corners[(apex + step) % corners.len()];
                let triangle = [at(0), at(k), at(k + 1)];
                let cotangents = half_cotangents(triangle.map(|vertex| mesh.position(vertex)), shortest);
                for (place, weight) in cotangents.into_iter().enumerate() {
                    let mut ends = [triangle[(place + 1) % 3], triangle[(place + 2) % 3]];
                    ends.sort_unstable();
                    triplets.add(ends[0].index(), ends[1].index(), share * weight);
                }
            }
        }
    }
    let matrix = triplets.build()?;
    let id = |index: usize| VertexId(index as u32);
    Ok(matrix.triplet_iter().map(|(a, b, &weight)| ([id(a), id(b)], weight)).collect())
}

/// The corners that triangles are cut from. Opposite corners of a quad give the same cut.
fn apexes(mesh: &QuadMesh, face: FaceId, corners: &[VertexId]) -> Vec<usize> {
    match mesh.degree(face) {
        3 => vec![0],
        4 => vec![0, 1],
        degree if degree <= MANY_CORNERS => (0..degree).collect(),
        degree => {
            let mean = corners.iter().map(|&corner| mesh.position(corner) / degree as f64).sum::<Vec3>();
            let distance = |k: usize| (mesh.position(corners[k]) - mean).norm();
            vec![
                (0..degree)
                    .reduce(|best, k| if distance(k) > distance(best) { k } else { best })
                    .unwrap_or(0),
            ]
        }
    }
}

/// Half the cotangent at each corner of a triangle, the weight of the opposite edge. A triangle of no size at all
/// counts as equilateral.
fn half_cotangents(corners: [Vec3; 3], shortest: f64) -> [f64; 3] {
    let edges = [corners[2] - corners[1], corners[0] - corners[2], corners[1] - corners[0]];
    let longest = edges.iter().map(Vec3::norm).fold(0.0, f64::max);
    if longest < shortest {
        return [0.5 / 3.0_f64.sqrt(); 3];
    }
    let edges = edges.map(|edge| edge / longest);
    let twice_area = edges[0].cross(&edges[1]).norm().max(THINNEST);
    // The corner lies between the other two edges, one of which comes in and the other goes out.
    [0, 1, 2].map(|k| -0.5 * edges[(k + 1) % 3].dot(&edges[(k + 2) % 3]) / twice_area)
}
