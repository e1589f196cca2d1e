//! Conjugate gradients for `K` right-hand sides in one pass.

use rayon::prelude::*;

use super::sparse::Sparse;

/// Rows that one task takes. Sums are taken chunk by chunk and then over the chunks in order, whoever computed them.
const CHUNK: usize = 1 << 13;

/// After so many iterations a preconditioner must have come as far as if it were to arrive after [`ACCEPTABLE`].
const PATIENCE: usize = 40;
const ACCEPTABLE: usize = 120;

/// `z ≈ A⁻¹ r`, a symmetric positive definite operation.
pub(super) trait Preconditioner<const K: usize> {
    fn apply(&mut self, r: &[[f64; K]]);
    /// What [`Preconditioner::apply`] gave.
    fn z(&self) -> &[[f32; K]];
}

/// What came of some iterations.
pub(super) struct Iterated<const K: usize> {
    pub(super) x: Vec<[f64; K]>,
    /// Iterations of each column.
    pub(super) taken: [usize; K],
    /// Columns that were given up because they came forward too slowly.
    pub(super) stalled: [bool; K],
}

/// `A X ≈ B` from zero [Hestenes, Stiefel 1952], until the error of each column is below `target` times its answer, both in the
/// energy norm `‖x‖² = xᵀ A x` as the preconditioner estimates it. Every column has steps of its own; one that has arrived waits for
/// the others. `r` is `B` before, and what recursion says of the residual after.
pub(super) fn conjugate_gradients<const K: usize>(
    matrix: &Sparse<f64>,
    preconditioner: &mut impl Preconditioner<K>,
    r: &mut [[f64; K]],
    target: [f64; K],
    budget: usize,
    is_patient: bool,
) -> Iterated<K> {
    let zeros = || vec![[0.0; K]; r.len()];
    let (mut x, mut p, mut ap) = (zeros(), zeros(), zeros());
    let (mut rz, mut first) = ([0.0; K], [0.0; K]);
    let (mut taken, mut stalled) = ([0; K], [false; K]);
    for iteration in 0..=budget {
        preconditioner.apply(r);
        let next = dot(r, preconditioner.z());
        let beta = if iteration == 0 { [0.0; K] } else { ratios(&next, &rz) };
        rz = next;
        if iteration == 0 {
            first = rz;
        }
        let is_open =
            |k: usize| rz[k] > target[k] * target[k] * first[k] && rz[k].is_finite() && taken[k] == iteration;
        let mut open: [bool; K] = std::array::from_fn(is_open);
        if iteration == PATIENCE && !is_patient {
            for k in 0..K {
                let expected = target[k].powf(2.0 * PATIENCE as f64 / ACCEPTABLE as f64);
                stalled[k] = open[k] && rz[k] > expected * first[k];
                open[k] &= !stalled[k];
            }
        }
        if iteration == budget || !open.contains(&true) {
            break;
        }
        advance_direction(&mut p, preconditioner.z(), &beta, &open);
        let curvature = multiply(matrix, &p, &mut ap);
        let mut alpha = ratios(&rz, &curvature);
        for k in 0..K {
            let goes_on = open[k] && curvature[k] > 0.0 && alpha[k].is_finite();
            alpha[k] = if goes_on { alpha[k] } else { 0.0 };
            taken[k] += usize::from(goes_on);
        }
        step(&mut x, r, &p, &ap, &alpha);
    }
    Iterated { x, taken, stalled }
}

fn ratios<const K: usize>(a: &[f64; K], b: &[f64; K]) -> [f64; K] {
    std::array::from_fn(|k| a[k] / b[k])
}

/// `p = z + β p` where a column is `open`, and zero where it is not.
fn advance_direction<const K: usize>(p: &mut [[f64; K]], z: &[[f32; K]], beta: &[f64; K], open: &[bool; K]) {
    p.par_iter_mut().with_min_len(CHUNK).zip(z).for_each(|(p, z)| {
        *p = std::array::from_fn(|k| if open[k] { f64::from(z[k]) + beta[k] * p[k] } else { 0.0 });
    });
}

/// `x += α p`, `r −= α A p`.
fn step<const K: usize>(
    x: &mut [[f64; K]],
    r: &mut [[f64; K]],
    p: &[[f64; K]],
    ap: &[[f64; K]],
    alpha: &[f64; K],
) {
    x.par_iter_mut().with_min_len(CHUNK).zip(r).zip(p).zip(ap).for_each(|(((x, r), p), ap)| {
        for k in 0..K {
            x[k] += alpha[k] * p[k];
            r[k] -= alpha[k] * ap[k];
        }
    });
}

/// `out = A x`; gives `x · A x`.
pub(super) fn multiply<const K: usize>(
    matrix: &Sparse<f64>,
    x: &[[f64; K]],
    out: &mut [[f64; K]],
) -> [f64; K] {
    let chunks = out.par_chunks_mut(CHUNK).enumerate();
    let sums: Vec<[f64; K]> = chunks
        .map(|(chunk, out)| {
            let mut total = [0.0; K];
            for (row, out) in (chunk * CHUNK..).zip(out) {
                let (columns, values) = matrix.row(row);
                let mut sum = [0.0; K];
                for (&column, value) in columns.iter().zip(values) {
                    let x = &x[column as usize];
                    (0..K).for_each(|k| sum[k] += value * x[k]);
                }
                (0..K).for_each(|k| total[k] += sum[k] * x[row][k]);
                *out = sum;
            }
            total
        })
        .collect();
    in_order(&sums)
}

fn dot<const K: usize>(r: &[[f64; K]], z: &[[f32; K]]) -> [f64; K] {
    let chunk = |(r, z): (&[[f64; K]], &[[f32; K]])| {
        let mut sum = [0.0; K];
        for (r, z) in r.iter().zip(z) {
            (0..K).for_each(|k| sum[k] += r[k] * f64::from(z[k]));
        }
        sum
    };
    in_order(&r.par_chunks(CHUNK).zip(z.par_chunks(CHUNK)).map(chunk).collect::<Vec<_>>())
}

/// Sums of chunks, added up in order.
pub(super) fn in_order<const K: usize>(sums: &[[f64; K]]) -> [f64; K] {
    sums.iter().fold([0.0; K], |total, sum| std::array::from_fn(|k| total[k] + sum[k]))
}
