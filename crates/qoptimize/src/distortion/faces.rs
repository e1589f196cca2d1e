//! Measures of single faces, for showing where a map is good.

use std::ops::Range;

use qembed::qmesh::{PolygonView, Vec2};

use super::corners::{Corner, Stretch, Surface};
use super::error;
use super::statistics::by_runs;
use super::tally::{Areas, Frame};
use super::{MeasureError, mirrored_islands, total_areas};
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

/// Measures each face of a UV map. One UV per corner.
///
/// # Errors
/// As [`measure`](super::measure).
pub fn measure_faces(polygons: PolygonView<'_>, corner_uv: &[Vec2]) -> Result<FaceMeasures, MeasureError> {
    error::check(polygons, corner_uv)?;
    let surface = Surface::new(polygons, corner_uv);
    let (islands, areas) = rayon::join(|| Islands::find(polygons, corner_uv), || total_areas(&surface));
    if areas.space < f64::MIN_POSITIVE {
        return Err(MeasureError::NoSurface);
    }
    let mirrored = mirrored_islands(&islands, &areas);
    let mirror = |face: usize| if mirrored[islands.of_face[face] as usize] { -1.0 } else { 1.0 };
    let frame = Frame::new(surface, &areas, &mirror);
    if areas.plane < f64::MIN_POSITIVE || !(frame.scale * frame.scale).is_normal() {
        return Err(MeasureError::NoArea);
    }
    let mut measures = FaceMeasures { islands: islands.count, ..FaceMeasures::default() };
    for part in by_runs(polygons.face_count(), |run| of_run(&frame, &areas, run)) {
        measures.append(part);
    }
    measures.island = islands.of_face;
    Ok(measures)
}

fn of_run(frame: &Frame<'_>, areas: &Areas, faces: Range<usize>) -> FaceMeasures {
    let mut measures = FaceMeasures::default();
    let mut corners = Vec::new();
    for face in faces {
        let range = frame.surface.polygons.corners(face);
        corners.clear();
        corners.extend(range.clone().map(|corner| frame.surface.corner(&range, corner)));
        measures.push(frame, &corners, (frame.mirror)(face), areas.faces[face]);
    }
    measures
}

impl FaceMeasures {
    fn push(&mut self, frame: &Frame<'_>, corners: &[Corner], mirror: f64, plane_area: f64) {
        let squared_scale = frame.scale * frame.scale;
        let (mut angle, mut space_area) = (0.0, 0.0);
        let (mut dirichlet, mut weight, mut ratio) = (0.0, 0.0, 1.0_f64);
        let flipped = corners.iter().any(|corner| corner.plane_area * mirror <= 0.0);
        for corner in corners {
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
        let space_area = space_area * super::tally::face_weight(corners.len());
        let area = if space_area > 0.0 { plane_area * mirror * squared_scale / space_area } else { 1.0 };
        self.angle_degrees.push((angle / corners.len() as f64).to_degrees());
        self.area_ratio.push(area);
        let unless_flipped = |value: f64| if flipped { f64::INFINITY } else { value };
        let mean = if weight > 0.0 { dirichlet / weight } else { 1.0 };
        self.symmetric_dirichlet.push(unless_flipped(mean));
        self.singular_ratio.push(unless_flipped(ratio));
        self.flipped.push(flipped);
    }

    fn append(&mut self, mut other: Self) {
        self.angle_degrees.append(&mut other.angle_degrees);
        self.area_ratio.append(&mut other.area_ratio);
        self.symmetric_dirichlet.append(&mut other.symmetric_dirichlet);
        self.singular_ratio.append(&mut other.singular_ratio);
        self.flipped.append(&mut other.flipped);
    }
}
