//! Flat rectangles: regular, graded, jittered.

use super::elementary::SplitMix64;
use super::lattice::Lattice;
use crate::{QuadMesh, Vec3};

/// A flat grid of unit squares in the plane `z = 0`, its lower left corner at the origin.
///
/// At least 1 column and 1 row; at most 2²⁴ columns and 2²⁸ faces (clamped). A disk.
///
/// ```
/// let mesh = qmesh::shapes::grid(4, 3);
/// assert_eq!((mesh.vertex_count(), mesh.face_count()), (20, 12));
/// assert!(mesh.topology().is_disk());
/// ```
#[must_use]
pub fn grid(columns: usize, rows: usize) -> QuadMesh {
    let lattice = Lattice::open(columns, rows);
    let (width, height) = (lattice.columns as f64, lattice.rows as f64);
    lattice.mesh(|[s, t]| Vec3::new((s * width).round(), (t * height).round(), 0.0))
}

/// A flat grid of `columns` × `rows` rectangles over the same rectangle as [`grid`], each column `ratio` times as
/// wide as the one to its left, each row `ratio` times as high as the one below.
///
/// Sizes as for [`grid`]; no column gets wider than 10⁶ or narrower than 10⁻⁶ times the first, and likewise for
/// rows; a `ratio` that is not a number counts as 1.
///
/// ```
/// let mesh = qmesh::shapes::graded_grid(3, 1, 2.0); // widths 3/7, 6/7, 12/7
/// assert!((mesh.position(qmesh::VertexId(1)).x - 3.0 / 7.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn graded_grid(columns: usize, rows: usize, ratio: f64) -> QuadMesh {
    let lattice = Lattice::open(columns, rows);
    let places = [graded(lattice.columns, ratio), graded(lattice.rows, ratio)];
    lattice.mesh(|[s, t]| {
        let column = (s * lattice.columns as f64).round() as usize;
        let row = (t * lattice.rows as f64).round() as usize;
        Vec3::new(places[0][column], places[1][row], 0.0)
    })
}

/// From 0 to `count`, in steps that grow by `ratio`.
fn graded(count: usize, ratio: f64) -> Vec<f64> {
    const WIDEST: f64 = 1e6;
    let ratio = if ratio.is_nan() { 1.0 } else { ratio.clamp(1.0 / WIDEST, WIDEST) };
    let mut width = 1.0;
    let mut sums = vec![0.0];
    for _ in 0..count {
        sums.push(sums[sums.len() - 1] + width);
        width = (width * ratio).clamp(1.0 / WIDEST, WIDEST);
    }
    let scale = count as f64 / sums[count];
    sums.iter().map(|sum| sum * scale).collect()
}

/// A flat grid whose interior vertices are moved at random by at most `amount` in `x` and in `y`; the boundary stays.
///
/// Sizes as for [`grid`]. `amount` is clamped to `0 ≤ amount ≤ 0.24` (not a number counts as 0), which keeps every
/// quad strictly convex. The same seed gives the same mesh, on every machine.
///
/// ```
/// use qmesh::shapes::{grid, jittered_grid};
/// assert_eq!(jittered_grid(5, 5, 0.0, 7).positions(), grid(5, 5).positions());
/// assert_ne!(jittered_grid(5, 5, 0.2, 7).positions(), jittered_grid(5, 5, 0.2, 8).positions());
/// ```
#[must_use]
pub fn jittered_grid(columns: usize, rows: usize, amount: f64, seed: u64) -> QuadMesh {
    // Two neighbours can come as close as 1 − 2a; a corner turns left as long as (1 − 2a)² > (2a)², that is a < 1/4.
    let amount = if amount.is_nan() { 0.0 } else { amount.clamp(0.0, 0.24) };
    let mesh = grid(columns, rows);
    let mut random = SplitMix64(seed);
    let positions = mesh.vertex_data(|vertex| {
        let shift = Vec3::new(random.signed(), random.signed(), 0.0);
        let here = mesh.positions()[vertex];
        if mesh.is_boundary(vertex) { here } else { here + shift * amount }
    });
    mesh.with_positions(positions)
}
