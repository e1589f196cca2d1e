//! One corner, in space and in the plane.
//!
//! Everything is measured on *corner triangles* (previous, this, next corner): four a quad, both diagonals, so that
//! none is preferred. They cover a quad twice.

use std::f64::consts::TAU;
use std::ops::Range;

use qembed::qmesh::{PolygonView, Vec2, Vec3};
use rayon::prelude::*;
use robust::{Coord, orient2d};

/// Polygons with their UVs, both brought into the range where squares of areas are representable.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) polygons: PolygonView<'a>,
    pub(super) uv: &'a [Vec2],
    /// What positions are multiplied with: a power of two, so that nothing is rounded.
    pub(super) position_scale: f64,
    /// And UVs.
    pub(super) uv_scale: f64,
}

/// A corner triangle and its image.
pub(super) struct Corner {
    /// To the next corner and to the previous one, in space.
    pub(super) space: [Vec3; 2],
    /// The same in the plane.
    pub(super) plane: [Vec2; 2],
    /// Twice the vector area in space.
    pub(super) normal: Vec3,
    /// Area in space.
    pub(super) space_area: f64,
    /// Signed area in the plane; its sign is exact.
    pub(super) plane_area: f64,
}

impl Corner {
    /// In [0, π].
    pub(super) fn space_angle(&self) -> f64 {
        (2.0 * self.space_area).atan2(self.space[0].dot(&self.space[1]))
    }

    /// In [0, 2π); 0 where an edge has no length. `mirror` is −1 on islands that were mirrored.
    pub(super) fn plane_angle(&self, mirror: f64) -> f64 {
        let [next, previous] = self.plane;
        if next.norm_squared() == 0.0 || previous.norm_squared() == 0.0 {
            return 0.0;
        }
        let angle = (2.0 * self.plane_area * mirror).atan2(next.dot(&previous));
        if angle < 0.0 { angle + TAU } else { angle }
    }
}

impl<'a> Surface<'a> {
    pub(super) fn new(polygons: PolygonView<'a>, uv: &'a [Vec2]) -> Self {
        let in_space = polygons.corner_vertex.par_iter().map(|&v| polygons.positions[v as usize].amax());
        let in_plane = uv.par_iter().map(Vec2::amax);
        Self {
            polygons,
            uv,
            position_scale: scale_for(in_space.reduce(|| 0.0, f64::max)),
            uv_scale: scale_for(in_plane.reduce(|| 0.0, f64::max)),
        }
    }

    pub(super) fn position(&self, corner: usize) -> Vec3 {
        self.polygons.positions[self.polygons.corner_vertex[corner] as usize] * self.position_scale
    }

    pub(super) fn uv(&self, corner: usize) -> Vec2 {
        self.uv[corner] * self.uv_scale
    }

    pub(super) fn corner(&self, face: &Range<usize>, corner: usize) -> Corner {
        let next = if corner + 1 == face.end { face.start } else { corner + 1 };
        let previous = if corner == face.start { face.end - 1 } else { corner - 1 };
        let [here, after, before] = [corner, next, previous].map(|c| self.position(c));
        let space = [after - here, before - here];
        let normal = space[0].cross(&space[1]);
        let [p, q, r] = [corner, next, previous].map(|c| self.uv(c));
        Corner {
            space,
            plane: [q - p, r - p],
            normal,
            space_area: normal.norm() / 2.0,
            plane_area: turn(p, q, r) / 2.0,
        }
    }

    /// Signed area of the face in the plane.
    pub(super) fn signed_area(&self, face: &Range<usize>) -> f64 {
        let Some(first) = face.clone().next().map(|corner| self.uv(corner)) else { return 0.0 };
        let fan = (face.start + 1..face.end).map(|c| self.uv(c) - first);
        fan.clone().zip(fan.skip(1)).map(|(a, b)| a.perp(&b) / 2.0).sum()
    }
}

/// Twice the signed area of a triangle; the sign is exact.
pub(super) fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let at = |p: Vec2| Coord { x: p.x, y: p.y };
    orient2d(at(a), at(b), at(c))
}

/// The power of two that brings `largest` near one, when its fourth power could leave the range of `f64`.
fn scale_for(largest: f64) -> f64 {
    const SAFE: Range<f64> = 1e-60..1e60;
    if largest == 0.0 || SAFE.contains(&largest) {
        return 1.0;
    }
    (-largest.log2().floor()).clamp(-1000.0, 1000.0).exp2()
}

/// What the affine map of a triangle does to lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Larger singular value.
    pub(super) large: f64,
    /// Smaller singular value, not negative.
    pub(super) small: f64,
    /// `s1² + s2²`.
    pub(super) frobenius: f64,
    /// Signed: negative where the map flips.
    pub(super) determinant: f64,
}

impl Stretch {
    /// Of the map that takes the `space` edges of a triangle to the `plane` ones. The areas are given too, because
    /// their ratio is the determinant, and the sign of an area in the plane is exact.
    pub(super) fn of(space: [Vec3; 2], space_area: f64, plane: [Vec2; 2], plane_area: f64) -> Self {
        let length = space[0].norm();
        let (x, y) = (space[0].dot(&space[1]) / length, 2.0 * space_area / length);
        let first = plane[0] / length;
        let second = (plane[1] - first * x) / y;
        // The sum and the difference of the singular values, or the other way round where the map flips.
        let sum = Vec2::new(first.x + second.y, first.y - second.x).norm();
        let difference = Vec2::new(first.x - second.y, first.y + second.x).norm();
        let determinant = plane_area / space_area;
        let large = f64::midpoint(sum, difference);
        let small = if large > 0.0 { determinant.abs() / large } else { 0.0 };
        let frobenius = first.norm_squared() + second.norm_squared();
        Self { large, small, frobenius, determinant }
    }
}
