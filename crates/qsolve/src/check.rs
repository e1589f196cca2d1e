//! What a system must be before anything is computed. Beyond this point nothing panics.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;
use rayon::prelude::*;

use crate::SolveError;

pub(crate) fn check_matrix(matrix: &CsrMatrix<f64>) -> Result<(), SolveError> {
    check_square(matrix.nrows(), matrix.ncols())?;
    let position =
        matrix.values().par_iter().with_min_len(1 << 16).position_first(|value| !value.is_finite());
    if let Some(place) = position {
        let row = matrix.row_offsets().partition_point(|&start| start <= place) - 1;
        return Err(SolveError::NonFiniteEntry { row, column: matrix.col_indices()[place] });
    }
    let empty = matrix.row_offsets().windows(2).position(|pair| pair[0] == pair[1]);
    empty.map_or(Ok(()), |row| Err(SolveError::Singular { row: Some(row) }))
}

pub(crate) fn check_square(rows: usize, columns: usize) -> Result<(), SolveError> {
    if rows == columns { Ok(()) } else { Err(SolveError::NotSquare { rows, columns }) }
}

pub(crate) fn check_rhs(unknowns: usize, rhs: &DMatrix<f64>) -> Result<(), SolveError> {
    if rhs.nrows() != unknowns {
        return Err(SolveError::WrongRightHandSide { expected: unknowns, found: rhs.nrows() });
    }
    match rhs.as_slice().iter().position(|value| !value.is_finite()) {
        Some(place) => {
            Err(SolveError::NonFiniteRightHandSide { row: place % unknowns, column: place / unknowns })
        }
        None => Ok(()),
    }
}

pub(crate) fn check_bound(bound: f64) -> Result<(), SolveError> {
    if bound > 0.0 { Ok(()) } else { Err(SolveError::BadBound(bound)) }
}
