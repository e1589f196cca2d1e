//! The matrix as faer takes it: by column, with 32-bit indices.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use nalgebra_sparse::CsrMatrix;

use crate::{SolveError, Structure};

/// The pattern of a square matrix, column by column.
///
/// The rows of the matrix serve as columns, so it is the transposed matrix that is factorized. Symmetric matrices do
/// not mind; of those only one triangle is kept. For the others the transposed factors are solved with, and pivots
/// are looked for within a row: a row-normalised matrix keeps its diagonal as pivots, and its factors sparse.
#[derive(Debug)]
pub(crate) struct Columns {
    starts: Vec<u32>,
    rows: Vec<u32>,
    triangle: bool,
}

impl Columns {
    pub(crate) fn new(matrix: &CsrMatrix<f64>, structure: Structure) -> Result<Self, SolveError> {
        if matrix.nnz() >= i32::MAX as usize || matrix.nrows() >= i32::MAX as usize {
            return Err(SolveError::TooLarge { unknowns: matrix.nrows() });
        }
        let triangle = structure == Structure::SymmetricPositiveDefinite;
        let mut columns = Self { starts: vec![0], rows: Vec::with_capacity(matrix.nnz()), triangle };
        for (column, lane) in matrix.row_iter().enumerate() {
            let rows = lane.col_indices();
            let first = columns.first(column, rows);
            columns.rows.extend(rows[first..].iter().map(|&row| row as u32));
            columns.starts.push(columns.rows.len() as u32);
        }
        Ok(columns)
    }

    pub(crate) fn pattern(&self) -> SymbolicSparseColMatRef<'_, u32> {
        let unknowns = self.starts.len() - 1;
        SymbolicSparseColMatRef::new_checked(unknowns, unknowns, &self.starts, None, &self.rows)
    }

    /// The kept values of `matrix`, which has the pattern that this was made from.
    pub(crate) fn values(&self, matrix: &CsrMatrix<f64>) -> Vec<f64> {
        if !self.triangle {
            return matrix.values().to_vec();
        }
        let mut values = Vec::with_capacity(self.rows.len());
        for (column, lane) in matrix.row_iter().enumerate() {
            values.extend_from_slice(&lane.values()[self.first(column, lane.col_indices())..]);
        }
        values
    }

    pub(crate) fn with_values<'a>(&'a self, values: &'a [f64]) -> SparseColMatRef<'a, u32, f64> {
        SparseColMatRef::new(self.pattern(), values)
    }

    /// Which of the entries of a column comes first: of a symmetric matrix, the diagonal.
    fn first(&self, column: usize, rows: &[usize]) -> usize {
        if self.triangle { rows.partition_point(|&row| row < column) } else { 0 }
    }
}
