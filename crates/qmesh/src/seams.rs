//! Seams: edges along which a surface is to be opened, named by their two vertices.

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

    /// The edges, sorted.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = [u32; 2]> + '_ {
        self.pairs.iter().copied()
    }
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
