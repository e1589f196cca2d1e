//! Faces with many corners, whose pairs are not written out.
//!
//! Which of them share two vertices is asked of the graph whose nodes are these faces and their vertices, each face joined to its
//! vertices: what share two is a cycle of four. Every such cycle is found from its highest node, by way of lower ones [Chiba,
//! Nishizeki 1985, "Arboricity and subgraph listing algorithms"]: on a surface that takes about as long as there are corners, though
//! all faces may meet in one vertex.

use qembed::qmesh::{FaceId, QuadMesh, VertexId};

use super::{Key, MANY_CORNERS, sorted};

/// One of their corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct LargeCorner {
    vertex: VertexId,
    face: FaceId,
    /// Its place in the face.
    place: usize,
    degree: usize,
}

impl LargeCorner {
    /// Whether the face has no edge between this one and `other`, which is of the same face.
    fn is_apart(&self, other: &Self) -> bool {
        let apart = self.place.abs_diff(other.place);
        apart > 1 && apart + 1 < self.degree
    }
}

/// The faces with many corners, by their vertices.
pub(super) struct LargeFaces<'a> {
    mesh: &'a QuadMesh,
    /// Sorted.
    corners: Vec<LargeCorner>,
}

impl<'a> LargeFaces<'a> {
    pub(super) fn new(mesh: &'a QuadMesh) -> Self {
        let large = mesh.faces().filter(|&face| mesh.degree(face) > MANY_CORNERS);
        let mut corners: Vec<_> = large.flat_map(|face| corners_of(mesh, face)).collect();
        corners.sort_unstable();
        Self { mesh, corners }
    }

    /// Adds these faces to the pairs of others that they have, to edges, and a pair for those that share one among themselves.
    pub(super) fn extend(&self, keys: &mut Vec<Key>) {
        if self.corners.is_empty() {
            return;
        }
        for i in 0..keys.len() {
            let pair = keys[i].0;
            keys.extend(self.with(pair).map(|face| (pair, face)));
        }
        for pair in self.mesh.edges().map(|edge| sorted(self.mesh.edge_vertices(edge))) {
            keys.extend(self.with(pair).map(|face| (pair, face)));
        }
        for corners in self.corners.chunk_by(|a, b| a.vertex == b.vertex) {
            self.around_vertex(corners, keys);
        }
        for face in self.mesh.faces().filter(|&face| self.mesh.degree(face) > MANY_CORNERS) {
            self.around_face(face, keys);
        }
    }

    /// The corners at `vertex`, by face.
    fn at(&self, vertex: VertexId) -> &[LargeCorner] {
        let start = self.corners.partition_point(|corner| corner.vertex < vertex);
        let count = self.corners[start..].partition_point(|corner| corner.vertex == vertex);
        &self.corners[start..start + count]
    }

    /// The faces that have both vertices, without an edge of theirs between. Takes as long as the vertex with fewer faces has some.
    fn with(&self, [a, b]: [VertexId; 2]) -> impl Iterator<Item = FaceId> + '_ {
        let (mut few, mut many) = (self.at(a), self.at(b));
        if few.len() > many.len() {
            std::mem::swap(&mut few, &mut many);
        }
        few.iter().filter_map(|corner| {
            let other = many.binary_search_by_key(&corner.face, |other| other.face).ok()?;
            corner.is_apart(&many[other]).then_some(corner.face)
        })
    }

    /// The pairs of the vertex of `corners` with another that several of its faces have.
    fn around_vertex(&self, corners: &[LargeCorner], keys: &mut Vec<Key>) {
        let mut pairs = self.opposite_of_vertex(corners);
        pairs.sort_unstable();
        let shared = pairs.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        keys.extend(shared.flatten());
    }

    /// What is over there by way of lower nodes: pairs with lower vertices.
    fn opposite_of_vertex(&self, corners: &[LargeCorner]) -> Vec<Key> {
        let by_way_of = corners.iter().filter(|corner| corner.degree <= corners.len());
        let pairs = by_way_of.flat_map(|corner| {
            let apart = corners_of(self.mesh, corner.face).filter(|other| corner.is_apart(other));
            apart.map(|other| ([corner.vertex, other.vertex], corner.face))
        });
        let is_lower = |[here, there]: [VertexId; 2]| (self.at(there).len(), there) < (corners.len(), here);
        pairs.filter(|&(pair, _)| is_lower(pair)).map(|(pair, face)| (sorted(pair), face)).collect()
    }

    /// A pair for each other face that shares one with `face`. Among six vertices that both have there are two that neither joins by an
    /// edge, if any are.
    fn around_face(&self, face: FaceId, keys: &mut Vec<Key>) {
        const ENOUGH: usize = 6;
        let mut corners = self.opposite_of_face(face);
        corners.sort_unstable_by_key(|[own, other]| (other.face, own.place));
        for shared in corners.chunk_by(|[_, a], [_, b]| a.face == b.face) {
            let shared = &shared[..shared.len().min(ENOUGH)];
            let pairs = shared.iter().enumerate().flat_map(|(i, a)| shared[..i].iter().map(move |b| (a, b)));
            let mut apart = pairs.filter(|(a, b)| a.iter().zip(b.iter()).all(|(a, b)| a.is_apart(b)));
            if let Some(([a, other], [b, _])) = apart.next() {
                let pair = sorted([a.vertex, b.vertex]);
                keys.extend([(pair, face), (pair, other.face)]);
            }
        }
    }

    /// What is over there by way of lower nodes: corners of `face`, each with one of a lower face at the same vertex.
    fn opposite_of_face(&self, face: FaceId) -> Vec<[LargeCorner; 2]> {
        let is_lower = |other: &LargeCorner| (other.degree, other.face) < (self.mesh.degree(face), face);
        let own = corners_of(self.mesh, face);
        let by_way_of = own.map(|own| (own, self.at(own.vertex))).filter(|(own, at)| at.len() < own.degree);
        by_way_of
            .flat_map(|(own, at)| at.iter().filter(|other| is_lower(other)).map(move |&other| [own, other]))
            .collect()
    }
}

fn corners_of(mesh: &QuadMesh, face: FaceId) -> impl Iterator<Item = LargeCorner> + '_ {
    let degree = mesh.degree(face);
    let vertices = mesh.face_vertices(face).enumerate();
    vertices.map(move |(place, vertex)| LargeCorner { vertex, face, place, degree })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{fan, slices};
    use super::*;

    /// What is over there, of all nodes together, is no more than a few times the corners: neither all faces around a vertex with each
    /// other, nor all corners of a face with all.
    #[test]
    fn work_grows_as_corners() {
        for mesh in [fan(2000, 26), fan(30, 26), fan(3, 4000), slices(1000, 12), slices(2, 4000)] {
            let large = LargeFaces::new(&mesh);
            let vertices = large.corners.chunk_by(|a, b| a.vertex == b.vertex);
            let of_vertices: usize = vertices.map(|corners| large.opposite_of_vertex(corners).len()).sum();
            let of_faces: usize = mesh.faces().map(|face| large.opposite_of_face(face).len()).sum();
            let corners = mesh.corner_count();
            assert!(of_vertices + of_faces <= 3 * corners, "{corners} corners, {of_vertices} {of_faces}");
            let mut keys = Vec::new();
            large.extend(&mut keys);
            assert!(keys.len() <= 3 * corners, "{corners} corners, {} keys", keys.len());
        }
    }
}
