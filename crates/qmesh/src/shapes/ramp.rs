//! Strips whose truest flattening lies on itself.

use std::f64::consts::TAU;

use super::elementary::{gauss, sin_cos};
use super::lattice::Lattice;
use crate::{QuadMesh, Vec3};

/// A spiral ramp of `turns` full turns around the z axis, from radius 1 to radius 1.5, that climbs by 0.2 a turn.
///
/// Nearly flat everywhere, but beyond one turn its truest map to the plane lies on itself. `turns` is clamped to
/// `0.01 ≤ turns ≤ 16` (not a number counts as 1); `columns` along and `rows` across are at least 1, at most 2²⁴ and 2²⁸
/// faces. A disk.
///
/// ```
/// assert!(qmesh::shapes::ramp(1.5, 48, 3).topology().is_disk());
/// ```
#[must_use]
pub fn ramp(turns: f64, columns: usize, rows: usize) -> QuadMesh {
    let turns = if turns.is_nan() { 1.0 } else { turns.clamp(0.01, 16.0) };
    Lattice::open(columns, rows).mesh(|[s, t]| {
        let [sine, cosine] = sin_cos(s * turns);
        let radius = 1.5 - 0.5 * t;
        Vec3::new(radius * cosine, radius * sine, 0.2 * turns * s)
    })
}

/// A flat C, open by `gap` of a full turn, with a hill of `height` on each end: flattened, the hills want the gap.
///
/// Radii 1 to 1.8. `gap` is clamped to `0.001 ≤ gap ≤ 0.5` (not a number counts as 0.05), `height` to `0 ≤ height ≤ 10` (not a
/// number counts as 0); `columns` along and `rows` across as for [`ramp`]. A disk.
///
/// ```
/// assert!(qmesh::shapes::horseshoe(0.05, 1.0, 60, 8).topology().is_disk());
/// ```
#[must_use]
pub fn horseshoe(gap: f64, height: f64, columns: usize, rows: usize) -> QuadMesh {
    const MIDDLE: f64 = 1.4;
    const HILL: f64 = 0.2;
    let gap = if gap.is_nan() { 0.05 } else { gap.clamp(0.001, 0.5) };
    let height = if height.is_nan() { 0.0 } else { height.clamp(0.0, 10.0) };
    Lattice::open(columns, rows).mesh(|[s, t]| {
        let turns = 0.5 * gap + s * (1.0 - gap);
        let [sine, cosine] = sin_cos(turns);
        let radius = 1.8 - 0.8 * t;
        let from_end = (turns.min(1.0 - turns) - 0.5 * gap) * TAU * MIDDLE - 0.4;
        let hill = height * gauss(from_end * from_end + (radius - MIDDLE) * (radius - MIDDLE), HILL);
        Vec3::new(radius * cosine, radius * sine, hill)
    })
}
