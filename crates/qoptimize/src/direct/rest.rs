//! What the surface prescribes: the corner triangles at rest, with their weights.
//!
//! Lengths are in units of about the square root of the surface area, so energies and tolerances are free of units.

use crate::qmesh::{CornerId, FaceId, QuadMesh, Vec3, VertexId};

use super::constraint::Constraint;
use crate::convexity::Exempt;

/// Rest angles are kept this far from 0 and π, so that no weight is infinite.
const ANGLE_MARGIN: f64 = 1e-3;
/// Edges at rest count as at least this fraction of the mean edge.
const SHORTEST_EDGE: f64 = 1e-6;
/// The share of the symmetric Dirichlet weight that is the same for all corners: without it, small quads bloat.
const UNIFORM_SHARE: f64 = 0.1;
/// In a quad with one corner concave in space, the corners that split it validly count double, the others this much.
const CONCAVE_LIGHT: f64 = 0.01;

/// A corner triangle at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct RestCorner {
    /// Here, next and previous vertex of the face.
    pub(super) vertices: [u32; 3],
    /// θ, in radians.
    pub(super) angle: f64,
    /// A(T).
    pub(super) area: f64,
    /// The entries 11, 12, 22 of the inverse of the edge vectors `(to next, to previous)` in an orthonormal frame.
    pub(super) inverse: [f64; 3],
    /// Weight of the angle and area terms; about 1/#corners.
    pub(super) share: f64,
    /// Weight of the symmetric Dirichlet term; they sum to 1.
    pub(super) weight: f64,
}

/// All corner triangles that the map has to keep positive, and the unit of length.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    pub(super) corners: Vec<RestCorner>,
    /// The corner of the mesh behind each entry.
    pub(super) ids: Vec<CornerId>,
    pub(super) vertex_count: usize,
    /// One unit of the energy's lengths, in units of the mesh.
    pub(super) unit: f64,
    /// What the map may not do besides flipping.
    pub(super) constraint: Constraint,
}

impl Rest {
    pub(super) fn new(mesh: &QuadMesh, exempt: &Exempt) -> Self {
        let unit = unit_length(crate::qcurv::surface_area(mesh));
        let shortest = SHORTEST_EDGE * mean_edge(mesh) / unit;
        let mut ids = Vec::with_capacity(mesh.corner_count());
        let mut corners = Vec::with_capacity(mesh.corner_count());
        for face in mesh.faces() {
            let factors = corner_factors(mesh, face, exempt);
            for (corner, factor) in mesh.face_corners(face).zip(factors) {
                if factor > 0.0 {
                    ids.push(corner);
                    corners.push(rest_corner(mesh, corner, unit, shortest, factor));
                }
            }
        }
        let mut rest =
            Self { corners, ids, vertex_count: mesh.vertex_count(), unit, constraint: Constraint::default() };
        rest.share_out();
        rest
    }

    /// The same surface in lengths `factor` times as long.
    pub(super) fn scale(&mut self, factor: f64) {
        for corner in &mut self.corners {
            corner.area *= factor * factor;
            corner.inverse = corner.inverse.map(|x| x / factor);
        }
    }

    /// Turns the factors of the corners, which stand in `share` so far, into weights.
    fn share_out(&mut self) {
        let count = self.corners.len() as f64;
        let area: f64 = self.corners.iter().map(|c| c.share * c.area).sum();
        for corner in &mut self.corners {
            let factor = corner.share;
            corner.share = factor / count;
            corner.weight = factor * ((1.0 - UNIFORM_SHARE) * corner.area / area + UNIFORM_SHARE / count);
        }
    }
}

/// The power of two next to the square root of the area: scaling by it rounds nothing, so a valid map stays valid.
pub(super) fn unit_length(area: f64) -> f64 {
    let exponent = (0.5 * area.log2()).round();
    if exponent.is_finite() { exponent.clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}

fn rest_corner(mesh: &QuadMesh, corner: CornerId, unit: f64, shortest: f64, factor: f64) -> RestCorner {
    let [to_next, to_previous] = mesh.corner_vectors(corner).map(|edge| edge / unit);
    let next = to_next.norm().max(shortest);
    let previous = to_previous.norm().max(shortest);
    let angle =
        crate::qcurv::corner_angle(mesh, corner).clamp(ANGLE_MARGIN, std::f64::consts::PI - ANGLE_MARGIN);
    let (sin, cos) = angle.sin_cos();
    let (x, y) = (previous * cos, previous * sin);
    let vertex = |c: CornerId| mesh.vertex(c).0;
    RestCorner {
        vertices: [vertex(corner), vertex(mesh.next_corner(corner)), vertex(mesh.previous_corner(corner))],
        angle,
        area: 0.5 * next * y,
        inverse: [1.0 / next, -x / (next * y), 1.0 / y],
        share: factor,
        weight: 0.0,
    }
}

fn mean_edge(mesh: &QuadMesh) -> f64 {
    mesh.edges().map(|edge| mesh.edge_length(edge)).sum::<f64>() / mesh.edge_count() as f64
}

/// How much each corner of `face` counts; 0 where it is exempt.
fn corner_factors(mesh: &QuadMesh, face: FaceId, exempt: &Exempt) -> Vec<f64> {
    let vertices: Vec<VertexId> = mesh.face_vertices(face).collect();
    if let Some(pair) = exempt.pair_of(face) {
        return vertices.iter().map(|v| if pair.contains(v) { 2.0 } else { 0.0 }).collect();
    }
    match (vertices.len(), concave_corners(mesh, face)) {
        (4, concave) if concave.iter().filter(|&&c| c).count() == 1 => {
            let at = concave.iter().position(|&c| c).unwrap_or(0);
            (0..4).map(|i| if (i + at) % 2 == 1 { 2.0 } else { CONCAVE_LIGHT }).collect()
        }
        (n, _) => vec![1.0; n],
    }
}

/// The normals of the corner triangles of `face`, twice as long as these have area.
pub(crate) fn corner_normals(mesh: &QuadMesh, face: FaceId) -> Vec<Vec3> {
    mesh.face_corners(face)
        .map(|corner| {
            let [next, previous] = mesh.corner_vectors(corner);
            next.cross(&previous)
        })
        .collect()
}

/// Which corners of `face` are concave in space: against the face's mean normal.
pub(crate) fn concave_corners(mesh: &QuadMesh, face: FaceId) -> Vec<bool> {
    let normals = corner_normals(mesh, face);
    let mean: Vec3 = normals.iter().sum();
    normals.iter().map(|normal| normal.dot(&mean) <= 0.0 && mean.norm_squared() > 0.0).collect()
}
