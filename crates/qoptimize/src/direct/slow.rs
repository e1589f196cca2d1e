//! The last of the way down where Newton systems are ill-conditioned.
//!
//! Squeezed limbs make systems that take tens of iterations, for a step that hardly lowers the energy: the quadratic model is soon
//! wrong. Quasi-Newton steps spend one cycle of the hierarchy on each new gradient instead. The hierarchy is renewed now and then.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::qmesh::{Observer, Vec2};

use super::conjugate::dot;
use super::energy;
use super::hessian::Hessian;
use super::learnt::Learnt;
use super::newton::{ARMIJO, COLLAPSE_FRACTION, ENERGY_FLOOR, SHRINK};
use super::rest::Rest;
use super::step::first_collapse;
use super::{DescentError, DescentOptions, Objective, Stop};

/// Steps for which a hierarchy serves. On `armadillo_200k` 12 and 40 take a tenth longer than 25.
const RENEWED_AFTER: usize = 25;
/// So many steps take about the work of a Newton step, and count as one.
const STEPS_OF_ONE: usize = 4;
/// Halvings of a step before it is given up.
const MOST_HALVINGS: usize = 12;
/// The descent ends when so many steps together have lowered the energy by less than [`ENOUGH`] times the promised decrease: at
/// the pace of these descents about as much is left as when a Newton step promises no more than that.
const PACE: usize = 8;
const ENOUGH: f64 = 5.0;
/// They may know the decrement badly: it ends them when it is this much smaller than what ends Newton steps.
const MARGIN: f64 = 0.1;
/// Vertices that one task takes.
const CHUNK: usize = 8192;

/// What came of the steps.
pub(super) struct Walked {
    /// In terms of Newton steps.
    pub(super) steps: usize,
    pub(super) energy: f64,
    pub(super) stop: Stop,
}

/// Walks down from `uv`, in place; [`Stop::Stalled`] where no such step lowers the energy any more. At most the work
/// of `most` Newton steps.
pub(super) fn walk(
    rest: &Rest,
    hessian: &mut Hessian,
    uv: &mut [Vec2],
    objective: &Objective,
    options: &DescentOptions,
    most: usize,
    observer: &dyn Observer,
) -> Result<Walked, DescentError> {
    let renew = |hessian: &mut Hessian, uv: &[Vec2]| -> Result<(f64, Vec<f64>), DescentError> {
        let found = energy::derivatives(objective, rest, hessian, uv).map_err(DescentError::InvalidStart)?;
        hessian.renew(uv)?;
        Ok(found)
    };
    let (mut energy, mut gradient) = renew(hessian, uv)?;
    let (mut learnt, mut age, mut steps) = (Learnt::default(), 0, 0);
    let mut energies = vec![energy];
    let walked =
        |steps: usize, energy: f64, stop: Stop| Walked { steps: steps.div_ceil(STEPS_OF_ONE), energy, stop };
    let budget = STEPS_OF_ONE * most;
    while steps < budget {
        let left = (budget - steps) as f64 / (STEPS_OF_ONE * options.max_steps) as f64;
        let before = (1.0 - left).clamp(0.0, 1.0);
        if let ControlFlow::Break(()) = observer.progress("minimise", before) {
            return Ok(walked(steps, energy, Stop::Cancelled));
        }
        if age == RENEWED_AFTER {
            (energy, gradient) = renew(hessian, uv)?;
            age = 0;
        }
        let Some(direction) = learnt.direction(hessian, &gradient) else {
            return Ok(walked(steps, energy, Stop::Stalled));
        };
        let decrement = -dot(&gradient, &direction);
        if (0.0..=2.0 * MARGIN * (options.relative_decrease * energy + ENERGY_FLOOR)).contains(&decrement) {
            return Ok(walked(steps, energy, Stop::Converged));
        }
        let Some(made) = step(rest, hessian, uv, objective, (energy, decrement), direction) else {
            if age == 0 && learnt.is_empty() {
                return Ok(walked(steps, energy, Stop::Stalled));
            }
            // What was learnt, or the hierarchy, is of another place.
            (learnt, age) = (Learnt::default(), RENEWED_AFTER);
            continue;
        };
        let changes = made.gradient.par_iter().with_min_len(CHUNK).zip(&gradient).map(|(b, a)| b - a);
        learnt.learn(made.step, changes.collect());
        uv.copy_from_slice(&made.uv);
        (energy, gradient) = (made.energy, made.gradient);
        (age, steps) = (age + 1, steps + 1);
        energies.push(energy);
        let earlier = energies.len().checked_sub(PACE + 1).map(|at| energies[at]);
        let enough = ENOUGH * options.relative_decrease * energy + ENERGY_FLOOR;
        if earlier.is_some_and(|earlier| earlier - energy <= enough) {
            return Ok(walked(steps, energy, Stop::Converged));
        }
    }
    Ok(walked(steps, energy, Stop::MaxSteps))
}

/// A step that was made.
struct Made {
    uv: Vec<Vec2>,
    step: Vec<Vec2>,
    energy: f64,
    gradient: Vec<f64>,
}

/// Along `direction`, if that goes down, as far as no corner collapses and the energy falls enough; `None` where it does not.
fn step(
    rest: &Rest,
    hessian: &mut Hessian,
    uv: &[Vec2],
    objective: &Objective,
    (energy_here, decrement): (f64, f64),
    mut direction: Vec<Vec2>,
) -> Option<Made> {
    let goes_down = decrement > 0.0;
    let mut length = (COLLAPSE_FRACTION * first_collapse(rest, uv, &direction)).min(1.0);
    for _ in 0..if goes_down { MOST_HALVINGS } else { 0 } {
        let moved = uv.par_iter().with_min_len(CHUNK).zip(&direction).map(|(p, d)| p + d * length);
        let moved: Vec<Vec2> = moved.collect();
        // What rounding lets collapse is too far as well.
        if let Ok((energy, gradient)) = energy::gradient(objective, rest, hessian, &moved)
            && energy <= energy_here - ARMIJO * length * decrement
        {
            direction.par_iter_mut().with_min_len(CHUNK).for_each(|d| *d *= length);
            return Some(Made { uv: moved, step: direction, energy, gradient });
        }
        length *= SHRINK;
    }
    None
}
