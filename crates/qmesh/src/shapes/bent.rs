//! Lattices bent around an axis: tube, rolled-up sheet, torus.

use std::f64::consts::TAU;

use super::elementary::sin_cos;
use super::lattice::Lattice;
use crate::{QuadMesh, Vec3};

/// An open tube around the z axis: radius 1, from `z = 0` to `z = 2`, outside facing out.
///
/// `columns` quads around (at least 3) and `rows` along (at least 1), at most 2²⁴ and 2²⁸ faces (clamped). An
/// annulus: two boundary loops, `χ = 0`.
///
/// ```
/// let topology = qmesh::shapes::cylinder(12, 4).topology();
/// assert_eq!((topology.boundary_loops, topology.euler_characteristic), (2, 0));
/// ```
#[must_use]
pub fn cylinder(columns: usize, rows: usize) -> QuadMesh {
    Lattice::tube(columns, rows).mesh(|[s, t]| {
        let [sine, cosine] = sin_cos(s);
        Vec3::new(cosine, sine, 2.0 * t)
    })
}

/// A rectangle rolled up around the z axis without closing: radius 1, its columns spread over `angle` radians.
///
/// Every quad is a flat square, so the surface unrolls onto [`grid`](super::grid), scaled, without any distortion.
/// `columns` and `rows` are at least 1, at most 2²⁴ and 2²⁸ faces; `angle` is clamped to `0.001 ≤ angle ≤ 6.2`, a
/// little less than a full circle (not a number counts as π). A disk.
///
/// ```
/// assert!(qmesh::shapes::cylinder_strip(16, 4, 4.5).topology().is_disk());
/// ```
#[must_use]
pub fn cylinder_strip(columns: usize, rows: usize, angle: f64) -> QuadMesh {
    let angle = if angle.is_nan() { TAU / 2.0 } else { angle.clamp(0.001, 6.2) };
    let lattice = Lattice::open(columns, rows);
    let step = angle / TAU / lattice.columns as f64;
    let side = 2.0 * sin_cos(step / 2.0)[0]; // the chord, not the arc: what the quad has for an edge
    let height = side * lattice.rows as f64;
    lattice.mesh(|[s, t]| {
        let [sine, cosine] = sin_cos((s - 0.5) * angle / TAU);
        Vec3::new(cosine, sine, t * height)
    })
}

/// A torus around the z axis: radii 1 and 0.4, outside facing out.
///
/// `columns` quads around the axis and `rows` around the tube, at least 3 each, at most 2²⁴ columns and 2²⁸ faces
/// (clamped). Closed, of genus 1, `χ = 0`.
///
/// ```
/// assert_eq!(qmesh::shapes::torus(12, 8).topology().genus, 1);
/// ```
#[must_use]
pub fn torus(columns: usize, rows: usize) -> QuadMesh {
    const TUBE: f64 = 0.4;
    Lattice::torus(columns, rows).mesh(|[s, t]| {
        let [sine, cosine] = sin_cos(s);
        let [up, out] = sin_cos(t).map(|x| x * TUBE);
        Vec3::new((1.0 + out) * cosine, (1.0 + out) * sine, up)
    })
}
