//! Charts: oriented manifold pieces of any polygons, opened along seams, with the way back.
//!
//! Files hold what no [`QuadMesh`] can be: edges with three faces, fans that touch in a vertex, faces turned over,
//! surfaces with one side only, the same face twice. None of that stands in the way of UVs, which may split where
//! geometry cannot. [`cut`] therefore makes one mesh of each piece that is connected through edges that are no seam:
//!
//! - an edge with more than two faces is a seam;
//! - a vertex becomes one vertex for each fan of faces around it that no edge joins: vertices are split in the
//!   charts, never in the caller's polygons;
//! - faces are turned over until neighbours agree, across seams too: the fewer of all that hang together;
//! - where that is impossible (Möbius strips, Klein bottles) the edges that remain in conflict are seams;
//! - a face that repeats an earlier one, in either direction, lies in a second layer, joined to others of its kind
//!   only: a leaf with two sides falls into its sides;
//! - a face that visits a vertex twice is a chart of its own, with a vertex for each corner.
//!
//! [`Repairs`] counts each of these and names the first places. A seam that opens nothing (one edge inside a surface,
//! whose ends stay whole) stays closed.

mod build;
mod layers;
mod orient;
mod pairs;
mod repairs;

pub use repairs::{Found, Repairs};

use crate::Seams;
use crate::build::check_polygons;
use crate::error::BuildError;
use crate::ids::{CornerId, EdgeId, FaceId};
use crate::mesh::QuadMesh;
use crate::polygons::PolygonView;

/// A piece of a surface as a mesh of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Connected, and with a consistent orientation. [`QuadMesh::source_vertex`] leads to the caller's vertices; several
    /// vertices of a chart may have the same.
    pub mesh: QuadMesh,
    /// The caller's face of each face, ascending.
    pub faces: Vec<u32>,
    /// The caller's corner of each corner: in order where the face kept its direction, backwards where it was turned over.
    pub corners: Vec<u32>,
}

/// What polygons fall into.
#[derive(Clone, Debug, PartialEq)]
pub struct Charts {
    /// The pieces, by first face. Every face of the caller lies in exactly one.
    pub charts: Vec<Chart>,
    /// What had to be mended to get there.
    pub repairs: Repairs,
}

/// Opens polygons along `seams`, and wherever they are no oriented manifold. Seams that are no edges are ignored.
///
/// The charts of an oriented manifold without seams are its components, with the vertices and faces in the order of
/// the input, as [`QuadMesh::build`] would number them.
///
/// ```
/// // Three squares at one edge: no mesh, but three charts.
/// let corners = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0., 0., 1.], [1., 0., 1.], [0., -1., 0.], [1., -1., 0.]];
/// let book = qmesh::Polygons::new(&corners, [[0, 1, 2, 3], [1, 0, 4, 5], [1, 0, 6, 7]]);
/// let cut = qmesh::charts::cut(book.view(), &qmesh::Seams::default())?;
/// assert_eq!((cut.charts.len(), cut.repairs.nonmanifold_edges.count), (3, 1));
/// # Ok::<(), qmesh::BuildError>(())
/// ```
///
/// # Errors
/// What no cut mends: no faces, arrays that contradict each other, faces of fewer than three corners, indices or
/// coordinates out of range. See [`BuildError`].
pub fn cut(polygons: PolygonView<'_>, seams: &Seams) -> Result<Charts, BuildError> {
    match one_piece(polygons, seams) {
        Some(chart) => Ok(Charts { charts: vec![chart], repairs: Repairs::default() }),
        None => cut_any(polygons, seams),
    }
}

/// The one chart of polygons with nothing to cut and nothing to mend: most meshes are that, and sooner seen than cut.
fn one_piece(polygons: PolygonView<'_>, seams: &Seams) -> Option<Chart> {
    // The two faces of a pillow count as one that is doubled.
    if !seams.is_empty() || polygons.face_count() < 3 {
        return None;
    }
    let mesh = QuadMesh::build(polygons.to_polygons()).ok()?;
    (mesh.components().1 == 1).then(|| Chart::whole(mesh))
}

fn cut_any(polygons: PolygonView<'_>, seams: &Seams) -> Result<Charts, BuildError> {
    let mut repairs = Repairs::default();
    let mut alone = Vec::new();
    check_polygons(polygons, |face, _| {
        repairs.repeated_corner_faces.push(face);
        alone.push(face);
        Ok(())
    })?;
    let layer = layers::layers(polygons, &mut repairs);
    let [mut mates, joined] = pairs::pair(polygons, &layer, &alone, seams, &mut repairs);
    let sides = orient::orient(polygons, &mut mates, &joined, &mut repairs);
    let charts = build::charts(polygons, &mates, &sides, &layer, &alone, &mut repairs)?;
    Ok(Charts { charts, repairs })
}

impl Chart {
    /// The whole of an oriented manifold as one chart; nothing is asked of its connectedness.
    #[must_use]
    pub fn whole(mesh: QuadMesh) -> Self {
        let faces = (0..mesh.face_count() as u32).collect();
        let corners = (0..mesh.corner_count() as u32).collect();
        Self { mesh, faces, corners }
    }

    /// The pieces into which the chart falls when it is opened along `edges`.
    ///
    /// # Panics
    /// When an edge is not of this chart's mesh.
    #[must_use]
    pub fn cut(&self, edges: &[EdgeId]) -> Vec<Self> {
        let seams: Seams =
            edges.iter().map(|&edge| self.mesh.edge_vertices(edge).map(|vertex| vertex.0)).collect();
        let Ok(cut) = cut(self.mesh.view(), &seams) else { return vec![self.clone()] };
        let within = |mut piece: Self| {
            piece.mesh.rename_sources(&self.mesh);
            piece.faces.iter_mut().for_each(|face| *face = self.faces[*face as usize]);
            piece.corners.iter_mut().for_each(|corner| *corner = self.corners[*corner as usize]);
            piece
        };
        cut.charts.into_iter().map(within).collect()
    }

    /// The caller's faces that run backwards here, ascending.
    pub fn turned_faces(&self) -> impl Iterator<Item = u32> + '_ {
        let is_turned = |face: &FaceId| {
            let mut corners = self.mesh.face_corners(*face).map(|corner| self.source_corner(corner));
            let [first, second] = [corners.next(), corners.next()];
            first.zip(second).is_some_and(|(first, second)| second != first + 1)
        };
        self.mesh.faces().filter(is_turned).map(|face| self.source_face(face))
    }

    /// The caller's face of `face`.
    #[must_use]
    pub fn source_face(&self, face: FaceId) -> u32 {
        self.faces[face.index()]
    }

    /// The caller's corner of `corner`.
    #[must_use]
    pub fn source_corner(&self, corner: CornerId) -> u32 {
        self.corners[corner.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Polygons, shapes};

    /// What is found in one glance is what the long way finds.
    #[test]
    fn one_piece_is_what_cutting_leaves_whole() {
        let with_spare_vertex = |mesh: &QuadMesh| {
            let mut polygons = mesh.view().to_polygons();
            polygons.positions.insert(0, polygons.positions[0]);
            polygons.corner_vertex.iter_mut().for_each(|vertex| *vertex += 1);
            polygons
        };
        let grid = shapes::grid(5, 4);
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let corners = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
        for polygons in [
            grid.view().to_polygons(),
            with_spare_vertex(&grid),
            Polygons::new(&corners, tetrahedron),
            Polygons::new(&corners, &tetrahedron[..3]),
        ] {
            let seams = Seams::default();
            let glance = one_piece(polygons.view(), &seams).expect("one piece");
            let cut = cut_any(polygons.view(), &seams).expect("polygons");
            assert_eq!(cut, Charts { charts: vec![glance], repairs: Repairs::default() });
        }
        let apart = Polygons::new(&corners, [[0, 1, 2], [0, 2, 3], [3, 2, 0]]);
        assert_eq!(one_piece(apart.view(), &Seams::default()), None);
        let pillow = Polygons::new(&corners, [[0, 1, 2], [2, 1, 0]]);
        assert_eq!(one_piece(pillow.view(), &Seams::default()), None);
        let edge: Seams = [[0, 1]].into_iter().collect();
        assert_eq!(one_piece(grid.view(), &edge), None);
    }
}
