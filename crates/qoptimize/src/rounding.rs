//! What rounding does to a map, and mending it: after a change of scale, and in single precision, as most programs keep UVs.
//!
//! Rounding moves each coordinate by up to half a unit in its last place, in single precision about 3·10⁻⁸ in the unit square: enough
//! to turn over corners that are thinner. Those are mended by moving their points to neighbouring floats, chosen with exact
//! predicates. What a few units do not mend stays, for the [certificate](crate::certificate) to name.

use std::collections::BTreeSet;

use qembed::qmesh::obj::{UvFormat, UvPrecision};
use qembed::qmesh::{PolygonView, Vec2};
use rayon::prelude::*;

use crate::ParameterizeError;
use crate::certificate::{certify, outline_sign};
use crate::plane::{Islands, orientation};

/// How far points are moved at most, in units of the last place.
const REACH: i32 = 4;
/// How often every broken face is looked at, at most.
const PASSES: usize = 16;

/// Violations listed of each kind.
pub(crate) const LISTED: usize = 100;

/// What rounding did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Rounding {
    /// Faces that lost a positive corner to rounding.
    pub broken_faces: usize,
    /// Points that were moved to other floats than the nearest, to mend them.
    pub moved_points: usize,
    /// Faces that could not be mended.
    pub lost_faces: Vec<u32>,
}

/// Rounds every UV to a pair of `f32` and mends the faces that it breaks. One UV per corner; corners at one point stay at one point.
///
/// A coordinate beyond the range of `f32` becomes infinite.
pub fn round_to_single(polygons: PolygonView<'_>, corner_uv: &mut [Vec2]) -> Rounding {
    let single = UvFormat::with_precision(UvPrecision::Single);
    let exact = corner_uv.to_vec();
    corner_uv.iter_mut().for_each(|p| *p = single.round(*p));
    mend(polygons, &exact, corner_uv, UvPrecision::Single)
}

/// Mends the faces that are positive with the UVs `exact`, but not with `rounded`, which are those, moved, scaled or rounded.
/// Points go to neighbouring floats of the precision.
pub(crate) fn mend(
    polygons: PolygonView<'_>,
    exact: &[Vec2],
    rounded: &mut [Vec2],
    precision: UvPrecision,
) -> Rounding {
    let faces = || (0..polygons.face_count()).into_par_iter().with_min_len(1024);
    let now = &*rounded;
    let is_broken = |&face: &usize| {
        // A triangle or quad that is convex has kept whatever it was.
        let is_convex = polygons.corners(face).len() <= 4 && Shape::Convex.is_kept(polygons, now, face);
        let is_kept = || Shape::of(polygons, exact, face).is_kept(polygons, now, face);
        !is_convex && !is_kept()
    };
    let broken: Vec<usize> = faces().filter(is_broken).collect();
    let mut rounding = Rounding { broken_faces: broken.len(), ..Rounding::default() };
    if !broken.is_empty() {
        let shapes: Vec<Shape> = faces().map(|face| Shape::of(polygons, exact, face)).collect();
        let mut mender = Mender::new(polygons, exact, rounded, &shapes, precision);
        let left = mender.mend(broken.into_iter().collect());
        rounding.moved_points = mender.moved.len();
        rounding.lost_faces = left.into_iter().map(|face| face as u32).collect();
    }
    rounding
}

/// Rounds UVs to `precision`; refuses when that costs the map its certificate.
pub(crate) fn to_precision(
    polygons: PolygonView<'_>,
    corner_uv: &mut [Vec2],
    precision: UvPrecision,
) -> Result<Option<Rounding>, ParameterizeError> {
    if precision != UvPrecision::Single {
        return Ok(None);
    }
    let exact = corner_uv.to_vec();
    let rounding = round_to_single(polygons, corner_uv);
    let certificate = certify(polygons, corner_uv, LISTED)?;
    if !certificate.holds && certify(polygons, &exact, 0)?.holds {
        return Err(ParameterizeError::Rounding(Box::new(certificate)));
    }
    Ok(Some(rounding))
}

/// What a face was before rounding, and is to stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    /// All corners turn left.
    Convex,
    /// A quad of which the corners at this place and opposite turn left.
    Split(usize),
    /// A simple polygon that runs counter-clockwise.
    Simple,
    /// Nothing to keep.
    Broken,
}

impl Shape {
    fn of(polygons: PolygonView<'_>, uv: &[Vec2], face: usize) -> Self {
        let shapes = match polygons.corners(face).len() {
            0..3 => &[][..],
            3 => &[Self::Convex][..],
            4 => &[Self::Convex, Self::Split(0), Self::Split(1)][..],
            _ => &[Self::Simple][..],
        };
        shapes.iter().copied().find(|shape| shape.is_kept(polygons, uv, face)).unwrap_or(Self::Broken)
    }

    fn is_kept(self, polygons: PolygonView<'_>, uv: &[Vec2], face: usize) -> bool {
        let corners = &uv[polygons.corners(face)];
        let n = corners.len();
        let is_left =
            |i: usize| orientation(corners[(i + n - 1) % n], corners[i % n], corners[(i + 1) % n]) > 0;
        match self {
            Self::Convex => (0..n).all(is_left),
            Self::Split(place) => is_left(place) && is_left(place + 2),
            Self::Simple => outline_sign(corners) > 0,
            Self::Broken => true,
        }
    }
}

struct Mender<'a> {
    polygons: PolygonView<'a>,
    precision: UvPrecision,
    /// Where the points were put first.
    nearest: Vec<Vec2>,
    uv: &'a mut [Vec2],
    shapes: &'a [Shape],
    islands: Islands,
    /// The corners sorted by their points.
    by_point: Vec<(u32, u32)>,
    moved: BTreeSet<u32>,
}

impl<'a> Mender<'a> {
    fn new(
        polygons: PolygonView<'a>,
        exact: &'a [Vec2],
        uv: &'a mut [Vec2],
        shapes: &'a [Shape],
        precision: UvPrecision,
    ) -> Self {
        let islands = Islands::find(polygons, exact);
        let mut by_point: Vec<(u32, u32)> = islands.point.iter().copied().zip(0..).collect();
        by_point.sort_unstable();
        let nearest = uv.to_vec();
        Self { polygons, precision, nearest, uv, shapes, islands, by_point, moved: BTreeSet::new() }
    }

    /// Moves points of broken faces until none is left or nothing helps; returns the faces that are left.
    fn mend(&mut self, mut broken: BTreeSet<usize>) -> BTreeSet<usize> {
        for _ in 0..PASSES {
            let before = broken.len();
            for face in broken.clone() {
                for corner in self.polygons.corners(face) {
                    if !self.is_broken(face) {
                        break;
                    }
                    self.move_point(self.islands.point[corner], &mut broken);
                }
            }
            if broken.is_empty() || broken.len() >= before {
                break;
            }
        }
        broken
    }

    fn is_broken(&self, face: usize) -> bool {
        !self.shapes[face].is_kept(self.polygons, self.uv, face)
    }

    /// Puts a point where the fewest of its faces are broken, as near to its first place as that allows.
    fn move_point(&mut self, point: u32, broken: &mut BTreeSet<usize>) {
        let start = self.by_point.partition_point(|entry| entry.0 < point);
        let corners: Vec<usize> = self.by_point[start..]
            .iter()
            .take_while(|entry| entry.0 == point)
            .map(|e| e.1 as usize)
            .collect();
        let mut faces: Vec<usize> =
            corners.iter().map(|&corner| self.islands.face_of[corner] as usize).collect();
        faces.sort_unstable();
        faces.dedup();
        let (here, nearest) = (self.uv[corners[0]], self.nearest[corners[0]]);
        let mut best = (self.put(&corners, &faces, here), here);
        let mut candidates: Vec<Vec2> = (-REACH..=REACH)
            .flat_map(|i| (-REACH..=REACH).map(move |j| (i, j)))
            .map(|(i, j)| Vec2::new(self.step(here.x, i), self.step(here.y, j)))
            .collect();
        candidates.sort_by(|a, b| (a - nearest).norm_squared().total_cmp(&(b - nearest).norm_squared()));
        for candidate in candidates {
            let count = self.put(&corners, &faces, candidate);
            if count < best.0 {
                best = (count, candidate);
            }
            if best.0 == 0 {
                break;
            }
        }
        self.put(&corners, &faces, best.1);
        if best.1 != here {
            self.moved.insert(point);
        }
        for face in faces {
            if self.is_broken(face) {
                broken.insert(face)
            } else {
                broken.remove(&face)
            };
        }
    }

    /// How many of `faces` are broken with the point at `place`, where it stays.
    fn put(&mut self, corners: &[usize], faces: &[usize], place: Vec2) -> usize {
        corners.iter().for_each(|&corner| self.uv[corner] = place);
        faces.iter().filter(|&&face| self.is_broken(face)).count()
    }

    /// The float of the precision that is `by` floats away; zeros count as one.
    fn step(&self, x: f64, by: i32) -> f64 {
        let count = by.unsigned_abs() as usize;
        if self.precision == UvPrecision::Single {
            let next = if by > 0 { f32::next_up } else { f32::next_down };
            return f64::from((0..count).fold(x as f32, |x, _| next(x))) + 0.0;
        }
        let next = if by > 0 { f64::next_up } else { f64::next_down };
        (0..count).fold(x, |x, _| next(x)) + 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify;
    use crate::qmesh::shapes;

    fn is_single(uv: &[Vec2]) -> bool {
        uv.iter().flatten().all(|&x| f64::from(x as f32) == x)
    }

    /// Cells a few floats wide are turned over by rounding to the nearest, and stand after mending; nothing else moves.
    #[test]
    fn thin_cells_are_mended() {
        let mesh = shapes::jittered_grid(40, 40, 0.2, 3);
        let flat: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy()).collect();
        for (squeeze, is_broken) in [(1.0, false), (1e-6, false), (1.2e-7, true), (8e-8, true)] {
            let mut uv: Vec<Vec2> = flat.iter().map(|p| p * squeeze + Vec2::new(0.5, 0.7)).collect();
            assert!(certify(mesh.view(), &uv, 9).unwrap().holds);
            let nearest: Vec<Vec2> = uv.iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
            let rounding = round_to_single(mesh.view(), &mut uv);
            assert!(is_single(&uv));
            assert_eq!(rounding.broken_faces > 0, is_broken, "{squeeze}: {rounding:?}");
            assert_eq!(rounding.lost_faces, [0_u32; 0], "{squeeze}: {rounding:?}");
            assert!(certify(mesh.view(), &uv, 9).unwrap().holds, "{squeeze}");
            let moved = uv.iter().zip(&nearest).filter(|(a, b)| a != b).count();
            assert!(moved <= 4 * rounding.moved_points && (moved > 0) == is_broken);
        }
    }

    /// Cells below the distance of floats collapse, and are named.
    #[test]
    fn cells_below_the_distance_of_floats_are_lost() {
        let mesh = shapes::grid(6, 6);
        let mut uv: Vec<Vec2> =
            mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy() * 1e-9 + Vec2::new(0.5, 0.7)).collect();
        let rounding = round_to_single(mesh.view(), &mut uv);
        assert_eq!(rounding.broken_faces, 36);
        assert!(!rounding.lost_faces.is_empty() && is_single(&uv));
        assert!(!certify(mesh.view(), &uv, 9).unwrap().holds);
    }
}
