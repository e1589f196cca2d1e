//! Eight corners at a time: their energies, with derivatives.
#![allow(clippy::needless_range_loop, clippy::assign_op_pattern)] // loops over lanes become vector instructions

use super::super::AngleTerm;
use super::super::element::Edges;
use super::super::layout::Triangle;
use super::super::rest::{Frame, RestCorner, framed};
use crate::lanes::{LANES, Lanes};
use crate::qmesh::Vec2;

/// Doubled areas and angles below this are left to the careful way.
const ORDINARY: f64 = 1e-140;

/// Eight corners: their edge vectors in the plane, and what [`RestCorner`] has of them.
pub(super) struct Group {
    f: [Lanes; 4],
    angle: Lanes,
    area: Lanes,
    inverse: [Lanes; 3],
    share: Lanes,
    weight: Lanes,
}

/// Energies of eight corners with their derivatives; the second ones only where they are asked for.
pub(super) struct Eight<const SECOND: bool> {
    pub(super) value: Lanes,
    gradient: [Lanes; 4],
    hessian: [Lanes; 10],
}

impl<const SECOND: bool> Eight<SECOND> {
    #[inline(always)]
    fn add(&mut self, slope: Lanes, curvature: Lanes, v: &[Lanes; 4]) {
        let mut at = 0;
        for i in 0..4 {
            self.gradient[i] += slope * v[i];
            if !SECOND {
                continue;
            }
            let scaled = curvature * v[i];
            for j in i..4 {
                self.hessian[at] += scaled * v[j];
                at += 1;
            }
        }
    }

    #[inline(always)]
    pub(super) fn store_gradients(&self, gradients: &mut [Edges]) {
        for l in 0..LANES {
            for i in 0..4 {
                gradients[l][i] = self.gradient[i].0[l];
            }
        }
    }

    #[inline(always)]
    pub(super) fn store(&self, gradients: &mut [Edges], triangles: &mut [Triangle]) {
        self.store_gradients(gradients);
        for l in 0..LANES {
            for i in 0..10 {
                triangles[l][i] = self.hessian[i].0[l];
            }
        }
    }
}

/// What energies are made of, without any weights.
struct Parts {
    /// The square of the angle term's residual.
    angle: Lanes,
    /// Twice the area term.
    area: Lanes,
    /// Symmetric Dirichlet less one.
    dirichlet: Lanes,
    /// `s1² + s2²`.
    norm: Lanes,
    /// `s1 s2`.
    det: Lanes,
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
    pub(super) fn new(corners: &[RestCorner; LANES], frames: Option<&[Frame]>, uv: &[Vec2]) -> Self {
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

    /// What the energies are made of; `None` where one of the corners is out of the ordinary.
    #[inline(always)]
    fn parts(&self, term: AngleTerm) -> Option<Parts> {
        let cross = self.cross();
        let phi = self.phi(cross);
        if !(cross.all_above(ORDINARY) && phi.all_above(ORDINARY)) {
            return None;
        }
        let (angle, _) = angle_residual(term, self.angle, phi);
        let ratio = self.area * (cross * 0.5).recip();
        let (more, less) = (ratio - 1.0, ratio.recip() - 1.0);
        let [a, b, c, d] = self.jacobian();
        let (norm, det) = (a * a + b * b + c * c + d * d, a * d - b * c);
        let dirichlet = (norm + norm * (det * det).recip()) * 0.25 - 1.0;
        Some(Parts { angle: angle * angle, area: more * more + less * less, dirichlet, norm, det })
    }

    #[inline(always)]
    pub(super) fn value(&self, q: f64, shape: f64, term: AngleTerm) -> Option<Lanes> {
        let Parts { angle, area, dirichlet, .. } = self.parts(term)?;
        Some(self.share * (angle * q + area * (0.5 * (1.0 - q))) + self.weight * dirichlet * shape)
    }

    /// The shares that [`Terms`](super::super::Terms) are sums of, and how many corners are stretched beyond `limit`.
    #[inline(always)]
    pub(super) fn terms(&self, term: AngleTerm, limit: f64) -> Option<([Lanes; 3], usize)> {
        let Parts { angle, area, dirichlet, norm, det } = self.parts(term)?;
        // s1/s2 + s2/s1, which grows with s1/s2.
        let bound = det * (limit + limit.recip());
        let beyond = (0..LANES).filter(|&l| norm.0[l] > bound.0[l]).count();
        Some(([self.share * angle, self.share * area * 0.5, self.weight * dirichlet], beyond))
    }

    #[inline(always)]
    pub(super) fn derivatives<const SECOND: bool>(
        &self,
        q: f64,
        shape: f64,
        term: AngleTerm,
    ) -> Option<Eight<SECOND>> {
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
    fn add_angle<const SECOND: bool>(
        &self,
        eight: &mut Eight<SECOND>,
        weight: Lanes,
        term: AngleTerm,
        phi: Lanes,
    ) {
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
    fn add_area<const SECOND: bool>(&self, eight: &mut Eight<SECOND>, weight: Lanes, cross: Lanes) {
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
    fn add_dirichlet<const SECOND: bool>(&self, eight: &mut Eight<SECOND>, weight: Lanes) {
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
        if !SECOND {
            return;
        }
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
