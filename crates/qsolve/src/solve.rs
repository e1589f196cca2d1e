//! One call: the backend that fits, and the next one where that fails.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;

use crate::check::{check_bound, check_matrix, check_rhs};
use crate::direct::Symbolic;
use crate::krylov::Krylov;
use crate::multigrid::BlockMatrix;
use crate::scalar::ScalarMultigrid;
use crate::solver::LinearSolver;
use crate::{Backend, SolveError, SolveMethod, SolveOptions, SolveRecord, Structure};

/// Unknowns above which a general system is iterated on first. Processor seconds and memory of a row-normalised
/// mesh system with two right-hand sides, LU against BiCGStab: 190 thousand unknowns 1.1 s, 0.45 GB and 1.3-2.0 s,
/// 0.17 GB; half a million 3.5 s, 1.3 GB and 6 s, 0.47 GB; a million 8.7 s, 2.9 GB and 13 s, 1.0 GB. The iterations use
/// a thread for each right-hand side, so with two the clock shows about the same; from here on memory decides.
const LU_LIMIT: usize = 500_000;

/// Unknowns above which a symmetric system is solved by multigrid first. Seconds for two right-hand sides, Cholesky against multigrid, on
/// two busy processors: 190 thousand unknowns 0.6 and 0.9; a million 2.6 and 2.4 on a regular grid, 2.4 and 4.5 where edges differ in
/// length. Four million unknowns would have 200 million entries in their factor.
const CHOLESKY_LIMIT: usize = 1_500_000;

/// Entries of a factor above which multigrid is tried first, whatever the number of unknowns: 0.8 GB. Those of surfaces have 30 to 50 for each
/// unknown at a million; systems that are not planar, as of volumes, many times that.
const FACTOR_LIMIT: usize = 100_000_000;

/// Solves `A X = B`, `A` n × n, `B` n × k.
///
/// Symmetric systems are factorized up to 1.5 million unknowns, if their factor will have at most a hundred million entries, general
/// ones up to half a million unknowns; larger ones are iterated on first, the symmetric ones by multigrid, and factorized when that fails. Every answer is checked against the
/// matrix, and refined or refused when its residual is too large.
///
/// ```
/// use qsolve::{DMatrix, SolveMethod, SolveOptions, Structure, Triplets};
///
/// let mut triplets = Triplets::new(2, 2);
/// for (row, column, value) in [(0, 0, 1.0), (0, 1, -0.5), (1, 1, 2.0)] {
///     triplets.add(row, column, value);
/// }
/// let matrix = triplets.build()?;
/// let rhs = DMatrix::from_vec(2, 1, vec![0.0, 2.0]);
/// let (x, record) = qsolve::solve(&matrix, Structure::General, &rhs, &SolveOptions::default())?;
/// assert_eq!((x[(0, 0)], x[(1, 0)], record.method), (0.5, 1.0, SolveMethod::Lu));
/// # Ok::<(), qsolve::SolveError>(())
/// ```
///
/// # Errors
/// See [`SolveError`].
pub fn solve(
    matrix: &CsrMatrix<f64>,
    structure: Structure,
    rhs: &DMatrix<f64>,
    options: &SolveOptions,
) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
    check_bound(options.residual_bound)?;
    check_matrix(matrix)?;
    check_rhs(matrix.nrows(), rhs)?;
    let factorized = |symbolic: &Symbolic| symbolic.factor(matrix)?.solve(rhs, options.residual_bound);
    let direct = || factorized(&Symbolic::analyze(matrix, structure)?);
    let iterative =
        || Krylov::new(matrix, structure, options.max_iterations)?.solve(rhs, options.residual_bound);
    if matrix.nrows() == 0 {
        return Ok((rhs.clone(), nothing_to_solve(structure)));
    }
    let multigrid = || match structure {
        Structure::SymmetricPositiveDefinite => {
            ScalarMultigrid::new(BlockMatrix::from_csr(matrix)?, options.max_iterations)?
                .solve(rhs, options.residual_bound)
        }
        Structure::General => {
            Krylov::multigrid(matrix, options.max_iterations)?.solve(rhs, options.residual_bound)
        }
    };
    match (options.backend, structure) {
        (Backend::Direct, _) => direct(),
        (Backend::Multigrid, _) => multigrid().or_else(|_| direct()),
        (Backend::Auto, Structure::SymmetricPositiveDefinite) if matrix.nrows() > CHOLESKY_LIMIT => {
            multigrid().or_else(|_| direct())
        }
        (Backend::Auto, Structure::SymmetricPositiveDefinite) => match Symbolic::analyze(matrix, structure) {
            Ok(symbolic) if symbolic.factor_entries() > Some(FACTOR_LIMIT) => {
                multigrid().or_else(|_| unless_too_large(factorized(&symbolic), iterative))
            }
            Ok(symbolic) => unless_too_large(factorized(&symbolic), iterative),
            Err(error) => unless_too_large(Err(error), iterative),
        },
        (Backend::Auto, Structure::General) if matrix.nrows() > LU_LIMIT => iterative().or_else(|_| direct()),
        (Backend::Auto, Structure::General) => unless_too_large(direct(), iterative),
        (Backend::Iterative, _) => iterative().or_else(|_| direct()),
    }
}

type Answer = Result<(DMatrix<f64>, SolveRecord), SolveError>;

/// What was found, or what `otherwise` finds where memory did not suffice.
fn unless_too_large(found: Answer, otherwise: impl FnOnce() -> Answer) -> Answer {
    match found {
        Err(SolveError::TooLarge { .. }) => otherwise(),
        decided => decided,
    }
}

fn nothing_to_solve(structure: Structure) -> SolveRecord {
    let method = match structure {
        Structure::SymmetricPositiveDefinite => SolveMethod::Cholesky,
        Structure::General => SolveMethod::Lu,
    };
    SolveRecord { unknowns: 0, nonzeros: 0, method, relative_residual: 0.0, iterations: 0 }
}
