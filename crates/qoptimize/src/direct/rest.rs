//! What the surface prescribes: the corner triangles at rest, with their weights.
//!
//! Lengths are in units of about the square root of the surface area, so energies and tolerances are free of units.

use std::ops::Range;

use rayon::prelude::*;

use crate::qmesh::{CornerId, FaceId, QuadMesh, Vec2, Vec3, VertexId};

use super::constraint::Constraint;
use super::element::Edges;
use super::energy::edges;
use super::layout::Triangle;
use crate::convexity::Exempt;

/// Rest angles are kept this far from 0 and π, so that no weight is infinite.
const ANGLE_MARGIN: f64 = 1e-3;
/// Edges at rest count as at least this fraction of the mean edge.
const SHORTEST_EDGE: f64 = 1e-6;
/// The share of the symmetric Dirichlet weight that is the same for all corners: without it, small quads bloat.
pub(super) const UNIFORM_SHARE: f64 = 0.1;
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

/// A corner of the surface that a larger triangle stands for: its edge vectors by those of the triangle, `[x1, y1, x0, y0]` where
/// that to the next vertex is `x1 f1 + y1 f0`, and that to the previous one `x0 f1 + y0 f0`.
pub(super) type Frame = [f64; 4];

/// Corners in a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners<'a> {
    pub(super) corners: &'a [RestCorner],
    /// One for each corner, or none at all: then triangles stand for themselves.
    pub(super) frames: &'a [Frame],
}

impl Corners<'_> {
    /// The edge vectors in the plane, `(to next, to previous)`, of corner number `at`.
    pub(super) fn edges(&self, at: usize, uv: &[Vec2]) -> Edges {
        let f = edges(&self.corners[at], uv);
        self.frames.get(at).map_or(f, |frame| framed(frame, f))
    }
}

/// The edge vectors of what a triangle with the edge vectors `f` stands for.
pub(super) fn framed(&[x1, y1, x0, y0]: &Frame, [f1x, f1y, f0x, f0y]: Edges) -> Edges {
    [x1 * f1x + y1 * f0x, x1 * f1y + y1 * f0y, x0 * f1x + y0 * f0x, x0 * f1y + y0 * f0y]
}

/// A derivative by those edge vectors as one by the triangle's.
pub(super) fn unframed(&[x1, y1, x0, y0]: &Frame, [g1x, g1y, g0x, g0y]: Edges) -> Edges {
    [x1 * g1x + x0 * g0x, x1 * g1y + x0 * g0y, y1 * g1x + y0 * g0x, y1 * g1y + y0 * g0y]
}

/// The same for second derivatives.
pub(super) fn unframed_triangle(frame: &Frame, &[a, b, c, d, e, f, g, h, i, j]: &Triangle) -> Triangle {
    let rows = [[a, b, c, d], [b, e, f, g], [c, f, h, i], [d, g, i, j]].map(|row| unframed(frame, row));
    let column = |k: usize| unframed(frame, [rows[0][k], rows[1][k], rows[2][k], rows[3][k]]);
    let [[a, ..], [b, e, ..], [c, f, h, _], [d, g, i, j]] = [column(0), column(1), column(2), column(3)];
    [a, b, c, d, e, f, g, h, i, j]
}

/// All corner triangles that the map has to keep positive, and the unit of length.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    pub(super) corners: Vec<RestCorner>,
    /// One for each corner, or none at all: see [`Corners`].
    pub(super) frames: Vec<Frame>,
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
        let shortest = shortest_edge(mesh) / unit;
        let mut ids = Vec::with_capacity(mesh.corner_count());
        let mut corners = Vec::with_capacity(mesh.corner_count());
        for face in mesh.faces() {
            for (corner, at_rest) in rest_corners(mesh, face, exempt, unit, shortest) {
                ids.push(corner);
                corners.push(at_rest);
            }
        }
        let mut rest = Self {
            corners,
            frames: Vec::new(),
            ids,
            vertex_count: mesh.vertex_count(),
            unit,
            constraint: Constraint::default(),
        };
        rest.share_out();
        rest
    }

    /// All corners in chunks of `size`.
    pub(super) fn par_chunks(&self, size: usize) -> impl IndexedParallelIterator<Item = Corners<'_>> {
        self.par_chunks_of(0..self.corners.len(), size)
    }

    /// The corners in `window` in chunks of `size`.
    pub(super) fn par_chunks_of(
        &self,
        window: Range<usize>,
        size: usize,
    ) -> impl IndexedParallelIterator<Item = Corners<'_>> {
        (0..window.len().div_ceil(size)).into_par_iter().map(move |chunk| {
            let start = window.start + chunk * size;
            let range = start..(start + size).min(window.end);
            let frames = if self.frames.is_empty() { &[] } else { &self.frames[range.clone()] };
            Corners { corners: &self.corners[range], frames }
        })
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

/// The corners of `face` that count, with their factors in place of their shares.
pub(super) fn rest_corners(
    mesh: &QuadMesh,
    face: FaceId,
    exempt: &Exempt,
    unit: f64,
    shortest: f64,
) -> impl Iterator<Item = (CornerId, RestCorner)> {
    let factors = corner_factors(mesh, face, exempt);
    let counting = mesh.face_corners(face).zip(factors).filter(|&(_, factor)| factor > 0.0);
    counting.map(move |(corner, factor)| (corner, rest_corner(mesh, corner, unit, shortest, factor)))
}

/// What edges count as at least.
pub(super) fn shortest_edge(mesh: &QuadMesh) -> f64 {
    SHORTEST_EDGE * mean_edge(mesh)
}

pub(super) fn mean_edge(mesh: &QuadMesh) -> f64 {
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
