//! Untangling by a regularised barrier, after [Garanzha et al. 2021, "Foldover-free maps in 50 lines of code"].
//!
//! Minimises `Σ (|J|² + det² + 1) / (2 χ(det, ε))`, `χ = (det + √(ε² + det²))/2`, over the interior vertices. χ is positive for
//! flipped corners too, so the sum is finite everywhere; ε falls towards 0 as the map improves, and what is left flipped then costs
//! more and more. J maps equal squares to the plane where the surface's shape is to play no part ([`untangle`]), or the corners at
//! rest where the map is to stay near what it is ([`mend`]).

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::element::Edges;
use super::energy::edges;
use super::hessian::{Accuracy, Hessian, Solved};
use super::layout::Triangle;
use super::rest::{Corners, Frame, Rest, RestCorner, framed, unframed, unframed_triangle};
use super::{DescentError, StartError};
use crate::qmesh::{Observer, QuadMesh, Vec2};

/// Steps at most; nested spikes thirty deep took 316.
const MAX_STEPS: usize = 400;
/// Enough room to go on from, in units of the squares' area.
const GOOD_DETERMINANT: f64 = 1e-3;
/// ε shrinks by at least this fraction a step.
const LEAST_SHRINK: f64 = 0.1;
const CHUNK: usize = 2048;

/// Moves the interior vertices of `uv` until every corner of `rest` has room, or nothing helps any more.
///
/// # Errors
/// [`StartError::Cancelled`], or a linear system that cannot be solved. Whether it succeeded is for the caller to judge.
pub(super) fn untangle(
    rest: &Rest,
    mesh: &QuadMesh,
    uv: &mut [Vec2],
    observer: &dyn Observer,
) -> Result<(), StartError> {
    let side = square_side(mesh, uv);
    let fixed: Vec<bool> = mesh.vertices().map(|vertex| mesh.is_boundary(vertex)).collect();
    widen(rest, Some(side), &fixed, uv, MAX_STEPS, observer)
}

/// Moves the vertices of `uv`, in units of `rest`, that are not `fixed` until every corner has room, or `max_steps` were made.
///
/// # Errors
/// As [`untangle`].
pub(super) fn mend(
    rest: &Rest,
    fixed: &[bool],
    uv: &mut [Vec2],
    max_steps: usize,
    observer: &dyn Observer,
) -> Result<(), StartError> {
    widen(rest, None, fixed, uv, max_steps, observer)
}

fn widen(
    rest: &Rest,
    side: Option<f64>,
    fixed: &[bool],
    uv: &mut [Vec2],
    max_steps: usize,
    observer: &dyn Observer,
) -> Result<(), StartError> {
    let mut hessian = Hessian::new(rest)?;
    hessian.factorize()?;
    let mut epsilon = 1.0;
    for step in 0..max_steps {
        if let ControlFlow::Break(()) = observer.progress("untangle", step as f64 / max_steps as f64) {
            return Err(StartError::Cancelled);
        }
        let barrier = Barrier { side, epsilon };
        let before = barrier.value(rest, uv);
        let gradient = barrier.derivatives(rest, uv, &mut hessian);
        let gradient = hessian.fix(fixed, gradient);
        let solved = hessian.newton_direction(uv, &gradient, Accuracy::DIRECTION, false);
        let Solved { mut direction, decrement, .. } = solved.map_err(solve_error)?;
        rest.constraint.reflect(&mut direction);
        let after = barrier.search(rest, uv, &direction, before, decrement);
        let smallest = barrier.smallest_determinant(rest, uv);
        if smallest > GOOD_DETERMINANT {
            return Ok(());
        }
        epsilon *= shrink(after / before, smallest, epsilon);
    }
    Ok(())
}

fn solve_error(error: DescentError) -> StartError {
    match error {
        DescentError::Solve(error) => StartError::Solve(error),
        DescentError::InvalidStart(corner) => StartError::Tangled { corner, count: 1 },
    }
}

/// The factor by which ε falls: the faster the sum fell and the less is flipped, the more.
fn shrink(ratio: f64, smallest: f64, epsilon: f64) -> f64 {
    let sigma = (1.0 - ratio).max(LEAST_SHRINK);
    if smallest < 0.0 {
        let reach = smallest.hypot(epsilon);
        1.0 - sigma * reach / (smallest.abs() + reach)
    } else {
        1.0 - sigma
    }
}

/// The side of the squares that together have the area of the boundary polygon.
fn square_side(mesh: &QuadMesh, uv: &[Vec2]) -> f64 {
    let doubled: f64 = mesh
        .boundary_halfedges()
        .map(|h| {
            let (from, to) = (uv[mesh.target(h).index()], uv[mesh.origin(h).index()]);
            from.x * to.y - from.y * to.x
        })
        .sum();
    (0.5 * doubled.abs() / mesh.face_count() as f64).sqrt()
}

struct Barrier {
    /// That of the squares, or none: corners are mapped from their own shape at rest.
    side: Option<f64>,
    epsilon: f64,
}

impl Barrier {
    /// The derivative of the map by the edge vectors in the plane.
    fn frame(&self, corner: &RestCorner) -> Frame {
        let [i11, i12, i22] = self.side.map_or(corner.inverse, |side| [1.0 / side, 0.0, 1.0 / side]);
        [i11, 0.0, i12, i22]
    }

    fn jacobian(&self, corner: &RestCorner, uv: &[Vec2]) -> [f64; 4] {
        framed(&self.frame(corner), edges(corner, uv))
    }

    fn chi(&self, det: f64) -> f64 {
        let root = self.epsilon.hypot(det);
        // For flipped corners the sum cancels; its conjugate does not.
        if det >= 0.0 { (det + root) / 2.0 } else { self.epsilon * self.epsilon / (2.0 * (root - det)) }
    }

    fn value(&self, rest: &Rest, uv: &[Vec2]) -> f64 {
        let term = |corner: &RestCorner| {
            let j = self.jacobian(corner, uv);
            let (norm, det) = invariants(j);
            (norm + det * det + 1.0) / (2.0 * self.chi(det))
        };
        let sums: Vec<f64> =
            rest.corners.par_chunks(CHUNK).map(|chunk| chunk.iter().map(term).sum()).collect();
        sums.iter().sum()
    }

    fn smallest_determinant(&self, rest: &Rest, uv: &[Vec2]) -> f64 {
        let det = |corner: &RestCorner| invariants(self.jacobian(corner, uv)).1;
        rest.corners.iter().map(det).fold(f64::INFINITY, f64::min)
    }

    /// Fills `hessian` and returns the gradient.
    ///
    /// With N = |J| and D = det the energy is g(N, D) and its Hessian `g_N/N · (1 − n nᵀ)` and the 2 × 2 Hessian of g in the
    /// directions n and ∇D, made positive semidefinite; the second derivative of D is left out.
    fn derivatives(&self, rest: &Rest, uv: &[Vec2], hessian: &mut Hessian) -> Vec<f64> {
        let shares = |corners: Corners<'_>, gradients: &mut [Edges], triangles: &mut [Triangle]| {
            for ((corner, gradient), triangle) in corners.corners.iter().zip(gradients).zip(triangles) {
                let frame = self.frame(corner);
                let (by_jacobian, twice) = self.corner(framed(&frame, edges(corner, uv)));
                (*gradient, *triangle) = (unframed(&frame, by_jacobian), unframed_triangle(&frame, &twice));
            }
            Ok(0.0)
        };
        hessian.assemble(rest, shares).map_or_else(|_| Vec::new(), |(_, gradient)| gradient)
    }

    /// First and second derivatives by the Jacobian.
    fn corner(&self, j: [f64; 4]) -> ([f64; 4], [f64; 10]) {
        let [a, c, b, d] = j;
        let (norm, det) = invariants(j);
        let chi = self.chi(det);
        let root = self.epsilon.hypot(det);
        let (chi1, chi2) = (chi / root, self.epsilon * self.epsilon / (2.0 * root.powi(3)));
        let sum = norm + det * det + 1.0;
        let by_det = det / chi - sum * chi1 / (2.0 * chi * chi);
        let by_det2 = 1.0 / chi - 2.0 * det * chi1 / (chi * chi) - sum * chi2 / (2.0 * chi * chi)
            + sum * chi1 * chi1 / chi.powi(3);
        let cofactor = [d, -b, -c, a];
        let length = norm.sqrt().max(f64::MIN_POSITIVE);
        let unit = j.map(|x| x / length);
        let mixed = -length * chi1 / (chi * chi);
        let gradient = std::array::from_fn(|i| j[i] / chi + by_det * cofactor[i]);
        let [(low, v), (high, w)] = super::isotropic::eigen_2x2([1.0 / chi, mixed, by_det2]);
        let along = |[x, y]: [f64; 2]| -> [f64; 4] { std::array::from_fn(|i| x * unit[i] + y * cofactor[i]) };
        let (v, w) = (along(v), along(w));
        let mut hessian = [0.0; 10];
        let mut at = 0;
        for i in 0..4 {
            for k in i..4 {
                let identity = if i == k { 1.0 } else { 0.0 };
                hessian[at] = (identity - unit[i] * unit[k]) / chi
                    + low.max(0.0) * v[i] * v[k]
                    + high.max(0.0) * w[i] * w[k];
                at += 1;
            }
        }
        (gradient, hessian)
    }

    /// Backtracks along `direction`; returns the value reached.
    fn search(&self, rest: &Rest, uv: &mut [Vec2], direction: &[Vec2], before: f64, decrement: f64) -> f64 {
        let start = uv.to_vec();
        let mut step = 1.0;
        while step > 1e-8 {
            for ((to, from), along) in uv.iter_mut().zip(&start).zip(direction) {
                *to = from + along * step;
            }
            let value = self.value(rest, uv);
            if value <= before - 1e-4 * step * decrement {
                return value;
            }
            step *= 0.5;
        }
        uv.copy_from_slice(&start);
        before
    }
}

/// `|J|²` and `det J`.
fn invariants([a, c, b, d]: [f64; 4]) -> (f64, f64) {
    (a * a + b * b + c * c + d * d, a * d - b * c)
}
