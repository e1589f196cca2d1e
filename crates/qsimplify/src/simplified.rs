//! What is left, and the record of what was removed.

use qcurv::qmesh::{Components, ElementData, Polygons, QuadMesh, VertexData, VertexId};

/// The simplified mesh and the record of what was removed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Simplified {
    /// Whether each vertex is kept. Boundary vertices always are.
    pub kept: VertexData<bool>,
    /// The removed vertices in the order of their removal.
    pub removed: Vec<VertexId>,
    /// How many interior vertices lay on the removed side of the threshold: all with rule `All`, none with `None`.
    pub candidates: usize,
    /// The edges of Eq. 5, each once, smaller vertex first, sorted. With rule `Carrier`, those of the full mesh.
    pub springs: Vec<[VertexId; 2]>,
    /// The faces of the simplified polygon mesh over the vertices of the full mesh, flat as in [`Polygons`]. With rule
    /// `Carrier`, those of the full mesh. With rules `Naive` and `All`, one polygon for each region of merged faces, as
    /// far as it has one: what hangs together with the boundary; islands, chains and isolated vertices are not shown.
    pub face_start: Vec<u32>,
    /// The vertices of those faces.
    pub face_vertex: Vec<VertexId>,
}

/// How well the kept interior vertices are held by the springs. For Eq. 5 to have one solution none may be cut off, for
/// its faces to have area none may have fewer than three springs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Connectivity {
    /// Kept vertices inside.
    pub interior: usize,
    /// Those without a spring.
    pub isolated: usize,
    /// Those with one spring: each falls onto its neighbour.
    pub degree_1: usize,
    /// Those with two springs: each comes to lie on a line between its neighbours.
    pub degree_2: usize,
    /// Those that no chain of springs joins with the boundary, isolated ones included: nothing says where they lie.
    pub cut_off: usize,
}

impl Simplified {
    /// The simplified mesh as polygons, for looking at it: the kept vertices, and those of the faces where rule `Carrier`
    /// shows removed ones, renumbered in their order.
    ///
    /// # Panics
    /// When `self` was made from a mesh with other vertices.
    #[must_use]
    pub fn polygons(&self, mesh: &QuadMesh) -> Polygons {
        assert_eq!(self.kept.len(), mesh.vertex_count(), "the mesh that was simplified");
        let mut shown = self.kept.clone();
        for &vertex in &self.face_vertex {
            shown[vertex] = true;
        }
        let mut number: VertexData<u32> = ElementData::filled(shown.len(), u32::MAX);
        let mut positions = Vec::new();
        for vertex in mesh.vertices().filter(|&v| shown[v]) {
            number[vertex] = positions.len() as u32;
            positions.push(mesh.position(vertex));
        }
        let corner_vertex = self.face_vertex.iter().map(|&v| number[v]).collect();
        Polygons { positions, face_start: self.face_start.clone(), corner_vertex }
    }

    /// Counts the kept interior vertices that Eq. 5 cannot hold or cannot spread out.
    ///
    /// # Panics
    /// When `self` was made from a mesh with other vertices.
    #[must_use]
    pub fn connectivity(&self, mesh: &QuadMesh) -> Connectivity {
        assert_eq!(self.kept.len(), mesh.vertex_count(), "the mesh that was simplified");
        let attached = self.attached(mesh);
        let mut degree: VertexData<u32> = ElementData::filled(mesh.vertex_count(), 0);
        for vertex in self.springs.iter().flatten() {
            degree[*vertex] += 1;
        }
        let mut connectivity = Connectivity::default();
        for vertex in mesh.vertices().filter(|&v| self.kept[v] && !mesh.is_boundary(v)) {
            connectivity.interior += 1;
            connectivity.isolated += usize::from(degree[vertex] == 0);
            connectivity.degree_1 += usize::from(degree[vertex] == 1);
            connectivity.degree_2 += usize::from(degree[vertex] == 2);
            connectivity.cut_off += usize::from(!attached[vertex.index()]);
        }
        connectivity
    }

    /// Whether springs join each vertex with the boundary.
    pub(crate) fn attached(&self, mesh: &QuadMesh) -> Vec<bool> {
        let mut components = Components::new(mesh.vertex_count());
        for [a, b] in &self.springs {
            components.join(a.0, b.0);
        }
        components.with_any(mesh.vertices().filter(|&v| mesh.is_boundary(v)).map(|v| v.0))
    }

    /// The mesh as it is, nothing removed.
    pub(crate) fn full(mesh: &QuadMesh) -> Self {
        let mut springs: Vec<[VertexId; 2]> = mesh
            .edges()
            .map(|edge| {
                let [a, b] = mesh.edge_vertices(edge);
                [a.min(b), a.max(b)]
            })
            .collect();
        springs.sort_unstable();
        let view = mesh.view();
        Self {
            kept: VertexData::filled(mesh.vertex_count(), true),
            removed: Vec::new(),
            candidates: 0,
            springs,
            face_start: view.face_start.to_vec(),
            face_vertex: view.corner_vertex.iter().map(|&v| VertexId(v)).collect(),
        }
    }

    /// Marks all of `candidates` as removed; springs and faces stay.
    pub(crate) fn remove(&mut self, candidates: &[VertexId]) {
        self.candidates = candidates.len();
        self.removed = candidates.to_vec();
        for &vertex in candidates {
            self.kept[vertex] = false;
        }
    }
}
