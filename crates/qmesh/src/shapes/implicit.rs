//! Solids as functions of space, negative inside: ellipsoids and capsules that melt into each other.
//!
//! Values are close to distances near the surface, which is what [`cast`] needs to find it.

use crate::Vec3;

/// An ellipsoid with its axes along the coordinates. The value is exact on the surface and along the axes.
pub(crate) fn ellipsoid(p: Vec3, center: [f64; 3], radii: [f64; 3]) -> f64 {
    let radii = Vec3::from(radii);
    let q = (p - Vec3::from(center)).component_div(&radii);
    let (level, slope) = (q.norm(), q.component_div(&radii).norm());
    if slope > 0.0 { level * (level - 1.0) / slope } else { -radii.min() }
}

/// A ball.
pub(crate) fn ball(p: Vec3, center: [f64; 3], radius: f64) -> f64 {
    (p - Vec3::from(center)).norm() - radius
}

/// A segment thickened by a radius that changes evenly from one end to the other.
pub(crate) fn capsule(p: Vec3, ends: [[f64; 3]; 2], radii: [f64; 2]) -> f64 {
    let [a, b] = ends.map(Vec3::from);
    let along = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
    (p - a.lerp(&b, along)).norm() - (radii[0] + (radii[1] - radii[0]) * along)
}

/// The union of two solids, rounded where they meet: no farther than `blend` from either.
pub(crate) fn melt(a: f64, b: f64, blend: f64) -> f64 {
    let overlap = (blend - (a - b).abs()).max(0.0);
    a.min(b) - overlap * overlap / (4.0 * blend)
}

/// The first solid without the second, the rim rounded.
pub(crate) fn carve(a: f64, b: f64, blend: f64) -> f64 {
    -melt(-a, b, blend)
}

/// Where the ray from `origin` towards `target` leaves `solid` for the last time, at most `reach` from the origin.
///
/// Walks inwards, so that nothing is hidden; gives the origin back when the ray never meets the solid.
pub(crate) fn cast(solid: impl Fn(Vec3) -> f64, origin: Vec3, target: Vec3, reach: f64) -> Vec3 {
    // Blends and flat ellipsoids overstate distances a little.
    const CAUTION: f64 = 0.7;
    const SHORTEST_STEP: f64 = 2e-3;
    let direction = (target - origin) / (target - origin).norm();
    let value = |along: f64| solid(origin + direction * along);
    let (mut outside, mut outside_value) = (reach, value(reach));
    let (mut inside, mut inside_value);
    loop {
        inside = (outside - (outside_value * CAUTION).max(SHORTEST_STEP)).max(0.0);
        inside_value = value(inside);
        if inside_value <= 0.0 {
            break;
        }
        if inside <= 0.0 {
            return origin;
        }
        (outside, outside_value) = (inside, inside_value);
    }
    // Regula falsi with the Illinois rule: an end that stays put loses half its weight.
    let mut middle = inside;
    for _ in 0..24 {
        middle = outside - (outside - inside) * outside_value / (outside_value - inside_value);
        let middle_value = value(middle);
        if middle_value > 0.0 {
            (outside, outside_value) = (middle, middle_value);
            inside_value *= 0.5;
        } else {
            (inside, inside_value) = (middle, middle_value);
            outside_value *= 0.5;
        }
        if middle_value.abs() < 1e-13 || outside - inside < 1e-13 {
            break;
        }
    }
    origin + direction * middle
}
