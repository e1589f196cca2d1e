//! Krylov methods, where the factors of the matrix itself would be too large.
//!
//! Beside a few vectors they hold a preconditioner: of symmetric matrices one as large as the matrix; of general ones the Cholesky factor
//! of a symmetric neighbour, a quarter of the LU factors, or with [`Krylov::multigrid`] a hierarchy about as large as the matrix.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;
use rayon::prelude::*;

use crate::check::{check_bound, check_matrix, check_rhs};
use crate::preconditioner::Preconditioner;
use crate::product::{column, dot, multiply, norm, ratio, residual};
use crate::solver::{LinearSolver, certified};
use crate::{SolveError, SolveMethod, SolveRecord, Structure};

/// Iterations go on until the residual is this small, or no longer falls; the caller's bound only decides what is
/// accepted. Positions that solve a mesh's system to `1e-8` are visibly worse than those of a factorization.
const TARGET: f64 = 1e-13;

/// Items below which a task is not split.
const GRAIN: usize = 8192;

/// Preconditioned BiCGStab, or conjugate gradients when the matrix is symmetric and positive definite.
///
/// BiCGStab uses the Cholesky factor of a symmetric neighbour of the matrix, conjugate gradients an incomplete one;
/// both fall back to ILU(0), and that to the diagonal. [`Krylov::multigrid`] uses a multigrid cycle instead.
#[derive(Debug)]
pub struct Krylov<'a> {
    matrix: &'a CsrMatrix<f64>,
    structure: Structure,
    preconditioner: Preconditioner,
    max_iterations: usize,
}

impl<'a> Krylov<'a> {
    /// Computes the preconditioner.
    ///
    /// # Errors
    /// When the matrix is not square, has entries that are not finite, or an empty row.
    pub fn new(
        matrix: &'a CsrMatrix<f64>,
        structure: Structure,
        max_iterations: usize,
    ) -> Result<Self, SolveError> {
        check_matrix(matrix)?;
        let preconditioner = Preconditioner::new(matrix, structure);
        Ok(Self { matrix, structure, preconditioner, max_iterations })
    }

    /// BiCGStab preconditioned by a multigrid cycle of the matrix's symmetric neighbour.
    ///
    /// # Errors
    /// As [`Krylov::new`]; and when the neighbour is not positive definite.
    pub fn multigrid(matrix: &'a CsrMatrix<f64>, max_iterations: usize) -> Result<Self, SolveError> {
        check_matrix(matrix)?;
        let preconditioner = Preconditioner::multigrid(matrix)?;
        Ok(Self { matrix, structure: Structure::General, preconditioner, max_iterations })
    }

    /// Cycles from the true residual until it is small enough or stalls.
    fn solve_column(&self, b: &[f64]) -> (Vec<f64>, usize) {
        let size = norm(b);
        let mut x = vec![0.0; b.len()];
        let mut r = b.to_vec();
        let mut reached = 1.0;
        let mut iterations = 0;
        while size > 0.0 && reached > TARGET && iterations < self.max_iterations {
            let budget = self.max_iterations - iterations;
            let (step, taken) = match self.structure {
                Structure::SymmetricPositiveDefinite => self.conjugate_gradients(&r, TARGET * size, budget),
                Structure::General => self.bicgstab(&r, TARGET * size, budget),
            };
            iterations += taken;
            let next: Vec<f64> = x.iter().zip(&step).map(|(x, step)| x + step).collect();
            let next_r = residual(self.matrix, &next, b);
            let next_reached = ratio(norm(&next_r), size);
            let better = next_reached < reached;
            let stalled = next_reached.is_nan() || next_reached > 0.5 * reached || taken == 0;
            if better {
                (x, r, reached) = (next, next_r, next_reached);
            }
            if stalled {
                break;
            }
        }
        (x, iterations)
    }

    /// Hestenes and Stiefel 1952; `A x ≈ b` from zero until the recursive residual is below `target`.
    fn conjugate_gradients(&self, b: &[f64], target: f64, budget: usize) -> (Vec<f64>, usize) {
        let n = b.len();
        let (mut x, mut r, mut z, mut ap) = (vec![0.0; n], b.to_vec(), vec![0.0; n], vec![0.0; n]);
        self.preconditioner.apply(&r, &mut z);
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        for iteration in 0..budget {
            multiply(self.matrix, &p, &mut ap);
            let alpha = rz / dot(&p, &ap);
            if !alpha.is_finite() {
                return (x, iteration);
            }
            add(&mut x, alpha, &p);
            add(&mut r, -alpha, &ap);
            if norm(&r) <= target {
                return (x, iteration + 1);
            }
            self.preconditioner.apply(&r, &mut z);
            let next_rz = dot(&r, &z);
            let beta = next_rz / rz;
            rz = next_rz;
            p.par_iter_mut().with_min_len(GRAIN).zip(&z).for_each(|(p, z)| *p = z + beta * *p);
        }
        (x, budget)
    }

    /// van der Vorst 1992, preconditioned from the right; `A x ≈ b` from zero until the recursive residual is below
    /// `target`. What was reached is returned when the method breaks down.
    fn bicgstab(&self, b: &[f64], target: f64, budget: usize) -> (Vec<f64>, usize) {
        let n = b.len();
        let (mut x, mut r) = (vec![0.0; n], b.to_vec());
        let shadow = b;
        let (mut p, mut v) = (vec![0.0; n], vec![0.0; n]);
        let (mut p_hat, mut s_hat, mut t) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        for iteration in 0..budget {
            let next_rho = dot(shadow, &r);
            let beta = (next_rho / rho) * (alpha / omega);
            rho = next_rho;
            if rho == 0.0 || !beta.is_finite() {
                return (x, iteration);
            }
            let direction = p.par_iter_mut().with_min_len(GRAIN).zip(&r).zip(&v);
            direction.for_each(|((p, r), v)| *p = r + beta * (*p - omega * v));
            self.preconditioner.apply(&p, &mut p_hat);
            multiply(self.matrix, &p_hat, &mut v);
            alpha = rho / dot(shadow, &v);
            if !alpha.is_finite() {
                return (x, iteration);
            }
            add(&mut r, -alpha, &v); // `r` is the `s` of the paper from here on
            add(&mut x, alpha, &p_hat);
            if norm(&r) <= target {
                return (x, iteration + 1);
            }
            self.preconditioner.apply(&r, &mut s_hat);
            multiply(self.matrix, &s_hat, &mut t);
            omega = dot(&t, &r) / dot(&t, &t);
            if !omega.is_finite() || omega == 0.0 {
                return (x, iteration + 1);
            }
            add(&mut x, omega, &s_hat);
            add(&mut r, -omega, &t);
            if norm(&r) <= target {
                return (x, iteration + 1);
            }
        }
        (x, budget)
    }
}

impl LinearSolver for Krylov<'_> {
    fn unknowns(&self) -> usize {
        self.matrix.nrows()
    }

    fn method(&self) -> SolveMethod {
        match (&self.preconditioner, self.structure) {
            (Preconditioner::Multigrid(_), _) => SolveMethod::Multigrid,
            (_, Structure::SymmetricPositiveDefinite) => SolveMethod::ConjugateGradient,
            (_, Structure::General) => SolveMethod::BiCgStab,
        }
    }

    fn solve(&self, rhs: &DMatrix<f64>, bound: f64) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
        check_bound(bound)?;
        check_rhs(self.unknowns(), rhs)?;
        let columns = (0..rhs.ncols()).into_par_iter().map(|k| self.solve_column(column(rhs, k))).collect();
        certified(self.matrix, rhs, columns, self.method(), bound)
    }
}

/// `x += factor · y`.
fn add(x: &mut [f64], factor: f64, y: &[f64]) {
    x.par_iter_mut().with_min_len(GRAIN).zip(y).for_each(|(x, y)| *x += factor * y);
}
