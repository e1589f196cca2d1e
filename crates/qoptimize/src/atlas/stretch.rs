//! How far an island is stretched, and where most.

use qembed::qmesh::{CornerId, Id, QuadMesh, Vec2, VertexId};
use rayon::prelude::*;

use super::measures::areas;

/// The share of the area that may be stretched more.
const TAIL: f64 = 0.01;

/// How far an island is stretched.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct StretchMeasure {
    /// What 99 % of the area stays below; 1 for an isometry.
    pub quantile: f64,
    /// The vertex around which stretch is largest, as the area-weighted mean over its corners.
    pub worst: VertexId,
    /// The same among the vertices that are not on the boundary.
    pub worst_inside: Option<VertexId>,
    /// The vertex off the boundary whose surroundings have least area in the plane for their area in space.
    pub smallest_inside: Option<VertexId>,
}

/// The stretch of an island: at each corner triangle the larger of `s1` and `1/s2`, with `s1 ≥ s2` the singular values of its map
/// once the island is scaled to its area in space. Twice as long and half as long as it should be count alike. Corner
/// triangles that are not positive count as infinite.
#[must_use]
pub fn stretch(mesh: &QuadMesh, uv: &[Vec2]) -> StretchMeasure {
    let mut values = corner_stretches(mesh, uv, areas(mesh, uv));
    let mut around = mesh.vertex_data(|_| Around::default());
    for (corner, &(stretch, area)) in mesh.corners().zip(&values).filter(|(_, value)| value.1 > 0.0) {
        let here = &mut around[mesh.vertex(corner)];
        here.stretch += stretch.min(1e9) * area;
        here.area += area;
        here.plane += plane_area(mesh, uv, corner);
    }
    let largest = |inside: bool, of: fn(&Around) -> f64| {
        let wanted = around
            .entries()
            .filter(|(vertex, around)| around.area > 0.0 && !(inside && mesh.is_boundary(*vertex)));
        wanted.fold(None, |best: Option<(VertexId, f64)>, (vertex, around)| match best {
            Some((_, known)) if known >= of(around) => best,
            _ => Some((vertex, of(around))),
        })
    };
    let stretched: fn(&Around) -> f64 = |around| around.stretch / around.area;
    let vertex = |found: Option<(VertexId, f64)>| found.map(|(vertex, _)| vertex);
    StretchMeasure {
        quantile: upper_quantile(&mut values),
        worst: vertex(largest(false, stretched)).unwrap_or(VertexId(0)),
        worst_inside: vertex(largest(true, stretched)),
        smallest_inside: vertex(largest(true, |around| -around.plane / around.area)),
    }
}

/// [`StretchMeasure::quantile`] alone, given the areas in space and in the plane.
pub(super) fn quantile(mesh: &QuadMesh, uv: &[Vec2], areas: [f64; 2]) -> f64 {
    upper_quantile(&mut corner_stretches(mesh, uv, areas))
}

/// Stretch and area in space of each corner triangle; the area is 0 where there is none.
fn corner_stretches(mesh: &QuadMesh, uv: &[Vec2], [space, plane]: [f64; 2]) -> Vec<(f64, f64)> {
    let scale = if plane > 0.0 { (space / plane).sqrt() } else { 1.0 };
    let corners = (0..mesh.corner_count()).into_par_iter().with_min_len(4096);
    corners
        .map(|corner| corner_stretch(mesh, uv, CornerId::from_index(corner), scale).unwrap_or((1.0, 0.0)))
        .collect()
}

/// What all but [`TAIL`] of the area stays below. Reorders the values: by halves, so that only the half is looked at further
/// in which the answer lies.
fn upper_quantile(values: &mut [(f64, f64)]) -> f64 {
    let area = |values: &[(f64, f64)]| values.iter().map(|value| value.1).sum::<f64>();
    let mut left = TAIL * area(values);
    if left <= 0.0 {
        return 1.0;
    }
    let mut rest = values;
    while rest.len() > 1 {
        let middle = rest.len() / 2;
        rest.select_nth_unstable_by(middle, |a, b| b.0.total_cmp(&a.0));
        let (above, below) = rest.split_at_mut(middle);
        let passed = area(above);
        rest = if passed > left {
            above
        } else {
            left -= passed;
            below
        };
    }
    rest.first().map_or(1.0, |value| value.0)
}

/// Sums over the corners around a vertex.
#[derive(Clone, Copy, Debug, Default)]
struct Around {
    /// Of stretch times area in space.
    stretch: f64,
    /// Of areas in space.
    area: f64,
    /// Of areas in the plane.
    plane: f64,
}

/// The area in the plane of a corner triangle.
fn plane_area(mesh: &QuadMesh, uv: &[Vec2], corner: CornerId) -> f64 {
    let here = uv[corner.index()];
    let [p, q] = [mesh.next_corner(corner), mesh.previous_corner(corner)].map(|c| uv[c.index()] - here);
    0.5 * p.perp(&q)
}

/// Stretch and area in space of a corner triangle; nothing when it has no area.
fn corner_stretch(mesh: &QuadMesh, uv: &[Vec2], corner: CornerId, scale: f64) -> Option<(f64, f64)> {
    let [a, b] = mesh.corner_vectors(corner);
    let length = a.norm();
    if length <= 0.0 {
        return None;
    }
    // The triangle in its own plane: a along x.
    let along = a.dot(&b) / length;
    let height = a.cross(&b).norm() / length;
    let area = 0.5 * length * height;
    if !(area > 0.0 && height > 1e-9 * b.norm()) {
        return None;
    }
    let here = uv[corner.index()];
    let [p, q] =
        [mesh.next_corner(corner), mesh.previous_corner(corner)].map(|c| scale * (uv[c.index()] - here));
    let first = p / length;
    let second = (q - first * along) / height;
    let (squares, det) = (first.norm_squared() + second.norm_squared(), first.perp(&second));
    if det <= 0.0 {
        return Some((f64::INFINITY, area));
    }
    let root = (squares * squares - 4.0 * det * det).max(0.0).sqrt();
    let largest = (0.5 * (squares + root)).sqrt();
    Some((largest.max(largest / det), area))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// The first value, from the largest down, with which the areas passed exceed the tail.
        #[test]
        fn the_quantile_is_that_of_sorted_values(values in prop::collection::vec((0u32..50, 0u32..40), 1..400)) {
            // Areas in 64ths, so that their sums are exact in any order.
            let mut values: Vec<(f64, f64)> =
                values.into_iter().map(|(s, a)| (f64::from(s), f64::from(a) / 64.0)).collect();
            let mut sorted = values.clone();
            sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
            let total: f64 = values.iter().map(|value| value.1).sum();
            let mut passed = 0.0;
            let expected = sorted.iter().find(|value| {
                passed += value.1;
                passed > TAIL * total
            });
            prop_assert_eq!(upper_quantile(&mut values), expected.map_or(1.0, |value| value.0));
        }
    }
}
