//! Holes: which boundary loop is the outer one, and the mesh with the others closed.

use crate::ids::{HalfedgeId, VertexId};
use crate::mesh::QuadMesh;

impl QuadMesh {
    /// Puts the longest of `loops` (in space) first; of equally long ones the one with most edges, then the first.
    /// The longest loop is the outer boundary of a patch with holes.
    pub fn outer_first(&self, loops: &mut [Vec<HalfedgeId>]) {
        let length =
            |walk: &[HalfedgeId]| -> f64 { walk.iter().map(|&h| self.edge_length(self.edge(h))).sum() };
        let measures: Vec<(f64, usize)> = loops.iter().map(|walk| (length(walk), walk.len())).collect();
        // Rounding must not decide between loops of one length.
        let longer = |a: (f64, usize), b: (f64, usize)| {
            a.0 > b.0 * (1.0 + 1e-9) || (a.0 >= b.0 * (1.0 - 1e-9) && a.1 > b.1)
        };
        let outer =
            (1..loops.len()).fold(0, |best, k| if longer(measures[k], measures[best]) { k } else { best });
        if outer > 0 {
            loops[..=outer].rotate_right(1);
        }
    }

    /// The mesh with all boundary loops but the outer one closed, each by a fan of triangles around a new vertex at its
    /// centroid; nothing when there are no holes. The new vertices and faces come last, so vertices, faces and corners
    /// keep their numbers (edges do not). The source of a new vertex is that of a vertex of its hole.
    ///
    /// ```
    /// let ring = qmesh::shapes::cylinder(8, 2);
    /// let filled = ring.filled().expect("two loops");
    /// assert!(filled.topology().is_disk() && filled.vertex_count() == ring.vertex_count() + 1);
    /// ```
    #[must_use]
    pub fn filled(&self) -> Option<Self> {
        let mut loops = self.boundary_loops();
        self.outer_first(&mut loops);
        let holes = loops.get(1..).filter(|holes| !holes.is_empty())?;
        let mut polygons = self.view().to_polygons();
        let mut sources: Vec<u32> = self.vertices().map(|vertex| self.source_vertex(vertex)).collect();
        for hole in holes {
            let center = polygons.positions.len() as u32;
            let first = self.position(self.origin(hole[0]));
            let offset =
                |&halfedge: &HalfedgeId| (self.position(self.origin(halfedge)) - first) / hole.len() as f64;
            polygons.positions.push(first + hole.iter().map(offset).sum::<crate::Vec3>());
            sources.push(self.source_vertex(self.origin(hole[0])));
            for &halfedge in hole {
                let [VertexId(from), VertexId(to)] = [self.origin(halfedge), self.target(halfedge)];
                polygons.push_face(&[from, to, center]);
            }
        }
        let mut mesh = Self::build(polygons).ok()?;
        mesh.set_sources(&sources, self.source_vertex_count());
        Some(mesh)
    }
}
