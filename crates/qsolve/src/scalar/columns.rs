//! Right-hand sides on their way to an answer: iterations, true residuals, and another try where one did not do.

use rayon::prelude::*;

use super::conjugate::{Iterated, conjugate_gradients, in_order, multiply};
use super::elimination::Eliminated;
use super::hierarchy::Cycles;
use super::sparse::times_power_of_two;
use super::{GRAIN, ScalarMultigrid};
use crate::product::{norm, ratio};

/// Iterations go on until the error, in the energy norm and relative to the answer, is this small; the caller's bound only decides
/// what is accepted. A place on the unit square is then exact to about as many digits.
const TARGET: f64 = 1e-12;
/// A true residual above this, relative in the Euclidean norm, or above the caller's bound, is one that rounding has taken away from
/// that of the recursion: the iterations start anew from it.
const ACCURATE: f64 = 100.0 * TARGET;
/// Iterations start at most so often.
const ROUNDS: usize = 8;

/// Where `K` columns stand.
struct Columns<const K: usize> {
    x: Vec<[f64; K]>,
    /// Relative residuals.
    reached: [f64; K],
    /// Iterations.
    taken: [usize; K],
    is_open: [bool; K],
    /// Whether the hierarchy was too slow for a column.
    is_eliminated: [bool; K],
}

/// Writes the answers of `K` right-hand sides, one after the other in `given`, to `out`; gives their relative residuals and
/// iterations. Every round is for the columns that need it, so no column depends on another.
pub(super) fn solve_columns<const K: usize>(
    system: &ScalarMultigrid,
    given: &[f64],
    bound: f64,
    out: &mut [f64],
) -> ([f64; K], [usize; K]) {
    let n = given.len() / K;
    let row_of = |row: usize| system.order.as_ref().map_or(row, |order| order[row] as usize);
    let size: [f64; K] = std::array::from_fn(|k| norm(&given[k * n..(k + 1) * n]));
    let exponent = size.map(exponent_near);
    let scale = exponent.map(|exponent| f64::from(exponent).exp2());
    let b = |row: usize| -> [f64; K] { std::array::from_fn(|k| given[k * n + row_of(row)] / scale[k]) };
    let is_open = size.map(|size| size > 0.0);
    let reached = is_open.map(|is_open| if is_open { 1.0 } else { 0.0 });
    let x = vec![[0.0; K]; n];
    let mut columns = Columns { x, reached, taken: [0; K], is_open, is_eliminated: [false; K] };
    let mut r = vec![[0.0; K]; n];
    for _ in 0..ROUNDS {
        if !columns.is_open.contains(&true) {
            break;
        }
        let (active, iterated) = columns.iterate(system, &b, &mut r);
        let Iterated { x: mut next, taken, stalled } = iterated;
        add(&mut next, &columns.x);
        multiply(&system.hierarchy.finest.matrix, &next, &mut r);
        let squares = subtract_from(&b, &mut r);
        let now: [f64; K] = std::array::from_fn(|k| ratio(squares[k].sqrt(), size[k] / scale[k]));
        let is_better: [bool; K] = std::array::from_fn(|k| active[k] && now[k] < columns.reached[k]);
        choose(&mut columns.x, &next, &is_better);
        for k in (0..K).filter(|&k| active[k]) {
            columns.taken[k] += taken[k];
            let is_worth_it =
                stalled[k] || (now[k] < 0.5 * columns.reached[k] && now[k] > bound.min(ACCURATE));
            columns.is_open[k] = is_worth_it && columns.taken[k] < system.max_iterations;
            columns.is_eliminated[k] |= stalled[k];
            columns.reached[k] = if is_better[k] { now[k] } else { columns.reached[k] };
        }
    }
    for (k, out) in out.chunks_mut(n).enumerate() {
        columns.x.iter().enumerate().for_each(|(row, x)| {
            out[row_of(row)] = times_power_of_two(x[k], exponent[k] - system.exponent);
        });
    }
    (columns.reached, columns.taken)
}

impl<const K: usize> Columns<K> {
    /// One round: of the open columns those that the hierarchy is too slow for, or else the others. `r` is overwritten.
    fn iterate(
        &self,
        system: &ScalarMultigrid,
        b: &(impl Fn(usize) -> [f64; K] + Sync),
        r: &mut [[f64; K]],
    ) -> ([bool; K], Iterated<K>) {
        let matrix = &system.hierarchy.finest.matrix;
        let eliminates = (0..K).any(|k| self.is_open[k] && self.is_eliminated[k]);
        let active = std::array::from_fn(|k| self.is_open[k] && self.is_eliminated[k] == eliminates);
        multiply(matrix, &self.x, r);
        subtract_from(b, r);
        r.par_iter_mut().with_min_len(GRAIN).for_each(|r| {
            *r = std::array::from_fn(|k| if active[k] { r[k] } else { 0.0 });
        });
        // In the norm that the residual is known in; it is near enough to the other.
        let target = self.reached.map(|reached| (TARGET / reached).min(0.1));
        let taken = (0..K).filter(|&k| active[k]).map(|k| self.taken[k]).max().unwrap_or(0);
        let budget = system.max_iterations.saturating_sub(taken);
        let iterated = if eliminates {
            let mut factors = Eliminated::new(system.elimination());
            conjugate_gradients(matrix, &mut factors, r, target, budget, true)
        } else {
            conjugate_gradients(matrix, &mut Cycles::new(&system.hierarchy), r, target, budget, false)
        };
        (active, iterated)
    }
}

/// The power of two by which a right-hand side of this norm is divided: exactly, and so that squares are in range.
fn exponent_near(size: f64) -> i32 {
    if size > 0.0 && size.is_finite() { size.log2().round().clamp(-1000.0, 1000.0) as i32 } else { 0 }
}

/// `x += y`.
fn add<const K: usize>(x: &mut [[f64; K]], y: &[[f64; K]]) {
    x.par_iter_mut().with_min_len(GRAIN).zip(y).for_each(|(x, y)| (0..K).for_each(|k| x[k] += y[k]));
}

/// Writes the `chosen` columns of `y` into `x`.
fn choose<const K: usize>(x: &mut [[f64; K]], y: &[[f64; K]], chosen: &[bool; K]) {
    x.par_iter_mut().with_min_len(GRAIN).zip(y).for_each(|(x, y)| {
        (0..K).filter(|&k| chosen[k]).for_each(|k| x[k] = y[k]);
    });
}

/// `r = b − r`; gives the sum of squares of each column.
fn subtract_from<const K: usize>(b: &(impl Fn(usize) -> [f64; K] + Sync), r: &mut [[f64; K]]) -> [f64; K] {
    let chunks = r.par_chunks_mut(GRAIN).enumerate();
    let sums: Vec<[f64; K]> = chunks
        .map(|(chunk, r)| {
            let mut sum = [0.0; K];
            for (row, r) in (chunk * GRAIN..).zip(r) {
                let b = b(row);
                *r = std::array::from_fn(|k| b[k] - r[k]);
                (0..K).for_each(|k| sum[k] += r[k] * r[k]);
            }
            sum
        })
        .collect();
    in_order(&sums)
}
