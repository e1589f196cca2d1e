//! Why a linear system has no answer.

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
    /// Only square systems are solved.
    #[error("the matrix is not square: {rows} rows, {columns} columns")]
    NotSquare {
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// The right-hand side has another number of rows than the matrix.
    #[error("the right-hand side has {found} rows, the matrix {expected}")]
    WrongRightHandSide {
        /// Rows of the matrix.
        expected: usize,
        /// Rows of the right-hand side.
        found: usize,
    },
    /// An entry of the matrix is infinite or not a number.
    #[error("matrix entry ({row}, {column}) is not finite")]
    NonFiniteEntry {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
    },
    /// An entry of the right-hand side is infinite or not a number.
    #[error("right-hand side entry ({row}, {column}) is not finite")]
    NonFiniteRightHandSide {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
    },
    /// A triplet lies outside the matrix.
    #[error("entry ({row}, {column}) lies outside a matrix of {rows} rows and {columns} columns")]
    OutOfRange {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// The matrix is not positive definite, so it has no Cholesky factor.
    #[error("the matrix is not positive definite{}", at_row(*row))]
    NotPositiveDefinite {
        /// A row whose pivot is not positive, where it is known.
        row: Option<usize>,
    },
    /// The matrix is singular: some unknown is not determined.
    #[error("the matrix is singular{}", at_row(*row))]
    Singular {
        /// A row without a pivot, where it is known.
        row: Option<usize>,
    },
    /// A matrix was handed over whose entries are not where those of the analysed one were.
    #[error("the matrix has another sparsity pattern than the one that was analysed")]
    OtherPattern,
    /// The factors do not fit into memory or into 32-bit indices.
    #[error("a system of {unknowns} unknowns is too large to be factorized: use the iterative backend")]
    TooLarge {
        /// Unknowns of the system.
        unknowns: usize,
    },
    /// The caller's bound is negative or not a number.
    #[error("the residual bound {0} is out of range: it must be a positive number")]
    BadBound(f64),
}

fn at_row(row: Option<usize>) -> String {
    row.map_or_else(String::new, |row| format!(": no pivot in row {row}"))
}
