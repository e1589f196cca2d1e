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

mod large;

use std::collections::HashMap;

use qembed::qmesh::{CornerId, FaceId, Id, QuadMesh, VertexId};
use rayon::prelude::*;

use self::large::LargeFaces;

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
                others.any(|other| other != face && is_diagonal(mesh, other, [a, b])) || is_edge(mesh, [a, b])
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

/// A pair of vertices of a face without an edge of it between, the lower first, and the face.
type Key = ([VertexId; 2], FaceId);

/// The pairs of vertices that stand in the way, each with the faces that contain it without an edge between. Of the pairs that two faces
/// with very many corners share only one is named.
fn shared_pairs(mesh: &QuadMesh) -> Vec<([VertexId; 2], Vec<FaceId>)> {
    let small = (0..mesh.face_count()).into_par_iter().with_min_len(GRAIN).map(FaceId::from_index);
    let small = small.filter(|&face| mesh.degree(face) <= MANY_CORNERS);
    let mut keys: Vec<Key> = small.flat_map_iter(|face| diagonals(mesh, face)).collect();
    LargeFaces::new(mesh).extend(&mut keys);
    keys.par_sort_unstable();
    keys.dedup();
    keys.chunk_by(|a, b| a.0 == b.0)
        .filter(|group| group.len() > 1 || is_edge(mesh, group[0].0))
        .map(|group| (group[0].0, group.iter().map(|&(_, face)| face).collect()))
        .collect()
}

/// Whether an edge joins the two.
fn is_edge(mesh: &QuadMesh, [a, b]: [VertexId; 2]) -> bool {
    neighbors_of_both(mesh, [a, b]).any(|[of_a, of_b]| of_a == b || of_b == a)
}

/// The neighbours of both side by side, as long as the one with fewer has some: where an edge joins the two, it is among those. Over all
/// diagonals of a surface that is a few for each; the neighbours of one end alone are, around a pole, as many as the square.
fn neighbors_of_both(mesh: &QuadMesh, [a, b]: [VertexId; 2]) -> impl Iterator<Item = [VertexId; 2]> + '_ {
    mesh.neighbors(a).zip(mesh.neighbors(b)).map(|(of_a, of_b)| [of_a, of_b])
}

/// The pairs of vertices of a face that are not neighbours in it.
fn diagonals(mesh: &QuadMesh, face: FaceId) -> impl Iterator<Item = Key> + '_ {
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

#[cfg(test)]
pub(crate) mod tests {
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

    /// `faces` around vertex 0, each with `degree` corners and an edge in common with the next, but for the last and the first.
    pub(super) fn fan(faces: u32, degree: u32) -> QuadMesh {
        let outer = degree - 2;
        let vertices = 1 + faces * outer + 1;
        let positions: Vec<[f64; 3]> = (0..vertices)
            .map(|v| {
                let angle = 6.0 * f64::from(v) / f64::from(vertices);
                if v == 0 { [0.0; 3] } else { [angle.cos(), angle.sin(), 0.0] }
            })
            .collect();
        let faces =
            (0..faces).map(|k| std::iter::once(0).chain(1 + k * outer..=1 + (k + 1) * outer).collect());
        QuadMesh::from_slices(&positions, faces.collect::<Vec<Vec<u32>>>()).expect("a fan")
    }

    /// Whether a diagonal is an edge too takes a look or two, even of those that end in a vertex of very many quads.
    #[test]
    fn a_pole_takes_no_more_than_other_vertices() {
        for count in [100, 5000] {
            let mesh = fan(count, 4);
            let pairs = mesh.faces().flat_map(|face| diagonals(&mesh, face));
            let looks: usize = pairs.map(|(pair, _)| neighbors_of_both(&mesh, pair).count()).sum();
            assert!(looks <= 10 * count as usize, "{count} quads, {looks} looks");
            assert!(Exempt::find(&mesh).is_empty());
        }
    }

    /// Slices of a sphere from pole to pole, all but one: every one has the same two vertices without an edge between.
    pub(super) fn slices(count: u32, inner: u32) -> QuadMesh {
        let line = |k: u32| 2 + (k * inner)..2 + (k + 1) * inner;
        let positions: Vec<[f64; 3]> = (0..2 + (count + 1) * inner)
            .map(|v| [f64::from(v).cos(), f64::from(v).sin(), f64::from(v)])
            .collect();
        let slice = |k: u32| {
            let there = std::iter::once(0).chain(line(k));
            there.chain(std::iter::once(1)).chain(line(k + 1).rev()).collect()
        };
        QuadMesh::from_slices(&positions, (0..count).map(slice).collect::<Vec<Vec<u32>>>()).expect("slices")
    }

    /// Large faces that share two vertices are found, two of them or many: from the vertex, and from the face.
    #[test]
    fn large_faces_that_share_a_pair_are_impossible() {
        for (count, inner) in [(2, 3), (2, 12), (2, 400), (40, 12), (2000, 12)] {
            let exempt = Exempt::find(&slices(count, inner));
            let all: Vec<FaceId> = (0..count).map(FaceId).collect();
            assert_eq!(exempt.impossible(), all, "{count} slices");
            assert!(exempt.faces().is_empty());
        }
    }
}
