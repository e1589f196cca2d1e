//! Round things without a pole: a disk of quads, and what it covers when it is bent; the cube-sphere.
//!
//! The disk is a square block of quads inside rings of quads, the usual "O-grid": four vertices of valence 3 and
//! not one degenerate corner, unlike a square that is pressed into a circle.

use std::f64::consts::TAU;

use super::elementary::sin_cos;
use super::lattice::built;
use crate::{Polygons, QuadMesh, Vec3};

/// The most rings, and the most quads along an edge of the cube.
const MOST: usize = 1 << 12;

/// A flat disk of radius 1 in the plane `z = 0`: a block of `2·rings` × `2·rings` quads inside `rings` rings of
/// `8·rings` quads each, `12·rings²` in all.
///
/// `rings` is at least 1 and at most 4096 (clamped). Mirror-symmetric in `x` and in `y`.
///
/// ```
/// let mesh = qmesh::shapes::disk(3);
/// assert_eq!(mesh.face_count(), 108);
/// assert!(mesh.topology().is_disk());
/// ```
#[must_use]
pub fn disk(rings: usize) -> QuadMesh {
    built(o_grid(rings.clamp(1, MOST)))
}

/// A spherical cap around the north pole of the unit sphere: the [`disk`], its radius wound along meridians.
///
/// `half_angle` is measured at the centre of the sphere, in radians: π/2 is a hemisphere. It is clamped to
/// `0.01 ≤ half_angle ≤ 3` (not a number counts as π/2); `rings` as for [`disk`]. A disk.
///
/// ```
/// let dome = qmesh::shapes::cap(4, std::f64::consts::FRAC_PI_2);
/// assert!(dome.positions().iter().all(|p| (p.norm() - 1.0).abs() < 1e-12 && p.z > -1e-12));
/// ```
#[must_use]
pub fn cap(rings: usize, half_angle: f64) -> QuadMesh {
    let half_angle = if half_angle.is_nan() { TAU / 4.0 } else { half_angle.clamp(0.01, 3.0) };
    let mut polygons = o_grid(rings.clamp(1, MOST));
    for position in &mut polygons.positions {
        *position = on_sphere(*position, half_angle / TAU);
    }
    built(polygons)
}

/// A point of the unit disk wound around the unit sphere, the rim `turns` away from the pole.
fn on_sphere(flat: Vec3, turns: f64) -> Vec3 {
    let radius = flat.norm();
    let [sine, cosine] = sin_cos(radius * turns);
    let shrink = if radius > 0.0 { sine / radius } else { 0.0 };
    Vec3::new(flat.x * shrink, flat.y * shrink, cosine)
}

/// A long tube with a round tip, open at its base in the plane `z = 0`: a disk whose far end is all but out of
/// reach of its boundary.
///
/// Radius 1. The tip is a hemisphere like [`cap`] with `rings` rings; the tube has `rows` rows (at least 1) of
/// `8·rings` squares. At most 4096 rings and 2²⁸ faces (clamped).
///
/// ```
/// let mesh = qmesh::shapes::finger(2, 40);
/// assert_eq!(mesh.topology().boundary_loops, 1);
/// assert_eq!(mesh.face_count(), 48 + 40 * 16);
/// ```
#[must_use]
pub fn finger(rings: usize, rows: usize) -> QuadMesh {
    let rings = rings.clamp(1, MOST);
    let around = 8 * rings;
    let rows = rows.clamp(1, most_rows(rings));
    let side = 2.0 * sin_cos(0.5 / around as f64)[0];
    let mut polygons = o_grid(rings);
    for position in &mut polygons.positions {
        *position = on_sphere(*position, 0.25) + Vec3::z() * (side * rows as f64);
    }
    let rim = polygons.positions.len() - around;
    for row in 1..=rows {
        for column in 0..around {
            let above = polygons.positions[rim + column];
            polygons.positions.push(Vec3::new(above.x, above.y, side * (rows - row) as f64));
        }
        push_ring(&mut polygons, rim + (row - 1) * around, rim + row * around, around);
    }
    built(polygons)
}

/// Rows of a tube that leave room for its tip: `12·rings²` quads, as many as `1.5·rings` rows have.
fn most_rows(rings: usize) -> usize {
    super::lattice::MOST_FACES / (8 * rings) - (3 * rings).div_ceil(2)
}

/// The quads between two loops of `around` vertices each, the first of which lies inside.
fn push_ring(polygons: &mut Polygons, inner: usize, outer: usize, around: usize) {
    for here in 0..around {
        let next = (here + 1) % around;
        polygons.push_face(&[inner + here, outer + here, outer + next, inner + next].map(|v| v as u32));
    }
}

/// The unit disk. The last `8·rings` vertices are its rim, counter-clockwise.
fn o_grid(rings: usize) -> Polygons {
    const BLOCK: f64 = 0.5; // half the width of the block
    let side = 2 * rings;
    let mut polygons = Polygons::default();
    let place = |i: usize| (i as f64 - rings as f64) / rings as f64;
    for row in 0..=side {
        for column in 0..=side {
            polygons.positions.push(bulged(place(column), place(row)) * BLOCK);
        }
    }
    for row in 0..side {
        for column in 0..side {
            let corner = row * (side + 1) + column;
            let above = corner + side + 1;
            polygons.push_face(&[corner, corner + 1, above + 1, above].map(|v| v as u32));
        }
    }
    // The loop around the block, counter-clockwise from its lower left corner.
    let across = side + 1;
    let lower = (0..side).chain((0..side).map(|row| row * across + side));
    let upper = (0..side).map(|i| side * across + side - i).chain((0..side).map(|i| (side - i) * across));
    let block_rim: Vec<usize> = lower.chain(upper).collect();
    let around = block_rim.len();
    let first = polygons.positions.len();
    for ring in 1..=rings {
        let outward = ring as f64 / rings as f64;
        for (step, &inner) in block_rim.iter().enumerate() {
            let [sine, cosine] = sin_cos(step as f64 / around as f64 - 0.375);
            let circle = Vec3::new(cosine, sine, 0.0);
            let position = polygons.positions[inner].lerp(&circle, outward);
            polygons.positions.push(position);
        }
    }
    for here in 0..around {
        let next = (here + 1) % around;
        let quad = [block_rim[here], first + here, first + next, block_rim[next]];
        polygons.push_face(&quad.map(|v| v as u32));
    }
    for ring in 1..rings {
        push_ring(&mut polygons, first + (ring - 1) * around, first + ring * around, around);
    }
    polygons
}

/// The square `[−1, 1]²` with sides that bulge a little towards the circle, so that no corner next to the block is
/// much wider than 120°.
fn bulged(x: f64, y: f64) -> Vec3 {
    const ROUNDING: f64 = 0.2;
    Vec3::new(x * (1.0 - ROUNDING * y * y), y * (1.0 - ROUNDING * x * x), 0.0)
}

/// The unit sphere as a blown-up cube of `6·cells²` quads, spaced evenly in angle.
///
/// `cells`, the quads along an edge of the cube, is at least 1 and at most 4096 (clamped). Closed, of genus 0,
/// `χ = 2`; with 1 it is a cube. Mirror-symmetric in `x`, `y` and `z`.
///
/// ```
/// let mesh = qmesh::shapes::sphere(4);
/// assert_eq!(mesh.face_count(), 96);
/// assert_eq!(mesh.euler_characteristic(), 2);
/// ```
#[must_use]
pub fn sphere(cells: usize) -> QuadMesh {
    let cells = cells.clamp(1, MOST);
    let surface = CubeSurface { cells };
    let mut polygons = Polygons::default();
    surface.for_each_point(|point| {
        let place = |i: usize| {
            // Equal angles, seen from the centre, between neighbours along a cube edge.
            let [sine, cosine] = sin_cos((2.0 * i as f64 - cells as f64) / cells as f64 / 8.0);
            sine / cosine
        };
        polygons.positions.push(Vec3::from(point.map(place)).normalize());
    });
    for axis in 0..3 {
        for far in [false, true] {
            for (i, j) in (0..cells * cells).map(|k| (k % cells, k / cells)) {
                let corner = |di: usize, dj: usize| {
                    let mut point = [0; 3];
                    point[axis] = if far { cells } else { 0 };
                    point[(axis + 1) % 3] = i + di;
                    point[(axis + 2) % 3] = j + dj;
                    surface.index(point) as u32
                };
                let mut quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if !far {
                    quad.reverse();
                }
                polygons.push_face(&quad);
            }
        }
    }
    built(polygons)
}

/// The lattice points on the surface of a cube, numbered layer by layer.
struct CubeSurface {
    cells: usize,
}

impl CubeSurface {
    fn for_each_point(&self, mut visit: impl FnMut([usize; 3])) {
        let n = self.cells;
        for z in 0..=n {
            for y in 0..=n {
                // A row strictly inside its layer, and its layer strictly inside the cube, has two ends only.
                let hollow = z > 0 && z < n && y > 0 && y < n;
                for x in (0..=n).step_by(if hollow { n } else { 1 }) {
                    visit([x, y, z]);
                }
            }
        }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        let n = self.cells;
        let full = (n + 1) * (n + 1);
        if z == 0 {
            return y * (n + 1) + x;
        }
        let below = full + (z - 1) * 4 * n;
        let within = match y {
            _ if z == n => y * (n + 1) + x,
            0 => x,
            _ if y == n => n + 1 + 2 * (n - 1) + x,
            _ => n + 1 + 2 * (y - 1) + usize::from(x == n),
        };
        below + within
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At any size there is room for a tube of at least one row, and none for more faces than there may be.
    #[test]
    fn fingers_of_any_size_have_a_tube() {
        for rings in 1..=MOST {
            let rows = most_rows(rings);
            let faces = |rows: usize| 12 * rings * rings + 8 * rings * rows;
            assert!(rows >= 1 && faces(rows) <= super::super::lattice::MOST_FACES, "{rings} rings");
            assert!(faces(rows + 2) > super::super::lattice::MOST_FACES, "{rings} rings");
        }
    }
}
