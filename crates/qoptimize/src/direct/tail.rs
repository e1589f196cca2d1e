//! The last of the way down, on what the last Newton system left.
//!
//! A map that is predicted from its neighbours has hardly any way to go. Quasi-Newton steps [Nocedal 1980, L-BFGS] that begin
//! with the last system that was solved take a gradient and one cycle of its hierarchy, or one solution with its factors: a fifth
//! of a Newton step. What they learn of the second derivatives holds for the next map too.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::qmesh::{Observer, Vec2};

use super::conjugate::dot;
use super::energy;
use super::hessian::Hessian;
use super::learnt::Learnt;
use super::newton::{ARMIJO, COLLAPSE_FRACTION, ENERGY_FLOOR};
use super::rest::Rest;
use super::step::first_collapse;
use super::{Descent, DescentError, DescentOptions, Objective, Stop};

/// The decrement is known less well than after a Newton step: it has to be this much smaller than what ends a descent.
const MARGIN: f64 = 0.5;
/// A decrement of more than this fraction of the energy is for Newton steps.
const FAR: f64 = 0.02;
/// With one that falls by less than this from one step to the next, the system is too old, or too far from the second derivatives.
const LEAST_PROGRESS: f64 = 0.7;
const MOST_STEPS: usize = 20;
/// Trials of a step, each this much shorter than the one before.
const TRIALS: usize = 4;
const SHRINK: f64 = 0.25;
/// Vertices that one task takes.
const CHUNK: usize = 8192;

/// A trial of a step that was good.
struct Further {
    uv: Vec<Vec2>,
    energy: f64,
    gradient: Vec<f64>,
    /// 1: the whole direction.
    step: f64,
}

/// The problem, and what is kept of the last ones.
pub(super) struct Tail<'a> {
    pub(super) rest: &'a Rest,
    pub(super) hessian: &'a mut Hessian,
    pub(super) learnt: &'a mut Learnt,
    pub(super) objective: &'a Objective,
}

impl Tail<'_> {
    /// Walks down from near the minimum. Stops with [`Stop::MaxSteps`] when the rest of the way, or all of it, is for Newton steps.
    pub(super) fn walk(
        &mut self,
        uv: &mut Vec<Vec2>,
        options: &DescentOptions,
        observer: &dyn Observer,
    ) -> Result<Descent, DescentError> {
        let (mut energy, mut gradient) = self.gradient(uv)?;
        let mut descent =
            Descent { steps: 0, iterations: 0, energy_before: energy, energy, stop: Stop::MaxSteps };
        let (mut is_fresh, mut is_worn) = (false, false);
        let mut last = f64::INFINITY;
        while descent.steps < options.max_steps.min(MOST_STEPS) {
            if let ControlFlow::Break(()) = observer.progress("minimise", 0.0) {
                return Ok(Descent { stop: Stop::Cancelled, ..descent });
            }
            let Some(direction) = self.learnt.direction(self.hessian, &gradient) else { break };
            let decrement = -dot(&gradient, &direction);
            let least = options.relative_decrease * energy + ENERGY_FLOOR;
            if decrement >= 0.0 && 0.5 * decrement <= MARGIN * least {
                if let Some((there, energy)) = self.last_step(uv, &direction, energy, decrement) {
                    (*uv, descent.energy, descent.steps) = (there, energy, descent.steps + 1);
                }
                return Ok(Descent { stop: Stop::Converged, ..descent });
            }
            let is_near = decrement > 0.0 && 0.5 * decrement <= FAR * energy;
            is_worn |= decrement > LEAST_PROGRESS * last;
            if !is_near || (is_worn && (is_fresh || !self.renew(uv))) {
                break;
            }
            if is_worn {
                (is_fresh, is_worn, last) = (true, false, f64::INFINITY);
                continue;
            }
            last = decrement;
            let Some(further) = self.further(uv, &direction, energy, decrement) else {
                is_worn = true;
                continue;
            };
            let made = direction.into_par_iter().with_min_len(CHUNK).map(|d| d * further.step).collect();
            let pairs = further.gradient.par_iter().with_min_len(CHUNK).zip(&gradient);
            self.learnt.learn(made, pairs.map(|(there, here)| there - here).collect());
            (*uv, energy, gradient) = (further.uv, further.energy, further.gradient);
            (descent.energy, descent.steps) = (energy, descent.steps + 1);
        }
        Ok(descent)
    }

    fn gradient(&mut self, uv: &[Vec2]) -> Result<(f64, Vec<f64>), DescentError> {
        energy::gradient(self.objective, self.rest, self.hessian, uv).map_err(DescentError::InvalidStart)
    }

    /// Assembles and prepares the system at `uv`, and forgets what was learnt; whether that succeeded.
    fn renew(&mut self, uv: &[Vec2]) -> bool {
        *self.learnt = Learnt::default();
        energy::derivatives(self.objective, self.rest, self.hessian, uv).is_ok()
            && self.hessian.renew(uv).is_ok()
    }

    /// Where the whole of a last, short step leads, if it leads down.
    fn last_step(
        &self,
        uv: &[Vec2],
        direction: &[Vec2],
        energy: f64,
        decrement: f64,
    ) -> Option<(Vec<Vec2>, f64)> {
        let step = self.longest(uv, direction);
        let there = moved(uv, direction, step);
        let energy_there = energy::value(self.objective, self.rest, &there);
        (energy_there <= energy - ARMIJO * step * decrement).then_some((there, energy_there))
    }

    /// As far along `direction` as the energy falls enough, of a few trials.
    fn further(
        &mut self,
        uv: &[Vec2],
        direction: &[Vec2],
        energy_here: f64,
        decrement: f64,
    ) -> Option<Further> {
        let mut step = self.longest(uv, direction);
        for _ in 0..TRIALS {
            let there = moved(uv, direction, step);
            // What rounding lets collapse is too far as well.
            if let Ok((energy, gradient)) = self.gradient(&there)
                && energy <= energy_here - ARMIJO * step * decrement
            {
                return Some(Further { uv: there, energy, gradient, step });
            }
            step *= SHRINK;
        }
        None
    }

    /// How much of `direction` may be gone.
    fn longest(&self, uv: &[Vec2], direction: &[Vec2]) -> f64 {
        (COLLAPSE_FRACTION * first_collapse(self.rest, uv, direction)).min(1.0)
    }
}

fn moved(uv: &[Vec2], direction: &[Vec2], step: f64) -> Vec<Vec2> {
    uv.par_iter().with_min_len(CHUNK).zip(direction).map(|(p, d)| p + d * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convexity::Exempt;
    use crate::qmesh::shapes;

    /// Far from the origin a vertex that goes nine tenths of the way to its neighbour is rounded to the very place: that is too far, and a
    /// shorter trial is good.
    #[test]
    fn a_trial_that_rounding_collapses_is_shortened() {
        // Coordinates are multiples of a half there.
        const FAR: f64 = 2_251_799_813_685_248.0;
        let mesh = shapes::grid(4, 4);
        let rest = Rest::new(&mesh, &Exempt::find(&mesh));
        let mut hessian = Hessian::new(&rest).unwrap();
        let at = |v| mesh.position(v).xy();
        let uv: Vec<Vec2> = mesh.vertices().map(|v| at(v).add_scalar(FAR)).collect();
        let towards = |v| if at(v) == Vec2::new(1.0, 1.0) { Vec2::new(-1.0, 0.0) } else { Vec2::zeros() };
        let direction: Vec<Vec2> = mesh.vertices().map(towards).collect();
        let objective = Objective::default();
        let mut learnt = Learnt::default();
        let mut tail =
            Tail { rest: &rest, hessian: &mut hessian, learnt: &mut learnt, objective: &objective };
        let longest = tail.longest(&uv, &direction);
        assert!(tail.gradient(&moved(&uv, &direction, longest)).is_err(), "{longest} is no step too far");
        let further = tail.further(&uv, &direction, f64::INFINITY, 1.0).expect("a shorter step");
        assert_eq!(further.step, SHRINK * longest);
    }
}
