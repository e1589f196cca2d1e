//! A mesh of the hierarchy, and what its elements stand for on the finest.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::qmesh::{FaceId, Id, QuadMesh, Vec3, VertexId};

/// One level.
pub(super) struct Surface<'a> {
    pub(super) mesh: Cow<'a, QuadMesh>,
    /// Per vertex, the unit normal of what it stands for.
    pub(super) normals: Vec<Vec3>,
    /// Per vertex, how many vertices of the finest mesh it stands for.
    pub(super) counts: Vec<f64>,
    /// Per vertex, the area that it stands for, in units of the finest mesh.
    pub(super) areas: Vec<f64>,
    /// Per face, the face of the finest mesh in its middle; empty on the finest.
    pub(super) middles: Vec<FaceId>,
}

impl<'a> Surface<'a> {
    /// The finest level.
    pub(super) fn new(mesh: &'a QuadMesh) -> Self {
        let (normals, areas) = (0..mesh.vertex_count())
            .into_par_iter()
            .with_min_len(4096)
            .map(|vertex| around(mesh, VertexId::from_index(vertex)))
            .unzip();
        Self {
            mesh: Cow::Borrowed(mesh),
            normals,
            counts: vec![1.0; mesh.vertex_count()],
            areas,
            middles: Vec::new(),
        }
    }

    /// The face of the finest mesh in the middle of `face`.
    pub(super) fn middle(&self, face: FaceId) -> FaceId {
        self.middles.get(face.index()).copied().unwrap_or(face)
    }
}

/// The normal of the corner triangles at `vertex`, and half of their area.
fn around(mesh: &QuadMesh, vertex: VertexId) -> (Vec3, f64) {
    let (mut normal, mut area) = (Vec3::zeros(), 0.0);
    for corner in mesh.vertex_corners(vertex) {
        let [next, previous] = mesh.corner_vectors(corner);
        let cross = next.cross(&previous);
        normal += cross;
        area += 0.25 * cross.norm();
    }
    (unit(normal), area)
}

/// `v` at length 1; any direction where there is none.
pub(super) fn unit(v: Vec3) -> Vec3 {
    v.try_normalize(0.0).unwrap_or_else(Vec3::z)
}
