//! The record of what was mended.

/// How many places a record names.
const NAMED: usize = 8;

/// How often something was found, and where first.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Found<T> {
    /// How often.
    pub count: usize,
    /// The first places, eight at most.
    pub first: Vec<T>,
}

impl<T> Default for Found<T> {
    fn default() -> Self {
        Self { count: 0, first: Vec::new() }
    }
}

impl<T> Found<T> {
    pub(super) fn push(&mut self, place: T) {
        self.count += 1;
        if self.first.len() < NAMED {
            self.first.push(place);
        }
    }
}

/// What had to be mended to make charts of polygons, in the caller's numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub struct Repairs {
    /// Edges with more than two faces, as their vertices: seams.
    pub nonmanifold_edges: Found<[u32; 2]>,
    /// Vertices whose faces form fans that only the vertex joins: split in the charts.
    pub nonmanifold_vertices: Found<u32>,
    /// Faces that run against their neighbours: turned over in their chart.
    pub flipped_faces: Found<u32>,
    /// Edges along which surfaces with one side only had to be opened.
    pub one_sided_edges: Found<[u32; 2]>,
    /// Faces with the vertices of an earlier face, in the same or the opposite direction: they lie in a second layer.
    pub doubled_faces: Found<u32>,
    /// Faces that visit a vertex more than once: charts of their own.
    pub repeated_corner_faces: Found<u32>,
}

impl Repairs {
    /// Whether nothing had to be mended.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
