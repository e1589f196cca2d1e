//! Which corner triangles overlap now, and which vertices may therefore move.

use qembed::qmesh::{CornerData, CornerId, QuadMesh, Vec2, VertexData, VertexId};
use robust::{Coord, orient2d};

use super::OverlapOptions;
use crate::convexity::Exempt;

pub(super) struct State<'a> {
    mesh: &'a QuadMesh,
    uv: &'a mut VertexData<Vec2>,
    lambda1: f64,
    lambda2: f64,
    /// Quads that no map can make convex: moving around them would never end.
    exempt: Exempt,
    /// −1 when the map is mirrored as a whole.
    mirror: f64,
    overlaps: CornerData<bool>,
    overlap_count: usize,
    /// Overlapping corner triangles at each vertex.
    at_vertex: VertexData<u32>,
    /// Overlapping interior vertices among each vertex and its immediate one-ring.
    around: VertexData<u32>,
}

impl<'a> State<'a> {
    pub(super) fn new(mesh: &'a QuadMesh, uv: &'a mut VertexData<Vec2>, options: &OverlapOptions) -> Self {
        let total: f64 = mesh.corners().map(|corner| area(mesh, uv, corner)).sum();
        let mirror = if total < 0.0 { -1.0 } else { 1.0 };
        let any = mesh.corners().any(|corner| area(mesh, uv, corner) * mirror <= 0.0);
        let mut state = Self {
            mesh,
            uv,
            lambda1: options.lambda1,
            lambda2: options.lambda2,
            exempt: if any { Exempt::find(mesh) } else { Exempt::default() },
            mirror,
            overlaps: CornerData::filled(mesh.corner_count(), false),
            overlap_count: 0,
            at_vertex: VertexData::filled(mesh.vertex_count(), 0),
            around: VertexData::filled(mesh.vertex_count(), 0),
        };
        mesh.corners().for_each(|corner| state.test(corner, &mut Vec::new()));
        state
    }

    /// Corner triangles that overlap.
    pub(super) fn overlaps(&self) -> usize {
        self.overlap_count
    }

    /// Those whose three corners lie on the boundary.
    pub(super) fn stuck_on_boundary(&self) -> usize {
        let stuck = |corner| self.triangle(corner).iter().all(|&v| self.mesh.is_boundary(v));
        self.mesh.corners().filter(|&corner| self.overlaps[corner] && stuck(corner)).count()
    }

    /// Those of quads that cannot be convex in any map, away from the vertices that they share.
    pub(super) fn impossible(&self) -> usize {
        let exempt = |&corner: &CornerId| self.overlaps[corner] && self.exempt.is_exempt(self.mesh, corner);
        if self.exempt.is_empty() { 0 } else { self.mesh.corners().filter(exempt).count() }
    }

    /// Whether `vertex` may move: it is not on the boundary, and it or an immediate neighbour overlaps.
    pub(super) fn is_active(&self, vertex: VertexId) -> bool {
        self.around[vertex] > 0 && !self.mesh.is_boundary(vertex)
    }

    /// Whether a move would change the coordinates of `vertex` at all.
    pub(super) fn would_move(&self, vertex: VertexId) -> bool {
        self.uv[vertex] + self.step(vertex) != self.uv[vertex]
    }

    /// σ of Eq. 12: how far `vertex` would move.
    pub(super) fn sigma(&self, vertex: VertexId) -> f64 {
        self.step(vertex).norm()
    }

    /// Moves `vertex` by Eq. 11, tests its corner triangles again, and appends the vertices whose σ changed or that may
    /// move from now on.
    pub(super) fn relax(&mut self, vertex: VertexId, wake: &mut Vec<VertexId>) {
        let step = self.step(vertex);
        self.uv[vertex] += step;
        let mesh = self.mesh;
        wake.push(vertex);
        for corner in mesh.vertex_corners(vertex) {
            wake.extend(mesh.face_vertices(mesh.face(corner)).filter(|&v| v != vertex));
            for changed in [mesh.previous_corner(corner), corner, mesh.next_corner(corner)] {
                self.test(changed, wake);
            }
        }
        wake.sort_unstable();
        wake.dedup();
    }

    /// What Eq. 11 adds to the position of `vertex`.
    ///
    /// `n` is the valence, which is also the number of diagonals when all faces are quads. Where larger polygons make
    /// it larger, it divides the diagonal term, so that the new position is always a mean of the old ones.
    fn step(&self, vertex: VertexId) -> Vec2 {
        let here = self.uv[vertex];
        let (mut immediate, mut valence) = (Vec2::zeros(), 0_u32);
        let (mut diagonal, mut diagonals) = (Vec2::zeros(), 0_u32);
        for halfedge in self.mesh.outgoing(vertex) {
            immediate += self.uv[self.mesh.target(halfedge)] - here;
            valence += 1;
            let Some(corner) = self.mesh.corner(halfedge) else { continue };
            let last = self.mesh.previous_corner(corner);
            let mut across = self.mesh.next_corner(self.mesh.next_corner(corner));
            while across != last && across != corner {
                diagonal += self.uv[self.mesh.vertex(across)] - here;
                diagonals += 1;
                across = self.mesh.next_corner(across);
            }
        }
        immediate * (self.lambda1 / f64::from(valence))
            + diagonal * (self.lambda2 / f64::from(valence.max(diagonals)))
    }

    /// Looks whether the triangle at `corner` overlaps, and appends the vertices that may move from now on.
    fn test(&mut self, corner: CornerId, wake: &mut Vec<VertexId>) {
        let overlaps = area(self.mesh, self.uv, corner) * self.mirror <= 0.0;
        if std::mem::replace(&mut self.overlaps[corner], overlaps) == overlaps {
            return;
        }
        self.overlap_count = if overlaps { self.overlap_count + 1 } else { self.overlap_count - 1 };
        if self.exempt.is_exempt(self.mesh, corner) {
            return;
        }
        for vertex in self.triangle(corner) {
            if self.mesh.is_boundary(vertex) {
                continue;
            }
            let count = &mut self.at_vertex[vertex];
            *count = if overlaps { *count + 1 } else { *count - 1 };
            match (overlaps, *count) {
                (true, 1) => {
                    for around in std::iter::once(vertex).chain(self.mesh.neighbors(vertex)) {
                        self.around[around] += 1;
                        if self.around[around] == 1 {
                            wake.push(around);
                        }
                    }
                }
                (false, 0) => {
                    self.around[vertex] -= 1;
                    for around in self.mesh.neighbors(vertex) {
                        self.around[around] -= 1;
                    }
                }
                _ => {}
            }
        }
    }

    fn triangle(&self, corner: CornerId) -> [VertexId; 3] {
        let mesh = self.mesh;
        [mesh.previous_corner(corner), corner, mesh.next_corner(corner)].map(|corner| mesh.vertex(corner))
    }
}

/// Signed area of the triangle at `corner`; its sign is exact.
fn area(mesh: &QuadMesh, uv: &VertexData<Vec2>, corner: CornerId) -> f64 {
    let at = |corner| {
        let p = uv[mesh.vertex(corner)];
        Coord { x: p.x, y: p.y }
    };
    orient2d(at(mesh.previous_corner(corner)), at(corner), at(mesh.next_corner(corner))) / 2.0
}
