//! Analytic derivatives against differences, and what Newton needs of the Hessian.

use proptest::prelude::*;

use super::super::element::{self, Edges};
use super::super::isotropic::{self, Columns, Density, Stretch};
use super::super::rest::{Corners, RestCorner};
use super::super::{AngleTerm, Objective};
use super::super::{energy, kernel};
use crate::qmesh::Vec2;

fn rest_corner(angle: f64, next: f64, previous: f64) -> RestCorner {
    let (x, y) = (previous * angle.cos(), previous * angle.sin());
    RestCorner {
        vertices: [0, 1, 2],
        angle,
        area: 0.5 * next * y,
        inverse: [1.0 / next, -x / (next * y), 1.0 / y],
        share: 0.7,
        weight: 1.3,
    }
}

const OBJECTIVES: [Objective; 5] = [
    Objective::Direct { q: 0.5, shape: 1.0, angle_term: AngleTerm::Log },
    Objective::Direct { q: 0.8, shape: 0.1, angle_term: AngleTerm::Paper },
    Objective::Direct { q: 0.2, shape: 0.0, angle_term: AngleTerm::Log },
    Objective::Conformal { q: 0.9 },
    Objective::Conformal { q: 0.1 },
];

/// Corners at rest and in the plane, not thinner than one degree or so.
fn corners() -> impl Strategy<Value = (RestCorner, Edges)> {
    let edge = 0.3..3.0f64;
    let angle = 0.2..2.9f64;
    (angle.clone(), edge.clone(), edge.clone(), angle, edge.clone(), edge, 0.0..6.2f64).prop_map(
        |(theta, a, b, phi, c, d, turn)| {
            let end = turn + phi;
            (rest_corner(theta, a, b), [c * turn.cos(), c * turn.sin(), d * end.cos(), d * end.sin()])
        },
    )
}

fn densities() -> [fn([f64; 2]) -> Density; 3] {
    [isotropic::symmetric_dirichlet, isotropic::mips, isotropic::area_change]
}

proptest! {
    /// The gradient is the derivative of the value, for every objective.
    #[test]
    fn gradient_matches_differences((rest, f) in corners()) {
        const H: f64 = 1e-6;
        for objective in OBJECTIVES {
            let analytic = element::derivatives(&objective, &rest, f).unwrap().gradient;
            let scale = analytic.iter().fold(1.0, |m: f64, g| m.max(g.abs()));
            for i in 0..4 {
                let (mut up, mut down) = (f, f);
                up[i] += H;
                down[i] -= H;
                let value = |f| element::value(&objective, &rest, f);
                let difference = (value(up) - value(down)) / (2.0 * H);
                prop_assert!((difference - analytic[i]).abs() < 1e-5 * scale, "{objective:?} {i}: {difference} {analytic:?}");
            }
        }
    }

    /// The Hessian that Newton sees has no negative curvature in any direction.
    #[test]
    fn hessian_is_positive_semidefinite((rest, f) in corners(), v in prop::array::uniform4(-1.0..1.0f64)) {
        for objective in OBJECTIVES {
            let element = element::derivatives(&objective, &rest, f).unwrap();
            let (mut at, mut curvature, mut size) = (0, 0.0, 0.0f64);
            for i in 0..4 {
                for j in i..4 {
                    let times = if i == j { 1.0 } else { 2.0 };
                    curvature += times * element.hessian[at] * v[i] * v[j];
                    size = size.max(element.hessian[at].abs());
                    at += 1;
                }
            }
            prop_assert!(curvature >= -1e-10 * size, "{objective:?}: {curvature}");
        }
    }

    /// Eight corners at a time give what each gives alone, also where one of them has no area or company ends early.
    #[test]
    fn eight_at_a_time_are_as_one_by_one(eleven in prop::collection::vec(corners(), 11), spoilt in 0..22usize) {
        let (mut rest, mut uv) = (Vec::new(), Vec::new());
        for (number, (corner, [ax, ay, bx, by])) in eleven.into_iter().enumerate() {
            let first = 3 * number as u32;
            rest.push(RestCorner { vertices: [first, first + 1, first + 2], ..corner });
            let here = Vec2::new(number as f64, -0.5);
            uv.extend([here, here + Vec2::new(ax, ay), here + Vec2::new(bx, by)]);
        }
        if spoilt < 11 {
            uv[3 * spoilt + 2] = uv[3 * spoilt + 1];
        }
        let corners = Corners { corners: &rest, frames: &[] };
        for objective in OBJECTIVES {
            let f: Vec<Edges> = rest.iter().map(|corner| energy::edges(corner, &uv)).collect();
            let alone: f64 = rest.iter().zip(&f).map(|(rest, &f)| element::value(&objective, rest, f)).sum();
            let together = kernel::value(&objective, corners, &uv);
            prop_assert!(alone == together || (alone - together).abs() < 1e-13 * alone, "{alone} {together}");
            let (mut gradients, mut triangles) = (vec![[0.0; 4]; 11], vec![[0.0; 10]; 11]);
            let done = kernel::derivatives(&objective, corners, &uv, &mut gradients, &mut triangles);
            if spoilt < 11 {
                prop_assert_eq!(done, Err(spoilt));
                continue;
            }
            prop_assert!((done.unwrap() - alone).abs() < 1e-13 * alone);
            for ((rest, &f), (gradient, triangle)) in rest.iter().zip(&f).zip(gradients.iter().zip(&triangles)) {
                let element = element::derivatives(&objective, rest, f).unwrap();
                let size = |x: &[f64]| x.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                let close = |a: &[f64], b: &[f64]| { let bound = 1e-11 * size(b); a.iter().zip(b).all(|(a, b)| (a - b).abs() < bound) };
                prop_assert!(close(gradient, &element.gradient), "{gradient:?} {:?}", element.gradient);
                prop_assert!(close(triangle, &element.hessian), "{triangle:?} {:?}", element.hessian);
            }
        }
    }

    /// The eigensystem before clamping is the Hessian of the density.
    #[test]
    fn eigensystem_matches_differences(j in prop::array::uniform4(-2.0..2.0f64), v in prop::array::uniform4(-1.0..1.0f64)) {
        const H: f64 = 1e-5;
        let det = |[a, c, b, d]: Columns| a * d - b * c;
        prop_assume!(det(j) > 0.2);
        let stretch = Stretch::new(j);
        prop_assert!((stretch.s[0] * stretch.s[1] - det(j)).abs() < 1e-12);
        let along = |t: f64| -> Columns { std::array::from_fn(|i| j[i] + t * v[i]) };
        for density in densities() {
            let gradient = |t: f64| { let s = Stretch::new(along(t)); s.gradient(&density(s.s)) };
            let (up, down) = (gradient(H), gradient(-H));
            let difference: f64 = (0..4).map(|i| v[i] * (up[i] - down[i]) / (2.0 * H)).sum();
            let analytic: f64 = stretch.hessian(&density(stretch.s)).iter()
                .map(|(lambda, d)| lambda * d.iter().zip(&v).map(|(x, y)| x * y).sum::<f64>().powi(2)).sum();
            prop_assert!((difference - analytic).abs() < 1e-5 * (1.0 + analytic.abs()), "{difference} {analytic}");
        }
    }
}

/// An isometry costs nothing and pulls nowhere.
#[test]
fn isometry_is_the_minimum() {
    let rest = rest_corner(1.1, 0.8, 1.7);
    let f = [0.0, 0.8, -1.7 * 1.1f64.sin(), 1.7 * 1.1f64.cos()];
    for objective in OBJECTIVES {
        let element = element::derivatives(&objective, &rest, f).unwrap();
        assert!(element.value.abs() < 1e-14, "{objective:?}: {}", element.value);
        assert!(element.gradient.iter().all(|g| g.abs() < 1e-13), "{objective:?}: {:?}", element.gradient);
    }
}

/// A flipped or empty corner is worth infinitely much and has no derivatives.
#[test]
fn flips_are_infinitely_bad() {
    let rest = rest_corner(1.1, 0.8, 1.7);
    for f in [[1.0, 0.0, 0.0, -1.0], [1.0, 1.0, 2.0, 2.0], [0.0; 4], [f64::NAN, 0.0, 0.0, 1.0]] {
        assert_eq!(element::value(&OBJECTIVES[0], &rest, f), f64::INFINITY);
        assert!(element::derivatives(&OBJECTIVES[0], &rest, f).is_none());
    }
}
