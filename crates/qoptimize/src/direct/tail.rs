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
const MARGIN: f64 = 0.25;
/// A decrement of more than this fraction of the energy is for Newton steps.
const FAR: f64 = 0.02;
/// With one that falls by less than this from one step to the next, the system is too old, or too far from the second derivatives.
const LEAST_PROGRESS: f64 = 0.5;
const MOST_STEPS: usize = 15;
/// Vertices that one task takes.
const CHUNK: usize = 8192;

/// Walks down from near the minimum. Stops with [`Stop::MaxSteps`] when the rest of the way, or all of it, is for Newton steps.
pub(super) fn walk(
    rest: &Rest,
    hessian: &mut Hessian,
    learnt: &mut Learnt,
    uv: &mut Vec<Vec2>,
    objective: &Objective,
    options: &DescentOptions,
    observer: &dyn Observer,
) -> Result<Descent, DescentError> {
    let gradient_at = |hessian: &mut Hessian, uv: &[Vec2]| {
        energy::gradient(objective, rest, hessian, uv).map_err(DescentError::InvalidStart)
    };
    let (mut energy, mut gradient) = gradient_at(hessian, uv)?;
    let mut descent =
        Descent { steps: 0, iterations: 0, energy_before: energy, energy, stop: Stop::MaxSteps };
    let (mut is_fresh, mut is_worn) = (false, false);
    let mut last = f64::INFINITY;
    while descent.steps < options.max_steps.min(MOST_STEPS) {
        if let ControlFlow::Break(()) = observer.progress("minimise", 0.0) {
            return Ok(Descent { stop: Stop::Cancelled, ..descent });
        }
        let Some(direction) = learnt.direction(hessian, &gradient) else { break };
        let decrement = -dot(&gradient, &direction);
        let least = options.relative_decrease * energy + ENERGY_FLOOR;
        let is_there = 0.5 * decrement <= MARGIN * least;
        if !is_there && 0.5 * decrement > FAR * energy {
            break;
        }
        if !is_there && (decrement > LEAST_PROGRESS * last || is_worn) {
            if is_fresh {
                break;
            }
            energy::derivatives(objective, rest, hessian, uv).map_err(DescentError::InvalidStart)?;
            hessian.renew(uv)?;
            (is_fresh, is_worn, last) = (true, false, f64::INFINITY);
            continue;
        }
        last = decrement;
        let step = (COLLAPSE_FRACTION * first_collapse(rest, uv, &direction)).min(1.0);
        let next: Vec<Vec2> =
            uv.par_iter().with_min_len(CHUNK).zip(&direction).map(|(p, d)| p + d * step).collect();
        let falls_enough = |there: f64| there <= energy - ARMIJO * step * decrement;
        if is_there {
            let there = energy::value(objective, rest, &next);
            if falls_enough(there) {
                *uv = next;
                descent.energy = there;
                descent.steps += 1;
            }
            return Ok(Descent { stop: Stop::Converged, ..descent });
        }
        let (energy_there, gradient_there) = gradient_at(hessian, &next)?;
        if !falls_enough(energy_there) {
            is_worn = true;
            continue;
        }
        let made = direction.into_par_iter().with_min_len(CHUNK).map(|d| d * step).collect();
        let change =
            gradient_there.par_iter().with_min_len(CHUNK).zip(&gradient).map(|(b, a)| b - a).collect();
        learnt.learn(made, change);
        *uv = next;
        (energy, gradient) = (energy_there, gradient_there);
        descent.energy = energy;
        descent.steps += 1;
    }
    Ok(descent)
}
