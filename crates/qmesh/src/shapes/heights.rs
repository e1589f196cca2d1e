//! Height fields over the square `[−1, 1]²`: a hill, a nose, a saddle.

use super::elementary::gauss;
use super::lattice::Lattice;
use crate::{QuadMesh, Vec3};

/// A round hill: `z = height · exp(−½ (x² + y²) / 0.3²)`.
///
/// `cells` × `cells` quads, at least 1 (clamped); `height` is clamped to ±10⁶ (not a number counts as 0). A disk,
/// the same seen from all four sides.
///
/// ```
/// let mesh = qmesh::shapes::bump(10, 0.5);
/// let top = mesh.positions().iter().map(|p| p.z).fold(0.0, f64::max);
/// assert_eq!(top, 0.5);
/// ```
#[must_use]
pub fn bump(cells: usize, height: f64) -> QuadMesh {
    let height = if height.is_nan() { 0.0 } else { height.clamp(-1e6, 1e6) };
    field(cells, |x, y| height * gauss(x * x + y * y, 0.3))
}

/// A steep ridge on a plain: it rises slowly from the top like the back of a nose, and falls off at its tip.
///
/// `z = 0.9 · exp(−½ (x / 0.15)²) · exp(−½ (y / w)²)` with `w = 0.45` above the tip (`y > 0`) and `0.12` below.
/// `cells` × `cells` quads, at least 1 (clamped). A disk, mirror-symmetric in `x`.
///
/// ```
/// assert_eq!(qmesh::shapes::nose(24).face_count(), 576);
/// ```
#[must_use]
pub fn nose(cells: usize) -> QuadMesh {
    field(cells, |x, y| 0.9 * gauss(x * x, 0.15) * gauss(y * y, if y > 0.0 { 0.45 } else { 0.12 }))
}

/// A saddle: `z = ½ (x² − y²)`, of negative Gaussian curvature everywhere.
///
/// `cells` × `cells` quads, at least 1 (clamped). A disk, mirror-symmetric in `x` and in `y`.
///
/// ```
/// assert!(qmesh::shapes::saddle(8).topology().is_disk());
/// ```
#[must_use]
pub fn saddle(cells: usize) -> QuadMesh {
    field(cells, |x, y| 0.5 * (x * x - y * y))
}

fn field(cells: usize, height: impl Fn(f64, f64) -> f64) -> QuadMesh {
    let lattice = Lattice::square(cells);
    let count = lattice.columns as f64;
    // From the numerator, so that opposite coordinates are the same but for the sign.
    let place = |fraction: f64| (2.0 * (fraction * count).round() - count) / count;
    lattice.mesh(|[s, t]| {
        let (x, y) = (place(s), place(t));
        Vec3::new(x, y, height(x, y))
    })
}
