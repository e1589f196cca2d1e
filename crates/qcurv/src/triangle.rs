//! One triangle: its angle, its area, and the Voronoi cell of one of its corners.
//!
//! Lengths are scaled to the order of one first, so squares and products of tiny edges do not underflow.

use qmesh::Vec3;

/// The angle between two directions, in `[0, π]`; 0 when one of them has no length.
pub(crate) fn angle_between(a: Vec3, b: Vec3) -> f64 {
    let (a, b) = (unscaled(a), unscaled(b));
    a.cross(&b).norm().atan2(a.dot(&b)) // acos would lose its digits near 0 and π
}

/// The area of the triangle with the sides `ab` and `ac` at its corner A.
#[must_use]
pub fn triangle_area(ab: Vec3, ac: Vec3) -> f64 {
    let (scale_b, scale_c) = (largest(ab), largest(ac));
    0.5 * unscaled(ab).cross(&unscaled(ac)).norm() * scale_b * scale_c
}

/// The area of the part of the triangle ABC that is nearer to A than to B and C, from the sides `ab` and `ac`
/// (Eqs. 3 and 4). It lies between 0 and the area of the triangle, and is 0 for a triangle without area.
///
/// With the edges as they are printed Eq. 4 is wrong, and it lacks the triangles that are obtuse at B or at C. From
/// "the bisector of AB meets BC at the distance `|AB| / (2 cos B)` from B" follow
///
/// | triangle | cell of A |
/// |---|---|
/// | nowhere obtuse (Eq. 3) | `(│AC│² cot B + │AB│² cot C) / 8` |
/// | obtuse at A (Eq. 4) | `S − │AB│² tan B / 8 − │AC│² tan C / 8` |
/// | obtuse at B | `│AB│² tan A / 8` |
/// | obtuse at C | `│AC│² tan A / 8` |
#[must_use]
pub fn voronoi_cell_area(ab: Vec3, ac: Vec3) -> f64 {
    let scale = largest(ab).max(largest(ac));
    if scale <= 0.0 {
        return 0.0;
    }
    unit_cell_area(ab / scale, ac / scale) * scale * scale
}

fn unit_cell_area(ab: Vec3, ac: Vec3) -> f64 {
    let bc = ac - ab;
    let double_area = ab.cross(&ac).norm();
    if double_area <= 0.0 {
        return 0.0;
    }
    let (ab2, ac2) = (ab.norm_squared(), ac.norm_squared());
    // tan X = double_area / dot_x and cot X = dot_x / double_area; a negative dot_x says "obtuse at X".
    let (dot_a, dot_b, dot_c) = (ab.dot(&ac), -ab.dot(&bc), ac.dot(&bc));
    let area = 0.5 * double_area;
    let cell = if dot_a < 0.0 {
        area - (ab2 * double_area / dot_b + ac2 * double_area / dot_c) / 8.0 // Eq. 4, corrected
    } else if dot_b < 0.0 {
        ab2 * double_area / dot_a / 8.0
    } else if dot_c < 0.0 {
        ac2 * double_area / dot_a / 8.0
    } else {
        (ac2 * dot_b + ab2 * dot_c) / double_area / 8.0 // Eq. 3
    };
    // `min` and `max` also turn the NaN of 0/0 in a needle of one rounding error's width into a bound.
    cell.max(0.0).min(area)
}

/// The largest coordinate, without its sign.
fn largest(v: Vec3) -> f64 {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

/// `v` with its largest coordinate brought to one; zero stays zero.
fn unscaled(v: Vec3) -> Vec3 {
    let scale = largest(v);
    if scale > 0.0 { v / scale } else { v }
}
