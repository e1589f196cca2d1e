//! Who is joined to whom, counted on bare polygons: nothing is assumed about them.

use std::collections::BTreeMap;

use qoptimize::qmesh::PolygonView;
use rayon::prelude::*;
use serde::Serialize;

/// Counts of edges and vertices, and what is unusual among them.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Connectivity {
    pub(crate) edges: usize,
    pub(crate) boundary_edges: usize,
    /// Edges of more than two faces.
    pub(crate) nonmanifold_edges: usize,
    /// Vertices in no face.
    pub(crate) unused_vertices: usize,
    /// Faces on the same vertices as an earlier face.
    pub(crate) repeated_faces: usize,
    /// Interior vertices of valence 2 between two quads.
    pub(crate) doublets: usize,
    /// Vertex pairs that lie opposite each other in several quads: those cannot all be convex in one map.
    pub(crate) shared_diagonals: usize,
    /// How many interior vertices have each number of edges.
    pub(crate) interior_valences: BTreeMap<usize, usize>,
    /// How many boundary vertices have each number of edges.
    pub(crate) boundary_valences: BTreeMap<usize, usize>,
}

/// Counts of edges and of vertices without faces.
pub(crate) struct Edges {
    pub(crate) edges: usize,
    pub(crate) boundary_edges: usize,
    pub(crate) unused_vertices: usize,
}

impl Edges {
    pub(crate) fn count(view: PolygonView<'_>) -> Self {
        let faces = (0..view.face_count()).map(|face| view.face(face));
        let mut edges: Vec<[u32; 2]> = faces.flat_map(sides).map(ordered).collect();
        edges.par_sort_unstable();
        let groups = || edges.chunk_by(|a, b| a == b);
        let mut used = vec![false; view.positions.len()];
        view.corner_vertex.iter().for_each(|&vertex| used[vertex as usize] = true);
        Self {
            edges: groups().count(),
            boundary_edges: groups().filter(|group| group.len() == 1).count(),
            unused_vertices: used.iter().filter(|&&used| !used).count(),
        }
    }
}

impl Connectivity {
    pub(crate) fn new(view: PolygonView<'_>) -> Self {
        let faces = || (0..view.face_count()).map(|face| view.face(face));
        let mut edges: Vec<[u32; 2]> = faces().flat_map(sides).map(ordered).collect();
        edges.sort_unstable();
        let mut result = Self::default();
        let mut valence = vec![0_usize; view.positions.len()];
        let mut boundary = vec![false; view.positions.len()];
        for group in edges.chunk_by(|a, b| a == b) {
            result.edges += 1;
            result.boundary_edges += usize::from(group.len() == 1);
            result.nonmanifold_edges += usize::from(group.len() > 2);
            for &vertex in &group[0] {
                valence[vertex as usize] += 1;
                boundary[vertex as usize] |= group.len() == 1;
            }
        }
        for (&valence, &boundary) in valence.iter().zip(&boundary).filter(|&(&valence, _)| valence > 0) {
            let histogram =
                if boundary { &mut result.boundary_valences } else { &mut result.interior_valences };
            *histogram.entry(valence).or_default() += 1;
        }
        let mut touched = vec![false; view.positions.len()];
        view.corner_vertex.iter().for_each(|&vertex| touched[vertex as usize] = true);
        result.unused_vertices = touched.iter().filter(|&&used| !used).count();
        result.repeated_faces = repeated_faces(view);
        result.doublets = doublets(view, &valence, &boundary);
        result.shared_diagonals = shared_diagonals(view);
        result
    }

    /// `4: 1 200, 3: 4, 5: 4; on the boundary 3: 60, 2: 4`.
    pub(crate) fn valences_text(&self) -> String {
        let list = |histogram: &BTreeMap<usize, usize>| {
            histogram
                .iter()
                .map(|(valence, &count)| format!("{valence}: {}", crate::table::grouped(count)))
                .collect::<Vec<_>>()
                .join(", ")
        };
        match (self.interior_valences.is_empty(), self.boundary_valences.is_empty()) {
            (_, true) => list(&self.interior_valences),
            (true, false) => format!("on the boundary {}", list(&self.boundary_valences)),
            (false, false) => {
                format!(
                    "{}; on the boundary {}",
                    list(&self.interior_valences),
                    list(&self.boundary_valences)
                )
            }
        }
    }
}

fn sides(face: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..face.len()).map(|i| [face[i], face[(i + 1) % face.len()]])
}

fn ordered([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn repeated_faces(view: PolygonView<'_>) -> usize {
    let mut faces: Vec<Vec<u32>> = (0..view.face_count())
        .map(|face| {
            let mut vertices = view.face(face).to_vec();
            vertices.sort_unstable();
            vertices
        })
        .collect();
    faces.sort_unstable();
    faces.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

/// An interior vertex with two edges lies in two faces that have both its edges in common.
fn doublets(view: PolygonView<'_>, valence: &[usize], boundary: &[bool]) -> usize {
    let mut quads = vec![0_usize; valence.len()];
    for face in (0..view.face_count()).map(|face| view.face(face)).filter(|face| face.len() == 4) {
        face.iter().for_each(|&vertex| quads[vertex as usize] += 1);
    }
    (0..valence.len()).filter(|&v| valence[v] == 2 && !boundary[v] && quads[v] == 2).count()
}

fn shared_diagonals(view: PolygonView<'_>) -> usize {
    let mut diagonals: Vec<[u32; 2]> = (0..view.face_count())
        .map(|face| view.face(face))
        .filter(|face| face.len() == 4)
        .flat_map(|face| [ordered([face[0], face[2]]), ordered([face[1], face[3]])])
        .collect();
    diagonals.sort_unstable();
    diagonals.chunk_by(|a, b| a == b).filter(|group| group.len() > 1).count()
}

#[cfg(test)]
mod tests {
    use qoptimize::qmesh::Polygons;

    use super::Connectivity;

    /// Two quads glued along two consecutive edges: the vertex between has valence 2, and both quads have the
    /// diagonal that does not meet it in common.
    #[test]
    fn a_doublet_is_one_vertex_and_one_shared_diagonal() {
        let mesh = Polygons::new(&[[0.0; 3]; 6], [[0, 1, 2, 3], [0, 3, 2, 4]]);
        let found = Connectivity::new(mesh.view());
        assert_eq!((found.doublets, found.shared_diagonals), (1, 1));
        assert_eq!((found.edges, found.boundary_edges, found.unused_vertices), (6, 4, 1));
        assert_eq!(found.valences_text(), "2: 1; on the boundary 2: 2, 3: 2");
    }

    #[test]
    fn what_is_not_manifold_is_counted() {
        let mesh = Polygons::new(&[[0.0; 3]; 8], [[0, 1, 2, 3], [1, 0, 4, 5], [0, 1, 6, 7], [3, 2, 1, 0]]);
        let found = Connectivity::new(mesh.view());
        assert_eq!((found.nonmanifold_edges, found.repeated_faces), (1, 1));
    }
}
