//! From the coarse map to the next finer one.

use crate::qmesh::nalgebra::Matrix2x3;
use rayon::prelude::*;

use crate::qmesh::{CornerId, Id, QuadMesh, Vec2, Vec3, VertexId};

use super::fit::Fit;
use super::surface::Surface;

/// A derivative: what it makes of a step along the surface.
type Gradient = Matrix2x3<f64>;

/// The map of `fine` that has, as nearly as can be, the derivatives of the map `uv` of `coarse`; in units of `unit`.
pub(super) fn carried(
    fine: &Surface<'_>,
    coarse: &Surface<'_>,
    cluster_of: &[u32],
    unit: f64,
    uv: &[Vec2],
) -> Vec<Vec2> {
    let gradients = gradients(coarse, unit, uv);
    let (first, gradients): (Vec<Vec2>, Vec<Gradient>) = (0..fine.mesh.vertex_count())
        .into_par_iter()
        .with_min_len(1024)
        .map(|vertex| {
            let cluster = VertexId(cluster_of[vertex]);
            interpolated(fine, coarse, &gradients, uv, unit, VertexId::from_index(vertex), cluster)
        })
        .unzip();
    Fit::new(&fine.mesh, &gradients, unit).solve(first)
}

/// Per coarse vertex, the mean derivative around it, for steps in its tangent plane.
fn gradients(coarse: &Surface<'_>, unit: f64, uv: &[Vec2]) -> Vec<Gradient> {
    let mesh = &coarse.mesh;
    (0..mesh.vertex_count())
        .into_par_iter()
        .with_min_len(1024)
        .map(|vertex| {
            let normal = coarse.normals[vertex];
            let (mut sum, mut weights) = (Gradient::zeros(), 0.0);
            for corner in mesh.vertex_corners(VertexId::from_index(vertex)) {
                let [next, previous] = mesh.corner_vectors(corner).map(|edge| edge / unit);
                let cross = next.cross(&previous);
                let (length, Some(facing)) = (cross.norm(), cross.try_normalize(0.0)) else { continue };
                let at = |c: CornerId| uv[mesh.vertex(c).index()];
                let (f1, f0) = (
                    at(mesh.next_corner(corner)) - at(corner),
                    at(mesh.previous_corner(corner)) - at(corner),
                );
                // The rows of the pseudoinverse of the edge vectors.
                let (by_next, by_previous) = (previous.cross(&facing) / length, facing.cross(&next) / length);
                let gradient = f1 * by_next.transpose() + f0 * by_previous.transpose();
                sum += turned(&gradient, &normal, &facing) * length;
                weights += length;
            }
            if weights > 0.0 { sum / weights } else { sum }
        })
        .collect()
}

/// The derivative for steps in the plane of normal `from`, where `gradient` is for those in the plane of normal `to`: turned by the
/// smallest rotation between the two.
fn turned(gradient: &Gradient, from: &Vec3, to: &Vec3) -> Gradient {
    let (axis, cos) = (from.cross(to), from.dot(to));
    if cos <= -1.0 + 1e-9 {
        return *gradient;
    }
    // R = 1 + [axis] + [axis]²/(1 + cos); the rows of G R.
    let k = axis.cross_matrix();
    gradient + gradient * k + gradient * k * k / (1.0 + cos)
}

/// Where the coarse map puts `vertex`, and its derivative there: from the coarse triangle at `cluster` that lies nearest.
fn interpolated(
    fine: &Surface<'_>,
    coarse: &Surface<'_>,
    gradients: &[Gradient],
    uv: &[Vec2],
    unit: f64,
    vertex: VertexId,
    cluster: VertexId,
) -> (Vec2, Gradient) {
    let (mesh, point) = (&coarse.mesh, fine.mesh.position(vertex));
    let mut best = ([1.0, 0.0, 0.0], [cluster; 3], f64::NEG_INFINITY);
    for corner in mesh.vertex_corners(cluster) {
        let Some(shares) = barycentric(mesh, corner, &(point - mesh.position(cluster))) else { continue };
        let least = shares.iter().copied().fold(f64::INFINITY, f64::min);
        if least > best.2 {
            let vertices =
                [corner, mesh.next_corner(corner), mesh.previous_corner(corner)].map(|c| mesh.vertex(c));
            best = (shares, vertices, least);
        }
    }
    let (shares, vertices, _) = best;
    let clamped = shares.map(|share: f64| share.max(0.0));
    let total: f64 = clamped.iter().sum();
    let (mut place, mut gradient) = (Vec2::zeros(), Gradient::zeros());
    for (share, v) in clamped.map(|share| share / total).into_iter().zip(vertices) {
        let v = v.index();
        let step = (point - mesh.position(VertexId::from_index(v))) / unit;
        place += (uv[v] + gradients[v] * step) * share;
        gradient += turned(&gradients[v], &fine.normals[vertex.index()], &coarse.normals[v]) * share;
    }
    (place, gradient)
}

/// The shares of the three vertices at the point that is `step` away from the corner's own, seen along the triangle's normal.
fn barycentric(mesh: &QuadMesh, corner: CornerId, step: &Vec3) -> Option<[f64; 3]> {
    let [next, previous] = mesh.corner_vectors(corner);
    let normal = next.cross(&previous);
    let square = normal.norm_squared();
    if square.is_nan() || square <= 0.0 {
        return None;
    }
    let b = step.cross(&previous).dot(&normal) / square;
    let c = next.cross(step).dot(&normal) / square;
    Some([1.0 - b - c, b, c])
}
