//! The measures of Shay, Solomon and Stein, "A Dataset and Benchmark for Mesh Parameterization" (2022), as theirs:
//! on fans of triangles, flipped ones included with their unsigned stretch, both surfaces scaled to area 1.

use std::f64::consts::TAU;
use std::ops::Range;

use qembed::qmesh::{Vec2, Vec3};

use super::corners::{Stretch, Surface, turn};
use super::eight::{Eight, FANS};
use super::statistics::by_runs;
use super::tally::two_quads;
use crate::lanes::{LANES, Lanes, vectorized};

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

/// Areas in space and, unsigned, in the plane.
fn areas(surface: &Surface<'_>, faces: Range<usize>) -> [f64; 2] {
    let (mut sums, mut others) = ([Lanes::ZERO; 2], [0.0; 2]);
    vectorized(
        #[inline(always)]
        || {
            let mut face = faces.start;
            while face < faces.end {
                if let Some(eight) = four_quads(surface, face, &faces) {
                    sums[0] += eight.space_area;
                    sums[1] += eight.plane_area;
                    face += 4;
                    continue;
                }
                for triangle in fans(surface, face..face + 1) {
                    others[0] += triangle.space_area;
                    others[1] += triangle.turn.abs() / 2.0;
                }
                face += 1;
            }
        },
    );
    std::array::from_fn(|i| sums[i].0.iter().sum::<f64>() + others[i])
}

/// The fans of four quads, if `face` and the next three in `faces` are ordinary ones.
#[inline(always)]
fn four_quads(surface: &Surface<'_>, face: usize, faces: &Range<usize>) -> Option<Eight> {
    let first = two_quads(surface, face, faces)?;
    two_quads(surface, face + 2, faces)?;
    Eight::of::<16>(surface, first, &FANS)
}

/// `space` and `plane`: what lengths are multiplied with so that each surface has area 1.
fn sums(surface: &Surface<'_>, faces: Range<usize>, space: f64, plane: f64) -> Sums {
    let mut sums = Sums::default();
    vectorized(
        #[inline(always)]
        || {
            let mut fours = Fours::new();
            let mut face = faces.start;
            while face < faces.end {
                let eight = four_quads(surface, face, &faces);
                if eight.is_some_and(|eight| fours.add(&eight, space, plane)) {
                    face += 4;
                } else {
                    sums.add(surface, face..face + 1, space, plane);
                    face += 1;
                }
            }
            fours.add_to(&mut sums);
        },
    );
    sums
}

/// Sums over quads, four at a time.
struct Fours {
    triangles: usize,
    area_ratio: Lanes,
    area_difference: Lanes,
    smallest: Lanes,
    largest: Lanes,
    angle_ratio: Lanes,
    angle_difference: Lanes,
    dirichlet: Lanes,
}

impl Fours {
    fn new() -> Self {
        let zero = Lanes::ZERO;
        Self {
            triangles: 0,
            area_ratio: zero,
            area_difference: zero,
            smallest: Lanes::all(f64::INFINITY),
            largest: zero,
            angle_ratio: zero,
            angle_difference: zero,
            dirichlet: zero,
        }
    }

    /// False, with nothing done, when one of the triangles is to be looked at closely.
    #[inline(always)]
    fn add(&mut self, eight: &Eight, space: f64, plane: f64) -> bool {
        let area = eight.space_area * (space * space);
        let Some(stretches) = eight.stretches(space, plane) else { return false };
        if !area.all_above(NO_AREA) {
            return false;
        }
        let plane_area = eight.plane_area * (plane * plane);
        let (s1, s2) = (stretches.large, stretches.small);
        let larger = |a: Lanes, b: Lanes| a.if_less(b, b, a);
        let ([theta, phi], [theta2, phi2]) = (eight.angles(), eight.second_angles());
        let (first, second) = (theta - phi, theta2 - phi2);
        self.triangles += LANES;
        self.area_difference += (plane_area - area).abs();
        self.area_ratio = larger(self.area_ratio, plane_area * area.recip() + area * plane_area.recip());
        self.smallest = s2.if_less(self.smallest, s2, self.smallest);
        self.largest = larger(self.largest, s1);
        self.angle_ratio = larger(self.angle_ratio, s1 * s2.recip() + s2 * s1.recip());
        self.angle_difference += area * (first.abs() + second.abs() + (first + second).abs());
        self.dirichlet += area * (s1 * s1 + s2 * s2 + (s1 * s1).recip() + (s2 * s2).recip()) * 0.5;
        true
    }

    fn add_to(&self, sums: &mut Sums) {
        let sum = |lanes: Lanes| lanes.0.iter().sum::<f64>();
        let largest = |lanes: Lanes| lanes.0.into_iter().fold(0.0, f64::max);
        sums.triangles += self.triangles;
        sums.area_ratio = sums.area_ratio.max(largest(self.area_ratio));
        sums.area_difference += sum(self.area_difference);
        if self.triangles > 0 {
            let smallest = self.smallest.0.into_iter().fold(f64::INFINITY, f64::min);
            sums.smallest = Some(sums.smallest.map_or(smallest, |s| s.min(smallest)));
        }
        sums.largest = sums.largest.max(largest(self.largest));
        sums.angle_ratio = sums.angle_ratio.max(largest(self.angle_ratio));
        sums.angle_difference += sum(self.angle_difference);
        sums.dirichlet += sum(self.dirichlet);
    }
}

impl Sums {
    /// Faces one by one.
    fn add(&mut self, surface: &Surface<'_>, faces: Range<usize>, space: f64, plane: f64) {
        let sums = self;
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
    }
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
    let totals = by_runs(faces, |run| areas(surface, run));
    let (space, plane) = totals.iter().fold((0.0, 0.0), |(s, p), part| (s + part[0], p + part[1]));
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
