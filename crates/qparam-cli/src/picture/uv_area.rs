//! How large a map is.

use qoptimize::qmesh::{PolygonView, Vec2};

/// Total area of the faces in the plane, flipped ones counted like the others; never zero.
pub(crate) fn uv_area(polygons: PolygonView<'_>, uv: &[Vec2]) -> f64 {
    let area = |face: usize| {
        let corners = &uv[polygons.corners(face)];
        let around = corners.iter().zip(corners.iter().cycle().skip(1));
        let origin = corners.first().copied().unwrap_or_default();
        (around.map(|(a, b)| (a - origin).perp(&(b - origin))).sum::<f64>() / 2.0).abs()
    };
    (0..polygons.face_count()).map(area).sum::<f64>().max(f64::MIN_POSITIVE)
}
