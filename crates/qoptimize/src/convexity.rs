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

use qembed::qmesh::{CornerId, FaceId, QuadMesh, VertexId};

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

/// The pairs of vertices that stand in the way, each with the faces that contain it without an edge between.
fn shared_pairs(mesh: &QuadMesh) -> Vec<([VertexId; 2], Vec<FaceId>)> {
    let mut keys: Vec<([VertexId; 2], FaceId)> = Vec::with_capacity(2 * mesh.face_count());
    for face in mesh.faces() {
        let vertices: Vec<VertexId> = mesh.face_vertices(face).collect();
        let n = vertices.len();
        for i in 0..n {
            for j in i + 2..n {
                if (i, j) != (0, n - 1) {
                    let pair = [vertices[i].min(vertices[j]), vertices[i].max(vertices[j])];
                    keys.push((pair, face));
                }
            }
        }
    }
    keys.sort_unstable();
    keys.chunk_by(|a, b| a.0 == b.0)
        .filter(|group| group.len() > 1 || mesh.neighbors(group[0].0[0]).any(|v| v == group[0].0[1]))
        .map(|group| (group[0].0, group.iter().map(|&(_, face)| face).collect()))
        .collect()
}
