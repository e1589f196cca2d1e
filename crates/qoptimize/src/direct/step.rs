//! How far a step may go: no corner may reach zero area.

use crate::qmesh::Vec2;
use rayon::prelude::*;

use super::energy::edges;
use super::rest::Rest;

/// The smallest positive `t` at which a corner of `uv + t · direction` has no area; infinite when none ever has.
///
/// Each corner's area is a quadratic in `t` [Smith, Schaefer 2015].
pub(super) fn first_collapse(rest: &Rest, uv: &[Vec2], direction: &[Vec2]) -> f64 {
    rest.corners
        .par_iter()
        .with_min_len(4096)
        .map(|corner| {
            let [ax, ay, bx, by] = edges(corner, uv);
            let [cx, cy, dx, dy] = edges(corner, direction);
            smallest_root(cx * dy - cy * dx, ax * dy - ay * dx + cx * by - cy * bx, ax * by - ay * bx)
        })
        .reduce(|| f64::INFINITY, f64::min)
}

/// The smallest positive root of `a t² + b t + c`, where `c > 0`.
fn smallest_root(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return f64::INFINITY;
    }
    let root = discriminant.sqrt();
    // The form without cancellation: with c > 0 the smallest positive root is this one, if it is positive.
    let denominator = root - b;
    if denominator > 0.0 { 2.0 * c / denominator } else { f64::INFINITY }
}
