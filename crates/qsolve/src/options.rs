//! What the caller chooses, and the record of what ran.

/// Which factorization fits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Symmetric and positive definite: Cholesky. Only the entries on and right of the diagonal are factorized;
    /// the residual is that of the whole matrix, so an asymmetric one is refused.
    SymmetricPositiveDefinite,
    /// Anything else that is square: LU, or BiCGStab where that is too large.
    General,
}

/// Which backend solves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Backend {
    /// Direct for systems of moderate size, multigrid above.
    #[default]
    Auto,
    /// Sparse factorization.
    Direct,
    /// Krylov iterations. Where they fail, the system is factorized after all.
    Iterative,
    /// Krylov iterations preconditioned by a multigrid cycle: their number hardly grows with the system. Where they fail, the
    /// system is factorized after all.
    Multigrid,
}

/// How to solve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, rename_all = "kebab-case"))]
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
    /// Preconditioned conjugate gradients.
    ConjugateGradient,
    /// Conjugate gradients (of general systems, BiCGStab) preconditioned by a multigrid cycle.
    Multigrid,
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
    /// Krylov iterations or refinement steps; the largest number over the right-hand sides.
    pub iterations: usize,
}
