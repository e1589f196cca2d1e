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
#[derive(Clone, Debug)]
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
        self.corner_range_starts().len() - 1
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

    fn corner_range_starts(&self) -> &[u32] {
        &self.face_start
    }
}

/// Walking.
impl QuadMesh {
    /// How many corners `face` has: 4 for a quad.
    #[inline]
    #[must_use]
    pub fn degree(&self, face: FaceId) -> usize {
        (self.face_start[face.index() + 1] - self.face_start[face.index()]) as usize
    }

    /// The corners of `face`, counter-clockwise.
    #[inline]
    pub fn face_corners(
        &self,
        face: FaceId,
    ) -> impl ExactSizeIterator<Item = CornerId> + DoubleEndedIterator + Clone + use<> {
        (self.face_start[face.index()]..self.face_start[face.index() + 1]).map(CornerId)
    }

    /// The vertices of `face`, counter-clockwise.
    #[inline]
    pub fn face_vertices(
        &self,
        face: FaceId,
    ) -> impl ExactSizeIterator<Item = VertexId> + DoubleEndedIterator + Clone {
        let range = self.face_start[face.index()] as usize..self.face_start[face.index() + 1] as usize;
        self.corner_vertex[range].iter().map(|&v| VertexId(v))
    }

    /// The vertex at `corner`.
    #[inline]
    #[must_use]
    pub fn vertex(&self, corner: CornerId) -> VertexId {
        VertexId(self.corner_vertex[corner.index()])
    }

    /// The face of `corner`.
    #[inline]
    #[must_use]
    pub fn face(&self, corner: CornerId) -> FaceId {
        self.corner_face[corner.index()]
    }

    /// The next corner of the same face, counter-clockwise.
    #[inline]
    #[must_use]
    pub fn next_corner(&self, corner: CornerId) -> CornerId {
        let face = self.corner_face[corner.index()].index();
        let after = corner.0 + 1;
        CornerId(if after == self.face_start[face + 1] { self.face_start[face] } else { after })
    }

    /// The previous corner of the same face.
    #[inline]
    #[must_use]
    pub fn previous_corner(&self, corner: CornerId) -> CornerId {
        let face = self.corner_face[corner.index()].index();
        let first = self.face_start[face];
        CornerId(if corner.0 == first { self.face_start[face + 1] - 1 } else { corner.0 - 1 })
    }

    /// Whether `halfedge` runs along the boundary, outside every face.
    #[inline]
    #[must_use]
    pub fn is_boundary_halfedge(&self, halfedge: HalfedgeId) -> bool {
        halfedge.index() >= self.corner_vertex.len()
    }

    /// The corner that `halfedge` leaves, unless it runs along the boundary.
    #[inline]
    #[must_use]
    pub fn corner(&self, halfedge: HalfedgeId) -> Option<CornerId> {
        (!self.is_boundary_halfedge(halfedge)).then_some(CornerId(halfedge.0))
    }

    /// The halfedge of the same edge that runs the other way.
    #[inline]
    #[must_use]
    pub fn twin(&self, halfedge: HalfedgeId) -> HalfedgeId {
        self.twin[halfedge.index()]
    }

    /// The next halfedge of the same face, or along the same boundary loop.
    #[inline]
    #[must_use]
    pub fn next(&self, halfedge: HalfedgeId) -> HalfedgeId {
        match self.corner(halfedge) {
            Some(corner) => self.next_corner(corner).halfedge(),
            None => self.boundary_next[halfedge.index() - self.corner_vertex.len()],
        }
    }

    /// Where `halfedge` starts.
    #[inline]
    #[must_use]
    pub fn origin(&self, halfedge: HalfedgeId) -> VertexId {
        match self.corner(halfedge) {
            Some(corner) => self.vertex(corner),
            None => self.target(self.twin(halfedge)),
        }
    }

    /// Where `halfedge` ends.
    #[inline]
    #[must_use]
    pub fn target(&self, halfedge: HalfedgeId) -> VertexId {
        match self.corner(halfedge) {
            Some(corner) => self.vertex(self.next_corner(corner)),
            None => self.vertex(CornerId(self.twin(halfedge).0)),
        }
    }

    /// The undirected edge of `halfedge`.
    #[inline]
    #[must_use]
    pub fn edge(&self, halfedge: HalfedgeId) -> EdgeId {
        self.halfedge_edge[halfedge.index()]
    }

    /// The halfedge of `edge` that comes first in the input; it lies in a face.
    #[inline]
    #[must_use]
    pub fn halfedge(&self, edge: EdgeId) -> HalfedgeId {
        self.edge_halfedge[edge.index()]
    }

    /// The two ends of `edge`.
    #[inline]
    #[must_use]
    pub fn edge_vertices(&self, edge: EdgeId) -> [VertexId; 2] {
        let halfedge = self.halfedge(edge);
        [self.origin(halfedge), self.target(halfedge)]
    }

    /// Whether `edge` has a face on one side only.
    #[inline]
    #[must_use]
    pub fn is_boundary_edge(&self, edge: EdgeId) -> bool {
        self.is_boundary_halfedge(self.twin(self.halfedge(edge)))
    }

    /// Whether `vertex` lies on the boundary.
    #[inline]
    #[must_use]
    pub fn is_boundary(&self, vertex: VertexId) -> bool {
        self.is_boundary_halfedge(self.twin(self.vertex_halfedge[vertex.index()]))
    }

    /// The halfedges that leave `vertex`, counter-clockwise. At the boundary the first has no face on its right and
    /// the last, a boundary halfedge, none on its left.
    pub fn outgoing(&self, vertex: VertexId) -> impl Iterator<Item = HalfedgeId> + Clone + '_ {
        let first = self.vertex_halfedge[vertex.index()];
        let mut current = Some(first);
        std::iter::from_fn(move || {
            let halfedge = current?;
            current = self
                .corner(halfedge)
                .map(|corner| self.twin(self.previous_corner(corner).halfedge()))
                .filter(|&following| following != first);
            Some(halfedge)
        })
    }

    /// The immediate one-ring of `vertex`: the other ends of its edges, counter-clockwise.
    pub fn neighbors(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.outgoing(vertex).map(|halfedge| self.target(halfedge))
    }

    /// The corners at `vertex`, counter-clockwise.
    pub fn vertex_corners(&self, vertex: VertexId) -> impl Iterator<Item = CornerId> + Clone + '_ {
        self.outgoing(vertex).filter_map(|halfedge| self.corner(halfedge))
    }

    /// How many edges meet at `vertex`.
    #[must_use]
    pub fn valence(&self, vertex: VertexId) -> usize {
        self.outgoing(vertex).count()
    }

    /// From the corner to the next and to the previous vertex of its face, in space.
    #[inline]
    #[must_use]
    pub fn corner_vectors(&self, corner: CornerId) -> [Vec3; 2] {
        let here = self.position(self.vertex(corner));
        let next = self.position(self.vertex(self.next_corner(corner)));
        let previous = self.position(self.vertex(self.previous_corner(corner)));
        [next - here, previous - here]
    }

    /// The length of `edge`.
    #[inline]
    #[must_use]
    pub fn edge_length(&self, edge: EdgeId) -> f64 {
        let [a, b] = self.edge_vertices(edge);
        (self.position(b) - self.position(a)).norm()
    }
}
