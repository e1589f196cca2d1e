//! Only planar patches have a map to the plane that needs no cut. Others are refused with what they are.

use std::borrow::Cow;

use crate::qmesh::{FaceId, Id, QuadMesh, Vec3, VertexId};

use crate::EmbedError;

/// Distances that differ by less than this fraction count as equal, so that rounding does not break ties.
const TIE: f64 = 1e-9;

/// Whether the mesh is a planar patch, a disk or a disk with holes: one component, no handles, at least one boundary
/// loop. Every embedding asks this first; ask it yourself before other long work.
///
/// # Errors
/// What the mesh is instead, with elements to find it by.
pub fn check_patch(mesh: &QuadMesh) -> Result<(), EmbedError> {
    let (component, components) = mesh.components();
    if components > 1 {
        let vertex = |wanted: u32| {
            let face = component.iter().position(|&found| found == wanted).map(FaceId::from_index);
            face.and_then(|face| mesh.face_vertices(face).next()).unwrap_or(VertexId(0))
        };
        return Err(EmbedError::SeveralComponents { components, vertices: [vertex(0), vertex(1)] });
    }
    let loops = mesh.boundary_loops().len();
    match (loops, (2 - loops as i64 - mesh.euler_characteristic()) / 2) {
        (0, genus) => Err(EmbedError::Closed { genus }),
        (_, 0) => Ok(()),
        (_, genus) => Err(EmbedError::Handles { genus }),
    }
}

/// A planar patch with its holes filled, for the time of the embedding.
///
/// # Errors
/// When the mesh is no planar patch.
pub(crate) fn filled(mesh: &QuadMesh) -> Result<Cow<'_, QuadMesh>, EmbedError> {
    check_patch(mesh)?;
    Ok(mesh.filled().map_or(Cow::Borrowed(mesh), Cow::Owned))
}

/// The outer boundary of a planar patch, counter-clockwise, from the vertex that lies farthest from its centroid.
pub(crate) fn rim(mesh: &QuadMesh) -> Vec<VertexId> {
    let mut loops = mesh.boundary_loops();
    mesh.outer_first(&mut loops);
    let mut rim = loops.first().map(|outer| mesh.loop_vertices(outer)).unwrap_or_default();
    let center = centroid(mesh, &rim);
    let start = farthest(mesh, &rim, center);
    if let Some(place) = rim.iter().position(|&vertex| vertex == start) {
        rim.rotate_left(place);
    }
    rim
}

/// The vertex of `among` farthest from `point`; the lowest index of several.
pub(crate) fn farthest(mesh: &QuadMesh, among: &[VertexId], point: Vec3) -> VertexId {
    let distance = |vertex: VertexId| (mesh.position(vertex) - point).norm();
    let largest = among.iter().map(|&vertex| distance(vertex)).fold(0.0, f64::max);
    let tied = among.iter().copied().filter(|&vertex| distance(vertex) >= (1.0 - TIE) * largest);
    tied.min().unwrap_or(VertexId(0))
}

/// The lengths of the edges of a closed walk; entry `k` leads from vertex `k` to the next.
pub(crate) fn edge_lengths(mesh: &QuadMesh, walk: &[VertexId]) -> Vec<f64> {
    pairs(walk).map(|[a, b]| (mesh.position(b) - mesh.position(a)).norm()).collect()
}

/// The edges of a closed walk.
pub(crate) fn pairs<T: Copy>(walk: &[T]) -> impl Iterator<Item = [T; 2]> {
    walk.iter().zip(walk.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}

/// The centroid of a closed curve; that of its vertices when it has no length.
pub(crate) fn centroid(mesh: &QuadMesh, walk: &[VertexId]) -> Vec3 {
    let first = walk.first().map_or_else(Vec3::zeros, |&vertex| mesh.position(vertex));
    let (mut sum, mut total) = (Vec3::zeros(), 0.0);
    for ([a, b], length) in pairs(walk).zip(edge_lengths(mesh, walk)) {
        sum += length * 0.5 * ((mesh.position(a) - first) + (mesh.position(b) - first));
        total += length;
    }
    if total > 0.0 { first + sum / total } else { first }
}
