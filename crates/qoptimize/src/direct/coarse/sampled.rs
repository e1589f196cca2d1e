//! The energy of the finest mesh, measured in the middle of each coarse face.

use crate::convexity::Exempt;
use crate::qmesh::{CornerId, FaceId, QuadMesh, Vec2, Vec3, VertexData};

use super::super::constraint::Constraint;
use super::super::rest::{Frame, Rest, RestCorner, UNIFORM_SHARE, rest_corners, shortest_edge};
use super::surface::Surface;

/// What `coarse` is at rest: every triangle stands for the corners of the quad in its middle, and they for as much of the surface as
/// lies around.
pub(super) fn rest(coarse: &Surface<'_>, quads: &QuadMesh, exempt: &Exempt, unit: f64) -> Rest {
    let mesh = &coarse.mesh;
    let (mut corners, mut frames, mut ids) = (Vec::new(), Vec::new(), Vec::new());
    let (total_count, total_area) = (coarse.counts.iter().sum::<f64>(), coarse.areas.iter().sum::<f64>());
    let shortest = shortest_edge(quads) / unit;
    let around = corners_around(mesh);
    for face in mesh.faces() {
        let Some(own) = mesh.face_corners(face).next() else { continue };
        let Some(triangle) = Triangle::new(mesh, own, unit) else { continue };
        let (count, area) = stands_for(coarse, &around, face);
        let (share, weight) = (count / total_count, area / total_area);
        let samples: Vec<_> = rest_corners(quads, coarse.middle(face), exempt, unit, shortest).collect();
        let factors: f64 = samples.iter().map(|(_, sample)| sample.share).sum();
        for (corner, sample) in samples {
            let part = sample.share / factors;
            corners.push(RestCorner {
                vertices: triangle.vertices,
                share: part * share,
                weight: part * ((1.0 - UNIFORM_SHARE) * weight + UNIFORM_SHARE * share),
                ..sample
            });
            frames.push(triangle.frame(quads, corner, &sample, unit));
            ids.push(own);
        }
    }
    Rest { corners, frames, ids, vertex_count: mesh.vertex_count(), unit, constraint: Constraint::default() }
}

/// How many corners there are at each vertex.
fn corners_around(mesh: &QuadMesh) -> VertexData<u32> {
    let mut around = mesh.vertex_data(|_| 0);
    mesh.corners().for_each(|corner| around[mesh.vertex(corner)] += 1);
    around
}

/// How many vertices of the finest mesh `face` stands for, and how much area.
fn stands_for(coarse: &Surface<'_>, around: &VertexData<u32>, face: FaceId) -> (f64, f64) {
    let mut sums = (0.0, 0.0);
    for vertex in coarse.mesh.face_vertices(face) {
        let around = f64::from(around[vertex]);
        sums.0 += coarse.counts[vertex.index()] / around;
        sums.1 += coarse.areas[vertex.index()] / around;
    }
    sums
}

/// A coarse triangle, in its plane.
struct Triangle {
    vertices: [u32; 3],
    axes: [Vec3; 2],
    /// The inverse of the edge vectors `(to next, to previous)`: entries 11, 12 and 22.
    inverse: [f64; 3],
}

impl Triangle {
    /// `None` without area.
    fn new(mesh: &QuadMesh, corner: CornerId, unit: f64) -> Option<Self> {
        let [next, previous] = mesh.corner_vectors(corner).map(|edge| edge / unit);
        let x = next.try_normalize(0.0)?;
        let y = (previous - x * previous.dot(&x)).try_normalize(1e-12 * previous.norm())?;
        let (length, along, height) = (next.norm(), previous.dot(&x), previous.dot(&y));
        let vertices =
            [corner, mesh.next_corner(corner), mesh.previous_corner(corner)].map(|c| mesh.vertex(c).0);
        Some(Self {
            vertices,
            axes: [x, y],
            inverse: [1.0 / length, -along / (length * height), 1.0 / height],
        })
    }

    /// The edges of `corner` by those of the triangle, laid into its plane without bending their angle or lengths.
    fn frame(&self, quads: &QuadMesh, corner: CornerId, sample: &RestCorner, unit: f64) -> Frame {
        let seen = quads
            .corner_vectors(corner)
            .map(|v| Vec2::new(v.dot(&self.axes[0]), v.dot(&self.axes[1])) / unit);
        let [i11, i12, i22] = sample.inverse;
        let own = [Vec2::new(1.0 / i11, 0.0), Vec2::new(-i12 / (i11 * i22), 1.0 / i22)];
        let cross: f64 = own.iter().zip(&seen).map(|(o, s)| o.perp(s)).sum();
        let dot: f64 = own.iter().zip(&seen).map(|(o, s)| o.dot(s)).sum();
        let (sin, cos) = cross.atan2(dot).sin_cos();
        let [a, b, c] = self.inverse;
        let by_triangle = |v: &Vec2| {
            let v = Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
            [a * v.x + b * v.y, c * v.y]
        };
        let ([x1, y1], [x0, y0]) = (by_triangle(&own[0]), by_triangle(&own[1]));
        [x1, y1, x0, y0]
    }
}
