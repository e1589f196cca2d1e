//! One corner triangle: energy, gradient and a positive semidefinite Hessian.
//!
//! All three depend on the two edge vectors at the corner only: `f1` to the next vertex, `f0` to the previous. So
//! derivatives have four entries, `(f1, f0)`, and the corner's own vertex takes what is left to make them sum to zero.

use super::isotropic::{Columns, Density, Stretch, area_change, mips, symmetric_dirichlet};
use super::rest::RestCorner;
use super::{AngleTerm, Objective};

/// A derivative by `(f1, f0)`.
pub(super) type Edges = [f64; 4];

/// Energy and derivatives of one corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    /// The energy; infinite where the corner is not positive.
    pub(super) value: f64,
    pub(super) gradient: Edges,
    /// The upper triangle, row by row.
    pub(super) hessian: [f64; 10],
}

impl Element {
    const ZERO: Self = Self { value: 0.0, gradient: [0.0; 4], hessian: [0.0; 10] };

    /// Adds `weight · v vᵀ` to the Hessian.
    fn add_square(&mut self, weight: f64, v: &Edges) {
        let mut at = 0;
        for i in 0..4 {
            let scaled = weight * v[i];
            for &w in &v[i..] {
                self.hessian[at] += scaled * w;
                at += 1;
            }
        }
    }

    fn add_gradient(&mut self, weight: f64, v: &Edges) {
        for (sum, x) in self.gradient.iter_mut().zip(v) {
            *sum += weight * x;
        }
    }
}

/// The map's derivative in an orthonormal frame of the corner triangle at rest.
pub(super) fn jacobian(rest: &RestCorner, [f1x, f1y, f0x, f0y]: Edges) -> Columns {
    let [i11, i12, i22] = rest.inverse;
    [f1x * i11, f1y * i11, f1x * i12 + f0x * i22, f1y * i12 + f0y * i22]
}

/// Singular values of a positive corner's map.
pub(super) fn stretch(rest: &RestCorner, f: Edges) -> Stretch {
    Stretch::new(jacobian(rest, f))
}

/// Whether s1/s2 is above `limit`.
pub(super) fn is_stretched_beyond(limit: f64, rest: &RestCorner, f: Edges) -> bool {
    let [larger, smaller] = stretch(rest, f).s;
    larger > limit * smaller
}

/// A derivative by the Jacobian, as one by the edge vectors.
fn pull_back(rest: &RestCorner, [ax, ay, bx, by]: Columns) -> Edges {
    let [i11, i12, i22] = rest.inverse;
    [ax * i11 + bx * i12, ay * i11 + by * i12, bx * i22, by * i22]
}

fn cross([f1x, f1y, f0x, f0y]: Edges) -> f64 {
    f1x * f0y - f1y * f0x
}

/// The interior angle between the edge vectors, for a positive corner.
fn angle(f: Edges) -> f64 {
    cross(f).atan2(f[0] * f[2] + f[1] * f[3])
}

/// The energy alone; infinite where the corner is not positive.
pub(super) fn value(objective: &Objective, rest: &RestCorner, f: Edges) -> f64 {
    let doubled = cross(f);
    if doubled.is_nan() || doubled <= 0.0 {
        return f64::INFINITY;
    }
    match *objective {
        Objective::Direct { q, shape, angle_term } => {
            let angle_value = angle_residual(angle_term, rest.angle, angle(f)).0.powi(2);
            let ratio = rest.area / (0.5 * doubled);
            let area_value = 0.5 * ((ratio - 1.0).powi(2) + (ratio.recip() - 1.0).powi(2));
            let [a, b, c, d] = jacobian(rest, f);
            let (norm, det) = (a * a + b * b + c * c + d * d, a * d - b * c);
            let dirichlet = (norm + norm / (det * det)) / 4.0;
            rest.share * (q * angle_value + (1.0 - q) * area_value) + shape * rest.weight * (dirichlet - 1.0)
        }
        Objective::Conformal { q } => {
            let [a, b, c, d] = jacobian(rest, f);
            let (norm, det) = (a * a + b * b + c * c + d * d, a * d - b * c);
            rest.weight * (q * norm / (2.0 * det) + (1.0 - q) * (det + 1.0 / det) / 2.0 - 1.0)
        }
    }
}

/// Energy, gradient and Hessian. `None` where the corner is not positive.
pub(super) fn derivatives(objective: &Objective, rest: &RestCorner, f: Edges) -> Option<Element> {
    let doubled = cross(f);
    if doubled.is_nan() || doubled <= 0.0 {
        return None;
    }
    let mut element = Element::ZERO;
    element.value = value(objective, rest, f);
    let stretch = Stretch::new(jacobian(rest, f));
    match *objective {
        Objective::Direct { q, shape, angle_term } => {
            add_angle(&mut element, q * rest.share, angle_term, rest, f);
            add_area(&mut element, (1.0 - q) * rest.share, rest, f, doubled);
            add_isotropic(&mut element, shape * rest.weight, rest, &stretch, &symmetric_dirichlet(stretch.s));
        }
        Objective::Conformal { q } => {
            let density = mix(q, &mips(stretch.s), &area_change(stretch.s));
            add_isotropic(&mut element, rest.weight, rest, &stretch, &density);
        }
    }
    Some(element)
}

/// The residual of the angle term and its derivative by the angle φ.
fn angle_residual(term: AngleTerm, theta: f64, phi: f64) -> (f64, f64) {
    match term {
        AngleTerm::Log => ((theta / phi).ln(), -1.0 / phi),
        AngleTerm::Paper => (theta / phi - 1.0, -theta / (phi * phi)),
    }
}

/// Gauss–Newton for the angle term (Eq. 13, or its logarithm).
fn add_angle(element: &mut Element, weight: f64, term: AngleTerm, rest: &RestCorner, f: Edges) {
    let (residual, slope) = angle_residual(term, rest.angle, angle(f));
    let [f1x, f1y, f0x, f0y] = f;
    let (n1, n0) = (f1x * f1x + f1y * f1y, f0x * f0x + f0y * f0y);
    // φ is the direction of f0 less that of f1.
    let by_edges = [f1y / n1, -f1x / n1, -f0y / n0, f0x / n0];
    element.add_gradient(2.0 * weight * residual * slope, &by_edges);
    element.add_square(2.0 * weight * slope * slope, &by_edges);
}

/// Gauss–Newton for both residuals of the area term: `r − 1` (Eq. 14) and `1/r − 1`, `r = A(T)/A(U)`.
fn add_area(element: &mut Element, weight: f64, rest: &RestCorner, f: Edges, doubled: f64) {
    let area = 0.5 * doubled;
    let ratio = rest.area / area;
    let slopes = [-ratio / area, 1.0 / rest.area];
    let [f1x, f1y, f0x, f0y] = f;
    let by_edges = [0.5 * f0y, -0.5 * f0x, -0.5 * f1y, 0.5 * f1x];
    let gradient = (ratio - 1.0) * slopes[0] + (ratio.recip() - 1.0) * slopes[1];
    element.add_gradient(weight * gradient, &by_edges);
    element.add_square(weight * (slopes[0] * slopes[0] + slopes[1] * slopes[1]), &by_edges);
}

/// Projected Newton for an energy of the singular values.
fn add_isotropic(
    element: &mut Element,
    weight: f64,
    rest: &RestCorner,
    stretch: &Stretch,
    density: &Density,
) {
    element.add_gradient(weight, &pull_back(rest, stretch.gradient(density)));
    for (eigenvalue, direction) in stretch.projected_hessian(density) {
        if eigenvalue > 0.0 {
            element.add_square(weight * eigenvalue, &pull_back(rest, direction));
        }
    }
}

fn mix(q: f64, a: &Density, b: &Density) -> Density {
    let blend = |x: f64, y: f64| q * x + (1.0 - q) * y;
    Density {
        value: blend(a.value, b.value),
        first: std::array::from_fn(|i| blend(a.first[i], b.first[i])),
        second: std::array::from_fn(|i| blend(a.second[i], b.second[i])),
        twist: blend(a.twist, b.twist),
        flip: blend(a.flip, b.flip),
    }
}
