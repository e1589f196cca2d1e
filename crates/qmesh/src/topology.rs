//! What a mesh is as a surface: components, boundary loops, Euler characteristic, genus.

use crate::data::FaceData;
use crate::ids::{CornerId, FaceId, HalfedgeId, Id, VertexId};
use crate::mesh::QuadMesh;

/// The topology of a mesh in numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Topology {
    /// Connected pieces; faces that touch only in a vertex are never in one mesh.
    pub components: usize,
    /// Closed walks along the boundary.
    pub boundary_loops: usize,
    /// `χ = #V − #E + #F`.
    pub euler_characteristic: i64,
    /// Handles, summed over the components: `(2·components − loops − χ) / 2`.
    pub genus: i64,
}

impl Topology {
    /// Whether the mesh is one component that can be flattened without a cut, and without a hole.
    #[must_use]
    pub fn is_disk(&self) -> bool {
        self.components == 1 && self.boundary_loops == 1 && self.genus == 0
    }
}

impl QuadMesh {
    /// Counts components, boundary loops, `χ` and genus.
    #[must_use]
    pub fn topology(&self) -> Topology {
        let components = self.components().1;
        let boundary_loops = self.boundary_loops().len();
        let euler_characteristic = self.euler_characteristic();
        let genus = (2 * components as i64 - boundary_loops as i64 - euler_characteristic) / 2;
        Topology { components, boundary_loops, euler_characteristic, genus }
    }

    /// `χ = #V − #E + #F`.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// The component of each face, numbered by first face, and how many there are.
    #[must_use]
    pub fn components(&self) -> (FaceData<u32>, usize) {
        const UNSEEN: u32 = u32::MAX;
        let mut component = FaceData::filled(self.face_count(), UNSEEN);
        let mut count = 0;
        let mut stack = Vec::new();
        for seed in self.faces() {
            if component[seed] != UNSEEN {
                continue;
            }
            component[seed] = count;
            stack.push(seed);
            while let Some(face) = stack.pop() {
                for neighbor in self.adjacent_faces(face) {
                    if component[neighbor] == UNSEEN {
                        component[neighbor] = count;
                        stack.push(neighbor);
                    }
                }
            }
            count += 1;
        }
        (component, count as usize)
    }

    /// The faces across the edges of `face`.
    fn adjacent_faces(&self, face: FaceId) -> impl Iterator<Item = FaceId> + '_ {
        self.face_corners(face)
            .filter_map(|corner| self.corner(self.twin(corner.halfedge())))
            .map(|corner: CornerId| self.face(corner))
    }

    /// The boundary loops, each as its boundary halfedges in walking order (the surface lies to their right).
    #[must_use]
    pub fn boundary_loops(&self) -> Vec<Vec<HalfedgeId>> {
        let inner = self.corner_count();
        let mut seen = vec![false; self.halfedge_count() - inner];
        let mut loops = Vec::new();
        for start in self.boundary_halfedges() {
            if seen[start.index() - inner] {
                continue;
            }
            let mut walk = Vec::new();
            let mut current = start;
            while !std::mem::replace(&mut seen[current.index() - inner], true) {
                walk.push(current);
                current = self.next(current);
            }
            loops.push(walk);
        }
        loops
    }

    /// The vertices of a boundary loop with the surface on the left: counter-clockwise for an outer loop in the plane.
    #[must_use]
    pub fn loop_vertices(&self, halfedges: &[HalfedgeId]) -> Vec<VertexId> {
        halfedges.iter().rev().map(|&halfedge| self.origin(halfedge)).collect()
    }
}

/// How many faces of each kind there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FaceCounts {
    /// Faces with three corners.
    pub triangles: usize,
    /// Faces with four corners.
    pub quads: usize,
    /// Faces with five corners or more.
    pub polygons: usize,
}

impl QuadMesh {
    /// How many triangles, quads and larger polygons there are.
    #[must_use]
    pub fn face_counts(&self) -> FaceCounts {
        let mut counts = FaceCounts::default();
        for face in (0..self.face_count()).map(FaceId::from_index) {
            match self.degree(face) {
                3 => counts.triangles += 1,
                4 => counts.quads += 1,
                _ => counts.polygons += 1,
            }
        }
        counts
    }
}
