//! Seams: edges along which a surface is to be opened, named by their two vertices.

use rayon::prelude::*;

use crate::polygons::PolygonView;

/// A set of edges, each as its two vertices in the caller's numbers, lower first.
///
/// ```
/// let mut seams = qmesh::Seams::from_iter([[3, 1], [1, 3], [2, 2]]);
/// assert!(seams.contains(1, 3) && seams.contains(3, 1) && seams.len() == 1);
/// seams.extend([[7, 5]]);
/// assert_eq!(seams.iter().collect::<Vec<_>>(), [[1, 3], [5, 7]]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Seams {
    /// Sorted, each once.
    pairs: Vec<[u32; 2]>,
}

impl Seams {
    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// How many edges there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether the edge between `a` and `b` is one.
    #[must_use]
    pub fn contains(&self, a: u32, b: u32) -> bool {
        self.pairs.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }

    /// The edges whose faces differ: `differ` is asked for pairs of faces that share an edge, with the corners of each at the
    /// edge's lower and at its higher vertex.
    #[must_use]
    pub fn between(polygons: PolygonView<'_>, differ: impl Fn([usize; 2], [usize; 2]) -> bool) -> Self {
        let differs = |group: &[Side]| group[1..].iter().any(|side| differ(group[0].1, side.1));
        of_edges(polygons, differs)
    }

    /// The edges of which each face differs from each other one, as [`between`](Self::between) asks for it: where of three faces two agree, the
    /// edge is none.
    #[must_use]
    pub fn among_all(polygons: PolygonView<'_>, differ: impl Fn([usize; 2], [usize; 2]) -> bool) -> Self {
        let differs = |group: &[Side]| {
            group.len() > 1
                && (1..group.len()).all(|i| group[..i].iter().all(|other| differ(other.1, group[i].1)))
        };
        of_edges(polygons, differs)
    }

    /// The edges, sorted.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = [u32; 2]> + '_ {
        self.pairs.iter().copied()
    }
}

/// An edge by its vertices, lower first, and the corners of one of its faces there.
type Side = ([u32; 2], [usize; 2]);

/// The edges whose faces' sides are as `is_seam` wants them.
fn of_edges(polygons: PolygonView<'_>, is_seam: impl Fn(&[Side]) -> bool) -> Seams {
    let mut sides: Vec<Side> = Vec::with_capacity(polygons.corner_count());
    for face in 0..polygons.face_count() {
        let corners = polygons.corners(face);
        for corner in corners.clone() {
            let next = if corner + 1 == corners.end { corners.start } else { corner + 1 };
            let [a, b] = [corner, next].map(|c| polygons.corner_vertex[c]);
            sides.push(if a < b { ([a, b], [corner, next]) } else { ([b, a], [next, corner]) });
        }
    }
    sides.par_sort_unstable();
    sides.chunk_by(|a, b| a.0 == b.0).filter(|group| is_seam(group)).map(|group| group[0].0).collect()
}

impl FromIterator<[u32; 2]> for Seams {
    fn from_iter<I: IntoIterator<Item = [u32; 2]>>(edges: I) -> Self {
        let mut seams = Self::default();
        seams.extend(edges);
        seams
    }
}

impl Extend<[u32; 2]> for Seams {
    /// Adds edges. One from a vertex to itself is none.
    fn extend<I: IntoIterator<Item = [u32; 2]>>(&mut self, edges: I) {
        let proper = edges.into_iter().filter(|[a, b]| a != b).map(|[a, b]| [a.min(b), a.max(b)]);
        self.pairs.extend(proper);
        self.pairs.sort_unstable();
        self.pairs.dedup();
    }
}
