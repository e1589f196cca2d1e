//! Sparse linear systems for mesh processing: every answer with its true residual.
//!
//! ```
//! use qsolve::{DMatrix, SolveOptions, Structure, Triplets};
//!
//! // A chain of three springs between walls at 0 and 1: the two free ends come to rest at 1/3 and 2/3.
//! let mut triplets = Triplets::new(2, 2);
//! for (row, column, value) in [(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 2.0)] {
//!     triplets.add(row, column, value);
//! }
//! let rhs = DMatrix::from_vec(2, 1, vec![0.0, 1.0]);
//! let structure = Structure::SymmetricPositiveDefinite;
//! let (x, record) = qsolve::solve(&triplets.build()?, structure, &rhs, &SolveOptions::default())?;
//! assert!((x[(0, 0)] - 1.0 / 3.0).abs() < 1e-15);
//! assert!(record.relative_residual < 1e-15);
//! # Ok::<(), qsolve::SolveError>(())
//! ```
//!
//! Guaranteed: an answer comes with `‖b − A x‖ / ‖b‖`, computed afresh from the matrix that was handed over, and is
//! refused above the caller's bound. The same input gives the same bits for any number of threads. Bad input is an
//! error that names the entry. Not guaranteed: that the error is as small as the residual, which it exceeds by up to
//! the condition number; and the same bits on another machine, since faer adapts its kernels to the processor.
//!
//! Limits: real square systems. Patterns and factors are indexed in 32 bits (about two thousand million entries).
//! Factorizations and triangular solves run on one thread, one right-hand side a thread; [`multigrid`] and
//! [`ScalarMultigrid`] use them all.

// In reading order.
mod assembly;
mod options;
mod solve;

mod solver;

mod direct;

mod columns;
mod factors;

mod krylov;

mod conjugate;
pub mod multigrid;
mod scalar;

mod incomplete;
mod preconditioner;
mod symmetrized;

mod check;
mod error;
mod product;

pub use assembly::Triplets;
pub use conjugate::ConjugateGradients;
pub use direct::{Factor, Symbolic};
pub use error::SolveError;
pub use factors::KeptFactors;
pub use krylov::Krylov;
pub use multigrid::{BlockMatrix, Multigrid, MultigridOptions};
pub use nalgebra::DMatrix;
pub use nalgebra_sparse::{self, CsrMatrix};
pub use options::{Backend, SolveMethod, SolveOptions, SolveRecord, Structure};
pub use qsimplify::{self, qcurv, qmesh};
pub use scalar::ScalarMultigrid;
pub use solve::solve;
pub use solver::LinearSolver;
