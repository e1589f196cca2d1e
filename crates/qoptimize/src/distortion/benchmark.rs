//! The measures of Shay, Solomon and Stein, "A Dataset and Benchmark for Mesh Parameterization" (2022), as theirs:
//! on fans of triangles, flipped ones included with their unsigned stretch, both surfaces scaled to area 1.

use std::f64::consts::TAU;
use std::ops::Range;

use qembed::qmesh::{Vec2, Vec3};

use super::corners::{Stretch, Surface, turn};
use super::statistics::by_runs;

/// The measures of the benchmark of Shay, Solomon and Stein (2022) under their names, on fans of triangles from each
/// face's first corner, as theirs. `None` stands for infinity: some triangle has collapsed in the plane.
///
/// Triangles of no area in space are left out. The benchmark takes UVs as they are: nothing is mirrored.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Benchmark {
    /// max (A_uv/A + A/A_uv) − 2, both total 1.
    pub max_area_distortion: Option<f64>,
    /// Σ |A_uv − A|, both total 1.
    pub average_area_discrepancy: f64,
    /// Smallest singular value, both areas 1.
    pub min_singular_value: f64,
    /// Largest singular value, both areas 1.
    pub max_singular_value: f64,
    /// Share of triangles with negative area, or of the others if those are fewer.
    pub proportion_flipped_triangles: f64,
    /// max (σ1/σ2 + σ2/σ1) − 2.
    pub max_angle_distortion: Option<f64>,
    /// Area-weighted sum of |change of corner angle| in radians; a triangle with an edge of no length counts 6π.
    pub average_angle_discrepancy: f64,
    /// max 1/σ with the UVs fitted to the unit square and the mesh in its own unit of length: the texels along the
    /// square's side that give every triangle one texel per unit. The only measure that depends on the unit.
    pub resolution: Option<f64>,
    /// Area-weighted ½ Σ (σ² + σ⁻²): 2 for an isometry. Flipped triangles are not told apart.
    pub symmetric_dirichlet_energy: Option<f64>,
}

/// Triangles below this share of the area have no measurable stretch.
const NO_AREA: f64 = 1e-60;

struct Triangle {
    space: [Vec3; 3],
    plane: [Vec2; 3],
    space_area: f64,
    /// Twice the signed area.
    turn: f64,
}

fn fans<'a>(surface: &'a Surface<'_>, faces: Range<usize>) -> impl Iterator<Item = Triangle> + 'a {
    faces.flat_map(move |face| {
        let range = surface.polygons.corners(face);
        let first = range.start;
        (first + 1..range.end.saturating_sub(1)).map(move |corner| {
            let space = [first, corner, corner + 1].map(|c| surface.position(c));
            let plane = [first, corner, corner + 1].map(|c| surface.uv(c));
            let space_area = (space[1] - space[0]).cross(&(space[2] - space[0])).norm() / 2.0;
            Triangle { space, plane, space_area, turn: turn(plane[0], plane[1], plane[2]) }
        })
    })
}

#[derive(Default)]
struct Sums {
    triangles: usize,
    flipped: usize,
    area_ratio: f64,
    area_difference: f64,
    smallest: Option<f64>,
    largest: f64,
    angle_ratio: f64,
    angle_difference: f64,
    dirichlet: f64,
}

/// `space` and `plane`: what lengths are multiplied with so that each surface has area 1.
fn sums(surface: &Surface<'_>, faces: Range<usize>, space: f64, plane: f64) -> Sums {
    let mut sums = Sums::default();
    for triangle in fans(surface, faces) {
        let area = triangle.space_area * space * space;
        let plane_area = triangle.turn.abs() / 2.0 * plane * plane;
        sums.area_difference += (plane_area - area).abs();
        if area < NO_AREA {
            continue;
        }
        let [a, b, c] = triangle.space;
        let [p, q, r] = triangle.plane;
        let edges = [(b - a) * space, (c - a) * space];
        let stretch = Stretch::of(edges, area, [(q - p) * plane, (r - p) * plane], plane_area);
        let (s1, s2) = (stretch.large, stretch.small);
        sums.triangles += 1;
        sums.flipped += usize::from(triangle.turn < 0.0);
        sums.area_ratio = sums.area_ratio.max(plane_area / area + area / plane_area);
        sums.smallest = Some(sums.smallest.map_or(s2, |s| s.min(s2)));
        sums.largest = sums.largest.max(s1);
        sums.angle_ratio = sums.angle_ratio.max(if s2 > 0.0 { s1 / s2 + s2 / s1 } else { f64::INFINITY });
        sums.angle_difference += area * angle_difference(&triangle);
        sums.dirichlet += area * 0.5 * (s1 * s1 + s2 * s2 + 1.0 / (s1 * s1) + 1.0 / (s2 * s2));
    }
    sums
}

/// Sum over the corners of the change of the (unsigned) angle; a full turn for each when a side has no length.
fn angle_difference(triangle: &Triangle) -> f64 {
    let [a, b, c] = triangle.space;
    let [p, q, r] = triangle.plane;
    let (space, plane) = ([b - a, c - b, a - c], [q - p, r - q, p - r]);
    if space.iter().any(|side| side.norm_squared() == 0.0)
        || plane.iter().any(|side| side.norm_squared() == 0.0)
    {
        return 3.0 * TAU;
    }
    let doubled = [2.0 * triangle.space_area, triangle.turn.abs()];
    let first = doubled[0].atan2(-space[0].dot(&space[2])) - doubled[1].atan2(-plane[0].dot(&plane[2]));
    let second = doubled[0].atan2(-space[0].dot(&space[1])) - doubled[1].atan2(-plane[0].dot(&plane[1]));
    // Both triangles have the same angle sum.
    first.abs() + second.abs() + (first + second).abs()
}

pub(super) fn benchmark(surface: &Surface<'_>) -> Benchmark {
    let faces = surface.polygons.face_count();
    let totals = by_runs(faces, |run| {
        fans(surface, run).fold((0.0, 0.0), |(s, p), t| (s + t.space_area, p + t.turn.abs() / 2.0))
    });
    let (space, plane) = totals.iter().fold((0.0, 0.0), |(s, p), part| (s + part.0, p + part.1));
    // Without area there is nothing to scale, and the measures say so as they are.
    let unit = |area: f64| if area > 0.0 { f64::sqrt(1.0 / area) } else { 1.0 };
    let (space, plane) = (unit(space), unit(plane));
    let mut all = Sums::default();
    for part in by_runs(faces, |run| sums(surface, run, space, plane)) {
        all.triangles += part.triangles;
        all.flipped += part.flipped;
        all.area_ratio = all.area_ratio.max(part.area_ratio);
        all.area_difference += part.area_difference;
        all.smallest = [all.smallest, part.smallest].into_iter().flatten().reduce(f64::min);
        all.largest = all.largest.max(part.largest);
        all.angle_ratio = all.angle_ratio.max(part.angle_ratio);
        all.angle_difference += part.angle_difference;
        all.dirichlet += part.dirichlet;
    }
    let finite = |value: f64| value.is_finite().then_some(value);
    let smallest = all.smallest.unwrap_or(0.0);
    let flipped = all.flipped as f64 / all.triangles.max(1) as f64;
    // From areas 1 and 1 back to the mesh's own length and a unit square: σ · (extent · plane)⁻¹ · space · scale.
    let fit = longer_side(surface) * plane / (space * surface.position_scale);
    Benchmark {
        max_area_distortion: finite(all.area_ratio - 2.0),
        average_area_discrepancy: all.area_difference,
        min_singular_value: smallest,
        max_singular_value: all.largest,
        proportion_flipped_triangles: flipped.min(1.0 - flipped),
        max_angle_distortion: finite(all.angle_ratio - 2.0),
        average_angle_discrepancy: all.angle_difference,
        resolution: finite(fit / smallest),
        symmetric_dirichlet_energy: finite(all.dirichlet),
    }
}

/// The longer side of the bounding box of the UVs.
fn longer_side(surface: &Surface<'_>) -> f64 {
    let corners = 0..surface.uv.len();
    let low = corners.clone().map(|c| surface.uv(c)).reduce(|a, b| a.inf(&b));
    let high = corners.map(|c| surface.uv(c)).reduce(|a, b| a.sup(&b));
    low.zip(high).map_or(0.0, |(low, high)| (high - low).max())
}
