//! Walking over a mesh: around a face, along a halfedge, about a vertex. Every step takes constant time.

use crate::Vec3;
use crate::ids::{CornerId, EdgeId, FaceId, HalfedgeId, VertexId};
use crate::mesh::QuadMesh;

/// Walking from element to element.
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
