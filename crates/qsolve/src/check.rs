//! What a system must be before anything is computed. Beyond this point nothing panics.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;
use rayon::prelude::*;

use crate::SolveError;

/// Values that are looked through at once.
const CHUNK: usize = 1 << 14;

pub(crate) fn check_matrix(matrix: &CsrMatrix<f64>) -> Result<(), SolveError> {
    check_square(matrix.nrows(), matrix.ncols())?;
    let is_bad = |value: &f64| !value.is_finite();
    let values = matrix.values();
    // Chunks, since a search that may end at any item asks after each.
    let chunk = values.par_chunks(CHUNK).position_first(|chunk| chunk.iter().any(is_bad));
    let place =
        chunk.and_then(|chunk| Some(chunk * CHUNK + values[chunk * CHUNK..].iter().position(is_bad)?));
    if let Some(place) = place {
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
