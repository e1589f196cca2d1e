//! Multigrid for symmetric positive definite systems of one unknown a row, as meshes give them: a hierarchy in single precision inside
//! conjugate gradients in double precision, two right-hand sides at a time.
//!
//! Smoothed aggregation as in [`multigrid`](crate::multigrid), with the constants as near-kernel; what is different serves size: the matrix is taken
//! over instead of copied, all else is stored in single precision, and products of three matrices are made row by row. A system with five
//! entries a row and two right-hand sides takes about 220 bytes an unknown, matrix and answer included.
//!
//! Where weights differ from entry to entry by many orders of magnitude, without pattern, no coarser level stands for them. Columns that
//! come forward too slowly are then preconditioned by a sampled incomplete Cholesky factorization, which does not mind.
//!
//! The hierarchy only preconditions: the accuracy of the answer is that of double precision. The same input gives the same bits for any
//! number of threads.

mod columns;
mod conjugate;
mod elimination;
mod hierarchy;
mod level;
mod order;
mod queue;
mod sparse;

#[cfg(test)]
mod tests;

use std::sync::{Mutex, OnceLock};

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::check::{check_bound, check_rhs};
use crate::multigrid::BlockMatrix;
use crate::solver::LinearSolver;
use crate::{SolveError, SolveMethod, SolveRecord};
use columns::solve_columns;
use conjugate::Preconditioner;
use elimination::Elimination;
use hierarchy::{Cycles, Hierarchy, Work};
use order::{better_order, permuted};
use sparse::{Sparse, times_power_of_two};

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
    /// Of the matrix over `2^exponent`.
    hierarchy: Hierarchy,
    exponent: i32,
    /// Which row of the caller's each row is, where they were put in another order.
    order: Option<Vec<u32>>,
    elimination: OnceLock<Elimination>,
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
        let exponent = matrix.normalize();
        let order = better_order(&matrix);
        if let Some(order) = &order {
            matrix = permuted(&matrix, order);
        }
        let hierarchy = Hierarchy::new(matrix).map_err(|error| in_given_order(error, order.as_deref()))?;
        let (elimination, spare) = (OnceLock::new(), Mutex::default());
        Ok(Self { hierarchy, exponent, order, elimination, max_iterations, spare })
    }

    /// Rows of each level, the finest first.
    #[must_use]
    pub fn level_rows(&self) -> &[usize] {
        &self.hierarchy.rows
    }

    /// `z ≈ A⁻¹ r` by one V-cycle.
    pub(crate) fn apply(&self, r: &[f64], z: &mut [f64]) {
        let spare = self.spare.lock().ok().and_then(|mut spare| spare.pop());
        let mut cycles = match spare {
            Some(work) => Cycles::with(&self.hierarchy, work),
            None => Cycles::new(&self.hierarchy),
        };
        match &self.order {
            None => {
                cycles.apply(r.as_chunks::<1>().0);
                let answers = z.par_iter_mut().with_min_len(GRAIN).zip(cycles.z());
                answers.for_each(|(z, x)| *z = self.scaled_back(x[0]));
            }
            Some(order) => {
                let sorted: Vec<[f64; 1]> = order.iter().map(|&row| [r[row as usize]]).collect();
                cycles.apply(&sorted);
                order.iter().zip(cycles.z()).for_each(|(&row, x)| z[row as usize] = self.scaled_back(x[0]));
            }
        }
        let work = cycles.into_work();
        if let Ok(mut spare) = self.spare.lock() {
            spare.push(work);
        }
    }

    fn scaled_back(&self, x: f32) -> f64 {
        times_power_of_two(f64::from(x), -self.exponent)
    }

    /// The factors for matrices that coarser levels do not serve, made when they are first asked for.
    fn elimination(&self) -> &Elimination {
        self.elimination.get_or_init(|| Elimination::new(&self.hierarchy.finest.matrix))
    }
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
                let (reached, taken) = solve_columns::<2>(self, given, bound, out);
                residuals.extend(reached);
                iterations = iterations.max(taken[0]).max(taken[1]);
            } else {
                let (reached, taken) = solve_columns::<1>(self, given, bound, out);
                residuals.extend(reached);
                iterations = iterations.max(taken[0]);
            }
        }
        if values.par_chunks(GRAIN).any(|chunk| chunk.iter().any(|value| !value.is_finite())) {
            return Err(SolveError::Singular { row: None });
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
