//! What vertices, edges and faces are called in the file.

use qoptimize::qmesh::{CornerId, FaceId, QuadMesh, VertexId};

use crate::input::Input;

/// A face of the file, from 0, with its line.
pub(super) fn face(face: usize, input: &Input) -> String {
    format!("face {} (line {})", face + 1, input.document.face_line(face))
}

/// A vertex of the file, from 0, with its line.
pub(super) fn vertex(vertex: usize, input: &Input) -> String {
    format!("vertex {} (line {})", vertex + 1, input.document.vertex_line(vertex))
}

/// A mesh, and the file that it is a part of.
pub(crate) struct Names<'a> {
    mesh: &'a QuadMesh,
    /// The file's face of each face of the mesh; nothing when the mesh is the whole file.
    faces: Option<&'a [u32]>,
    pub(super) input: &'a Input,
}

impl<'a> Names<'a> {
    /// A mesh of all faces of the file.
    pub(crate) fn of_all(mesh: &'a QuadMesh, input: &'a Input) -> Self {
        Self { mesh, faces: None, input }
    }

    /// A mesh of these faces of the file.
    pub(super) fn of_part(mesh: &'a QuadMesh, faces: &'a [u32], input: &'a Input) -> Self {
        Self { mesh, faces: Some(faces), input }
    }

    pub(super) fn vertex(&self, id: VertexId) -> String {
        vertex(self.mesh.source_vertex(id) as usize, self.input)
    }

    /// The numbers of both ends.
    pub(super) fn edge(&self, ends: [VertexId; 2]) -> String {
        let [a, b] = ends.map(|end| self.mesh.source_vertex(end) + 1);
        format!("{a}-{b}")
    }

    /// The face of a corner.
    pub(super) fn face(&self, corner: CornerId) -> String {
        face(self.source_face(self.mesh.face(corner)), self.input)
    }

    /// The vertex of a corner.
    pub(super) fn at(&self, corner: CornerId) -> String {
        self.vertex(self.mesh.vertex(corner))
    }

    /// The file's number of a face, from 0.
    pub(super) fn source_face(&self, face: FaceId) -> usize {
        self.faces.and_then(|faces| faces.get(face.index())).map_or(face.index(), |&face| face as usize)
    }
}
