//! Eight corner triangles at a time, where nothing is out of the ordinary: no flips, no slivers.
//!
//! What is measured is what [`corners`](super::corners) measures one by one, but for rounding.
#![allow(clippy::needless_range_loop)] // loops over lanes become vector instructions

use super::corners::Surface;
use crate::lanes::{LANES, Lanes};
use crate::qmesh::{Vec2, Vec3};

/// A signed area in the plane is known to be positive when it exceeds this fraction of its two products: as `robust` does it.
const CERTAIN: f64 = 3.330_669_073_875_471_6e-16;
/// Smaller numbers may have lost digits.
const ORDINARY: f64 = 1e-140;

/// The corner triangles of two quads: this corner, the next, the one before.
pub(super) const CORNERS: [[usize; 3]; LANES] =
    [[0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2], [4, 5, 7], [5, 6, 4], [6, 7, 5], [7, 4, 6]];
/// The fans from the first corners of four quads.
pub(super) const FANS: [[usize; 3]; LANES] =
    [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7], [8, 9, 10], [8, 10, 11], [12, 13, 14], [12, 14, 15]];

/// Corner triangles and their images.
pub(super) struct Eight {
    /// To the second corner and to the third one, in space.
    space: [[Lanes; 3]; 2],
    /// The same in the plane.
    plane: [[Lanes; 2]; 2],
    /// Twice the vector areas in space.
    pub(super) normal: [Lanes; 3],
    pub(super) space_area: Lanes,
    pub(super) plane_area: Lanes,
}

/// What [`Stretch`](super::corners::Stretch) has, of eight.
pub(super) struct Stretches {
    pub(super) large: Lanes,
    pub(super) small: Lanes,
    pub(super) frobenius: Lanes,
    pub(super) determinant: Lanes,
}

#[inline(always)]
fn dot<const N: usize>(a: &[Lanes; N], b: &[Lanes; N]) -> Lanes {
    let mut sum = a[0] * b[0];
    for k in 1..N {
        sum += a[k] * b[k];
    }
    sum
}

impl Eight {
    /// Of the triangles of `N` corners from `first` on whose places among them are given. `None` unless all have area in space
    /// and are known to turn left in the plane.
    #[inline(always)]
    pub(super) fn of<const N: usize>(
        surface: &Surface<'_>,
        first: usize,
        triangles: &[[usize; 3]; LANES],
    ) -> Option<Self> {
        let points: [Vec3; N] = std::array::from_fn(|k| surface.position(first + k));
        let places: [Vec2; N] = std::array::from_fn(|k| surface.uv(first + k));
        let zero = Lanes::ZERO;
        let (mut space, mut plane) = ([[zero; 3]; 2], [[zero; 2]; 2]);
        let mut third = [[zero; 2]; 2];
        for l in 0..LANES {
            let [a, b, c] = triangles[l];
            for k in 0..3 {
                space[0][k].0[l] = points[b][k] - points[a][k];
                space[1][k].0[l] = points[c][k] - points[a][k];
            }
            for k in 0..2 {
                plane[0][k].0[l] = places[b][k] - places[a][k];
                plane[1][k].0[l] = places[c][k] - places[a][k];
                third[0][k].0[l] = places[a][k] - places[c][k];
                third[1][k].0[l] = places[b][k] - places[c][k];
            }
        }
        let [[ax, ay, az], [bx, by, bz]] = space;
        let normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        let space_area = dot(&normal, &normal).sqrt() * 0.5;
        let [[px, py], [qx, qy]] = third;
        let (left, right) = (px * qy, py * qx);
        let turn = left - right;
        let surplus = turn - (left.abs() + right.abs()) * CERTAIN;
        let is_ordinary =
            space_area.all_above(ORDINARY) && turn.all_above(ORDINARY) && surplus.all_above(0.0);
        is_ordinary.then_some(Self { space, plane, normal, space_area, plane_area: turn * 0.5 })
    }

    /// The angles at the first corners, in space and in the plane.
    #[inline(always)]
    pub(super) fn angles(&self) -> [Lanes; 2] {
        let space = (self.space_area * 2.0).atan2_positive(dot(&self.space[0], &self.space[1]));
        let plane = (self.plane_area * 2.0).atan2_positive(dot(&self.plane[0], &self.plane[1]));
        [space, plane]
    }

    /// The angles at the second corners.
    #[inline(always)]
    pub(super) fn second_angles(&self) -> [Lanes; 2] {
        let (s, p) = (&self.space, &self.plane);
        // −a · (b − a), with a to the second corner and b to the third.
        let in_space = dot(&s[0], &s[0]) - dot(&s[0], &s[1]);
        let in_plane = dot(&p[0], &p[0]) - dot(&p[0], &p[1]);
        [(self.space_area * 2.0).atan2_positive(in_space), (self.plane_area * 2.0).atan2_positive(in_plane)]
    }

    /// With lengths multiplied by `space` and `plane` first. `None` where one has no ordinary value.
    #[inline(always)]
    pub(super) fn stretches(&self, space: f64, plane: f64) -> Option<Stretches> {
        let length = dot(&self.space[0], &self.space[0]).sqrt();
        // Positions and UVs may have units of their own: one factor for both.
        let (ratio, per_length) = (plane / space, length.recip());
        let x = dot(&self.space[0], &self.space[1]) * per_length;
        let per_y = (self.space_area * 2.0 * per_length).recip();
        let first = self.plane[0].map(|edge| edge * ratio * per_length);
        let second = [0, 1].map(|k| (self.plane[1][k] * ratio - first[k] * x) * per_y);
        let sum = [first[0] + second[1], first[1] - second[0]];
        let difference = [first[0] - second[1], first[1] + second[0]];
        let large = (dot(&sum, &sum).sqrt() + dot(&difference, &difference).sqrt()) * 0.5;
        let determinant = self.plane_area * (ratio * ratio) * self.space_area.recip();
        let small = determinant * large.recip();
        let frobenius = dot(&first, &first) + dot(&second, &second);
        let is_ordinary = small.all_above(ORDINARY)
            && frobenius.all_above(ORDINARY)
            && (determinant * determinant).all_above(ORDINARY);
        is_ordinary.then_some(Stretches { large, small, frobenius, determinant })
    }
}
