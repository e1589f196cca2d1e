//! Small dense blocks.
//!
//! Loops run over indices: with sizes that are known they unroll, in whatever profile.
#![allow(clippy::needless_range_loop)]

/// `R × C` numbers, row by row.
pub type Block<const R: usize, const C: usize> = [[f64; C]; R];

/// `sum += a b`.
#[inline(always)]
pub(super) fn add_product<const R: usize, const K: usize, const C: usize>(
    sum: &mut Block<R, C>,
    a: &Block<R, K>,
    b: &Block<K, C>,
) {
    for i in 0..R {
        for k in 0..K {
            for j in 0..C {
                sum[i][j] += a[i][k] * b[k][j];
            }
        }
    }
}

/// `sum += aᵀ b`.
#[inline(always)]
pub(super) fn add_transposed_product<const R: usize, const K: usize, const C: usize>(
    sum: &mut Block<R, C>,
    a: &Block<K, R>,
    b: &Block<K, C>,
) {
    for k in 0..K {
        for i in 0..R {
            for j in 0..C {
                sum[i][j] += a[k][i] * b[k][j];
            }
        }
    }
}

/// `y += a x`.
#[inline(always)]
pub(super) fn add_times<const R: usize, const C: usize>(y: &mut [f64; R], a: &Block<R, C>, x: &[f64; C]) {
    for i in 0..R {
        for j in 0..C {
            y[i] += a[i][j] * x[j];
        }
    }
}

/// `y −= a x`.
#[inline(always)]
pub(super) fn subtract_times<const R: usize, const C: usize>(
    y: &mut [f64; R],
    a: &Block<R, C>,
    x: &[f64; C],
) {
    for i in 0..R {
        for j in 0..C {
            y[i] -= a[i][j] * x[j];
        }
    }
}

/// `y += aᵀ x`.
#[inline(always)]
pub(super) fn add_transposed_times<const R: usize, const C: usize>(
    y: &mut [f64; C],
    a: &Block<R, C>,
    x: &[f64; R],
) {
    for i in 0..R {
        for j in 0..C {
            y[j] += a[i][j] * x[i];
        }
    }
}

/// The sum of squares of the entries.
pub(super) fn square<const R: usize, const C: usize>(a: &Block<R, C>) -> f64 {
    a.iter().flatten().map(|a| a * a).sum()
}

/// The inverse of a symmetric positive definite block, nothing when it is not.
pub(super) fn inverse<const N: usize>(a: &Block<N, N>) -> Option<Block<N, N>> {
    let factor = cholesky(a)?;
    let mut inverse = [[0.0; N]; N];
    // Symmetric, so its columns may serve as rows.
    for (k, row) in inverse.iter_mut().enumerate() {
        *row = solve(&factor, std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 }));
    }
    inverse.iter().flatten().all(|value| value.is_finite()).then_some(inverse)
}

/// `L` with `L Lᵀ = a`.
fn cholesky<const N: usize>(a: &Block<N, N>) -> Option<Block<N, N>> {
    let mut factor = [[0.0; N]; N];
    for row in 0..N {
        for column in 0..=row {
            let known: f64 = (0..column).map(|k| factor[row][k] * factor[column][k]).sum();
            let left = a[row][column] - known;
            if row != column {
                factor[row][column] = left / factor[column][column];
            } else if left > 1e-12 * a[row][row] {
                factor[row][row] = left.sqrt();
            } else {
                return None;
            }
        }
    }
    Some(factor)
}

fn solve<const N: usize>(factor: &Block<N, N>, mut x: [f64; N]) -> [f64; N] {
    for row in 0..N {
        let known: f64 = (0..row).map(|k| factor[row][k] * x[k]).sum();
        x[row] = (x[row] - known) / factor[row][row];
    }
    for row in (0..N).rev() {
        let known: f64 = (row + 1..N).map(|k| factor[k][row] * x[k]).sum();
        x[row] = (x[row] - known) / factor[row][row];
    }
    x
}
