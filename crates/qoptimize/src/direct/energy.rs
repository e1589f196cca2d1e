//! The sum over all corners, its gradient, and its sparse Hessian.
//!
//! Sums run in chunks of fixed size whose results are added in order, so they do not depend on the number of threads.

use crate::qmesh::{CornerId, Vec2};
use rayon::prelude::*;

use super::Objective;
use super::element::Edges;
use super::hessian::Hessian;
use super::kernel;
use super::layout::Triangle;
use super::rest::{Corners, Rest, RestCorner};

/// Corners that are summed by one task.
const CHUNK: usize = 2048;

pub(super) fn edges(corner: &RestCorner, uv: &[Vec2]) -> Edges {
    let [here, next, previous] = corner.vertices.map(|v| uv[v as usize]);
    let (f1, f0) = (next - here, previous - here);
    [f1.x, f1.y, f0.x, f0.y]
}

/// What an energy is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Terms {
    /// What q counts: the mean over the corners of `log²(θ/φ)`, or of `(θ/φ − 1)²`; that of MIPS − 1 for the conformal family.
    pub angle: f64,
    /// What 1 − q counts: the mean of `½[(r − 1)² + (1/r − 1)²]`, `r = A(T)/A(U)`; that of `(det + 1/det)/2 − 1` for the conformal
    /// family.
    pub area: f64,
    /// What the dial `shape` counts: the mean of the symmetric Dirichlet energy − 1; 0 for the conformal family.
    pub shape: f64,
}

/// What the energy of `uv` is made of, and how many corners are stretched beyond `limit`; none are where there is no limit.
pub(super) fn terms(objective: &Objective, rest: &Rest, uv: &[Vec2], limit: Option<f64>) -> (Terms, usize) {
    match *objective {
        Objective::Direct { angle_term, .. } => {
            let limit = limit.unwrap_or(f64::INFINITY);
            let chunks = rest.par_chunks(CHUNK).map(|corners| kernel::terms(angle_term, limit, corners, uv));
            let chunks: Vec<([f64; 3], usize)> = chunks.collect();
            let [angle, area, shape] =
                chunks.iter().fold([0.0; 3], |sum, (terms, _)| std::array::from_fn(|i| sum[i] + terms[i]));
            (Terms { angle, area, shape }, chunks.iter().map(|(_, beyond)| beyond).sum())
        }
        // Elliptic at any stretch.
        Objective::Conformal { .. } => {
            let alone = |q| value(&Objective::Conformal { q }, rest, uv);
            (Terms { angle: alone(1.0), area: alone(0.0), shape: 0.0 }, 0)
        }
    }
}

/// The energy of `uv`; infinite where a corner is not positive.
pub(super) fn value(objective: &Objective, rest: &Rest, uv: &[Vec2]) -> f64 {
    let sums: Vec<f64> =
        rest.par_chunks(CHUNK).map(|corners| kernel::value(objective, corners, uv)).collect();
    sums.iter().sum()
}

/// Fills `hessian` with the Hessian at `uv`; returns energy and gradient (2 entries a vertex), or the first corner that is not
/// positive.
pub(super) fn derivatives(
    objective: &Objective,
    rest: &Rest,
    hessian: &mut Hessian,
    uv: &[Vec2],
) -> Result<(f64, Vec<f64>), CornerId> {
    let corners = |corners: Corners<'_>, gradients: &mut [Edges], triangles: &mut [Triangle]| {
        kernel::derivatives(objective, corners, uv, gradients, triangles)
    };
    hessian.assemble(rest, corners).map_err(|corner| rest.ids[corner])
}

/// Energy and gradient alone; `hessian` keeps what it has.
pub(super) fn gradient(
    objective: &Objective,
    rest: &Rest,
    hessian: &mut Hessian,
    uv: &[Vec2],
) -> Result<(f64, Vec<f64>), CornerId> {
    let corners =
        |corners: Corners<'_>, gradients: &mut [Edges]| kernel::gradients(objective, corners, uv, gradients);
    hessian.gradient(rest, corners).map_err(|corner| rest.ids[corner])
}
