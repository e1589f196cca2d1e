//! Measures of single faces, for showing where a map is good and where it is worst.

use std::ops::Range;

use qembed::qmesh::{PolygonView, Vec2};

use super::corners::{Corner, Stretch, Surface};
use super::eight::{CORNERS, Eight};
use super::error;
use super::statistics::by_runs;
use super::tally::{Areas, Frame, face_weight, two_quads};
use super::{MeasureError, mirrored_islands, total_areas};
use crate::lanes::vectorized;
use crate::plane::Islands;

/// How good the map is on each face; the definitions are those of the [module](super). One value a face, in order.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct FaceMeasures {
    /// The island of each face, numbered by first face.
    pub island: Vec<u32>,
    /// How many islands there are.
    pub islands: usize,
    /// Mean of |θ − φ| over the corners, in degrees.
    pub angle_degrees: Vec<f64>,
    /// Area in the plane over area in space, both totals made equal: 1 is true to area. Zero or less where the face has no
    /// positive area in the plane; 1 where it has none in space.
    pub area_ratio: Vec<f64>,
    /// Mean of (s1² + s2² + s1⁻² + s2⁻²)/4 over the corner triangles, weighted with their areas in space: 1 for an isometry,
    /// infinite where a corner is flipped.
    pub symmetric_dirichlet: Vec<f64>,
    /// The largest s1/s2 of the corner triangles: 1 where conformal, infinite where a corner is flipped.
    pub singular_ratio: Vec<f64>,
    /// Whether a corner triangle has no positive area.
    pub flipped: Vec<bool>,
}

/// How good the map is on one face; the definitions are those of [`FaceMeasures`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FaceMeasure {
    /// See [`FaceMeasures::angle_degrees`].
    pub angle_degrees: f64,
    /// See [`FaceMeasures::area_ratio`].
    pub area_ratio: f64,
    /// See [`FaceMeasures::symmetric_dirichlet`].
    pub symmetric_dirichlet: f64,
    /// See [`FaceMeasures::singular_ratio`].
    pub singular_ratio: f64,
    /// See [`FaceMeasures::flipped`].
    pub flipped: bool,
}

/// Measures each face of a UV map. One UV per corner.
///
/// # Errors
/// As [`measure`](super::measure).
pub fn measure_faces(polygons: PolygonView<'_>, corner_uv: &[Vec2]) -> Result<FaceMeasures, MeasureError> {
    error::check(polygons, corner_uv)?;
    let surface = Surface::new(polygons, corner_uv);
    let (islands, areas) = rayon::join(|| Islands::find(polygons, corner_uv), || total_areas(&surface));
    let mirrored = mirrored_islands(&islands, &areas);
    let mirror = |face: usize| if mirrored[islands.of_face[face] as usize] { -1.0 } else { 1.0 };
    let frame = frame(surface, &areas, &mirror)?;
    let mut measures = FaceMeasures { islands: islands.count, ..FaceMeasures::default() };
    for part in by_runs(polygons.face_count(), |run| of_run(&frame, &areas, run)) {
        measures.append(part);
    }
    measures.island = islands.of_face;
    Ok(measures)
}

/// The `count` faces with the largest symmetric Dirichlet energy and their measures, flipped ones before all; ties (to seven
/// digits) go to the lower index. Much faster than to measure all faces and to choose.
///
/// # Errors
/// As [`measure`](super::measure).
pub fn measure_worst_faces(
    polygons: PolygonView<'_>,
    corner_uv: &[Vec2],
    count: usize,
) -> Result<Vec<(usize, FaceMeasure)>, MeasureError> {
    error::check(polygons, corner_uv)?;
    let surface = Surface::new(polygons, corner_uv);
    let areas = total_areas(&surface);
    // Where no face has negative area no island has, whatever the islands are.
    let mirrored_faces = areas.faces.iter().any(|&area| area < 0.0).then(|| {
        let islands = Islands::find(polygons, corner_uv);
        let mirrored = mirrored_islands(&islands, &areas);
        islands.of_face.iter().map(|&island| mirrored[island as usize]).collect::<Vec<bool>>()
    });
    let mirror =
        |face: usize| if mirrored_faces.as_ref().is_some_and(|faces| faces[face]) { -1.0 } else { 1.0 };
    let frame = frame(surface, &areas, &mirror)?;
    let mut worst = by_runs(polygons.face_count(), |run| worst_of_run(&frame, &areas, run, count)).concat();
    keep_worst(&mut worst, count);
    worst.sort_unstable_by(worse);
    Ok(worst.into_iter().map(|(_, face)| (face, of_face(&frame, &areas, face, &mut Vec::new()))).collect())
}

fn frame<'a>(
    surface: Surface<'a>,
    areas: &Areas,
    mirror: &'a (dyn Fn(usize) -> f64 + Sync),
) -> Result<Frame<'a>, MeasureError> {
    if areas.space < f64::MIN_POSITIVE {
        return Err(MeasureError::NoSurface);
    }
    let frame = Frame::new(surface, areas, mirror);
    if areas.plane < f64::MIN_POSITIVE || !(frame.scale * frame.scale).is_normal() {
        return Err(MeasureError::NoArea);
    }
    Ok(frame)
}

/// An energy and its face. Rounded, because rounding must not decide between faces that are alike.
type Ranked = (f32, usize);

fn worse(a: &Ranked, b: &Ranked) -> std::cmp::Ordering {
    b.0.total_cmp(&a.0).then(a.1.cmp(&b.1))
}

fn keep_worst(faces: &mut Vec<Ranked>, count: usize) {
    if count < faces.len() {
        faces.select_nth_unstable_by(count, worse);
        faces.truncate(count);
    }
}

fn worst_of_run(frame: &Frame<'_>, areas: &Areas, faces: Range<usize>, count: usize) -> Vec<Ranked> {
    let mut ranked = Vec::with_capacity(faces.len());
    let mut corners = Vec::new();
    vectorized(
        #[inline(always)]
        || {
            let mut face = faces.start;
            while face < faces.end {
                let two =
                    two_quads(&frame.surface, face, &faces).and_then(|first| two_energies(frame, first));
                let is_upright = |face: usize| (frame.mirror)(face) == 1.0;
                if let Some([first, second]) = two.filter(|_| is_upright(face) && is_upright(face + 1)) {
                    ranked.extend([(first as f32, face), (second as f32, face + 1)]);
                    face += 2;
                    continue;
                }
                ranked.push((of_face(frame, areas, face, &mut corners).symmetric_dirichlet as f32, face));
                face += 1;
            }
        },
    );
    keep_worst(&mut ranked, count);
    ranked
}

/// The energies of two quads whose corners start at `first`, where nothing is out of the ordinary.
#[inline(always)]
fn two_energies(frame: &Frame<'_>, first: usize) -> Option<[f64; 2]> {
    let eight = Eight::of::<8>(&frame.surface, first, &CORNERS)?;
    let stretches = eight.stretches(1.0, frame.scale)?;
    if !eight.space_area.all_above(frame.least_space_area) {
        return None;
    }
    let per_squared = (stretches.determinant * stretches.determinant).recip();
    let energy = (stretches.frobenius + stretches.frobenius * per_squared) * 0.25;
    let weighted = eight.space_area * energy;
    let sum = |values: &[f64]| values.iter().sum::<f64>();
    Some([0, 4].map(|at| sum(&weighted.0[at..at + 4]) / sum(&eight.space_area.0[at..at + 4])))
}

fn of_run(frame: &Frame<'_>, areas: &Areas, faces: Range<usize>) -> FaceMeasures {
    let mut measures = FaceMeasures::default();
    let mut corners = Vec::new();
    for face in faces {
        measures.push(of_face(frame, areas, face, &mut corners));
    }
    measures
}

/// Measures one face. `corners` is space to work in.
fn of_face(frame: &Frame<'_>, areas: &Areas, face: usize, corners: &mut Vec<Corner>) -> FaceMeasure {
    let (mirror, plane_area) = ((frame.mirror)(face), areas.faces[face]);
    let range = frame.surface.polygons.corners(face);
    corners.clear();
    corners.extend(range.clone().map(|corner| frame.surface.corner(&range, corner)));
    let squared_scale = frame.scale * frame.scale;
    let (mut angle, mut space_area) = (0.0, 0.0);
    let (mut dirichlet, mut weight, mut ratio) = (0.0, 0.0, 1.0_f64);
    let flipped = corners.iter().any(|corner| corner.plane_area * mirror <= 0.0);
    for corner in corners.iter() {
        angle += (corner.space_angle() - corner.plane_angle(mirror)).abs();
        space_area += corner.space_area;
        if corner.space_area > frame.least_space_area && !flipped {
            let plane = corner.plane.map(|edge| edge * frame.scale);
            let plane_area = corner.plane_area * mirror * squared_scale;
            let stretch = Stretch::of(corner.space, corner.space_area, plane, plane_area);
            let inverse = stretch.frobenius / (stretch.determinant * stretch.determinant);
            dirichlet += corner.space_area * (stretch.frobenius + inverse) / 4.0;
            weight += corner.space_area;
            ratio = ratio.max(stretch.large / stretch.small);
        }
    }
    // The corner triangles of a quad cover it twice, those of larger polygons are no cover: see `face_weight`.
    let space_area = space_area * face_weight(corners.len());
    let unless_flipped = |value: f64| if flipped { f64::INFINITY } else { value };
    FaceMeasure {
        angle_degrees: (angle / corners.len() as f64).to_degrees(),
        area_ratio: if space_area > 0.0 { plane_area * mirror * squared_scale / space_area } else { 1.0 },
        symmetric_dirichlet: unless_flipped(if weight > 0.0 { dirichlet / weight } else { 1.0 }),
        singular_ratio: unless_flipped(ratio),
        flipped,
    }
}

impl FaceMeasures {
    fn push(&mut self, face: FaceMeasure) {
        self.angle_degrees.push(face.angle_degrees);
        self.area_ratio.push(face.area_ratio);
        self.symmetric_dirichlet.push(face.symmetric_dirichlet);
        self.singular_ratio.push(face.singular_ratio);
        self.flipped.push(face.flipped);
    }

    fn append(&mut self, mut other: Self) {
        self.angle_degrees.append(&mut other.angle_degrees);
        self.area_ratio.append(&mut other.area_ratio);
        self.symmetric_dirichlet.append(&mut other.symmetric_dirichlet);
        self.singular_ratio.append(&mut other.singular_ratio);
        self.flipped.append(&mut other.flipped);
    }
}
