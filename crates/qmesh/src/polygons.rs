//! Polygons as flat arrays: what files hold, what meshes are built from, and what measures read.

use crate::Vec3;

/// A borrowed list of polygons over shared positions. Nothing about it is checked.
///
/// Corner `i` of face `f` is `corner_vertex[face_start[f] + i]`.
#[derive(Clone, Copy, Debug)]
pub struct PolygonView<'a> {
    /// One position per vertex.
    pub positions: &'a [Vec3],
    /// Where each face's corners start, and one entry more for the end: `#F + 1` values.
    pub face_start: &'a [u32],
    /// The vertex of each corner, face after face: `#C` values.
    pub corner_vertex: &'a [u32],
}

impl<'a> PolygonView<'a> {
    /// How many faces there are.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.face_start.len().saturating_sub(1)
    }

    /// How many corners there are.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.corner_vertex.len()
    }

    /// The corner indices of face `face`.
    #[must_use]
    pub fn corners(&self, face: usize) -> std::ops::Range<usize> {
        self.face_start[face] as usize..self.face_start[face + 1] as usize
    }

    /// The vertices of face `face`.
    #[must_use]
    pub fn face(&self, face: usize) -> &'a [u32] {
        &self.corner_vertex[self.corners(face)]
    }
}

impl PolygonView<'_> {
    /// The same polygons, copied.
    #[must_use]
    pub fn to_polygons(&self) -> Polygons {
        Polygons {
            positions: self.positions.to_vec(),
            face_start: self.face_start.to_vec(),
            corner_vertex: self.corner_vertex.to_vec(),
        }
    }
}

/// An owned list of polygons over shared positions.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub struct Polygons {
    /// One position per vertex.
    pub positions: Vec<Vec3>,
    /// Where each face's corners start, and one entry more for the end.
    pub face_start: Vec<u32>,
    /// The vertex of each corner, face after face.
    pub corner_vertex: Vec<u32>,
}

impl Polygons {
    /// Polygons from positions and faces given as lists of vertex indices.
    ///
    /// ```
    /// let square = qmesh::Polygons::new(
    ///     &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ///     [[0, 1, 2, 3]],
    /// );
    /// assert_eq!(square.view().face(0), [0, 1, 2, 3]);
    /// ```
    #[must_use]
    pub fn new<F: AsRef<[u32]>>(positions: &[[f64; 3]], faces: impl IntoIterator<Item = F>) -> Self {
        let mut polygons = Self {
            positions: positions.iter().map(|&p| Vec3::from(p)).collect(),
            face_start: vec![0],
            corner_vertex: Vec::new(),
        };
        for face in faces {
            polygons.push_face(face.as_ref());
        }
        polygons
    }

    /// Appends a face.
    pub fn push_face(&mut self, vertices: &[u32]) {
        if self.face_start.is_empty() {
            self.face_start.push(0);
        }
        self.corner_vertex.extend_from_slice(vertices);
        self.face_start.push(self.corner_vertex.len() as u32);
    }

    /// The same polygons, borrowed.
    #[must_use]
    pub fn view(&self) -> PolygonView<'_> {
        PolygonView {
            positions: &self.positions,
            face_start: &self.face_start,
            corner_vertex: &self.corner_vertex,
        }
    }
}
