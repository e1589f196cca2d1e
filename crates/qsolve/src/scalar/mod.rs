//! Multigrid for symmetric positive definite systems of one unknown a row, as meshes give them: a hierarchy in single precision inside
//! conjugate gradients in double precision, two right-hand sides at a time.
//!
//! Smoothed aggregation as in [`multigrid`](crate::multigrid), with the constants as near-kernel; what is different serves size: the matrix is taken
//! over instead of copied, all else is stored in single precision, and products of three matrices are made row by row. A system with five
//! entries a row and two right-hand sides takes about 220 bytes an unknown, matrix and answer included.
//!
//! The hierarchy only preconditions: the accuracy of the answer is that of double precision. The same input gives the same bits for any
//! number of threads.

mod conjugate;
mod hierarchy;
mod level;
mod order;
mod sparse;

#[cfg(test)]
mod tests;

use std::sync::Mutex;

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::check::{check_bound, check_rhs};
use crate::multigrid::BlockMatrix;
use crate::product::{norm, ratio};
use crate::solver::LinearSolver;
use crate::{SolveError, SolveMethod, SolveRecord};
use conjugate::{conjugate_gradients, in_order, multiply};
use hierarchy::{Hierarchy, Work};
use order::{better_order, permuted};
use sparse::Sparse;

/// Iterations go on until the error, in the energy norm and relative to the answer, is this small; the caller's bound only decides
/// what is accepted. A place on the unit square is then exact to about as many digits.
const TARGET: f64 = 1e-12;
/// How often the iterations start anew from the true residual, where rounding has taken that away from the residual of the recursion.
const RESTARTS: usize = 3;
/// A true residual above this, relative in the Euclidean norm, or above the caller's bound, is one that rounding has taken away.
const ACCURATE: f64 = 100.0 * TARGET;
/// Rows that one task takes.
const GRAIN: usize = 4096;

/// A symmetric positive definite system that is ready to be solved for any number of right-hand sides.
///
/// ```
/// use qsolve::{BlockMatrix, DMatrix, LinearSolver, ScalarMultigrid};
///
/// // Springs of stiffness 1 between neighbours in a row, and between the first and the ground.
/// let n = 1000;
/// let neighbors = |row: u32| [row.checked_sub(1), Some(row), Some(row + 1).filter(|&next| next < n)];
/// let columns: Vec<u32> = (0..n).flat_map(neighbors).flatten().collect();
/// let starts = (0..=n).map(|row| (3 * row).saturating_sub(1).min(3 * n - 2)).collect();
/// let mut matrix = BlockMatrix::zeros(starts, columns)?;
/// matrix.fill_rows(|row, columns, values| {
///     for (value, &column) in values.iter_mut().zip(columns) {
///         let own = if row + 1 < n as usize { 2.0 } else { 1.0 };
///         *value = [[if column as usize == row { own } else { -1.0 }]];
///     }
/// });
/// // Pulled at its end by 1, every spring gets longer by 1.
/// let pull = DMatrix::from_fn(n as usize, 1, |row, _| f64::from(u8::from(row + 1 == n as usize)));
/// let (x, record) = ScalarMultigrid::new(matrix, 500)?.solve(&pull, 1e-8)?;
/// assert!((x[(999, 0)] - 1000.0).abs() < 1e-6, "{record:?}");
/// # Ok::<(), qsolve::SolveError>(())
/// ```
#[derive(Debug)]
pub struct ScalarMultigrid {
    hierarchy: Hierarchy,
    /// Which row of the caller's each row is, where they were put in another order.
    order: Option<Vec<u32>>,
    max_iterations: usize,
    spare: Mutex<Vec<Work<1>>>,
}

impl ScalarMultigrid {
    /// The hierarchy of `matrix`; at most `max_iterations` for each right-hand side.
    ///
    /// # Errors
    /// [`SolveError::NonFiniteEntry`]; [`SolveError::NotPositiveDefinite`] where a diagonal entry is not positive, or the coarsest level
    /// is not definite.
    pub fn new(matrix: BlockMatrix<1>, max_iterations: usize) -> Result<Self, SolveError> {
        let BlockMatrix { starts, columns, values } = matrix;
        let mut matrix = Sparse { starts, columns, values: values.into_flattened().into_flattened() };
        matrix.check_finite()?;
        let order = better_order(&matrix);
        if let Some(order) = &order {
            matrix = permuted(&matrix, order);
        }
        let hierarchy = Hierarchy::new(matrix).map_err(|error| in_given_order(error, order.as_deref()))?;
        Ok(Self { hierarchy, order, max_iterations, spare: Mutex::default() })
    }

    /// Rows of each level, the finest first.
    #[must_use]
    pub fn level_rows(&self) -> &[usize] {
        &self.hierarchy.rows
    }

    /// `z ≈ A⁻¹ r` by one V-cycle.
    pub(crate) fn apply(&self, r: &[f64], z: &mut [f64]) {
        let spare = self.spare.lock().ok().and_then(|mut spare| spare.pop());
        let mut work = spare.unwrap_or_else(|| Work::new(&self.hierarchy));
        match &self.order {
            None => {
                self.hierarchy.cycle(r.as_chunks::<1>().0, &mut work);
                z.par_iter_mut().with_min_len(GRAIN).zip(work.x()).for_each(|(z, x)| *z = f64::from(x[0]));
            }
            Some(order) => {
                let sorted: Vec<[f64; 1]> = order.iter().map(|&row| [r[row as usize]]).collect();
                self.hierarchy.cycle(&sorted, &mut work);
                order.iter().zip(work.x()).for_each(|(&row, x)| z[row as usize] = f64::from(x[0]));
            }
        }
        if let Ok(mut spare) = self.spare.lock() {
            spare.push(work);
        }
    }

    /// Writes the answers of `K` right-hand sides, one after the other in `given`, to `out`; gives their relative residuals and
    /// iterations. Starts anew from the true residual are for the columns that need them, so no column depends on another.
    fn solve_columns<const K: usize>(
        &self,
        given: &[f64],
        bound: f64,
        out: &mut [f64],
    ) -> ([f64; K], [usize; K]) {
        let n = self.unknowns();
        let row_of = |row: usize| self.order.as_ref().map_or(row, |order| order[row] as usize);
        let size: [f64; K] = std::array::from_fn(|k| norm(&given[k * n..(k + 1) * n]));
        let scale = size.map(power_of_two_near);
        let b = |row: usize| -> [f64; K] { std::array::from_fn(|k| given[k * n + row_of(row)] / scale[k]) };
        let mut r: Vec<[f64; K]> = (0..n).into_par_iter().with_min_len(GRAIN).map(b).collect();
        let mut x = vec![[0.0; K]; n];
        let (mut reached, mut taken) = (size.map(|size| if size > 0.0 { 1.0 } else { 0.0 }), [0; K]);
        for _ in 0..=RESTARTS {
            let budget =
                self.max_iterations - taken.iter().max().map_or(0, |&most| most.min(self.max_iterations));
            let (mut next, more) = conjugate_gradients(&self.hierarchy, &mut r, TARGET, budget);
            (0..K).for_each(|k| taken[k] += more[k]);
            add(&mut next, &x);
            multiply(&self.hierarchy.finest.matrix, &next, &mut r);
            let squares = subtract_from(&b, &mut r);
            let now: [f64; K] = std::array::from_fn(|k| ratio(squares[k].sqrt(), size[k] / scale[k]));
            let is_better: [bool; K] = std::array::from_fn(|k| now[k] < reached[k]);
            let goes_on = |k: usize| now[k] < 0.5 * reached[k] && now[k] > bound.min(ACCURATE);
            let open: [bool; K] = std::array::from_fn(|k| goes_on(k) && taken[k] < self.max_iterations);
            choose(&mut x, &next, &is_better);
            r.par_iter_mut()
                .with_min_len(GRAIN)
                .for_each(|r| *r = std::array::from_fn(|k| if open[k] { r[k] } else { 0.0 }));
            (0..K).filter(|&k| is_better[k]).for_each(|k| reached[k] = now[k]);
            if !open.contains(&true) {
                break;
            }
        }
        for (k, out) in out.chunks_mut(n).enumerate() {
            x.iter().enumerate().for_each(|(row, x)| out[row_of(row)] = scale[k] * x[k]);
        }
        (reached, taken)
    }
}

/// By what a right-hand side of this norm is divided: exactly, and so that squares are in range.
fn power_of_two_near(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { size.log2().round().clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
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

fn in_given_order(error: SolveError, order: Option<&[u32]>) -> SolveError {
    match (error, order) {
        (SolveError::NotPositiveDefinite { row: Some(row) }, Some(order)) => {
            SolveError::NotPositiveDefinite { row: order.get(row).map(|&row| row as usize) }
        }
        (error, _) => error,
    }
}

impl LinearSolver for ScalarMultigrid {
    fn unknowns(&self) -> usize {
        self.hierarchy.finest.matrix.rows()
    }

    fn method(&self) -> SolveMethod {
        SolveMethod::Multigrid
    }

    fn solve(&self, rhs: &DMatrix<f64>, bound: f64) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
        check_bound(bound)?;
        let unknowns = self.unknowns();
        check_rhs(unknowns, rhs)?;
        let mut values = vec![0.0; rhs.len()];
        let (mut residuals, mut iterations) = (Vec::new(), 0);
        let pairs =
            rhs.as_slice().chunks((2 * unknowns).max(1)).zip(values.chunks_mut((2 * unknowns).max(1)));
        for (given, out) in pairs {
            if given.len() == 2 * unknowns {
                let (reached, taken) = self.solve_columns::<2>(given, bound, out);
                residuals.extend(reached);
                iterations = iterations.max(taken[0]).max(taken[1]);
            } else {
                let (reached, taken) = self.solve_columns::<1>(given, bound, out);
                residuals.extend(reached);
                iterations = iterations.max(taken[0]);
            }
        }
        let relative_residual = residuals.into_iter().fold(0.0, f64::max);
        if relative_residual <= bound {
            let nonzeros = self.hierarchy.finest.matrix.columns.len();
            let method = SolveMethod::Multigrid;
            let record = SolveRecord { unknowns, nonzeros, method, relative_residual, iterations };
            Ok((DMatrix::from_vec(unknowns, rhs.ncols(), values), record))
        } else {
            Err(SolveError::Inaccurate { residual: relative_residual, bound })
        }
    }
}
