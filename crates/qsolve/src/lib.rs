//! Sparse linear systems: every answer with its true residual.

pub use nalgebra::DMatrix;
pub use nalgebra_sparse::{self, CsrMatrix};
pub use qsimplify::{self, qcurv, qmesh};

/// Which factorization fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Symmetric and positive definite: Cholesky.
    SymmetricPositiveDefinite,
    /// Anything else that is square: LU, or BiCGStab where that is too large.
    General,
}

/// Which backend solves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Backend {
    /// Direct where the estimated fill allows, iterative above.
    #[default]
    Auto,
    /// Sparse factorization.
    Direct,
    /// Krylov iterations.
    Iterative,
}

/// How to solve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SolveOptions {
    /// Default `Auto`.
    pub backend: Backend,
    /// An answer with a larger relative residual is refused. Default `1e-8`.
    pub residual_bound: f64,
    /// Krylov iterations at most. Default 2000.
    pub max_iterations: usize,
}
impl Default for SolveOptions {
    fn default() -> Self {
        Self { backend: Backend::Auto, residual_bound: 1e-8, max_iterations: 2000 }
    }
}

/// What ran.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SolveMethod {
    /// Sparse Cholesky.
    Cholesky,
    /// Sparse LU.
    Lu,
    /// Preconditioned BiCGStab.
    BiCgStab,
}

/// How a system was solved, and how well.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SolveRecord {
    /// Unknowns.
    pub unknowns: usize,
    /// Stored entries of the matrix.
    pub nonzeros: usize,
    /// What ran in the end.
    pub method: SolveMethod,
    /// Largest over the right-hand sides of `‖b − A x‖₂ / ‖b‖₂`, computed afresh from the matrix.
    pub relative_residual: f64,
    /// Krylov iterations or refinement steps.
    pub iterations: usize,
}

/// Solves `A X = B`, `A` n × n, `B` n × k.
///
/// # Errors
/// See [`SolveError`].
pub fn solve(
    _matrix: &CsrMatrix<f64>,
    _structure: Structure,
    _rhs: &DMatrix<f64>,
    _options: &SolveOptions,
) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
    unimplemented!()
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The residual stayed above the bound.
    #[error(
        "the linear system could not be solved: relative residual {residual:.1e}, at most {bound:.1e} is accepted"
    )]
    Inaccurate {
        /// What was reached.
        residual: f64,
        /// What was asked.
        bound: f64,
    },
}
