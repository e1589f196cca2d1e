//! Downhill without ever flipping a corner.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::qmesh::{CornerId, Observer, QuadMesh, Vec2, VertexData};
use crate::qsolve::SolveError;

use super::Objective;
use super::conjugate::Memory;
use super::energy;
use super::hessian::{Accuracy, Hessian, Solved};
use super::rest::Rest;
use super::scale::to_best_scale;
use super::slow;
use super::step::first_collapse;
use crate::convexity::Exempt;

/// A step goes at most this fraction of the way to the first collapse of a corner.
pub(super) const COLLAPSE_FRACTION: f64 = 0.9;
/// Sufficient decrease [Armijo 1966].
pub(super) const ARMIJO: f64 = 1e-4;
/// How much shorter each trial is than the last.
pub(super) const SHRINK: f64 = 0.5;
/// A whole step that lowers the energy by more than this, over its length and the decrement, is tried at twice the length. A
/// quadratic function gives 1/2, `1/s²` gives 0.66.
const MORE_THAN_PROMISED: f64 = 0.55;
/// A shorter step than this fraction of the first trial is no step.
const SHORTEST: f64 = 1e-9;
/// The residual, relative, to which Newton systems are solved: less exact solutions cost steps, more exact ones bring nothing.
const ENOUGH_RESIDUAL: f64 = 0.1;
/// A decrement that is this many times what would end the descent, or less, is determined to a tenth.
const DECISIVE: f64 = 4.0;
/// After a step that was almost whole, and lowered the energy by no more than this, the preconditioner may stay.
const LAG_STEP: f64 = 0.9;
const LAG_DECREASE: f64 = 0.01;
/// What a step tells about the next holds when the energy fell by no more than this fraction, and corners about to collapse did
/// not cut it shorter than that.
const CALM: f64 = 0.1;
const LEAST_CALM_STEP: f64 = 0.5;
/// After a step this short, cut off by corners about to collapse, an exact direction pays: it bends round more of them.
const SHORT: f64 = 0.3;
/// A system that takes so many iterations, for a step that lowers the energy by no more than this fraction, is ill-conditioned:
/// the rest of the way goes by [steps without systems](super::slow).
const MANY_ITERATIONS: usize = 8;
const SLOW_DECREASE: f64 = 4e-4;
/// Energies are means of squares: below this there is nothing left that `f64` could tell from zero.
pub(super) const ENERGY_FLOOR: f64 = 1e-14;

/// When the descent ends. All tolerances are relative and means, so a model in metres or inches, coarse or fine, ends alike.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DescentOptions {
    /// Steps at most. Default 200. Where ill-conditioned systems make way for quasi-Newton steps, four of those count as one.
    pub max_steps: usize,
    /// Stop when half the Newton decrement, the decrease that the quadratic model promises, is below this fraction of the
    /// energy. Default `1e-5`.
    pub relative_decrease: f64,
}

impl Default for DescentOptions {
    fn default() -> Self {
        Self { max_steps: 200, relative_decrease: 1e-5 }
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
    /// Steps made; four quasi-Newton steps count as one.
    pub steps: usize,
    /// Iterations of conjugate gradients, over all steps; 0 where the Newton systems were factorized.
    pub iterations: usize,
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

/// Minimises `objective` from `uv`, a map whose corners (but for exempt ones) are all positive; in place, at true scale. The
/// scale of the start plays no part: the best one is found first.
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
    // From inside the pool, where short parallel loops do not have to wake it first.
    let result = rayon::scope(|_| {
        to_best_scale(&rest, &objective, uv);
        let mut hessian = Hessian::new(&rest)?;
        descend(&rest, &mut hessian, uv, &objective, options, observer)
    });
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
    let descent = Descent {
        steps: 0,
        iterations: 0,
        energy_before: f64::INFINITY,
        energy: f64::INFINITY,
        stop: Stop::MaxSteps,
    };
    let way = Way {
        rest,
        hessian,
        objective,
        options,
        observer,
        descent,
        memory: Memory::default(),
        lagged: false,
        may_be_slow: rest.constraint.is_open(),
    };
    way.down(uv)
}

/// The way down, as far as it was gone.
struct Way<'a> {
    rest: &'a Rest,
    hessian: &'a mut Hessian,
    objective: &'a Objective,
    options: &'a DescentOptions,
    observer: &'a dyn Observer,
    descent: Descent,
    memory: Memory,
    /// Whether the preconditioner may stay.
    lagged: bool,
    may_be_slow: bool,
}

impl Way<'_> {
    fn down(mut self, uv: &mut [Vec2]) -> Result<Descent, DescentError> {
        loop {
            if let Some(stop) = self.step(uv)? {
                return Ok(Descent { stop, ..self.descent });
            }
        }
    }

    /// One step, or what leads to a better one; why there is none, where there is none.
    fn step(&mut self, uv: &mut [Vec2]) -> Result<Option<Stop>, DescentError> {
        self.hessian.reconsider()?;
        let (energy, gradient) = energy::derivatives(self.objective, self.rest, self.hessian, uv)
            .map_err(DescentError::InvalidStart)?;
        self.descent.energy = energy;
        if self.descent.steps == 0 {
            self.descent.energy_before = energy;
        }
        if self.descent.steps == self.options.max_steps {
            return Ok(Some(Stop::MaxSteps));
        }
        let fraction = self.descent.steps as f64 / self.options.max_steps as f64;
        if let ControlFlow::Break(()) = self.observer.progress("minimise", fraction) {
            return Ok(Some(Stop::Cancelled));
        }
        let gradient = self.rest.constraint.restrict(self.hessian, gradient);
        let least = self.options.relative_decrease * energy + ENERGY_FLOOR;
        let Some(solved) = self.solve(uv, &gradient, least)? else { return Ok(None) };
        let Solved { mut direction, decrement, missing, iterations } = solved;
        self.descent.iterations += iterations;
        let decrement = self.rest.constraint.project(&mut direction, &gradient, decrement);
        if 0.5 * (decrement + missing) <= least {
            return Ok(Some(Stop::Converged));
        }
        let joint = self.memory.conjugate(&mut direction, &gradient, decrement);
        let Some(moved) = line_search(self.rest, uv, self.objective, &direction, energy, joint) else {
            return Ok(self.after_no_step());
        };
        self.descent.steps += 1;
        let fell = (energy - moved.energy) / energy;
        self.lagged = moved.step >= LAG_STEP && fell <= LAG_DECREASE;
        if fell <= CALM && moved.step >= LEAST_CALM_STEP {
            self.memory.remember(gradient, direction, decrement);
        } else {
            self.memory.forget();
        }
        if moved.step < SHORT && iterations > 0 {
            self.hessian.factorize_unless_huge()?;
        }
        let is_slow = self.may_be_slow && fell <= SLOW_DECREASE && iterations >= MANY_ITERATIONS;
        if is_slow && !self.hessian.is_factored() { self.slowly(uv) } else { Ok(None) }
    }

    /// The Newton system at `uv`; `None` when iterations fail, which are given up then.
    fn solve(&mut self, uv: &[Vec2], gradient: &[f64], least: f64) -> Result<Option<Solved>, DescentError> {
        let accuracy = Accuracy { residual: ENOUGH_RESIDUAL, decisive: DECISIVE * 2.0 * least };
        match self.hessian.newton_direction(uv, gradient, accuracy, self.lagged) {
            Ok(solved) => Ok(Some(solved)),
            Err(error) if self.hessian.is_factored() => Err(error),
            Err(_) => {
                self.hessian.give_up_iterations()?;
                Ok(None)
            }
        }
    }

    /// A direction from an old preconditioner or an old direction may be a poor one: only without them this is the end.
    fn after_no_step(&mut self) -> Option<Stop> {
        let may_be_poor = self.lagged || !self.memory.is_empty();
        self.lagged = false;
        self.memory.forget();
        (!may_be_poor).then_some(Stop::Stalled)
    }

    /// The rest of the way without systems, as far as that leads.
    fn slowly(&mut self, uv: &mut [Vec2]) -> Result<Option<Stop>, DescentError> {
        let most = self.options.max_steps - self.descent.steps;
        let walked =
            slow::walk(self.rest, self.hessian, uv, self.objective, self.options, most, self.observer)?;
        self.descent.steps += walked.steps;
        self.descent.energy = walked.energy;
        if walked.stop != Stop::Stalled {
            return Ok(Some(walked.stop));
        }
        (self.may_be_slow, self.lagged) = (false, false);
        self.memory.forget();
        Ok(None)
    }
}

/// A step that was made.
struct Moved {
    /// 1: the whole direction.
    step: f64,
    energy: f64,
}

/// Moves along `direction` as far as the energy falls enough, if it does.
///
/// Where squeezed corners make up the energy, it falls by more than the quadratic model promises, and several steps in the same
/// direction would follow: so a whole step is doubled while that pays.
fn line_search(
    rest: &Rest,
    uv: &mut [Vec2],
    objective: &Objective,
    direction: &[Vec2],
    energy_here: f64,
    decrement: f64,
) -> Option<Moved> {
    let limit = COLLAPSE_FRACTION * first_collapse(rest, uv, direction);
    let longest = limit.min(1.0);
    let mut trial = vec![Vec2::zeros(); uv.len()];
    let mut energy_at = |step: f64| {
        let moves = trial.par_iter_mut().with_min_len(8192).zip(&*uv).zip(direction);
        moves.for_each(|((to, from), along)| *to = from + along * step);
        energy::value(objective, rest, &trial)
    };
    // Both energies may be infinite at the start: then the comparison is false, as it should be.
    let falls_enough = |step: f64, energy: f64| energy <= energy_here - ARMIJO * step * decrement;
    let mut step = longest;
    let mut energy = energy_at(step);
    if falls_enough(step, energy) {
        while energy_here - energy > MORE_THAN_PROMISED * step * decrement && 2.0 * step <= limit {
            let further = energy_at(2.0 * step);
            if !falls_enough(2.0 * step, further) || further >= energy {
                break;
            }
            (step, energy) = (2.0 * step, further);
        }
    } else {
        while !falls_enough(step, energy) {
            step *= SHRINK;
            if step < SHORTEST * longest || step <= 0.0 {
                return None;
            }
            energy = energy_at(step);
        }
    }
    uv.par_iter_mut().with_min_len(8192).zip(direction).for_each(|(p, along)| *p += along * step);
    Some(Moved { step, energy })
}
