//! Block Gauss–Seidel within chunks of rows, Jacobi between them.
//!
//! The chunks depend on the number of rows alone, so the result does not depend on the number of threads. Half the norms of the
//! couplings between chunks are added to the diagonal: then forward and backward sweep together make a symmetric positive
//! definite preconditioner of any symmetric positive definite matrix.

use rayon::prelude::*;

use super::block::{Block, add_times, inverse, square, subtract_times};
use super::matrix::{BlockMatrix, MIN_ROWS};
use crate::SolveError;

/// Steps of the power iteration, the first time and when values are refreshed.
const POWER_STEPS: [usize; 2] = [12, 2];
/// The power iteration approaches the eigenvalue from below.
const POWER_MARGIN: f64 = 1.05;

/// What a diagonal block that is singular but for rounding gets added, relative to its trace: a smoother may be a little lazy.
const SINGULAR_SHIFTS: [f64; 3] = [0.0, 1e-11, 1e-8];

#[derive(Clone, Debug)]
pub(super) struct Smoother<const F: usize> {
    /// Rows of a chunk.
    chunk: usize,
    /// Inverses of the diagonal with its excess.
    inverse: Vec<Block<F, F>>,
    /// What was added to the diagonal.
    excess: Vec<f64>,
    /// Iterate of the power iteration, and what it told.
    vector: Vec<[f64; F]>,
    eigenvalue: f64,
}

impl<const F: usize> Smoother<F> {
    pub(super) fn new(matrix: &BlockMatrix<F>) -> Self {
        let chunk = (matrix.rows() / 32).clamp(256, 16384);
        Self { chunk, inverse: Vec::new(), excess: Vec::new(), vector: Vec::new(), eigenvalue: 0.0 }
    }

    /// Inverts the diagonal, and estimates the largest eigenvalue anew.
    pub(super) fn refresh(&mut self, matrix: &BlockMatrix<F>) -> Result<(), SolveError> {
        self.invert(matrix)?;
        self.iterate_power(matrix);
        Ok(())
    }

    pub(super) fn invert(&mut self, matrix: &BlockMatrix<F>) -> Result<(), SolveError> {
        let mut inverses = std::mem::take(&mut self.inverse);
        let mut excess = std::mem::take(&mut self.excess);
        inverses.resize(matrix.rows(), [[0.0; F]; F]);
        excess.resize(matrix.rows(), 0.0);
        let rows = inverses.par_iter_mut().zip(&mut excess).with_min_len(MIN_ROWS).enumerate();
        let singular = rows.filter_map(|(row, (inverse, excess))| match self.inverted(matrix, row) {
            Some(inverted) => {
                (*inverse, *excess) = inverted;
                None
            }
            None => Some(row),
        });
        let singular = singular.min();
        (self.inverse, self.excess) = (inverses, excess);
        singular.map_or(Ok(()), |row| Err(SolveError::NotPositiveDefinite { row: Some(row) }))
    }

    /// The inverse of a row's diagonal with its excess, and the excess.
    fn inverted(&self, matrix: &BlockMatrix<F>, row: usize) -> Option<(Block<F, F>, f64)> {
        let excess = self.excess_of(matrix, row);
        let mut diagonal = matrix.diagonal(row);
        (0..F).for_each(|k| diagonal[k][k] += excess);
        let trace: f64 = (0..F).map(|k| diagonal[k][k]).sum();
        SINGULAR_SHIFTS.iter().find_map(|shift| {
            let mut shifted = diagonal;
            (0..F).for_each(|k| shifted[k][k] += shift * trace);
            inverse(&shifted).map(|inverse| (inverse, excess + shift * trace))
        })
    }

    fn excess_of(&self, matrix: &BlockMatrix<F>, row: usize) -> f64 {
        let first = row / self.chunk * self.chunk;
        let (columns, blocks) = matrix.row(row);
        let outside = |column: u32| !(first..first + self.chunk).contains(&(column as usize));
        let norms = columns.iter().zip(blocks).filter(|(column, _)| outside(**column));
        0.5 * norms.map(|(_, block)| square(block).sqrt()).sum::<f64>()
    }

    /// About the largest eigenvalue of `D⁻¹ A`.
    pub(super) fn largest_eigenvalue(&self) -> f64 {
        self.eigenvalue
    }

    fn iterate_power(&mut self, matrix: &BlockMatrix<F>) {
        let fresh = self.vector.is_empty();
        if fresh {
            // Neighbours differ, and nothing repeats: any oscillation has its share.
            let entry = |row: usize, k: usize| {
                let hash = (row * F + k + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40;
                hash as f64 / (1 << 24) as f64 - 0.5
            };
            self.vector = (0..matrix.rows()).map(|row| std::array::from_fn(|k| entry(row, k))).collect();
        }
        for _ in 0..POWER_STEPS[usize::from(!fresh)] {
            let x = &self.vector;
            let mut y: Vec<[f64; F]> = (0..matrix.rows())
                .into_par_iter()
                .with_min_len(MIN_ROWS)
                .map(|row| {
                    let (columns, blocks) = matrix.row(row);
                    let mut product = [0.0; F];
                    for (&column, block) in columns.iter().zip(blocks) {
                        add_times(&mut product, block, &x[column as usize]);
                    }
                    let mut y = [0.0; F];
                    add_times(&mut y, &self.inverse[row], &product);
                    y
                })
                .collect();
            let length = norm(&y);
            if !(length > 0.0 && length.is_finite()) {
                break;
            }
            self.eigenvalue = length / norm(x) * POWER_MARGIN;
            let scale = 1.0 / length;
            y.par_iter_mut().with_min_len(MIN_ROWS).for_each(|y| y.iter_mut().for_each(|y| *y *= scale));
            self.vector = y;
        }
        self.eigenvalue = self.eigenvalue.max(1.0);
    }

    /// `x = (D + L)⁻¹ b`, L below the diagonal within each chunk.
    pub(super) fn forward(&self, matrix: &BlockMatrix<F>, b: &[[f64; F]], x: &mut [[f64; F]]) {
        x.par_chunks_mut(self.chunk).enumerate().for_each(|(number, x)| {
            let first = number * self.chunk;
            for place in 0..x.len() {
                let row = first + place;
                let mut left = b[row];
                let (columns, blocks) = matrix.row(row);
                for (&column, block) in columns.iter().zip(blocks) {
                    let column = column as usize;
                    if column >= row {
                        break;
                    }
                    if column >= first {
                        subtract_times(&mut left, block, &x[column - first]);
                    }
                }
                let mut solved = [0.0; F];
                add_times(&mut solved, &self.inverse[row], &left);
                x[place] = solved;
            }
        });
    }

    /// `r = b − A x` for what [`Smoother::forward`] made of `b`: most of the sum is known to vanish.
    pub(super) fn residual(&self, matrix: &BlockMatrix<F>, x: &[[f64; F]], r: &mut [[f64; F]]) {
        r.par_chunks_mut(self.chunk).enumerate().for_each(|(number, r)| {
            let first = number * self.chunk;
            for (place, r) in r.iter_mut().enumerate() {
                let row = first + place;
                let mut left = x[row].map(|x| self.excess[row] * x);
                let (columns, blocks) = matrix.row(row);
                for (&column, block) in columns.iter().zip(blocks) {
                    let column = column as usize;
                    if column > row || column < first {
                        subtract_times(&mut left, block, &x[column]);
                    }
                }
                *r = left;
            }
        });
    }

    /// `x += (D + U)⁻¹ (b − A x)`, U above the diagonal within each chunk. `old` equals `x` before.
    pub(super) fn backward(
        &self,
        matrix: &BlockMatrix<F>,
        b: &[[f64; F]],
        old: &[[f64; F]],
        x: &mut [[f64; F]],
    ) {
        x.par_chunks_mut(self.chunk).enumerate().for_each(|(number, x)| {
            let first = number * self.chunk;
            for place in (0..x.len()).rev() {
                let row = first + place;
                let mut left = b[row];
                let (columns, blocks) = matrix.row(row);
                for (&column, block) in columns.iter().zip(blocks) {
                    let column = column as usize;
                    let value = x.get(column.wrapping_sub(first)).unwrap_or(&old[column]);
                    subtract_times(&mut left, block, value);
                }
                add_times(&mut x[place], &self.inverse[row], &left);
            }
        });
    }
}

/// In chunks of fixed size, so that the sum does not depend on the number of threads.
fn norm<const F: usize>(x: &[[f64; F]]) -> f64 {
    let chunk = |x: &[[f64; F]]| x.iter().flatten().map(|x| x * x).sum::<f64>();
    let sums: Vec<f64> = x.par_chunks(8192).map(chunk).collect();
    sums.iter().sum::<f64>().sqrt()
}
