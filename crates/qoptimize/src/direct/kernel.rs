//! The energy of [`element`](super::element) for eight corners at a time.
//!
//! Whatever is out of the ordinary (a corner without area, an angle near zero, the last corners of a chunk, other objectives) goes
//! through `element` one by one.
#![allow(clippy::needless_range_loop, clippy::assign_op_pattern)] // loops over lanes become vector instructions

use std::ops::Range;

use pulp::Arch;

use super::element::{self, Edges};
use super::lanes::{LANES, Lanes};
use super::layout::Triangle;
use super::rest::{Corners, Frame, RestCorner, framed, unframed, unframed_triangle};
use super::{AngleTerm, Objective};
use crate::qmesh::Vec2;

/// Doubled areas and angles below this are left to the careful way.
const ORDINARY: f64 = 1e-140;

/// The sum of the energies of `corners`; infinite where one is not positive.
pub(super) fn value(objective: &Objective, chunk: Corners<'_>, uv: &[Vec2]) -> f64 {
    let count = chunk.corners.len();
    let one_by_one = |places: Range<usize>| {
        places.map(|at| element::value(objective, &chunk.corners[at], chunk.edges(at, uv))).sum::<f64>()
    };
    let Objective::Direct { q, shape, angle_term } = *objective else { return one_by_one(0..count) };
    Arch::new().dispatch(|| {
        let (groups, last) = chunk.corners.as_chunks::<LANES>();
        let mut sums = Lanes::ZERO;
        let mut others = 0.0;
        for (number, corners) in groups.iter().enumerate() {
            let places = number * LANES..(number + 1) * LANES;
            match Group::new(corners, chunk.frames.get(places.clone()), uv).value(q, shape, angle_term) {
                Some(values) => sums += values,
                None => others += one_by_one(places),
            }
        }
        sums.0.iter().sum::<f64>() + others + one_by_one(count - last.len()..count)
    })
}

/// Fills in gradient and Hessian of every corner and returns the sum of the energies, or the place of the first corner that is
/// not positive.
pub(super) fn derivatives(
    objective: &Objective,
    chunk: Corners<'_>,
    uv: &[Vec2],
    gradients: &mut [Edges],
    triangles: &mut [Triangle],
) -> Result<f64, usize> {
    let value = derivatives_by_edges(objective, chunk, uv, gradients, triangles)?;
    for ((frame, gradient), triangle) in chunk.frames.iter().zip(gradients).zip(triangles) {
        *gradient = unframed(frame, *gradient);
        *triangle = unframed_triangle(frame, triangle);
    }
    Ok(value)
}

/// The same by the edge vectors of what the triangles stand for.
fn derivatives_by_edges(
    objective: &Objective,
    chunk: Corners<'_>,
    uv: &[Vec2],
    gradients: &mut [Edges],
    triangles: &mut [Triangle],
) -> Result<f64, usize> {
    let corners = chunk.corners;
    let one_by_one = |places: Range<usize>, gradients: &mut [Edges], triangles: &mut [Triangle]| {
        let mut sum = 0.0;
        for at in places {
            let element = element::derivatives(objective, &corners[at], chunk.edges(at, uv)).ok_or(at)?;
            sum += element.value;
            gradients[at] = element.gradient;
            triangles[at] = element.hessian;
        }
        Ok(sum)
    };
    let Objective::Direct { q, shape, angle_term } = *objective else {
        return one_by_one(0..corners.len(), gradients, triangles);
    };
    Arch::new().dispatch(|| {
        let (groups, last) = corners.as_chunks::<LANES>();
        let mut sums = Lanes::ZERO;
        let mut others = 0.0;
        for (number, corners) in groups.iter().enumerate() {
            let places = number * LANES..(number + 1) * LANES;
            let group = Group::new(corners, chunk.frames.get(places.clone()), uv);
            match group.derivatives(q, shape, angle_term) {
                Some(eight) => {
                    sums += eight.value;
                    eight.store(&mut gradients[places.clone()], &mut triangles[places]);
                }
                None => others += one_by_one(places, gradients, triangles)?,
            }
        }
        others += one_by_one(corners.len() - last.len()..corners.len(), gradients, triangles)?;
        Ok(sums.0.iter().sum::<f64>() + others)
    })
}

/// Eight corners: their edge vectors in the plane, and what [`RestCorner`] has of them.
struct Group {
    f: [Lanes; 4],
    angle: Lanes,
    area: Lanes,
    inverse: [Lanes; 3],
    share: Lanes,
    weight: Lanes,
}

/// Energies of eight corners with their derivatives.
struct Eight {
    value: Lanes,
    gradient: [Lanes; 4],
    hessian: [Lanes; 10],
}

impl Eight {
    #[inline(always)]
    fn add(&mut self, slope: Lanes, curvature: Lanes, v: &[Lanes; 4]) {
        let mut at = 0;
        for i in 0..4 {
            self.gradient[i] += slope * v[i];
            let scaled = curvature * v[i];
            for j in i..4 {
                self.hessian[at] += scaled * v[j];
                at += 1;
            }
        }
    }

    #[inline(always)]
    fn store(&self, gradients: &mut [Edges], triangles: &mut [Triangle]) {
        for l in 0..LANES {
            for i in 0..4 {
                gradients[l][i] = self.gradient[i].0[l];
            }
            for i in 0..10 {
                triangles[l][i] = self.hessian[i].0[l];
            }
        }
    }
}

/// The angle term's residual, and its derivative by φ.
#[inline(always)]
fn angle_residual(term: AngleTerm, theta: Lanes, phi: Lanes) -> (Lanes, Lanes) {
    let inverse = phi.recip();
    let ratio = theta * inverse;
    match term {
        AngleTerm::Log => (ratio.ln(), -inverse),
        AngleTerm::Paper => (ratio - 1.0, -(ratio * inverse)),
    }
}

impl Group {
    #[inline(always)]
    fn new(corners: &[RestCorner; LANES], frames: Option<&[Frame]>, uv: &[Vec2]) -> Self {
        let zero = Lanes::ZERO;
        let mut group =
            Self { f: [zero; 4], angle: zero, area: zero, inverse: [zero; 3], share: zero, weight: zero };
        for l in 0..LANES {
            let corner = &corners[l];
            let [here, next, previous] = corner.vertices;
            let (here, next, previous) = (uv[here as usize], uv[next as usize], uv[previous as usize]);
            group.f[0].0[l] = next.x - here.x;
            group.f[1].0[l] = next.y - here.y;
            group.f[2].0[l] = previous.x - here.x;
            group.f[3].0[l] = previous.y - here.y;
            group.angle.0[l] = corner.angle;
            group.area.0[l] = corner.area;
            for k in 0..3 {
                group.inverse[k].0[l] = corner.inverse[k];
            }
            group.share.0[l] = corner.share;
            group.weight.0[l] = corner.weight;
        }
        if let Some(frames) = frames {
            for (l, frame) in frames.iter().enumerate() {
                let f = framed(frame, group.f.map(|f| f.0[l]));
                (0..4).for_each(|i| group.f[i].0[l] = f[i]);
            }
        }
        group
    }

    #[inline(always)]
    fn cross(&self) -> Lanes {
        let [f1x, f1y, f0x, f0y] = self.f;
        f1x * f0y - f1y * f0x
    }

    /// The angle in the plane.
    #[inline(always)]
    fn phi(&self, cross: Lanes) -> Lanes {
        let [f1x, f1y, f0x, f0y] = self.f;
        cross.atan2_positive(f1x * f0x + f1y * f0y)
    }

    /// The derivative of the map, column by column.
    #[inline(always)]
    fn jacobian(&self) -> [Lanes; 4] {
        let ([f1x, f1y, f0x, f0y], [i11, i12, i22]) = (self.f, self.inverse);
        [f1x * i11, f1y * i11, f1x * i12 + f0x * i22, f1y * i12 + f0y * i22]
    }

    #[inline(always)]
    fn value(&self, q: f64, shape: f64, term: AngleTerm) -> Option<Lanes> {
        let cross = self.cross();
        let phi = self.phi(cross);
        if !(cross.all_above(ORDINARY) && phi.all_above(ORDINARY)) {
            return None;
        }
        let (angle, _) = angle_residual(term, self.angle, phi);
        let ratio = self.area * (cross * 0.5).recip();
        let (more, less) = (ratio - 1.0, ratio.recip() - 1.0);
        let errors = angle * angle * q + (more * more + less * less) * (0.5 * (1.0 - q));
        let [a, b, c, d] = self.jacobian();
        let (norm, det) = (a * a + b * b + c * c + d * d, a * d - b * c);
        let dirichlet = (norm + norm * (det * det).recip()) * 0.25 - 1.0;
        Some(self.share * errors + self.weight * dirichlet * shape)
    }

    #[inline(always)]
    fn derivatives(&self, q: f64, shape: f64, term: AngleTerm) -> Option<Eight> {
        let cross = self.cross();
        let phi = self.phi(cross);
        if !(cross.all_above(ORDINARY) && phi.all_above(ORDINARY)) {
            return None;
        }
        let mut eight = Eight { value: Lanes::ZERO, gradient: [Lanes::ZERO; 4], hessian: [Lanes::ZERO; 10] };
        self.add_angle(&mut eight, self.share * q, term, phi);
        self.add_area(&mut eight, self.share * (1.0 - q), cross);
        self.add_dirichlet(&mut eight, self.weight * shape);
        Some(eight)
    }

    /// Gauss–Newton.
    #[inline(always)]
    fn add_angle(&self, eight: &mut Eight, weight: Lanes, term: AngleTerm, phi: Lanes) {
        let (residual, slope) = angle_residual(term, self.angle, phi);
        let [f1x, f1y, f0x, f0y] = self.f;
        let (r1, r0) = ((f1x * f1x + f1y * f1y).recip(), (f0x * f0x + f0y * f0y).recip());
        let by_edges = [f1y * r1, -(f1x * r1), -(f0y * r0), f0x * r0];
        eight.value += weight * residual * residual;
        let doubled = weight * slope * 2.0;
        eight.add(doubled * residual, doubled * slope, &by_edges);
    }

    /// Gauss–Newton for both residuals.
    #[inline(always)]
    fn add_area(&self, eight: &mut Eight, weight: Lanes, cross: Lanes) {
        let area = cross * 0.5;
        let (inverse, at_rest) = (area.recip(), self.area.recip());
        let ratio = self.area * inverse;
        let (more, less) = (ratio - 1.0, area * at_rest - 1.0);
        let slope = -(ratio * inverse);
        let [f1x, f1y, f0x, f0y] = self.f;
        let by_edges = [f0y * 0.5, f0x * -0.5, f1y * -0.5, f1x * 0.5];
        eight.value += weight * (more * more + less * less) * 0.5;
        eight.add(
            weight * (more * slope + less * at_rest),
            weight * (slope * slope + at_rest * at_rest),
            &by_edges,
        );
    }

    /// Projected Newton: of the four eigenvalues only the twist's can be negative.
    #[inline(always)]
    fn add_dirichlet(&self, eight: &mut Eight, weight: Lanes) {
        let [a, c, b, d] = self.jacobian();
        let (e, f, g, h) = ((a + d) * 0.5, (a - d) * 0.5, (c + b) * 0.5, (c - b) * 0.5);
        let (turning, mirroring) = ((e * e + h * h).sqrt(), (f * f + g * g).sqrt());
        let det = a * d - b * c;
        let s1 = turning + mirroring;
        let s2 = det * s1.recip(); // the difference would cancel on slivers
        let per_turning = turning.recip();
        let (e, h) = (e * per_turning, h * per_turning);
        let zero = Lanes::ZERO;
        let per_mirroring = zero.if_less(mirroring, mirroring.recip(), zero);
        let (f, g) = (zero.if_less(mirroring, f * per_mirroring, Lanes::all(1.0)), g * per_mirroring);
        let per_det = det.recip();
        let (r1, r2) = (s2 * per_det, s1 * per_det);
        let (i1, i2) = (r1 * r1, r2 * r2);
        let (first, second) = ((s1 - i1 * r1) * 0.5, (s2 - i2 * r2) * 0.5);
        let twist = (first + second) * (per_turning * 0.5);
        let twist = zero.if_less(twist, twist, zero);
        let flip = (s1 * s1 + det + s2 * s2) * (per_det * per_det * per_det) * 0.5 + 0.5;
        eight.value += weight * ((s1 * s1 + s2 * s2 + i1 + i2) * 0.25 - 1.0);
        let grow = [(e + f) * 0.5, (h + g) * 0.5, (g - h) * 0.5, (e - f) * 0.5];
        eight.add(weight * first, weight * (i1 * i1 * 1.5 + 0.5), &self.pull_back(grow));
        let grow = [(e - f) * 0.5, (h - g) * 0.5, -(g + h) * 0.5, (e + f) * 0.5];
        eight.add(weight * second, weight * (i2 * i2 * 1.5 + 0.5), &self.pull_back(grow));
        // These two directions have length √2.
        eight.add(zero, weight * twist * 0.5, &self.pull_back([-h, e, -e, -h]));
        eight.add(zero, weight * flip * 0.5, &self.pull_back([-g, f, f, g]));
    }

    /// A derivative by the Jacobian, as one by the edge vectors.
    #[inline(always)]
    fn pull_back(&self, [ax, ay, bx, by]: [Lanes; 4]) -> [Lanes; 4] {
        let [i11, i12, i22] = self.inverse;
        [ax * i11 + bx * i12, ay * i11 + by * i12, bx * i22, by * i22]
    }
}
