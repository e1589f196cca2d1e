//! Areas of corner triangles, faces and the surface.

use qmesh::{CornerId, FaceData, FaceId, QuadMesh, Vec3};

use crate::par_data;
use crate::triangle::triangle_area;

/// The area of the corner triangle (previous, here, next). Those of a quad are its two triangulations: together
/// they cover it twice.
#[must_use]
pub fn corner_area(mesh: &QuadMesh, corner: CornerId) -> f64 {
    let [next, previous] = mesh.corner_vectors(corner);
    triangle_area(next, previous)
}

/// The area of `face`. A quad counts the mean of its two diagonal splits (more than its area when it is concave);
/// a polygon of more corners counts its vector area, exact when it is planar and a lower bound otherwise.
#[must_use]
pub fn face_area(mesh: &QuadMesh, face: FaceId) -> f64 {
    match mesh.degree(face) {
        3 => mesh.face_corners(face).next().map_or(0.0, |corner| corner_area(mesh, corner)),
        4 => 0.5 * quad_corner_areas(mesh, face).into_iter().sum::<f64>(),
        _ => vector_area(mesh, face),
    }
}

/// The corner areas of a quad; each vertex is looked up once.
fn quad_corner_areas(mesh: &QuadMesh, face: FaceId) -> [f64; 4] {
    let mut vertices = mesh.face_vertices(face).map(|vertex| mesh.position(vertex));
    let at: [Vec3; 4] = std::array::from_fn(|_| vertices.next().unwrap_or_default());
    std::array::from_fn(|here| {
        let [next, previous] = [1, 3].map(|step| at[(here + step) % 4] - at[here]);
        triangle_area(next, previous)
    })
}

/// All face areas.
#[must_use]
pub fn face_areas(mesh: &QuadMesh) -> FaceData<f64> {
    par_data(mesh.face_count(), |face| face_area(mesh, face))
}

/// Area of the surface; a quad counts the mean of its two diagonal splits (see [`face_area`]).
#[must_use]
pub fn surface_area(mesh: &QuadMesh) -> f64 {
    face_areas(mesh).iter().sum()
}

/// `½ |Σ p_i × p_{i+1}|`, measured from the first vertex so that far-away coordinates keep their digits.
fn vector_area(mesh: &QuadMesh, face: FaceId) -> f64 {
    let mut vertices = mesh.face_vertices(face).map(|vertex| mesh.position(vertex));
    let Some(first) = vertices.next() else { return 0.0 };
    let mut before = Vec3::zeros();
    let mut sum = Vec3::zeros();
    for point in vertices {
        let here = point - first;
        sum += before.cross(&here);
        before = here;
    }
    0.5 * sum.norm()
}
