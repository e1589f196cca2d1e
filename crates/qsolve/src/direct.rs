//! Sparse factorization: analyse a pattern once, factorize values often, solve for many right-hand sides.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;
use nalgebra_sparse::pattern::SparsityPattern;
use rayon::prelude::*;

use crate::check::{check_bound, check_matrix, check_rhs, check_square};
use crate::factors::{Analysis, Factors, KeptFactors};
use crate::product::{column, norm, ratio, residual};
use crate::solver::{LinearSolver, certified};
use crate::{SolveError, SolveMethod, SolveRecord, Structure};

/// Answers with a larger relative residual are refined.
const REFINE_ABOVE: f64 = 1e-13;
/// Refinement steps at most. What two do not mend, more do not.
const REFINEMENTS: usize = 2;

/// Where a matrix has entries, analysed: the order of elimination and the shape of its factors.
#[derive(Debug)]
pub struct Symbolic {
    pattern: SparsityPattern,
    analysis: Analysis,
}

impl Symbolic {
    /// Analyses where `matrix` has entries; its values are not looked at.
    ///
    /// ```
    /// use qsolve::{DMatrix, LinearSolver, Structure, Symbolic, Triplets};
    ///
    /// let mut triplets = Triplets::new(2, 2);
    /// for (row, column, value) in [(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.0)] {
    ///     triplets.add(row, column, value);
    /// }
    /// let matrix = triplets.build()?;
    /// let symbolic = Symbolic::analyze(&matrix, Structure::SymmetricPositiveDefinite)?;
    /// let factor = symbolic.factor(&matrix)?;
    /// let (x, record) = factor.solve(&DMatrix::from_vec(2, 1, vec![1.0, 1.0]), 1e-8)?;
    /// assert!((x[(0, 0)] - 1.0).abs() < 1e-15 && record.relative_residual < 1e-15);
    /// # Ok::<(), qsolve::SolveError>(())
    /// ```
    ///
    /// # Errors
    /// [`SolveError::NotSquare`], or [`SolveError::TooLarge`] when the factors would be.
    pub fn analyze(matrix: &CsrMatrix<f64>, structure: Structure) -> Result<Self, SolveError> {
        check_square(matrix.nrows(), matrix.ncols())?;
        let analysis = Analysis::new(matrix, structure)?;
        Ok(Self { pattern: matrix.pattern().clone(), analysis })
    }

    /// Entries that the factor of a symmetric matrix will have, 8 bytes each; `None` for general ones, whose pivots decide.
    #[must_use]
    pub fn factor_entries(&self) -> Option<usize> {
        self.analysis.factor_entries()
    }

    /// Factorizes `matrix`, which has the pattern that was analysed.
    ///
    /// # Errors
    /// [`SolveError::OtherPattern`], [`SolveError::NonFiniteEntry`], [`SolveError::NotPositiveDefinite`],
    /// [`SolveError::Singular`], or [`SolveError::TooLarge`] when memory runs out.
    pub fn factor<'a>(&'a self, matrix: &'a CsrMatrix<f64>) -> Result<Factor<'a>, SolveError> {
        if *matrix.pattern() != self.pattern {
            return Err(SolveError::OtherPattern);
        }
        check_matrix(matrix)?;
        let factors = self.analysis.factor(matrix)?;
        Ok(Factor { analysis: &self.analysis, matrix, factors })
    }

    /// `x = A⁻¹ x` with factors that [`Factor::into_factors`] kept: for preconditioning, when A has changed since. Nothing is
    /// refined, and no residual computed.
    ///
    /// # Errors
    /// [`SolveError::OtherPattern`] for factors of another analysis, of the same pattern too, [`SolveError::WrongRightHandSide`], or
    /// [`SolveError::TooLarge`] when memory runs out.
    pub fn solve_in_place(&self, factors: &KeptFactors, x: &mut [f64]) -> Result<(), SolveError> {
        let (expected, found) = (self.pattern.major_dim(), x.len());
        if expected != found {
            return Err(SolveError::WrongRightHandSide { expected, found });
        }
        let factors = self.analysis.recognize(factors).ok_or(SolveError::OtherPattern)?;
        self.analysis.solve_in_place(factors, x)
    }
}

/// A factorized matrix: Cholesky or LU.
#[derive(Debug)]
pub struct Factor<'a> {
    analysis: &'a Analysis,
    matrix: &'a CsrMatrix<f64>,
    factors: Factors,
}

impl Factor<'_> {
    /// The factors alone, to precondition other matrices of the same pattern.
    #[must_use]
    pub fn into_factors(self) -> KeptFactors {
        self.analysis.keep(self.factors)
    }

    /// Solves with the factors, and refines while the residual asks for it and falls.
    fn solve_column(&self, b: &[f64]) -> Result<(Vec<f64>, usize), SolveError> {
        let size = norm(b);
        let mut x = b.to_vec();
        if size == 0.0 {
            return Ok((x, 0));
        }
        self.analysis.solve_in_place(&self.factors, &mut x)?;
        let mut r = residual(self.matrix, &x, b);
        let mut reached = ratio(norm(&r), size);
        for step in 0..REFINEMENTS {
            if reached <= REFINE_ABOVE || reached.is_nan() {
                return Ok((x, step));
            }
            self.analysis.solve_in_place(&self.factors, &mut r)?;
            let next: Vec<f64> = x.iter().zip(&r).map(|(x, correction)| x + correction).collect();
            let next_r = residual(self.matrix, &next, b);
            let next_reached = ratio(norm(&next_r), size);
            if next_reached.is_nan() || next_reached >= reached {
                return Ok((x, step));
            }
            (x, r, reached) = (next, next_r, next_reached);
        }
        Ok((x, REFINEMENTS))
    }
}

impl LinearSolver for Factor<'_> {
    fn unknowns(&self) -> usize {
        self.matrix.nrows()
    }

    fn method(&self) -> SolveMethod {
        self.analysis.method()
    }

    fn solve(&self, rhs: &DMatrix<f64>, bound: f64) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
        check_bound(bound)?;
        check_rhs(self.unknowns(), rhs)?;
        let columns: Vec<(Vec<f64>, usize)> = (0..rhs.ncols())
            .into_par_iter()
            .map(|k| self.solve_column(column(rhs, k)))
            .collect::<Result<_, _>>()?;
        certified(self.matrix, rhs, columns, self.method(), bound)
    }
}
