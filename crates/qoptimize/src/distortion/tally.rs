//! The measures of this crate, summed over the corners.

use std::ops::Range;

use super::corners::{Corner, Stretch, Surface};
use super::eight::{CORNERS, Eight};
use super::quads::Quads;
use super::statistics::concatenated;
use crate::lanes::{Lanes, vectorized};

/// UV angles below this (radians) count as this.
pub(super) const ANGLE_CLAMP: f64 = 1e-9;
/// UV areas below this fraction of the mean count as this.
const AREA_CLAMP: f64 = 1e-12;
/// Corner triangles below this fraction of the mean area in space have no measurable stretch.
const DEGENERATE: f64 = 1e-14;
/// Squares of stretches are cut off here, so that their sums stay finite.
pub(super) const STRETCH_LIMIT: f64 = 1e150;

/// A corner triangle's share of its face's area: a quad's four cover it twice, a triangle's three are the same.
pub(super) fn face_weight(degree: usize) -> f64 {
    match degree {
        3 => 1.0 / 3.0,
        4 => 0.5,
        n => 1.0 / n.saturating_sub(2).max(1) as f64,
    }
}

/// Where the corners of two quads start, if `face` and the one after it in `faces` are quads.
pub(super) fn two_quads(surface: &Surface<'_>, face: usize, faces: &Range<usize>) -> Option<usize> {
    let are_quads = face + 1 < faces.end && (face..face + 2).all(|f| surface.polygons.corners(f).len() == 4);
    are_quads.then(|| surface.polygons.corners(face).start)
}

/// Areas of a run of faces, before anything is scaled.
#[derive(Default)]
pub(super) struct Areas {
    /// Weighted corner areas in space.
    pub(super) space: f64,
    /// The same in the plane, unsigned.
    pub(super) plane: f64,
    /// Plain sum of unsigned corner areas in the plane.
    pub(super) corners: f64,
    /// Signed area of each face in the plane.
    pub(super) faces: Vec<f64>,
}

impl Areas {
    pub(super) fn of(surface: &Surface<'_>, faces: Range<usize>) -> Self {
        let mut areas = Self::default();
        vectorized(
            #[inline(always)]
            || {
                let mut sums = [Lanes::ZERO; 2];
                let mut face = faces.start;
                while face < faces.end {
                    let eight = two_quads(surface, face, &faces)
                        .and_then(|first| Eight::of::<8>(surface, first, &CORNERS));
                    let done = match eight {
                        Some(eight) => {
                            sums[0] += eight.space_area;
                            sums[1] += eight.plane_area;
                            2
                        }
                        None => {
                            areas.add(surface, &surface.polygons.corners(face));
                            1
                        }
                    };
                    let next = (face..face + done).map(|face| surface.polygons.corners(face));
                    areas.faces.extend(next.map(|range| surface.signed_area(&range)));
                    face += done;
                }
                let [space, plane] = sums.map(|sum| sum.0.iter().sum::<f64>());
                areas.space += face_weight(4) * space;
                areas.plane += face_weight(4) * plane;
                areas.corners += plane;
            },
        );
        areas
    }

    /// A face by itself.
    fn add(&mut self, surface: &Surface<'_>, range: &Range<usize>) {
        let weight = face_weight(range.len());
        for index in range.clone() {
            let corner = surface.corner(range, index);
            self.space += weight * corner.space_area;
            self.plane += weight * corner.plane_area.abs();
            self.corners += corner.plane_area.abs();
        }
    }

    /// The areas of runs of faces together.
    pub(super) fn total(parts: Vec<Self>) -> Self {
        let mut total = Self::default();
        for part in &parts {
            total.space += part.space;
            total.plane += part.plane;
            total.corners += part.corners;
        }
        total.faces = concatenated(parts.into_iter().map(|part| part.faces).collect());
        total
    }
}

/// What all corners are measured against.
pub(super) struct Frame<'a> {
    pub(super) surface: Surface<'a>,
    /// Area in space.
    pub(super) space_area: f64,
    /// Lengths in the plane are multiplied with this, so that both surfaces have one area.
    pub(super) scale: f64,
    /// Smallest unsigned corner area in the plane, after scaling.
    pub(super) least_plane_area: f64,
    /// Smallest corner area in space whose stretch is measured.
    pub(super) least_space_area: f64,
    /// −1 for the faces of mirrored islands, 1 for the others.
    pub(super) mirror: &'a (dyn Fn(usize) -> f64 + Sync),
}

impl<'a> Frame<'a> {
    pub(super) fn new(
        surface: Surface<'a>,
        areas: &Areas,
        mirror: &'a (dyn Fn(usize) -> f64 + Sync),
    ) -> Self {
        let corners = surface.uv.len() as f64;
        let scale = (areas.space / areas.plane).sqrt();
        Self {
            surface,
            space_area: areas.space,
            scale,
            least_plane_area: AREA_CLAMP * scale * scale * areas.corners / corners,
            least_space_area: DEGENERATE * areas.space / corners,
            mirror,
        }
    }
}

/// Sums over a run of faces.
#[derive(Default)]
pub(super) struct Tally {
    /// The terms of Eq. 13, one per corner.
    pub(super) angle_terms: Vec<f64>,
    /// `A(T)/A(U)` of Eq. 14, one per corner.
    pub(super) area_ratios: Vec<f64>,
    /// `s1/s2` of the corners that are not flipped.
    pub(super) singular_ratios: Vec<f64>,
    pub(super) angle_symmetric: f64,
    pub(super) angle_squares: f64,
    pub(super) angle_clamped: usize,
    pub(super) area_symmetric: f64,
    pub(super) area_positive: usize,
    pub(super) area_clamped: usize,
    /// Share of the area of the corners that are not flipped.
    pub(super) positive_weight: f64,
    pub(super) symmetric_dirichlet: f64,
    pub(super) symmetric_dirichlet_max: f64,
    pub(super) mips: f64,
    pub(super) arap: f64,
    pub(super) singular_ratio: f64,
    pub(super) stretch_weight: f64,
    pub(super) stretch_squares: f64,
    pub(super) stretch_max: f64,
    pub(super) flipped_corners: usize,
    pub(super) newly_flipped_corners: usize,
    pub(super) concave_corners: usize,
    pub(super) flipped_faces: usize,
    pub(super) folded_faces: usize,
    pub(super) negative_faces: usize,
    pub(super) wound_faces: usize,
}

impl Tally {
    pub(super) fn of(frame: &Frame<'_>, faces: Range<usize>, signed_areas: &[f64]) -> Self {
        let mut tally = Self::default();
        let is_upright = |face: usize| (frame.mirror)(face) == 1.0 && signed_areas[face] > 0.0;
        vectorized(
            #[inline(always)]
            || {
                let mut quads = Quads::NONE;
                let mut face = faces.start;
                while face < faces.end {
                    let two = two_quads(&frame.surface, face, &faces)
                        .filter(|_| is_upright(face) && is_upright(face + 1));
                    if two.is_some_and(|first| quads.add(frame, first, &mut tally)) {
                        face += 2;
                        continue;
                    }
                    let range = frame.surface.polygons.corners(face);
                    let corners: Vec<Corner> =
                        range.clone().map(|corner| frame.surface.corner(&range, corner)).collect();
                    tally.add_face(frame, &corners, (frame.mirror)(face), signed_areas[face]);
                    face += 1;
                }
                quads.add_to(&mut tally);
            },
        );
        tally
    }

    fn add_face(&mut self, frame: &Frame<'_>, corners: &[Corner], mirror: f64, signed_area: f64) {
        let weight = face_weight(corners.len());
        let normal = corners.iter().map(|corner| corner.normal).sum();
        // Whether a corner is flipped, for those at even and at odd places: a quad's two pairs are its two diagonals.
        let mut flipped = [false; 2];
        for (place, corner) in corners.iter().enumerate() {
            let is_flipped = corner.plane_area * mirror <= 0.0;
            let is_concave = corner.normal.dot(&normal) <= 0.0;
            flipped[place % 2] |= is_flipped;
            self.flipped_corners += usize::from(is_flipped);
            self.concave_corners += usize::from(is_concave);
            self.newly_flipped_corners += usize::from(is_flipped && !is_concave);
            self.add_angle(corner, mirror);
            self.add_area(frame, corner, mirror);
            self.add_stretch(frame, corner, mirror, weight);
        }
        let any_flipped = flipped[0] || flipped[1];
        let is_negative = signed_area * mirror <= 0.0;
        self.flipped_faces += usize::from(any_flipped);
        self.negative_faces += usize::from(is_negative);
        self.folded_faces += usize::from(match corners.len() {
            4 => flipped[0] && flipped[1],
            3 => any_flipped,
            _ => is_negative,
        });
        self.wound_faces += usize::from(!any_flipped && winds_more_than_once(corners));
    }

    /// Eq. 13.
    fn add_angle(&mut self, corner: &Corner, mirror: f64) {
        let (theta, phi) = (corner.space_angle(), corner.plane_angle(mirror));
        self.angle_clamped += usize::from(phi < ANGLE_CLAMP);
        self.angle_squares += (theta - phi).powi(2);
        let divisor = phi.max(ANGLE_CLAMP);
        self.angle_terms.push((theta / divisor - 1.0).powi(2));
        let ratio = theta.max(ANGLE_CLAMP) / divisor;
        self.angle_symmetric += (ratio.max(1.0 / ratio) - 1.0).powi(2);
    }

    /// Eq. 14.
    fn add_area(&mut self, frame: &Frame<'_>, corner: &Corner, mirror: f64) {
        let least = frame.least_plane_area;
        let area = corner.plane_area * mirror * frame.scale * frame.scale;
        let clamped = match area {
            _ if area.abs() >= least => area,
            _ if area < 0.0 => -least,
            _ => least,
        };
        self.area_clamped += usize::from(area.abs() < least);
        let ratio = corner.space_area / clamped;
        self.area_ratios.push(ratio);
        if area >= least && corner.space_area > 0.0 {
            self.area_positive += 1;
            self.area_symmetric += (ratio.max(1.0 / ratio) - 1.0).powi(2);
        }
    }

    fn add_stretch(&mut self, frame: &Frame<'_>, corner: &Corner, mirror: f64, weight: f64) {
        if corner.space_area <= frame.least_space_area {
            return;
        }
        let plane = corner.plane.map(|edge| edge * frame.scale);
        let plane_area = corner.plane_area * mirror * frame.scale * frame.scale;
        let stretch = Stretch::of(corner.space, corner.space_area, plane, plane_area);
        let (s1, s2) = (stretch.large, stretch.small);
        let squared = stretch.determinant * stretch.determinant;
        // Shares of the whole, so that sums of stretches at their limit stay finite.
        let weight = weight * (corner.space_area / frame.space_area);
        // Sander et al. 2001: the root mean square and the largest of the singular values of the inverse map.
        let inverse_squares = stretch.frobenius / squared.max(1e-300) / 2.0;
        self.stretch_weight += weight;
        self.stretch_squares += weight * inverse_squares.min(STRETCH_LIMIT * STRETCH_LIMIT);
        self.stretch_max = self.stretch_max.max(1.0 / s2.max(1.0 / STRETCH_LIMIT));
        if stretch.determinant <= 0.0 {
            return;
        }
        let dirichlet = (stretch.frobenius + stretch.frobenius / squared) / 4.0;
        self.positive_weight += weight;
        self.symmetric_dirichlet += weight * dirichlet;
        self.symmetric_dirichlet_max = self.symmetric_dirichlet_max.max(dirichlet);
        self.mips += weight * f64::midpoint(s1 / s2, s2 / s1);
        self.arap += weight * ((s1 - 1.0).powi(2) + (s2 - 1.0).powi(2));
        self.singular_ratio += weight * s1 / s2;
        self.singular_ratios.push(s1 / s2);
    }

    /// The sums and lists of runs of faces together.
    pub(super) fn total(mut parts: Vec<Self>) -> Self {
        let mut total = Self::default();
        parts.iter().for_each(|part| total.add_sums(part));
        let mut list = |of: fn(&mut Self) -> &mut Vec<f64>| {
            concatenated(parts.iter_mut().map(|part| std::mem::take(of(part))).collect())
        };
        total.angle_terms = list(|part| &mut part.angle_terms);
        total.area_ratios = list(|part| &mut part.area_ratios);
        total.singular_ratios = list(|part| &mut part.singular_ratios);
        total
    }

    fn add_sums(&mut self, other: &Self) {
        self.angle_symmetric += other.angle_symmetric;
        self.angle_squares += other.angle_squares;
        self.angle_clamped += other.angle_clamped;
        self.area_symmetric += other.area_symmetric;
        self.area_positive += other.area_positive;
        self.area_clamped += other.area_clamped;
        self.positive_weight += other.positive_weight;
        self.symmetric_dirichlet += other.symmetric_dirichlet;
        self.symmetric_dirichlet_max = self.symmetric_dirichlet_max.max(other.symmetric_dirichlet_max);
        self.mips += other.mips;
        self.arap += other.arap;
        self.singular_ratio += other.singular_ratio;
        self.stretch_weight += other.stretch_weight;
        self.stretch_squares += other.stretch_squares;
        self.stretch_max = self.stretch_max.max(other.stretch_max);
        self.flipped_corners += other.flipped_corners;
        self.newly_flipped_corners += other.newly_flipped_corners;
        self.concave_corners += other.concave_corners;
        self.flipped_faces += other.flipped_faces;
        self.folded_faces += other.folded_faces;
        self.negative_faces += other.negative_faces;
        self.wound_faces += other.wound_faces;
    }
}

/// Whether a polygon that turns the same way at every corner does so through more than one full turn, like a pentagram.
///
/// A full turn passes from pointing down to pointing up exactly once. Below five corners, each turning by less than
/// half a turn, there is not enough for two.
fn winds_more_than_once(corners: &[Corner]) -> bool {
    if corners.len() < 5 {
        return false;
    }
    let points_up = |corner: &Corner| {
        let edge = corner.plane[0];
        edge.y > 0.0 || (edge.y == 0.0 && edge.x > 0.0)
    };
    let up: Vec<bool> = corners.iter().map(points_up).collect();
    (0..up.len()).filter(|&i| !up[i] && up[(i + 1) % up.len()]).count() > 1
}
