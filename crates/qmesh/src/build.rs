//! From polygons to a mesh, or a refusal that names the elements.

mod check;
mod edges;
mod links;

pub(crate) use self::check::check_polygons;
use self::edges::Edges;
use self::links::{Links, Outgoing};
use crate::Vec3;
use crate::data::ElementData;
use crate::error::BuildError;
use crate::ids::FaceId;
use crate::mesh::QuadMesh;
use crate::polygons::Polygons;

pub(crate) const NONE: u32 = u32::MAX;

impl QuadMesh {
    /// Builds a mesh from polygons, in their order. Vertices that no face uses are left out
    /// ([`source_vertex`](Self::source_vertex) leads back); nothing else is changed or repaired.
    ///
    /// # Errors
    /// [`BuildError`] when the polygons are no oriented manifold, with the elements that say so.
    pub fn build(polygons: Polygons) -> Result<Self, BuildError> {
        check_polygons(polygons.view(), |face, vertex| Err(BuildError::RepeatedVertex { face, vertex }))?;
        let source_vertex_count = polygons.positions.len();
        let Polygons { positions, face_start, mut corner_vertex } = polygons;
        let (positions, source_vertex) = drop_unused_vertices(positions, &mut corner_vertex);
        let source = |vertex: u32| source_vertex.as_ref().map_or(vertex, |map| map[vertex as usize]);

        let corner_face = corner_faces(&face_start, corner_vertex.len(), FaceId);
        let fans = Outgoing::new(positions.len(), &corner_vertex);
        let links =
            Links { face_start: &face_start, corner_vertex: &corner_vertex, corner_face: &corner_face };
        let twin = links.twins(&fans).map_err(|error| error.with_vertices(&source))?;
        let vertex_halfedge =
            links.vertex_halfedges(&fans, &twin).map_err(|error| error.with_vertices(&source))?;
        let edges = Edges::new(&links, twin, &vertex_halfedge);
        Ok(Self {
            positions: ElementData::from_vec(positions),
            face_start,
            corner_vertex,
            corner_face,
            twin: edges.twin,
            halfedge_edge: edges.halfedge_edge,
            edge_halfedge: edges.edge_halfedge,
            boundary_next: edges.boundary_next,
            vertex_halfedge,
            source_vertex,
            source_vertex_count,
        })
    }

    /// Builds a mesh from slices: positions, and faces as lists of vertex indices from 0.
    ///
    /// ```
    /// let mesh = qmesh::QuadMesh::from_slices(
    ///     &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ///     [[0, 1, 2, 3]],
    /// )?;
    /// assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (4, 4, 1));
    /// # Ok::<(), qmesh::BuildError>(())
    /// ```
    ///
    /// # Errors
    /// As [`QuadMesh::build`].
    pub fn from_slices<F: AsRef<[u32]>>(
        positions: &[[f64; 3]],
        faces: impl IntoIterator<Item = F>,
    ) -> Result<Self, BuildError> {
        Self::build(Polygons::new(positions, faces))
    }
}

/// Renumbers the corners to the vertices in use and returns their positions, with the way back if any was dropped.
fn drop_unused_vertices(positions: Vec<Vec3>, corner_vertex: &mut [u32]) -> (Vec<Vec3>, Option<Vec<u32>>) {
    let mut used = vec![false; positions.len()];
    for &vertex in corner_vertex.iter() {
        used[vertex as usize] = true;
    }
    if used.iter().all(|&used| used) {
        return (positions, None);
    }
    let mut renumbered = vec![NONE; positions.len()];
    let mut source = Vec::new();
    for (old, _) in used.iter().enumerate().filter(|(_, used)| **used) {
        renumbered[old] = source.len() as u32;
        source.push(old as u32);
    }
    for vertex in corner_vertex.iter_mut() {
        *vertex = renumbered[*vertex as usize];
    }
    (source.iter().map(|&old| positions[old as usize]).collect(), Some(source))
}

/// The face of each corner, as `id` makes it of its number.
pub(crate) fn corner_faces<F: Clone>(
    face_start: &[u32],
    corner_count: usize,
    id: impl Fn(u32) -> F,
) -> Vec<F> {
    let mut faces = Vec::with_capacity(corner_count);
    for (face, pair) in (0..).zip(face_start.windows(2)) {
        faces.resize(pair[1] as usize, id(face));
    }
    faces
}

impl BuildError {
    /// Translates the vertices of connectivity errors back to the caller's.
    fn with_vertices(self, source: &impl Fn(u32) -> u32) -> Self {
        match self {
            Self::NonManifoldEdge { vertices, faces } => {
                Self::NonManifoldEdge { vertices: vertices.map(source), faces }
            }
            Self::InconsistentOrientation { vertices, faces } => {
                Self::InconsistentOrientation { vertices: vertices.map(source), faces }
            }
            Self::NonManifoldVertex { vertex, faces } => {
                Self::NonManifoldVertex { vertex: source(vertex), faces }
            }
            other => other,
        }
    }
}
