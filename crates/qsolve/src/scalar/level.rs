//! One level: its matrix, its smoother, and the way to the next level and back.
//!
//! The smoother is Gauss–Seidel within chunks of rows and Jacobi between them. Half the couplings between chunks are added to the
//! diagonal: then forward and backward sweep together are a symmetric positive definite operation.

use rayon::prelude::*;

use super::sparse::{Sparse, Sums, Transposed, Value};
use crate::SolveError;
use crate::multigrid::{NONE, aggregate, for_each_row};

/// How far the prolongation is smoothed [Vaněk, Mandel, Brezina 1996]: 4/3 over the largest eigenvalue of `D⁻¹ A`, which is at most one when
/// D are the sums of magnitudes of the rows.
const DAMPING: f64 = 4.0 / 3.0;

/// Rows that one task takes at least.
const GRAIN: usize = 1024;

/// A level whose matrix is stored as `T`.
#[derive(Debug)]
pub(super) struct Level<T> {
    pub(super) matrix: Sparse<T>,
    /// Rows of a chunk of the smoother; depends on the number of rows alone.
    chunk: usize,
    /// One over the diagonal with its excess.
    inverse: Vec<f32>,
    prolongation: Sparse<f32>,
    restriction: Transposed,
}

/// Rows that one chunk of the smoother of a matrix takes.
pub(super) fn chunk_of(rows: usize) -> usize {
    (rows / 32).clamp(256, 1 << 17)
}

impl<T: Value> Level<T> {
    /// The level and the matrix of the next one. Couplings above `theta` times the geometric mean of the diagonals are strong.
    pub(super) fn new(matrix: Sparse<T>, theta: f64) -> Result<(Self, Sparse<f32>), SolveError> {
        let chunk = chunk_of(matrix.rows());
        let inverse = inverse_diagonal(&matrix, chunk)?;
        let strong = strong(&matrix, theta);
        let neighbors = |row: usize| {
            let entries = matrix.range(row).filter(|&at| strong[at]);
            entries.map(|at| matrix.columns[at] as usize).filter(move |&column| column != row)
        };
        let (of, count) = aggregate(matrix.rows(), neighbors);
        let prolongation = prolongation(&matrix, &strong, &of);
        drop((strong, of));
        let restriction = Transposed::new(&prolongation, count);
        let coarse = galerkin(&matrix, &prolongation, &restriction);
        Ok((Self { matrix, chunk, inverse, prolongation, restriction }, coarse))
    }

    /// `x = (D + L)⁻¹ b`, L below the diagonal within each chunk.
    pub(super) fn forward<V: Value, const K: usize>(&self, b: &[[V; K]], x: &mut [[f32; K]]) {
        x.par_chunks_mut(self.chunk).enumerate().for_each(|(number, x)| {
            let first = number * self.chunk;
            for place in 0..x.len() {
                let row = first + place;
                let mut left = b[row].map(Value::single);
                let (columns, values) = self.matrix.row(row);
                for (&column, &value) in columns.iter().zip(values) {
                    let column = column as usize;
                    if column >= row {
                        break;
                    }
                    if column >= first {
                        subtract(&mut left, value.single(), &x[column - first]);
                    }
                }
                x[place] = left.map(|left| self.inverse[row] * left);
            }
        });
    }

    /// `r = b − A x` for what [`Level::forward`] made of `b`: most of the sum is known to vanish.
    pub(super) fn residual<const K: usize>(&self, x: &[[f32; K]], r: &mut [[f32; K]]) {
        r.par_chunks_mut(self.chunk).enumerate().for_each(|(number, r)| {
            let first = number * self.chunk;
            let end = first + r.len();
            for (row, r) in (first..).zip(r) {
                let (mut left, mut excess) = ([0.0; K], 0.0);
                let (columns, values) = self.matrix.row(row);
                for (&column, &value) in columns.iter().zip(values) {
                    let (column, value) = (column as usize, value.single());
                    if column > row || column < first {
                        subtract(&mut left, value, &x[column]);
                    }
                    if column < first || column >= end {
                        excess += 0.5 * value.abs();
                    }
                }
                *r = std::array::from_fn(|k| left[k] + excess * x[row][k]);
            }
        });
    }

    /// `new = x + (D + U)⁻¹ (b − A x)`, U above the diagonal within each chunk.
    pub(super) fn backward<V: Value, const K: usize>(
        &self,
        b: &[[V; K]],
        x: &[[f32; K]],
        new: &mut [[f32; K]],
    ) {
        new.par_chunks_mut(self.chunk).enumerate().for_each(|(number, new)| {
            let first = number * self.chunk;
            let end = first + new.len();
            for row in (first..end).rev() {
                let mut left = b[row].map(Value::single);
                let (columns, values) = self.matrix.row(row);
                for (&column, &value) in columns.iter().zip(values) {
                    let column = column as usize;
                    let is_new = column > row && column < end;
                    let at = if is_new { &new[column - first] } else { &x[column] };
                    subtract(&mut left, value.single(), at);
                }
                new[row - first] = std::array::from_fn(|k| x[row][k] + self.inverse[row] * left[k]);
            }
        });
    }

    /// `coarse = Pᵀ r`.
    pub(super) fn restrict<const K: usize>(&self, r: &[[f32; K]], coarse: &mut [[f32; K]]) {
        coarse.par_iter_mut().with_min_len(GRAIN / 4).enumerate().for_each(|(row, to)| {
            let mut sum = [0.0; K];
            for (fine, value) in self.restriction.entries(&self.prolongation, row) {
                (0..K).for_each(|k| sum[k] += value * r[fine as usize][k]);
            }
            *to = sum;
        });
    }

    /// `x += P coarse`.
    pub(super) fn prolong<const K: usize>(&self, coarse: &[[f32; K]], x: &mut [[f32; K]]) {
        x.par_iter_mut().with_min_len(GRAIN).enumerate().for_each(|(row, x)| {
            let (numbers, values) = self.prolongation.row(row);
            for (&number, value) in numbers.iter().zip(values) {
                (0..K).for_each(|k| x[k] += value * coarse[number as usize][k]);
            }
        });
    }
}

#[inline(always)]
fn subtract<const K: usize>(left: &mut [f32; K], value: f32, x: &[f32; K]) {
    (0..K).for_each(|k| left[k] -= value * x[k]);
}

/// One over the diagonal with its excess.
fn inverse_diagonal<T: Value>(matrix: &Sparse<T>, chunk: usize) -> Result<Vec<f32>, SolveError> {
    let inverse = |row: usize| {
        let first = row / chunk * chunk;
        let (columns, values) = matrix.row(row);
        let (mut diagonal, mut excess) = (0.0, 0.0);
        for (&column, value) in columns.iter().zip(values) {
            let column = column as usize;
            if column == row {
                diagonal = value.double();
            } else if !(first..first + chunk).contains(&column) {
                excess += 0.5 * value.double().abs();
            }
        }
        if diagonal > 0.0 { (diagonal + excess).recip() as f32 } else { f32::NAN }
    };
    let inverses: Vec<f32> = (0..matrix.rows()).into_par_iter().with_min_len(GRAIN).map(inverse).collect();
    match inverses.iter().position(|&inverse| !(inverse.is_finite() && inverse > 0.0)) {
        Some(row) => Err(SolveError::NotPositiveDefinite { row: Some(row) }),
        None => Ok(inverses),
    }
}

/// Which entries are strong couplings: `aᵢⱼ² > θ² aᵢᵢ aⱼⱼ` [Vaněk, Mandel, Brezina 1996].
fn strong<T: Value>(matrix: &Sparse<T>, theta: f64) -> Vec<bool> {
    let mut size = vec![0.0_f32; matrix.rows()];
    size.par_iter_mut()
        .with_min_len(GRAIN)
        .enumerate()
        .for_each(|(row, to)| *to = matrix.diagonal(row).sqrt() as f32);
    let mut strong = vec![false; matrix.columns.len()];
    for_each_row(&matrix.starts, &mut strong, |row, flags| {
        let (columns, values) = matrix.row(row);
        for ((flag, &column), &value) in flags.iter_mut().zip(columns).zip(values) {
            let column = column as usize;
            let bound = theta * f64::from(size[row]) * f64::from(size[column]);
            *flag = column == row || value.double().abs() > bound;
        }
    });
    strong
}

/// `P = (1 − ω D⁻¹ A) T`: T joins the rows of each aggregate; A without its weak couplings, which are added to its diagonal; D the sums of
/// magnitudes of its rows.
fn prolongation<T: Value>(matrix: &Sparse<T>, strong: &[bool], aggregate: &[u32]) -> Sparse<f32> {
    Sparse::of_rows(matrix.rows(), |row, sums: &mut Sums| {
        let own = aggregate[row];
        if own == NONE {
            return;
        }
        let (mut diagonal, mut others) = (0.0, 0.0);
        for at in matrix.range(row) {
            let value = matrix.values[at].double();
            if matrix.columns[at] as usize == row || !strong[at] {
                diagonal += value;
            } else {
                others += value.abs();
            }
        }
        // Where the weak couplings took the diagonal's definiteness, nothing is smoothed.
        let omega = if diagonal > 0.0 { DAMPING / (diagonal + others) } else { 0.0 };
        sums.add(own, 1.0 - omega * diagonal);
        for at in matrix.range(row).filter(|&at| strong[at]) {
            let column = matrix.columns[at] as usize;
            if column != row && aggregate[column] != NONE {
                sums.add(aggregate[column], -omega * matrix.values[at].double());
            }
        }
    })
}

/// `Pᵀ A P`, row by row, so that `A P` is never stored.
fn galerkin<T: Value>(
    matrix: &Sparse<T>,
    prolongation: &Sparse<f32>,
    restriction: &Transposed,
) -> Sparse<f32> {
    Sparse::of_rows(restriction.rows(), |coarse, sums| {
        for (row, share) in restriction.entries(prolongation, coarse) {
            let (columns, values) = matrix.row(row as usize);
            for (&column, value) in columns.iter().zip(values) {
                let product = share.double() * value.double();
                let (numbers, parts) = prolongation.row(column as usize);
                for (&number, part) in numbers.iter().zip(parts) {
                    sums.add(number, product * part.double());
                }
            }
        }
    })
}
