//! Which faces can be convex at all.
//!
//! A disk of quads has a map in which every quad is strictly convex if and only if no two quads have the same pair of
//! opposite vertices: a strictly convex face contains the open segment between any two of its vertices that are not
//! neighbours, so two faces with the same such pair would overlap; and without such pairs the graph is internally
//! 3-connected, so Tutte's embedding is such a map. With other faces among the quads, the pairs are all pairs of vertices
//! that are not adjacent in a face, and none may be an edge of the mesh either. One hash of the pairs tells.
//!
//! The quads concerned (doublets, bubbles) are *exempt*: they are held to the two corners at the shared vertices, which
//! is the split into two triangles along the other diagonal.

use std::collections::HashMap;

use qembed::qmesh::{CornerId, FaceId, Id, QuadMesh, VertexId};
use rayon::prelude::*;

/// The quads that no map can make convex.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exempt {
    pairs: HashMap<FaceId, [VertexId; 2]>,
    others: Vec<FaceId>,
}

impl Exempt {
    /// Finds them.
    #[must_use]
    pub fn find(mesh: &QuadMesh) -> Self {
        let mut exempt = Self::default();
        for (pair, faces) in shared_pairs(mesh) {
            for face in faces {
                if mesh.degree(face) == 4 {
                    exempt.pairs.entry(face).or_insert(pair);
                } else {
                    exempt.others.push(face);
                }
            }
        }
        exempt.others.sort_unstable();
        exempt.others.dedup();
        exempt
    }

    /// Whether [`find`](Self::find) finds the quad `face`, from its surroundings alone.
    #[must_use]
    pub fn contains(mesh: &QuadMesh, face: FaceId) -> bool {
        let mut pairs = diagonals(mesh, face).map(|(pair, _)| pair);
        mesh.degree(face) == 4
            && pairs.any(|[a, b]| {
                let mut others = mesh.vertex_corners(a).map(|corner| mesh.face(corner));
                others.any(|other| other != face && is_diagonal(mesh, other, [a, b]))
                    || mesh.neighbors(a).any(|vertex| vertex == b)
            })
    }

    /// The vertices whose corners certify `face`, when it is exempt.
    #[must_use]
    pub fn pair_of(&self, face: FaceId) -> Option<[VertexId; 2]> {
        self.pairs.get(&face).copied()
    }

    /// Whether `corner` cannot be held to turn left: it belongs to an exempt quad, away from the shared vertices.
    #[must_use]
    pub fn is_exempt(&self, mesh: &QuadMesh, corner: CornerId) -> bool {
        self.pair_of(mesh.face(corner)).is_some_and(|pair| !pair.contains(&mesh.vertex(corner)))
    }

    /// The exempt quads in order.
    #[must_use]
    pub fn faces(&self) -> Vec<FaceId> {
        let mut faces: Vec<FaceId> = self.pairs.keys().copied().collect();
        faces.sort_unstable();
        faces
    }

    /// Faces of other degrees that no map can make convex; there is no rule for them.
    #[must_use]
    pub fn impossible(&self) -> &[FaceId] {
        &self.others
    }

    /// Whether every face can be convex.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty() && self.others.is_empty()
    }
}

/// Faces that one task takes.
const GRAIN: usize = 4096;
/// Faces with more corners are not written out as pairs, of which they have as many as the square.
const MANY_CORNERS: usize = 24;

/// The pairs of vertices that stand in the way, each with the faces that contain it without an edge between. Of the pairs that two faces
/// with very many corners share only one is named.
fn shared_pairs(mesh: &QuadMesh) -> Vec<([VertexId; 2], Vec<FaceId>)> {
    let small = (0..mesh.face_count()).into_par_iter().with_min_len(GRAIN).map(FaceId::from_index);
    let small = small.filter(|&face| mesh.degree(face) <= MANY_CORNERS);
    let mut keys: Vec<([VertexId; 2], FaceId)> = small.flat_map_iter(|face| diagonals(mesh, face)).collect();
    let large = LargeFaces::new(mesh);
    if !large.corners.is_empty() {
        let own = keys.clone();
        let pairs =
            own.iter().map(|key| key.0).chain(mesh.edges().map(|edge| sorted(mesh.edge_vertices(edge))));
        pairs.for_each(|pair| keys.extend(large.with(pair).map(|face| (pair, face))));
        large.among_themselves(&mut keys);
    }
    keys.par_sort_unstable();
    keys.dedup();
    keys.chunk_by(|a, b| a.0 == b.0)
        .filter(|group| group.len() > 1 || mesh.neighbors(group[0].0[0]).any(|v| v == group[0].0[1]))
        .map(|group| (group[0].0, group.iter().map(|&(_, face)| face).collect()))
        .collect()
}

/// The pairs of vertices of a face that are not neighbours in it.
fn diagonals(mesh: &QuadMesh, face: FaceId) -> impl Iterator<Item = ([VertexId; 2], FaceId)> + '_ {
    let n = mesh.degree(face);
    let ends = move |i: usize| (i + 2..n).filter(move |&j| (i, j) != (0, n - 1));
    let vertex = move |k: usize| mesh.face_vertices(face).nth(k);
    (0..n).flat_map(move |i| ends(i).filter_map(move |j| Some((sorted([vertex(i)?, vertex(j)?]), face))))
}

/// Whether both are vertices of `face`, without an edge of it between.
fn is_diagonal(mesh: &QuadMesh, face: FaceId, [a, b]: [VertexId; 2]) -> bool {
    let place = |wanted| mesh.face_vertices(face).position(|vertex| vertex == wanted);
    place(a).zip(place(b)).is_some_and(|(i, j)| {
        let apart = i.abs_diff(j);
        apart > 1 && apart + 1 < mesh.degree(face)
    })
}

fn sorted([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    [a.min(b), a.max(b)]
}

/// The faces with many corners, by their vertices.
struct LargeFaces {
    /// Vertex, face, place in the face, degree of the face; sorted.
    corners: Vec<(VertexId, FaceId, usize, usize)>,
}

impl LargeFaces {
    fn new(mesh: &QuadMesh) -> Self {
        let large = mesh.faces().filter(|&face| mesh.degree(face) > MANY_CORNERS);
        let mut corners: Vec<_> = large
            .flat_map(|face| {
                let degree = mesh.degree(face);
                mesh.face_vertices(face).enumerate().map(move |(place, vertex)| (vertex, face, place, degree))
            })
            .collect();
        corners.sort_unstable();
        Self { corners }
    }

    fn at(&self, vertex: VertexId) -> &[(VertexId, FaceId, usize, usize)] {
        let start = self.corners.partition_point(|corner| corner.0 < vertex);
        let end = start + self.corners[start..].iter().take_while(|corner| corner.0 == vertex).count();
        &self.corners[start..end]
    }

    /// The faces that have both vertices, without an edge of theirs between.
    fn with(&self, [a, b]: [VertexId; 2]) -> impl Iterator<Item = FaceId> + '_ {
        let others = self.at(b);
        self.at(a).iter().filter_map(move |&(_, face, place, degree)| {
            let other = others.iter().find(|other| other.1 == face)?.2;
            let apart = place.abs_diff(other);
            (apart > 1 && apart + 1 < degree).then_some(face)
        })
    }

    /// A pair for every two of these faces that share one. Among six vertices that both have there are two that neither joins by an
    /// edge, if any are.
    fn among_themselves(&self, keys: &mut Vec<([VertexId; 2], FaceId)>) {
        const ENOUGH: usize = 6;
        let mut shared: HashMap<[FaceId; 2], Vec<VertexId>> = HashMap::new();
        for group in self.corners.chunk_by(|a, b| a.0 == b.0) {
            for (i, first) in group.iter().enumerate() {
                for second in &group[i + 1..] {
                    let vertices = shared.entry([first.1, second.1]).or_default();
                    if vertices.len() < ENOUGH {
                        vertices.push(first.0);
                    }
                }
            }
        }
        for (faces, vertices) in shared {
            let pairs =
                vertices.iter().enumerate().flat_map(|(i, &a)| vertices[..i].iter().map(move |&b| [b, a]));
            let found =
                pairs.into_iter().find(|&pair| faces.iter().all(|&face| self.with(pair).any(|f| f == face)));
            keys.extend(found.into_iter().flat_map(|pair| faces.map(|face| (pair, face))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of `n` quads around one face with `n` corners.
    fn drum(n: u32) -> QuadMesh {
        let positions: Vec<[f64; 3]> = (0..2 * n)
            .map(|v| {
                let angle = std::f64::consts::TAU * f64::from(v % n) / f64::from(n);
                [angle.cos(), angle.sin(), f64::from(v / n)]
            })
            .collect();
        let mut faces: Vec<Vec<u32>> = vec![(0..n).rev().collect()];
        faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
        QuadMesh::from_slices(&positions, faces).expect("a drum")
    }

    /// Written out as pairs or not, faces with many corners get the same verdict: a drum can be convex.
    #[test]
    fn many_corners_are_no_obstacle() {
        for n in [8, 24, 25, 400, 50_000] {
            let exempt = Exempt::find(&drum(n));
            assert!(exempt.is_empty(), "{n}: {} impossible", exempt.impossible().len());
        }
    }

    /// A quad across a large face (both have its opposite vertices) is exempt, the large face impossible, however many corners it has.
    #[test]
    fn a_quad_across_a_large_face_is_found() {
        for n in [8_u32, 25, 300] {
            let mut faces: Vec<Vec<u32>> = vec![(0..n).collect()];
            // Opposite vertices 0 and 4 of the quad are both in the large face.
            faces.push(vec![1, 0, n, 2]);
            faces.push(vec![2, n, 4, 3]);
            let positions: Vec<[f64; 3]> =
                (0..=n).map(|v| [f64::from(v).cos(), f64::from(v).sin(), f64::from(v)]).collect();
            let Ok(mesh) = QuadMesh::from_slices(&positions, faces) else { panic!("a mesh") };
            let exempt = Exempt::find(&mesh);
            assert_eq!(exempt.impossible(), [FaceId(0)], "{n}");
            assert_eq!(exempt.faces(), [FaceId(1), FaceId(2)], "{n}");
        }
    }
}
