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
        let edges = Pairs::of_edges(view);
        let mut counts = [0; 2];
        edges.groups().for_each(|(_, count)| {
            counts[0] += 1;
            counts[1] += usize::from(count == 1);
        });
        let mut used = vec![false; view.positions.len()];
        view.corner_vertex.iter().for_each(|&vertex| used[vertex as usize] = true);
        Self {
            edges: counts[0],
            boundary_edges: counts[1],
            unused_vertices: used.iter().filter(|&&used| !used).count(),
        }
    }
}

impl Connectivity {
    pub(crate) fn new(view: PolygonView<'_>) -> Self {
        let mut result = Self::default();
        let mut valence = vec![0_usize; view.positions.len()];
        let mut boundary = vec![false; view.positions.len()];
        for (ends, count) in Pairs::of_edges(view).groups() {
            result.edges += 1;
            result.boundary_edges += usize::from(count == 1);
            result.nonmanifold_edges += usize::from(count > 2);
            for vertex in ends {
                valence[vertex as usize] += 1;
                boundary[vertex as usize] |= count == 1;
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

/// Pairs of vertices, those of the same lower vertex together: in linear time, where sorting them all would take longer than the map of a
/// plain mesh takes to be written.
struct Pairs {
    start: Vec<u32>,
    /// The higher vertices, ascending for each lower one.
    high: Vec<u32>,
}

impl Pairs {
    fn of_edges(view: PolygonView<'_>) -> Self {
        let faces = || (0..view.face_count()).map(|face| view.face(face));
        Self::new(view.positions.len(), || faces().flat_map(sides).map(ordered))
    }

    fn new<I: Iterator<Item = [u32; 2]>>(vertices: usize, pairs: impl Fn() -> I) -> Self {
        // Two places ahead, so that the starts, moved on while pairs find their places, end up where they belong.
        let mut start = vec![0_u32; vertices + 2];
        let mut count = 0;
        for [low, _] in pairs() {
            start[low as usize + 2] += 1;
            count += 1;
        }
        for vertex in 2..vertices + 2 {
            start[vertex] += start[vertex - 1];
        }
        let mut high = vec![0; count];
        for [low, other] in pairs() {
            let place = &mut start[low as usize + 1];
            high[*place as usize] = other;
            *place += 1;
        }
        start.pop();
        start.windows(2).for_each(|range| high[range[0] as usize..range[1] as usize].sort_unstable());
        Self { start, high }
    }

    /// Each pair that there is, and how often.
    fn groups(&self) -> impl Iterator<Item = ([u32; 2], usize)> + '_ {
        self.start.windows(2).enumerate().flat_map(|(low, range)| {
            let high = &self.high[range[0] as usize..range[1] as usize];
            high.chunk_by(|a, b| a == b).map(move |same| ([low as u32, same[0]], same.len()))
        })
    }
}

fn repeated_faces(view: PolygonView<'_>) -> usize {
    let sorted = |face: usize| {
        let mut vertices = view.face(face).to_vec();
        vertices.sort_unstable();
        vertices
    };
    // Only faces with the same sum can have the same vertices. The factors are those of SplitMix64.
    let mixed = |vertex: u32| {
        let mixed = u64::from(vertex).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(31);
        mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9)
    };
    let sum = |face: usize| view.face(face).iter().map(|&vertex| mixed(vertex)).fold(0, u64::wrapping_add);
    let mut faces: Vec<(u64, u32)> =
        (0..view.face_count()).into_par_iter().map(|face| (sum(face), face as u32)).collect();
    faces.par_sort_unstable();
    let alike = faces.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
    alike
        .map(|group| {
            let mut group: Vec<Vec<u32>> = group.iter().map(|&(_, face)| sorted(face as usize)).collect();
            group.sort_unstable();
            group.windows(2).filter(|pair| pair[0] == pair[1]).count()
        })
        .sum()
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
    let quads = || (0..view.face_count()).map(|face| view.face(face)).filter(|face| face.len() == 4);
    let diagonals = || quads().flat_map(|face| [ordered([face[0], face[2]]), ordered([face[1], face[3]])]);
    Pairs::new(view.positions.len(), diagonals).groups().filter(|&(_, count)| count > 1).count()
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
