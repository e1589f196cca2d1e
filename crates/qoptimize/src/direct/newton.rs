//! Downhill without ever flipping a corner.

use std::ops::ControlFlow;

use crate::qmesh::{CornerId, Observer, QuadMesh, Vec2, VertexData};
use crate::qsolve::SolveError;

use super::Objective;
use super::energy;
use super::hessian::Hessian;
use super::rest::Rest;
use super::step::first_collapse;
use crate::convexity::Exempt;

/// A step goes at most this fraction of the way to the first collapse of a corner.
const COLLAPSE_FRACTION: f64 = 0.9;
/// Sufficient decrease [Armijo 1966].
const ARMIJO: f64 = 1e-4;
/// How much shorter each trial is than the last.
const SHRINK: f64 = 0.5;
/// A shorter step than this fraction of the first trial is no step.
const SHORTEST: f64 = 1e-9;
/// Energies are means of squares: below this there is nothing left that `f64` could tell from zero.
const ENERGY_FLOOR: f64 = 1e-14;

/// When the descent ends. All tolerances are relative and means, so a model in metres or inches, coarse or fine, ends alike.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DescentOptions {
    /// Steps at most. Default 200.
    pub max_steps: usize,
    /// Stop when half the Newton decrement, the decrease that the quadratic model promises, is below this fraction of the
    /// energy. Default `1e-6`.
    pub relative_decrease: f64,
}

impl Default for DescentOptions {
    fn default() -> Self {
        Self { max_steps: 200, relative_decrease: 1e-6 }
    }
}

/// Why the descent ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Stop {
    /// The promised decrease is below the tolerance.
    Converged,
    /// `max_steps` were made.
    MaxSteps,
    /// No step along the direction lowered the energy any more.
    Stalled,
    /// The observer asked to stop; the map at hand is valid.
    Cancelled,
}

/// How the descent went.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Descent {
    /// Steps made.
    pub steps: usize,
    /// The energy before the first step.
    pub energy_before: f64,
    /// The energy at the end.
    pub energy: f64,
    /// Why it ended.
    pub stop: Stop,
}

/// Why there is no descent.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DescentError {
    /// The start is not valid.
    #[error("corner {0} of the start is flipped or has no area")]
    InvalidStart(CornerId),
    /// A Newton system could not be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// Minimises `objective` from `uv`, a map whose corners (but for exempt ones) are all positive; in place, at true scale.
///
/// # Errors
/// [`DescentError`] when a corner of the start is not positive, or a linear system cannot be solved.
pub fn minimize(
    mesh: &QuadMesh,
    uv: &mut VertexData<Vec2>,
    exempt: &Exempt,
    objective: &Objective,
    options: &DescentOptions,
    observer: &dyn Observer,
) -> Result<Descent, DescentError> {
    let rest = Rest::new(mesh, exempt);
    let objective = objective.clamped();
    for point in uv.iter_mut() {
        *point /= rest.unit;
    }
    let result = Hessian::new(&rest)
        .map_err(DescentError::from)
        .and_then(|mut hessian| descend(&rest, &mut hessian, uv, &objective, options, observer));
    for point in uv.iter_mut() {
        *point *= rest.unit;
    }
    result
}

pub(super) fn descend(
    rest: &Rest,
    hessian: &mut Hessian,
    uv: &mut [Vec2],
    objective: &Objective,
    options: &DescentOptions,
    observer: &dyn Observer,
) -> Result<Descent, DescentError> {
    let mut descent =
        Descent { steps: 0, energy_before: f64::INFINITY, energy: f64::INFINITY, stop: Stop::MaxSteps };
    loop {
        let (energy, gradient) =
            energy::derivatives(objective, rest, hessian, uv).map_err(DescentError::InvalidStart)?;
        descent.energy = energy;
        if descent.steps == 0 {
            descent.energy_before = energy;
        }
        if descent.steps == options.max_steps {
            return Ok(descent);
        }
        let fraction = descent.steps as f64 / options.max_steps as f64;
        if let ControlFlow::Break(()) = observer.progress("minimise", fraction) {
            return Ok(Descent { stop: Stop::Cancelled, ..descent });
        }
        let gradient = rest.constraint.restrict(hessian, gradient);
        let (mut direction, decrement) = hessian.newton_direction(&gradient)?;
        let decrement = rest.constraint.project(&mut direction, &gradient, decrement);
        if 0.5 * decrement <= options.relative_decrease * energy + ENERGY_FLOOR {
            return Ok(Descent { stop: Stop::Converged, ..descent });
        }
        if !line_search(rest, uv, objective, &direction, energy, decrement) {
            return Ok(Descent { stop: Stop::Stalled, ..descent });
        }
        descent.steps += 1;
    }
}

/// Moves along `direction` as far as the energy falls enough; whether it moved.
fn line_search(
    rest: &Rest,
    uv: &mut [Vec2],
    objective: &Objective,
    direction: &[Vec2],
    energy_here: f64,
    decrement: f64,
) -> bool {
    let longest = (COLLAPSE_FRACTION * first_collapse(rest, uv, direction)).min(1.0);
    let mut step = longest;
    let mut trial = uv.to_vec();
    while step >= SHORTEST * longest && step > 0.0 {
        for ((to, from), along) in trial.iter_mut().zip(uv.iter()).zip(direction) {
            *to = from + along * step;
        }
        let energy_there = energy::value(objective, rest, &trial);
        // Both may be infinite at the start: then the comparison is false, as it should be.
        if energy_there <= energy_here - ARMIJO * step * decrement {
            uv.copy_from_slice(&trial);
            return true;
        }
        step *= SHRINK;
    }
    false
}
