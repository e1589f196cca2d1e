//! Small dense blocks, in single precision: what a preconditioner needs, at half the memory traffic.

/// `R × C` numbers, row by row.
pub type Block<const R: usize, const C: usize> = [[f32; C]; R];

/// `R × C` numbers in double precision, row by row.
pub(super) type Exact<const R: usize, const C: usize> = [[f64; C]; R];

/// `sum += a b`.
#[inline(always)]
pub(super) fn add_product<const R: usize, const K: usize, const C: usize>(
    sum: &mut Block<R, C>,
    a: &Block<R, K>,
    b: &Block<K, C>,
) {
    for (sum, a) in sum.iter_mut().zip(a) {
        for (a, b) in a.iter().zip(b) {
            for (sum, b) in sum.iter_mut().zip(b) {
                *sum += a * b;
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
    for (a, b) in a.iter().zip(b) {
        for (sum, a) in sum.iter_mut().zip(a) {
            for (sum, b) in sum.iter_mut().zip(b) {
                *sum += a * b;
            }
        }
    }
}

/// `y += a x`.
#[inline(always)]
pub(super) fn add_times<const R: usize, const C: usize>(y: &mut [f32; R], a: &Block<R, C>, x: &[f32; C]) {
    for (y, a) in y.iter_mut().zip(a) {
        for (a, x) in a.iter().zip(x) {
            *y += a * x;
        }
    }
}

/// `y −= a x`.
#[inline(always)]
pub(super) fn subtract_times<const R: usize, const C: usize>(
    y: &mut [f32; R],
    a: &Block<R, C>,
    x: &[f32; C],
) {
    for (y, a) in y.iter_mut().zip(a) {
        for (a, x) in a.iter().zip(x) {
            *y -= a * x;
        }
    }
}

/// `y += aᵀ x`.
#[inline(always)]
pub(super) fn add_transposed_times<const R: usize, const C: usize>(
    y: &mut [f32; C],
    a: &Block<R, C>,
    x: &[f32; R],
) {
    for (a, x) in a.iter().zip(x) {
        for (y, a) in y.iter_mut().zip(a) {
            *y += a * x;
        }
    }
}

/// The sum of squares of the entries.
pub(super) fn square<const R: usize, const C: usize>(a: &Block<R, C>) -> f32 {
    a.iter().flatten().map(|a| a * a).sum()
}

/// The inverse of a symmetric positive definite block, nothing when it is not.
pub(super) fn inverse<const N: usize>(a: &Block<N, N>) -> Option<Block<N, N>> {
    let factor = cholesky(&widened(a))?;
    let mut inverse = [[0.0; N]; N];
    // Symmetric, so its columns may serve as rows.
    for (k, row) in inverse.iter_mut().enumerate() {
        *row = solve(&factor, std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 })).map(|x| x as f32);
    }
    inverse.iter().flatten().all(|value| value.is_finite()).then_some(inverse)
}

pub(super) fn widened<const R: usize, const C: usize>(a: &Block<R, C>) -> Exact<R, C> {
    a.map(|row| row.map(f64::from))
}

pub(super) fn narrowed<const R: usize, const C: usize>(a: &Exact<R, C>) -> Block<R, C> {
    a.map(|row| row.map(|value| value as f32))
}

/// `L` with `L Lᵀ = a`.
fn cholesky<const N: usize>(a: &Exact<N, N>) -> Option<Exact<N, N>> {
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

fn solve<const N: usize>(factor: &Exact<N, N>, mut x: [f64; N]) -> [f64; N] {
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
