//! How good a UV map is: the paper's errors (Eqs. 13 and 14), the field's measures, flips and crossings.
//!
//! # Definitions
//! *T* are the polygons in space, *U* their UVs. Everything is measured on *corner triangles* (previous, this, next
//! corner), four a quad, so no diagonal is preferred. Corners with the same vertex and the same UV (`-0` is `0`) are
//! one point of the map; faces joined through an edge between the same two points form an *island*. An island of
//! negative total area is mirrored first. U is scaled once, globally, so that both have the same area, a quad's being
//! the mean of its two diagonal splits. UV areas are signed.
//!
//! Signs are exact (adaptive predicates), everything else is rounded as usual. Scaling, turning, moving or mirroring
//! U, and scaling T, change nothing else than [`Benchmark::resolution`]. Sums are in fixed order: the same bits for
//! any number of threads.
//!
//! # Limits
//! UV angles count at least 1e-9, and UV areas at least 1e-12 of the mean, as divisors; how often that happened is
//! reported. Stretches end at 1e150. What has no value (a mean over no corners, an infinite maximum) is `None`, so no
//! measure is ever infinite or not a number. Corner triangles below 1e-14 of the mean area in space take no part in
//! measures of stretch.

mod benchmark;
mod corners;
mod eight;
mod error;
mod faces;
mod quads;
mod statistics;
mod tally;

pub use benchmark::Benchmark;
pub use error::MeasureError;
pub(crate) use error::{check, check_arrays, check_polygons, first};
pub use faces::{FaceMeasure, FaceMeasures, measure_faces, measure_worst_faces};
use qembed::qmesh::{PolygonView, Vec2};
use rayon::prelude::*;

use self::corners::Surface;
use self::statistics::{by_runs, quantile};
use self::tally::{Areas, Frame, Tally};
pub use crate::plane::CROSSING_LIMIT;
use crate::plane::{Crossings, Islands, Outline, Scope, find_crossings};

/// Every measure of a UV map; see the [module](self) for the definitions. Means over corners are plain means unless
/// said.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Distortion {
    /// Faces measured.
    pub faces: usize,
    /// Corners measured.
    pub corners: usize,
    /// Pieces that are connected in the plane.
    pub islands: usize,
    /// Islands of negative total area, mirrored before they were measured.
    pub mirrored_islands: usize,
    /// Eq. 13: Σ (θ/φ − 1)² over the corners; θ in space, φ the interior angle in the plane, in (0, 2π).
    pub angle_error: f64,
    /// Eq. 13 divided by the number of corners.
    pub angle_error_mean: f64,
    /// Median of the terms of Eq. 13.
    pub angle_error_median: f64,
    /// 99th percentile of the terms of Eq. 13.
    pub angle_error_p99: f64,
    /// Mean of (max(θ/φ, φ/θ) − 1)²: growing and shrinking count alike.
    pub angle_error_symmetric: f64,
    /// Corners whose UV angle counted as 1e-9.
    pub angle_clamped: usize,
    /// Root mean square of θ − φ, in degrees.
    pub angle_rms_degrees: f64,
    /// Eq. 14: Σ (A(T)/A(U) − 1)² over the corner triangles; signed areas, total areas made equal.
    pub area_error: f64,
    /// Eq. 14 divided by the number of corner triangles.
    pub area_error_mean: f64,
    /// Median of the terms of Eq. 14.
    pub area_error_median: f64,
    /// 99th percentile of the terms of Eq. 14.
    pub area_error_p99: f64,
    /// Mean of (max(r, 1/r) − 1)², r = A(T)/A(U), over corner triangles of positive area; `None` without any.
    pub area_error_symmetric: Option<f64>,
    /// Corner triangles whose UV area counted as 1e-12 of the mean.
    pub area_clamped: usize,
    /// Eq. 14 at the scale of U that makes it smallest; the number of corners when it falls for ever as U grows.
    pub area_error_best_scale: f64,
    /// Area-weighted mean of (s1² + s2² + s1⁻² + s2⁻²)/4; 1 for an isometry. Over corner triangles that are not
    /// flipped; `None` without any.
    pub symmetric_dirichlet: Option<f64>,
    /// Its largest value.
    pub symmetric_dirichlet_max: Option<f64>,
    /// Area-weighted mean of (s1/s2 + s2/s1)/2; 1 where conformal. Not flipped ones only.
    pub mips: Option<f64>,
    /// Area-weighted mean of (s1 − 1)² + (s2 − 1)²; 0 for an isometry. Not flipped ones only.
    pub arap: Option<f64>,
    /// Area-weighted mean of s1/s2. Not flipped ones only.
    pub singular_ratio_mean: Option<f64>,
    /// 99th percentile of s1/s2 over the corners that are not flipped.
    pub singular_ratio_p99: Option<f64>,
    /// Largest s1/s2. Not flipped ones only.
    pub singular_ratio_max: Option<f64>,
    /// Sander's L2 stretch, of the map from the plane to space; flipped ones count unsigned. At most 1e150.
    pub stretch_l2: f64,
    /// Sander's L∞ stretch. At most 1e150.
    pub stretch_linf: f64,
    /// Corner triangles of no positive area.
    pub flipped_corners: usize,
    /// Of those, the ones that are not concave in space already.
    pub newly_flipped_corners: usize,
    /// Corners that are concave in space, against the mean normal of their face.
    pub concave_corners: usize,
    /// Faces with a flipped corner.
    pub flipped_faces: usize,
    /// Quads of which neither diagonal gives two positive triangles; triangles and n-gons of no positive area.
    pub folded_faces: usize,
    /// Faces of no positive area.
    pub negative_faces: usize,
    /// Faces of five corners or more without a flipped corner that wind round more than once, like a pentagram.
    pub wound_faces: usize,
    /// Edges of the map with more than two faces, or with two faces that run the same way.
    pub nonmanifold_edges: usize,
    /// Connected pieces of the islands' boundaries: loops, where nothing is pinched.
    pub boundary_loops: usize,
    /// Points of the map that the boundary does not enter and leave exactly once.
    pub boundary_pinches: usize,
    /// Pairs of boundary edges of one island that meet though they share no point of the map; touching counts.
    /// At most [`CROSSING_LIMIT`].
    pub boundary_crossings: usize,
    /// Whether every pair was looked at. `false` makes `boundary_crossings` a lower bound: there are as many as the
    /// limit, or the boundary is so entangled that looking at all pairs would take minutes.
    pub boundary_crossings_complete: bool,
    /// The measures of the Shay-Solomon-Stein benchmark under their names.
    pub benchmark: Benchmark,
}

/// Measures the UVs of polygons, whoever made them. One UV per corner.
///
/// Any soup of polygons will do: several components, non-manifold edges, faces of any degree, vertices without faces.
/// Time grows as n log n; a million quads take about a second on two cores.
///
/// # Errors
/// UVs or positions that are not finite, or of no area at all; arrays that contradict each other. See [`MeasureError`].
pub fn measure(polygons: PolygonView<'_>, corner_uv: &[Vec2]) -> Result<Distortion, MeasureError> {
    check(polygons, corner_uv)?;
    measure_islands(polygons, corner_uv, &Islands::find(polygons, corner_uv))
}

/// As [`measure`], for arrays that are checked already and whose islands are known.
pub(crate) fn measure_islands(
    polygons: PolygonView<'_>,
    corner_uv: &[Vec2],
    islands: &Islands,
) -> Result<Distortion, MeasureError> {
    let surface = Surface::new(polygons, corner_uv);
    let ((outline, crossings), (areas, benchmark)) = rayon::join(
        || outline(&surface, islands),
        || (total_areas(&surface), benchmark::benchmark(&surface)),
    );
    let mirrored = mirrored_islands(islands, &areas);
    let mirror = |face: usize| if mirrored[islands.of_face[face] as usize] { -1.0 } else { 1.0 };
    let frame = Frame::new(surface, &areas, &mirror);
    if areas.space < f64::MIN_POSITIVE {
        return Err(MeasureError::NoSurface);
    }
    if areas.plane < f64::MIN_POSITIVE || !(frame.scale * frame.scale).is_normal() {
        return Err(MeasureError::NoArea);
    }
    let tally = Tally::total(by_runs(polygons.face_count(), |run| Tally::of(&frame, run, &areas.faces)));
    let mirrored = mirrored.iter().filter(|&&m| m).count();
    Ok(summary(&surface, tally, islands, mirrored, &outline, &crossings, benchmark))
}

fn outline(surface: &Surface<'_>, islands: &Islands) -> (Outline, Crossings) {
    let outline = islands.outline();
    let at = |corner: u32| surface.uv(corner as usize);
    let segments = islands.boundary.iter().map(|&corner| islands.segment(corner, at)).collect();
    let crossings = find_crossings(segments, Scope::WithinIslands, 0);
    (outline, crossings)
}

fn total_areas(surface: &Surface<'_>) -> Areas {
    Areas::total(by_runs(surface.polygons.face_count(), |run| Areas::of(surface, run)))
}

fn mirrored_islands(islands: &Islands, areas: &Areas) -> Vec<bool> {
    let mut total = vec![0.0; islands.count];
    for (&island, area) in islands.of_face.iter().zip(&areas.faces) {
        total[island as usize] += area;
    }
    total.iter().map(|&area| area < 0.0).collect()
}

fn summary(
    surface: &Surface<'_>,
    mut tally: Tally,
    islands: &Islands,
    mirrored_islands: usize,
    outline: &Outline,
    crossings: &Crossings,
    benchmark: Benchmark,
) -> Distortion {
    let corners = surface.uv.len();
    let mean = |sum: f64| sum / corners as f64;
    let weighted = |sum: f64| {
        let value = sum / tally.positive_weight;
        value.is_finite().then_some(value)
    };
    let angle_error = fixed_sum(&tally.angle_terms, |term| term);
    let area_error_best_scale = best_scale(&tally.area_ratios);
    let mut area_terms = tally.area_ratios;
    area_terms.par_iter_mut().for_each(|ratio| *ratio = (*ratio - 1.0).powi(2));
    let area_error = fixed_sum(&area_terms, |term| term);
    let (angle_quantiles, (area_quantiles, singular_ratio)) = rayon::join(
        || [0.5, 0.99].map(|fraction| quantile(&mut tally.angle_terms, fraction).unwrap_or(0.0)),
        || {
            let area = [0.5, 0.99].map(|fraction| quantile(&mut area_terms, fraction).unwrap_or(0.0));
            (area, [0.99, 1.0].map(|fraction| quantile(&mut tally.singular_ratios, fraction)))
        },
    );
    let finite = |value: f64| value.is_finite();
    Distortion {
        faces: surface.polygons.face_count(),
        corners,
        islands: islands.count,
        mirrored_islands,
        angle_error,
        angle_error_mean: mean(angle_error),
        angle_error_median: angle_quantiles[0],
        angle_error_p99: angle_quantiles[1],
        angle_error_symmetric: mean(tally.angle_symmetric),
        angle_clamped: tally.angle_clamped,
        angle_rms_degrees: mean(tally.angle_squares).sqrt().to_degrees(),
        area_error,
        area_error_mean: mean(area_error),
        area_error_median: area_quantiles[0],
        area_error_p99: area_quantiles[1],
        area_error_symmetric: (tally.area_positive > 0)
            .then(|| tally.area_symmetric / tally.area_positive as f64),
        area_clamped: tally.area_clamped,
        area_error_best_scale,
        symmetric_dirichlet: weighted(tally.symmetric_dirichlet),
        symmetric_dirichlet_max: (tally.positive_weight > 0.0)
            .then_some(tally.symmetric_dirichlet_max)
            .filter(|&value| finite(value)),
        mips: weighted(tally.mips),
        arap: weighted(tally.arap),
        singular_ratio_mean: weighted(tally.singular_ratio),
        singular_ratio_p99: singular_ratio[0].filter(|&value| finite(value)),
        singular_ratio_max: singular_ratio[1].filter(|&value| finite(value)),
        stretch_l2: if tally.stretch_weight > 0.0 {
            (tally.stretch_squares / tally.stretch_weight).sqrt()
        } else {
            0.0
        },
        stretch_linf: tally.stretch_max,
        flipped_corners: tally.flipped_corners,
        newly_flipped_corners: tally.newly_flipped_corners,
        concave_corners: tally.concave_corners,
        flipped_faces: tally.flipped_faces,
        folded_faces: tally.folded_faces,
        negative_faces: tally.negative_faces,
        wound_faces: tally.wound_faces,
        nonmanifold_edges: islands.nonmanifold.len(),
        boundary_loops: outline.loops,
        boundary_pinches: outline.pinches,
        boundary_crossings: crossings.count,
        boundary_crossings_complete: crossings.complete,
        benchmark,
    }
}

/// A sum of many terms: runs first, so that few roundings pile up.
fn fixed_sum(values: &[f64], term: impl Fn(f64) -> f64 + Sync) -> f64 {
    let runs: Vec<f64> =
        values.par_chunks(1024).map(|run| run.iter().map(|&value| term(value)).sum::<f64>()).collect();
    runs.into_iter().sum()
}

/// Eq. 14 at its best scale: U scaled by s turns every ratio r into r x with x = 1/s², and Σ (r x − 1)² is smallest at
/// x = Σr / Σr². Without a positive such x the infimum is at x → 0.
fn best_scale(ratios: &[f64]) -> f64 {
    let x = fixed_sum(ratios, |r| r) / fixed_sum(ratios, |r| r * r);
    let x = if x > 0.0 { x } else { 0.0 };
    fixed_sum(ratios, |r| (r * x - 1.0).powi(2))
}
