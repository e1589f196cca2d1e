//! Products, sums and residuals: in parallel, with the same bits for any number of threads.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;
use rayon::prelude::*;

/// Items that one task takes. Sums are taken chunk by chunk and then over the chunks in order, whoever computed them.
const CHUNK: usize = 8192;

/// `out = A x`.
pub(crate) fn multiply(matrix: &CsrMatrix<f64>, x: &[f64], out: &mut [f64]) {
    let (offsets, columns, values) = matrix.csr_data();
    out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, out)| {
        let first = chunk * CHUNK;
        for (place, out) in out.iter_mut().enumerate() {
            let range = offsets[first + place]..offsets[first + place + 1];
            let row = columns[range.clone()].iter().zip(&values[range]);
            *out = row.map(|(&column, &value)| value * x[column]).sum();
        }
    });
}

/// `x · y`.
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let chunk = |(x, y): (&[f64], &[f64])| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    if x.len() <= CHUNK {
        return chunk((x, y));
    }
    let sums: Vec<f64> = x.par_chunks(CHUNK).zip(y.par_chunks(CHUNK)).map(chunk).collect();
    sums.iter().sum()
}

/// `‖x‖₂`, without overflow or underflow on the way.
pub(crate) fn norm(x: &[f64]) -> f64 {
    let largest = x.iter().fold(0.0_f64, |largest, &value| {
        if value.is_nan() {
            f64::NAN
        } else if largest.is_nan() {
            largest
        } else {
            largest.max(value.abs())
        }
    });
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    if (1e-100..1e100).contains(&largest) {
        return dot(x, x).sqrt();
    }
    let scaled: Vec<f64> = x.iter().map(|value| value / largest).collect();
    largest * dot(&scaled, &scaled).sqrt()
}

/// `b − A x` of one right-hand side.
pub(crate) fn residual(matrix: &CsrMatrix<f64>, x: &[f64], b: &[f64]) -> Vec<f64> {
    let mut r = vec![0.0; b.len()];
    multiply(matrix, x, &mut r);
    r.par_iter_mut().with_min_len(CHUNK).zip(b).for_each(|(r, b)| *r = b - *r);
    r
}

/// The largest over the columns of `‖b − A x‖₂ / ‖b‖₂`; not a number when some part of it is not.
///
/// A right-hand side of zeros has the answer zero; anything else is infinitely wrong.
pub(crate) fn relative_residual(matrix: &CsrMatrix<f64>, x: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    let columns = 0..b.ncols();
    let each =
        columns.map(|k| ratio(norm(&residual(matrix, column(x, k), column(b, k))), norm(column(b, k))));
    each.fold(
        0.0,
        |worst: f64, value| if value.is_nan() || worst.is_nan() { f64::NAN } else { worst.max(value) },
    )
}

/// `residual / size`, with `0 / 0 = 0`.
pub(crate) fn ratio(residual: f64, size: f64) -> f64 {
    if residual == 0.0 { 0.0 } else { residual / size }
}

/// Column `k` of a matrix as a slice.
pub(crate) fn column(matrix: &DMatrix<f64>, k: usize) -> &[f64] {
    let rows = matrix.nrows();
    &matrix.as_slice()[k * rows..(k + 1) * rows]
}
