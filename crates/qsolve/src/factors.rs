//! Factors as faer computes them.
//!
//! Everything runs on one thread: with several, faer adds up in another order, and its multithreaded supernodal code
//! has been reported to return wrong answers.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::cholesky::{
    LltRef, SymbolicCholesky, SymbolicCholeskyRaw, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, MatMut, Par, Side};
use nalgebra_sparse::{CsrMatrix, SparseEntry};

use crate::columns::Columns;
use crate::{SolveError, SolveMethod, Structure};

/// The order of elimination and the shape of the factors.
#[derive(Debug)]
pub(crate) struct Analysis {
    columns: Columns,
    shape: Shape,
    /// No other analysis has the same: factors of another one, of whatever size, mean nothing here.
    identity: Arc<()>,
}

#[derive(Debug)]
enum Shape {
    /// Ordered by approximate minimum degree.
    Cholesky(SymbolicCholesky<u32>),
    /// Ordered by COLAMD; pivots are chosen among the rows of a column.
    Lu(SymbolicLu<u32>),
}

/// The factors of one matrix; belongs to the [`Analysis`] that made it.
#[derive(Debug)]
pub(crate) enum Factors {
    Cholesky(Vec<f64>),
    Lu(Box<NumericLu<u32, f64>>),
}

/// The factors of a matrix that need not be there any more: see [`Symbolic::solve_in_place`](crate::Symbolic::solve_in_place).
#[derive(Debug)]
pub struct KeptFactors {
    factors: Factors,
    made_by: Arc<()>,
}

impl Analysis {
    /// Analyses a square matrix.
    pub(crate) fn new(matrix: &CsrMatrix<f64>, structure: Structure) -> Result<Self, SolveError> {
        let columns = Columns::new(matrix, structure)?;
        let pattern = columns.pattern();
        let shape = match structure {
            Structure::SymmetricPositiveDefinite => {
                factorize_symbolic_cholesky(pattern, Side::Lower, Default::default(), Default::default())
                    .map(Shape::Cholesky)
            }
            Structure::General => factorize_symbolic_lu(pattern, Default::default()).map(Shape::Lu),
        };
        let shape = shape.map_err(|_| SolveError::TooLarge { unknowns: matrix.nrows() })?;
        Ok(Self { columns, shape, identity: Arc::default() })
    }

    pub(crate) fn method(&self) -> SolveMethod {
        match self.shape {
            Shape::Cholesky(_) => SolveMethod::Cholesky,
            Shape::Lu(_) => SolveMethod::Lu,
        }
    }

    /// Entries of the factor that will be stored, explicit zeros of its dense blocks among them. Of LU only a bound would be known.
    pub(crate) fn factor_entries(&self) -> Option<usize> {
        match &self.shape {
            Shape::Cholesky(shape) => Some(shape.len_val()),
            Shape::Lu(_) => None,
        }
    }

    /// Factorizes a matrix of the analysed pattern with finite entries.
    pub(crate) fn factor(&self, matrix: &CsrMatrix<f64>) -> Result<Factors, SolveError> {
        let values = self.columns.values(matrix);
        match &self.shape {
            Shape::Cholesky(shape) => self.factor_cholesky(shape, &values, matrix).map(Factors::Cholesky),
            Shape::Lu(shape) => self.factor_lu(shape, &values).map(|factor| Factors::Lu(Box::new(factor))),
        }
    }

    fn factor_cholesky(
        &self,
        shape: &SymbolicCholesky<u32>,
        values: &[f64],
        matrix: &CsrMatrix<f64>,
    ) -> Result<Vec<f64>, SolveError> {
        let too_large = || SolveError::TooLarge { unknowns: shape.nrows() };
        let mut factor = Vec::new();
        factor.try_reserve_exact(shape.len_val()).map_err(|_| too_large())?;
        factor.resize(shape.len_val(), 0.0);
        let mut memory =
            self.memory(shape.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()))?;
        let done = shape.factorize_numeric_llt(
            &mut factor,
            self.columns.with_values(values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        match done.map(|_| ()) {
            Ok(()) => Ok(factor),
            Err(LltError::NonPositivePivot { index }) => {
                Err(SolveError::NotPositiveDefinite { row: row_without_pivot(shape, index, matrix) })
            }
        }
    }

    fn factor_lu(&self, shape: &SymbolicLu<u32>, values: &[f64]) -> Result<NumericLu<u32, f64>, SolveError> {
        let mut factor = NumericLu::new();
        let mut memory =
            self.memory(shape.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default()))?;
        let done = shape.factorize_numeric_lu(
            &mut factor,
            self.columns.with_values(values),
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        match done.map(|_| ()) {
            Ok(()) => Ok(factor),
            Err(LuError::SymbolicSingular { index }) => {
                let row = shape.col_perm().arrays().0.get(index).map(|&row| row as usize);
                Err(SolveError::Singular { row })
            }
            Err(LuError::Generic(_)) => Err(SolveError::TooLarge { unknowns: shape.nrows() }),
        }
    }

    /// `x = A⁻¹ x` with factors that [`Analysis::factor`] made.
    pub(crate) fn solve_in_place(&self, factors: &Factors, x: &mut [f64]) -> Result<(), SolveError> {
        let unknowns = x.len();
        let column = MatMut::from_column_major_slice_mut(x, unknowns, 1);
        match (&self.shape, factors) {
            (Shape::Cholesky(shape), Factors::Cholesky(values)) => {
                let mut memory = self.memory(shape.solve_in_place_scratch::<f64>(1, Par::Seq))?;
                let stack = MemStack::new(&mut memory);
                LltRef::new(shape, values).solve_in_place_with_conj(Conj::No, column, Par::Seq, stack);
            }
            (Shape::Lu(shape), Factors::Lu(factor)) => {
                let mut memory = self.memory(shape.solve_transpose_in_place_scratch::<f64>(1, Par::Seq))?;
                let stack = MemStack::new(&mut memory);
                let factor = LuRef::new_unchecked(shape, factor);
                factor.solve_transpose_in_place_with_conj(Conj::No, column, Par::Seq, stack);
            }
            _ => unreachable!("factors are only used with the analysis that made them"),
        }
        Ok(())
    }

    /// Factors that know where they come from.
    pub(crate) fn keep(&self, factors: Factors) -> KeptFactors {
        KeptFactors { factors, made_by: Arc::clone(&self.identity) }
    }

    /// The factors, if it was this analysis that made them.
    pub(crate) fn recognize<'a>(&self, kept: &'a KeptFactors) -> Option<&'a Factors> {
        Arc::ptr_eq(&self.identity, &kept.made_by).then_some(&kept.factors)
    }

    fn memory(&self, needed: StackReq) -> Result<MemBuffer, SolveError> {
        let unknowns = self.columns.pattern().nrows();
        MemBuffer::try_new(needed).map_err(|_| SolveError::TooLarge { unknowns })
    }
}

/// The row whose pivot was not positive. faer counts from one in a simplicial factorization, and within a block that
/// it does not name in a supernodal one; then a diagonal entry that is not positive is the next best answer.
fn row_without_pivot(shape: &SymbolicCholesky<u32>, index: usize, matrix: &CsrMatrix<f64>) -> Option<usize> {
    let eliminated = match (shape.raw(), shape.perm()) {
        (SymbolicCholeskyRaw::Simplicial(_), Some(order)) => {
            index.checked_sub(1).and_then(|place| order.arrays().0.get(place)).map(|&row| row as usize)
        }
        _ => None,
    };
    let diagonal = |row: usize| matrix.get_entry(row, row).map_or(0.0, SparseEntry::into_value);
    eliminated.or_else(|| (0..matrix.nrows()).find(|&row| diagonal(row) <= 0.0))
}
