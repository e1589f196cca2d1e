//! An orthographic camera and a lamp: which quads are seen, where, how near and how bright.

use qparam_cli::qmesh::{FaceId, QuadMesh, Vec2, Vec3, VertexData};

/// A quad that faces the camera.
pub(super) struct Seen {
    pub(super) face: FaceId,
    /// Distance towards the camera, from 0 (farthest in the picture) to 1 (nearest).
    pub(super) nearness: f64,
    /// Lambert: 0 where the lamp is behind the surface, 1 where it shines straight at it.
    pub(super) light: f64,
}

/// A mesh as the camera sees it. Only `+ − × / √` are used, so every machine gets the same bits.
pub(super) struct View {
    /// Where each vertex is in the picture, in pixels, `y` down.
    pub(super) place: VertexData<Vec2>,
    /// What is seen, farthest first.
    pub(super) seen: Vec<Seen>,
}

/// Looks at `mesh` from `towards`, upright, and fits it into the frame of this middle and size.
pub(super) fn look(mesh: &QuadMesh, towards: Vec3, middle: Vec2, size: Vec2) -> View {
    let back = towards.normalize();
    let right = Vec3::y().cross(&back).normalize();
    let up = back.cross(&right);
    let flat = mesh.vertex_data(|v| {
        let p = mesh.position(v);
        Vec2::new(p.dot(&right), -p.dot(&up))
    });
    let place = fit(flat, middle, size);
    // Over the left shoulder of the camera, and a little above.
    let lamp = (back * 1.0 - right * 0.55 + up * 0.6).normalize();
    let normals = vertex_normals(mesh);
    let depth = |face| mean(mesh, face, |v| mesh.position(v).dot(&back));
    let depths: Vec<f64> = mesh.faces().map(depth).collect();
    let nearest = depths.iter().copied().fold(f64::MIN, f64::max);
    let farthest = depths.iter().copied().fold(f64::MAX, f64::min);
    let range = (nearest - farthest).max(f64::MIN_POSITIVE);
    let mut seen: Vec<Seen> = mesh
        .faces()
        .filter(|&face| faces_camera(mesh, face, &place))
        .map(|face| {
            let normal = mesh.face_vertices(face).map(|v| normals[v]).sum::<Vec3>();
            let light = normal.dot(&lamp) / normal.norm().max(f64::MIN_POSITIVE);
            Seen { face, nearness: (depths[face.index()] - farthest) / range, light: light.max(0.0) }
        })
        .collect();
    seen.sort_by(|a, b| a.nearness.total_cmp(&b.nearness).then(a.face.cmp(&b.face)));
    View { place, seen }
}

/// Centred in the frame, as large as fits.
fn fit(mut flat: VertexData<Vec2>, middle: Vec2, size: Vec2) -> VertexData<Vec2> {
    let low = flat.iter().copied().fold(Vec2::repeat(f64::MAX), |a, b| a.inf(&b));
    let high = flat.iter().copied().fold(Vec2::repeat(f64::MIN), |a, b| a.sup(&b));
    let extent = high - low;
    let scale = (size.x / extent.x).min(size.y / extent.y);
    flat.iter_mut().for_each(|p| *p = middle + (*p - (low + high) / 2.0) * scale);
    flat
}

fn mean(mesh: &QuadMesh, face: FaceId, value: impl Fn(qparam_cli::qmesh::VertexId) -> f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for vertex in mesh.face_vertices(face) {
        sum += value(vertex);
        count += 1.0;
    }
    sum / count
}

/// Whether the outline turns left as the camera sees it (`y` is down, so the sign is the other one).
fn faces_camera(mesh: &QuadMesh, face: FaceId, place: &VertexData<Vec2>) -> bool {
    let outline: Vec<Vec2> = mesh.face_vertices(face).map(|v| place[v]).collect();
    super::checker::doubled_area(&outline) < 0.0
}

/// The normal of a vertex is the sum over its faces' vector areas: smooth shading hides the facets.
fn vertex_normals(mesh: &QuadMesh) -> VertexData<Vec3> {
    let mut normals = mesh.vertex_data(|_| Vec3::zeros());
    for face in mesh.faces() {
        let corners: Vec<Vec3> = mesh.face_vertices(face).map(|v| mesh.position(v)).collect();
        let next = corners.iter().cycle().skip(1);
        let vector_area: Vec3 = corners.iter().zip(next).map(|(a, b)| a.cross(b)).sum();
        mesh.face_vertices(face).for_each(|v| normals[v] += vector_area);
    }
    normals
}
