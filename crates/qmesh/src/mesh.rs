//! Halfedge connectivity in flat arrays.
//!
//! Corners are numbered face after face, so a corner, the halfedge that leaves it and its place in the input
//! are one number. Boundary halfedges follow: each is the twin of a halfedge without a second face, and they
//! are linked into loops that keep the surface on their right. Every halfedge therefore has a twin.

use crate::Vec3;
use crate::data::{CornerData, EdgeData, ElementData, FaceData, VertexData};
use crate::ids::{CornerId, EdgeId, FaceId, HalfedgeId, Id, VertexId};
use crate::polygons::PolygonView;

/// An oriented, manifold polygon mesh; quads are the case that everything is made for.
///
/// Build one with [`QuadMesh::build`]. The connectivity never changes afterwards.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadMesh {
    pub(crate) positions: VertexData<Vec3>,
    pub(crate) face_start: Vec<u32>,
    pub(crate) corner_vertex: Vec<u32>,
    pub(crate) corner_face: Vec<FaceId>,
    /// One entry per halfedge, boundary halfedges included.
    pub(crate) twin: Vec<HalfedgeId>,
    /// One entry per halfedge, boundary halfedges included.
    pub(crate) halfedge_edge: Vec<EdgeId>,
    /// The halfedge of each edge that comes first in the input; never a boundary halfedge.
    pub(crate) edge_halfedge: Vec<HalfedgeId>,
    /// The next halfedge along the loop, one entry per boundary halfedge.
    pub(crate) boundary_next: Vec<HalfedgeId>,
    /// A halfedge that leaves each vertex and lies in a face; at the boundary the one whose twin has no face.
    pub(crate) vertex_halfedge: Vec<HalfedgeId>,
    /// The caller's index of each vertex, unless it is the same for all.
    pub(crate) source_vertex: Option<Vec<u32>>,
    /// How many vertices the caller had, those included that no face uses.
    pub(crate) source_vertex_count: usize,
}

fn ids<I: Id>(count: usize) -> impl ExactSizeIterator<Item = I> + DoubleEndedIterator + Clone {
    (0..count).map(I::from_index)
}

/// Elements and their values.
impl QuadMesh {
    /// How many vertices there are.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// How many faces there are.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.face_start.len() - 1
    }

    /// How many face corners there are; also how many halfedges lie in faces.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.corner_vertex.len()
    }

    /// How many undirected edges there are.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.edge_halfedge.len()
    }

    /// How many halfedges there are, those along the boundary included.
    #[must_use]
    pub fn halfedge_count(&self) -> usize {
        self.twin.len()
    }

    /// All vertices in order.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + DoubleEndedIterator + Clone + use<> {
        ids(self.vertex_count())
    }

    /// All faces in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + DoubleEndedIterator + Clone + use<> {
        ids(self.face_count())
    }

    /// All edges in order.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = EdgeId> + DoubleEndedIterator + Clone + use<> {
        ids(self.edge_count())
    }

    /// All corners, face after face.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = CornerId> + DoubleEndedIterator + Clone + use<> {
        ids(self.corner_count())
    }

    /// The halfedges without a face.
    pub fn boundary_halfedges(
        &self,
    ) -> impl ExactSizeIterator<Item = HalfedgeId> + DoubleEndedIterator + Clone + use<> {
        (self.corner_count()..self.halfedge_count()).map(HalfedgeId::from_index)
    }

    /// Where each vertex is.
    #[must_use]
    pub fn positions(&self) -> &VertexData<Vec3> {
        &self.positions
    }

    /// Where `vertex` is.
    #[inline]
    #[must_use]
    pub fn position(&self, vertex: VertexId) -> Vec3 {
        self.positions[vertex]
    }

    /// The same mesh with its vertices elsewhere. Nothing is asked of the new positions but to be finite.
    ///
    /// # Panics
    /// When there is not one position per vertex.
    #[must_use]
    pub fn with_positions(mut self, positions: VertexData<Vec3>) -> Self {
        assert_eq!(positions.len(), self.vertex_count(), "one position per vertex");
        self.positions = positions;
        self
    }

    /// The faces as flat arrays.
    #[must_use]
    pub fn view(&self) -> PolygonView<'_> {
        PolygonView {
            positions: &self.positions,
            face_start: &self.face_start,
            corner_vertex: &self.corner_vertex,
        }
    }

    /// The index that `vertex` had in the polygons that the mesh was built from.
    #[must_use]
    pub fn source_vertex(&self, vertex: VertexId) -> u32 {
        self.source_vertex.as_ref().map_or(vertex.0, |map| map[vertex.index()])
    }

    /// How many vertices the polygons had, those included that no face uses and the mesh leaves out.
    #[must_use]
    pub fn source_vertex_count(&self) -> usize {
        self.source_vertex_count
    }

    /// Says which of the caller's `count` vertices each vertex is.
    pub(crate) fn set_sources(&mut self, sources: &[u32], count: usize) {
        let same = sources.len() == count
            && sources.iter().enumerate().all(|(vertex, &source)| vertex == source as usize);
        self.source_vertex = (!same).then(|| sources.to_vec());
        self.source_vertex_count = count;
    }

    /// Leads on to the vertices that those of `outer` come from; `self` was built from the faces of `outer`.
    pub(crate) fn rename_sources(&mut self, outer: &Self) {
        let sources: Vec<u32> =
            self.vertices().map(|vertex| outer.source_vertex(VertexId(self.source_vertex(vertex)))).collect();
        self.set_sources(&sources, outer.source_vertex_count);
    }

    /// One value per vertex, computed from its id.
    pub fn vertex_data<T>(&self, value: impl FnMut(VertexId) -> T) -> VertexData<T> {
        ElementData::from_vec(self.vertices().map(value).collect())
    }

    /// One value per face, computed from its id.
    pub fn face_data<T>(&self, value: impl FnMut(FaceId) -> T) -> FaceData<T> {
        ElementData::from_vec(self.faces().map(value).collect())
    }

    /// One value per edge, computed from its id.
    pub fn edge_data<T>(&self, value: impl FnMut(EdgeId) -> T) -> EdgeData<T> {
        ElementData::from_vec(self.edges().map(value).collect())
    }

    /// One value per corner, computed from its id.
    pub fn corner_data<T>(&self, value: impl FnMut(CornerId) -> T) -> CornerData<T> {
        ElementData::from_vec(self.corners().map(value).collect())
    }

    /// Values per vertex, handed to every corner at that vertex.
    #[must_use]
    pub fn to_corners<T: Clone>(&self, values: &VertexData<T>) -> CornerData<T> {
        self.corner_data(|corner| values[self.vertex(corner)].clone())
    }
}
