//! The unit in which systems are solved: the boundary around the origin, its extent about one.

use crate::qmesh::{QuadMesh, Vec2, VertexData, VertexId};

/// Where the given boundary positions lie, and how large they are.
pub(crate) struct Frame {
    center: Vec2,
    size: f64,
}

impl Frame {
    pub(crate) fn new(positions: &[Vec2]) -> Self {
        let center: Vec2 = positions.iter().map(|p| p / positions.len() as f64).sum();
        let size = positions.iter().map(|p| (p - center).amax()).fold(0.0, f64::max);
        Self { center, size: if size > 0.0 { size } else { 1.0 } }
    }

    /// The boundary in this frame, everything else at the origin.
    pub(crate) fn enter(&self, mesh: &QuadMesh, rim: &[VertexId], positions: &[Vec2]) -> VertexData<Vec2> {
        let mut uv = VertexData::filled(mesh.vertex_count(), Vec2::zeros());
        for (&vertex, position) in rim.iter().zip(positions) {
            uv[vertex] = (position - self.center) / self.size;
        }
        uv
    }

    /// Back from this frame; the boundary gets exactly the positions that were given.
    pub(crate) fn leave(&self, uv: &mut VertexData<Vec2>, rim: &[VertexId], positions: &[Vec2]) {
        for position in uv.iter_mut() {
            *position = self.center + self.size * *position;
        }
        for (&vertex, &position) in rim.iter().zip(positions) {
            uv[vertex] = position;
        }
    }
}
