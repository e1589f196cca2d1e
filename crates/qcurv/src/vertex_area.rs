//! The area attributed to a vertex: S of Eq. 2.

use qmesh::{QuadMesh, VertexData, VertexId};

use crate::area::face_areas;
use crate::par_data;
use crate::triangle::voronoi_cell_area;

/// Which area is attributed to a vertex (Eq. 2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VertexArea {
    /// The Voronoi cell of the vertex inside its corner triangles (Eqs. 3 and 4, corrected).
    #[default]
    Voronoi,
    /// The plain sum of the adjacent faces' areas, as the text under Eq. 2 says: on quads about four times as much.
    FaceSum,
}

/// S of Eq. 2, one value per vertex in squared units of length; never negative, 0 where every face at the vertex
/// has no area.
#[must_use]
pub fn vertex_areas(mesh: &QuadMesh, area: VertexArea) -> VertexData<f64> {
    match area {
        VertexArea::Voronoi => par_data(mesh.vertex_count(), |vertex| voronoi_area(mesh, vertex)),
        VertexArea::FaceSum => {
            let faces = face_areas(mesh);
            par_data(mesh.vertex_count(), |vertex| {
                mesh.vertex_corners(vertex).map(|corner| faces[mesh.face(corner)]).sum()
            })
        }
    }
}

fn voronoi_area(mesh: &QuadMesh, vertex: VertexId) -> f64 {
    let cell = |corner| {
        let [next, previous] = mesh.corner_vectors(corner);
        voronoi_cell_area(next, previous)
    };
    mesh.vertex_corners(vertex).map(cell).sum()
}
