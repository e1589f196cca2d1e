//! Several meshes in one.

use crate::{BuildError, Polygons, QuadMesh, Vec3};

/// Two meshes in one, the second moved along `x` so that it stands clear of the first by a tenth of its width:
/// first all vertices and faces of the one, then those of the other.
///
/// ```
/// use qmesh::shapes::{disjoint_union, disk, grid};
/// let both = disjoint_union(&grid(2, 2), &disk(1))?;
/// assert_eq!(both.topology().components, 2);
/// # Ok::<(), qmesh::BuildError>(())
/// ```
///
/// # Errors
/// [`BuildError::TooLarge`] or [`BuildError::NonFiniteCoordinate`] when there is no room for both.
pub fn disjoint_union(first: &QuadMesh, second: &QuadMesh) -> Result<QuadMesh, BuildError> {
    let [left, right] = extent(first);
    let [other_left, _] = extent(second);
    let shift = Vec3::x() * (right + 0.1 * (right - left) - other_left);
    let mut polygons = Polygons::default();
    for (mesh, shift) in [(first, Vec3::zeros()), (second, shift)] {
        let offset = polygons.positions.len() as u32;
        polygons.positions.extend(mesh.positions().iter().map(|p| p + shift));
        for face in mesh.faces() {
            let vertices: Vec<u32> = mesh.face_vertices(face).map(|v| v.0 + offset).collect();
            polygons.push_face(&vertices);
        }
    }
    QuadMesh::build(polygons)
}

fn extent(mesh: &QuadMesh) -> [f64; 2] {
    mesh.positions()
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p.x), high.max(p.x)])
}
