//! A polygon graph that changes: linked halfedges, with the boundary loops as faces of their own.

use qcurv::qmesh::{HalfedgeId, Id, QuadMesh, VertexId};

/// Marks a halfedge that is gone.
pub(crate) const GONE: u32 = u32::MAX;

/// Vertices with more edges stop removals next to them. Each of those would have to look at all of them: quadratic time
/// around the poles of a ball.
pub(crate) const MAX_EDGES: u32 = 1024;

/// Halfedges linked around faces. Faces below `inner_faces` are those of the mesh, then follow the boundary loops, then
/// faces that removals made.
pub(crate) struct PolygonGraph {
    pub(crate) origin: Vec<u32>,
    pub(crate) next: Vec<u32>,
    pub(crate) previous: Vec<u32>,
    pub(crate) twin: Vec<u32>,
    /// The face on the left, or [`GONE`].
    pub(crate) face: Vec<u32>,
    /// One of the halfedges that leave each vertex.
    pub(crate) leaving: Vec<u32>,
    /// Edges at each vertex.
    pub(crate) degree: Vec<u32>,
    pub(crate) on_boundary: Vec<bool>,
    inner_faces: u32,
    outer_faces: u32,
    face_count: u32,
}

impl PolygonGraph {
    pub(crate) fn new(mesh: &QuadMesh) -> Self {
        let halfedges = || (0..mesh.halfedge_count()).map(HalfedgeId::from_index);
        let mut face: Vec<u32> = mesh.corners().map(|corner| mesh.face(corner).0).collect();
        face.resize(mesh.halfedge_count(), GONE);
        let loops = mesh.boundary_loops();
        for (walk, id) in loops.iter().zip(mesh.face_count() as u32..) {
            for halfedge in walk {
                face[halfedge.index()] = id;
            }
        }
        let next: Vec<u32> = halfedges().map(|h| mesh.next(h).0).collect();
        let mut previous = vec![0; next.len()];
        let origin: Vec<u32> = halfedges().map(|h| mesh.origin(h).0).collect();
        let mut leaving = vec![0; mesh.vertex_count()];
        let mut degree = vec![0; mesh.vertex_count()];
        for (halfedge, (&after, &vertex)) in (0u32..).zip(next.iter().zip(&origin)) {
            previous[after as usize] = halfedge;
            leaving[vertex as usize] = halfedge;
            degree[vertex as usize] += 1;
        }
        Self {
            twin: halfedges().map(|h| mesh.twin(h).0).collect(),
            on_boundary: mesh.vertices().map(|v| mesh.is_boundary(v)).collect(),
            inner_faces: mesh.face_count() as u32,
            outer_faces: loops.len() as u32,
            face_count: (mesh.face_count() + loops.len()) as u32,
            origin,
            next,
            previous,
            face,
            leaving,
            degree,
        }
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.leaving.len()
    }

    /// One more than the largest face index so far.
    pub(crate) fn face_count(&self) -> usize {
        self.face_count as usize
    }

    pub(crate) fn new_face(&mut self) -> u32 {
        self.face_count += 1;
        self.face_count - 1
    }

    pub(crate) fn target(&self, halfedge: u32) -> u32 {
        self.origin[self.twin[halfedge as usize] as usize]
    }

    /// The halfedges that leave `vertex`, counter-clockwise.
    pub(crate) fn fan(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.leaving[vertex as usize];
        let mut current = Some(first);
        std::iter::from_fn(move || {
            let halfedge = current?;
            let following = self.twin[self.previous[halfedge as usize] as usize];
            current = (following != first).then_some(following);
            Some(halfedge)
        })
    }

    /// Makes `after` follow `before` around a face.
    pub(crate) fn link(&mut self, before: u32, after: u32) {
        self.next[before as usize] = after;
        self.previous[after as usize] = before;
    }

    /// Makes `a` and `b` the two sides of one edge.
    pub(crate) fn pair(&mut self, a: u32, b: u32) {
        self.twin[a as usize] = b;
        self.twin[b as usize] = a;
    }

    /// All edges, smaller vertex first, sorted.
    pub(crate) fn edges(&self) -> Vec<[VertexId; 2]> {
        let mut edges: Vec<[VertexId; 2]> = (0..self.origin.len() as u32)
            .filter(|&h| self.face[h as usize] != GONE)
            .map(|h| [VertexId(self.origin[h as usize]), VertexId(self.target(h))])
            .filter(|[a, b]| a < b)
            .collect();
        edges.sort_unstable();
        edges
    }

    /// The faces, boundary loops left out, flat; untouched ones in the order of the mesh and from the same corner.
    pub(crate) fn faces(&self) -> (Vec<u32>, Vec<VertexId>) {
        let outer = self.inner_faces..self.inner_faces + self.outer_faces;
        let mut seen = vec![false; self.face_count()];
        let (mut face_start, mut face_vertex) = (vec![0], Vec::new());
        for start in 0..self.origin.len() as u32 {
            let face = self.face[start as usize];
            if face == GONE || outer.contains(&face) || std::mem::replace(&mut seen[face as usize], true) {
                continue;
            }
            let mut current = start;
            loop {
                face_vertex.push(VertexId(self.origin[current as usize]));
                current = self.next[current as usize];
                if current == start {
                    break;
                }
            }
            face_start.push(face_vertex.len() as u32);
        }
        (face_start, face_vertex)
    }
}
