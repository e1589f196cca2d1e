//! What every backend has in common.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;

use crate::product::relative_residual;
use crate::{SolveError, SolveMethod, SolveRecord};

/// A system that is ready to be solved for any number of right-hand sides.
///
/// Factorizations and Krylov methods (with any preconditioner, [`multigrid`](crate::multigrid) among them) implement it.
pub trait LinearSolver: Sync {
    /// How many unknowns there are.
    fn unknowns(&self) -> usize;

    /// What [`LinearSolver::solve`] runs.
    fn method(&self) -> SolveMethod;

    /// Solves `A X = B`, `B` n × k. Each column is solved for itself, so its bits do not depend on the others.
    ///
    /// # Errors
    /// [`SolveError::Singular`] when the answer is not finite; [`SolveError::Inaccurate`] when the residual, computed afresh from `A`,
    /// is larger than `bound`, or not a number. (Krylov iterations end with the last answer that is finite, and so with the latter.)
    /// Others where the right-hand side does not fit.
    fn solve(&self, rhs: &DMatrix<f64>, bound: f64) -> Result<(DMatrix<f64>, SolveRecord), SolveError>;
}

/// The columns of an answer and the iterations that each took, with their residual, or a refusal.
pub(crate) fn certified(
    matrix: &CsrMatrix<f64>,
    rhs: &DMatrix<f64>,
    columns: Vec<(Vec<f64>, usize)>,
    method: SolveMethod,
    bound: f64,
) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
    if columns.iter().any(|(x, _)| x.iter().any(|value| !value.is_finite())) {
        return Err(SolveError::Singular { row: None });
    }
    let iterations = columns.iter().map(|(_, taken)| *taken).max().unwrap_or(0);
    let values = columns.into_iter().flat_map(|(x, _)| x).collect();
    let solution = DMatrix::from_vec(rhs.nrows(), rhs.ncols(), values);
    let relative_residual = relative_residual(matrix, &solution, rhs);
    // A residual that is not a number is refused too.
    if relative_residual <= bound {
        let (unknowns, nonzeros) = (matrix.nrows(), matrix.nnz());
        Ok((solution, SolveRecord { unknowns, nonzeros, method, relative_residual, iterations }))
    } else {
        Err(SolveError::Inaccurate { residual: relative_residual, bound })
    }
}
