//! What it costs to cut an edge.

use qmesh::{EdgeData, EdgeId, FaceId, HalfedgeData, HalfedgeId, QuadMesh, Vec3, VertexData, VertexId};

/// A bend that counts as a crease, in radians: an edge that bends as much costs about half of a flat one.
const CREASE: f64 = 0.6;
/// How many edge lengths a right-angled turn costs.
const TURN: f64 = 1.0;

/// What it costs to cut along each edge, in units of length.
#[derive(Clone, Debug)]
pub struct SeamCost {
    /// The length of each edge, less where the surface bends.
    pub edges: EdgeData<f64>,
    /// Which of the halfedges that leave its origin each one is, counter-clockwise.
    rank: HalfedgeData<u32>,
    valence: VertexData<u32>,
}

impl SeamCost {
    /// Length, divided by `1 + (bend / 0.6)²` along convex creases and by twice that at most along concave ones, where seams are
    /// least seen. Edges of no length cost next to nothing.
    #[must_use]
    pub fn new(mesh: &QuadMesh) -> Self {
        let bends = bends(mesh);
        let mean = mesh.edges().map(|edge| mesh.edge_length(edge)).sum::<f64>() / mesh.edge_count() as f64;
        let least = if mean > 0.0 { 1e-6 * mean } else { 1.0 };
        let edges = mesh.edge_data(|edge| {
            let bend = bends[edge] / CREASE;
            let crease = bend * bend;
            let hidden = if bend < 0.0 { crease.min(1.0) } else { 0.0 };
            mesh.edge_length(edge).max(least) / (1.0 + crease.min(4.0) + hidden)
        });
        let (rank, valence) = ranks(mesh);
        Self { edges, rank, valence }
    }

    /// What it costs to go on from `before` to `after`, which leaves where `before` ends: nothing straight on, one edge
    /// length at a right angle. Straight on is the middle of the edges around the vertex.
    #[must_use]
    pub fn turn(&self, mesh: &QuadMesh, before: HalfedgeId, after: HalfedgeId) -> f64 {
        let vertex = mesh.target(before);
        if mesh.is_boundary(vertex) {
            return 0.0;
        }
        let count = self.valence[vertex];
        let (from, to) = (self.rank[mesh.twin(before)], self.rank[after]);
        let apart = f64::from((to + count - from) % count) / f64::from(count);
        let length = |halfedge| mesh.edge_length(mesh.edge(halfedge));
        // A right angle is half way between straight on and back.
        2.0 * (2.0 * apart - 1.0).abs() * TURN * 0.5 * (length(before) + length(after))
    }

    /// How many edges meet at `vertex`, in constant time.
    pub(super) fn valence(&self, vertex: VertexId) -> u32 {
        self.valence[vertex]
    }

    /// The sum over edges.
    #[must_use]
    pub fn of(&self, edges: &[EdgeId]) -> f64 {
        edges.iter().map(|&edge| self.edges[edge]).sum()
    }
}

/// The rank of each halfedge around its origin, and the valences: walking around a vertex for every turn there would take cubic time.
fn ranks(mesh: &QuadMesh) -> (HalfedgeData<u32>, VertexData<u32>) {
    let mut rank = HalfedgeData::filled(mesh.halfedge_count(), 0);
    let valence = mesh.vertex_data(|vertex| {
        let mut count = 0;
        for halfedge in mesh.outgoing(vertex) {
            rank[halfedge] = count;
            count += 1;
        }
        count
    });
    (rank, valence)
}

/// The angle between the mean normals of the faces of each edge, in radians: positive where the surface is convex, 0 on the
/// boundary and beside faces of no area.
pub(super) fn bends(mesh: &QuadMesh) -> EdgeData<f64> {
    let normals = mesh.face_data(|face| normal(mesh, face));
    mesh.edge_data(|edge| {
        let halfedge = mesh.halfedge(edge);
        let faces = [halfedge, mesh.twin(halfedge)].map(|h| mesh.corner(h).map(|corner| mesh.face(corner)));
        let [Some(left), Some(right)] = faces else { return 0.0 };
        let (left, right) = (normals[left], normals[right]);
        let [a, b] = mesh.edge_vertices(edge);
        let along = mesh.position(b) - mesh.position(a);
        let turn = left.cross(&right);
        // Going along the left face's direction, convex edges turn the normal to the right.
        let sign = if turn.dot(&along) > 0.0 { 1.0 } else { -1.0 };
        let bend = turn.norm().atan2(left.dot(&right));
        if left.norm_squared() > 0.0 && right.norm_squared() > 0.0 { sign * bend } else { 0.0 }
    })
}

/// The mean normal of a face, of length one; zero when it has no area.
fn normal(mesh: &QuadMesh, face: FaceId) -> Vec3 {
    let sum: Vec3 = mesh
        .face_corners(face)
        .map(|corner| {
            let [next, previous] = mesh.corner_vectors(corner);
            next.cross(&previous)
        })
        .sum();
    sum.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::zeros)
}
