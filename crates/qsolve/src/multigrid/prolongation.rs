//! The way from a level to the next finer one, and back.

use rayon::prelude::*;

use super::aggregate::{NONE, Strong};
use super::block::{Block, add_product, add_times, add_transposed_times, inverse};
use super::matrix::{BlockMatrix, MIN_ROWS, for_each_row_with};
use super::pattern::{Pattern, Transposed};

/// How far the prolongation is smoothed, over the largest eigenvalue [Vaněk, Mandel, Brezina 1996].
const DAMPING: f64 = 4.0 / 3.0;

/// `P = (1 − ω D⁻¹ A) T`, A without its weak couplings, which are added to its diagonal.
///
/// Stored in single precision: the coarse matrix is made of what is stored, `Pᵀ A P` in double precision, so it is as definite as
/// A, and the near-kernel is missed by a rounding error whose energy is the square of that.
#[derive(Clone, Debug)]
pub(super) struct Prolongation<const F: usize, const C: usize> {
    pattern: Pattern,
    values: Vec<[[f32; C]; F]>,
    transposed: Transposed,
}

/// What P is made of.
pub(super) struct Parts<'a, const F: usize, const C: usize> {
    pub(super) matrix: &'a BlockMatrix<F>,
    pub(super) strong: &'a Strong,
    /// Of each row; its block of T stands in that column.
    pub(super) aggregate: &'a [u32],
    /// T.
    pub(super) tentative: &'a [Block<F, C>],
    /// Of `D⁻¹ A`.
    pub(super) largest_eigenvalue: f64,
}

impl<const F: usize, const C: usize> Prolongation<F, C> {
    /// Where its blocks stand; the blocks are zero.
    pub(super) fn new(matrix: &BlockMatrix<F>, strong: &Strong, aggregate: &[u32], count: usize) -> Self {
        let pattern = Pattern::prolongation(matrix, strong, aggregate);
        let transposed = Transposed::new(&pattern, count);
        let values = vec![[[0.0; C]; F]; pattern.columns.len()];
        Self { pattern, values, transposed }
    }

    pub(super) fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    pub(super) fn transposed(&self) -> &Transposed {
        &self.transposed
    }

    /// Columns and blocks of a row.
    #[inline]
    pub(super) fn row(&self, row: usize) -> (&[u32], impl Iterator<Item = Block<F, C>>) {
        let first = self.pattern.starts[row] as usize;
        let columns = self.pattern.row(row);
        (columns, self.values[first..first + columns.len()].iter().map(widened))
    }

    /// New values.
    pub(super) fn refresh(&mut self, parts: &Parts<'_, F, C>) {
        let Self { pattern, values, .. } = self;
        for_each_row_with(&pattern.starts, values, Vec::new, |blocks, row, values| {
            blocks.clear();
            blocks.resize(values.len(), [[0.0; C]; F]);
            parts.smooth_row(row, pattern.row(row), blocks);
            let entries = values.iter_mut().flatten().flatten();
            entries.zip(blocks.iter().flatten().flatten()).for_each(|(to, &entry)| *to = entry as f32);
        });
    }

    /// `coarse = Pᵀ r`.
    pub(super) fn restrict(&self, r: &[[f64; F]], coarse: &mut [[f64; C]]) {
        coarse.par_iter_mut().with_min_len(MIN_ROWS / 4).enumerate().for_each(|(row, to)| {
            let mut sum = [0.0; C];
            for &(fine, at) in self.transposed.row(row) {
                add_transposed_times(&mut sum, &widened(&self.values[at as usize]), &r[fine as usize]);
            }
            *to = sum;
        });
    }

    /// `x += P coarse`.
    pub(super) fn prolong(&self, coarse: &[[f64; C]], x: &mut [[f64; F]]) {
        x.par_iter_mut().with_min_len(MIN_ROWS).enumerate().for_each(|(row, x)| {
            let (columns, blocks) = self.row(row);
            for (&column, block) in columns.iter().zip(blocks) {
                add_times(x, &block, &coarse[column as usize]);
            }
        });
    }
}

impl<const F: usize, const C: usize> Parts<'_, F, C> {
    /// One row of P, whose `blocks` stand in the columns `numbers` and are zero.
    fn smooth_row(&self, row: usize, numbers: &[u32], blocks: &mut [Block<F, C>]) {
        let &Self { matrix, strong, aggregate, tentative, largest_eigenvalue } = self;
        let own = aggregate[row];
        if own == NONE {
            return;
        }
        let mut diagonal = [[0.0; F]; F];
        let mut add = |number: u32, a: &Block<F, F>, t: &Block<F, C>| {
            if let Some(at) = numbers.iter().position(|&n| n == number) {
                add_product(&mut blocks[at], a, t);
            }
        };
        for at in matrix.range(row) {
            let (column, a) = (matrix.columns[at] as usize, &matrix.values[at]);
            if column == row || !strong.is(at) {
                diagonal.iter_mut().flatten().zip(a.iter().flatten()).for_each(|(d, a)| *d += a);
            } else if aggregate[column] != NONE {
                add(aggregate[column], a, &tentative[column]);
            }
        }
        add(own, &diagonal, &tentative[row]);
        // Where the weak couplings took the diagonal's definiteness, the tentative block stays unsmoothed.
        let mut scaled = inverse(&diagonal).unwrap_or([[0.0; F]; F]);
        scaled.iter_mut().flatten().for_each(|value| *value *= -DAMPING / largest_eigenvalue);
        for (block, &number) in blocks.iter_mut().zip(numbers) {
            let unsmoothed = if number == own { tentative[row] } else { [[0.0; C]; F] };
            let product = std::mem::replace(block, unsmoothed);
            add_product(block, &scaled, &product);
        }
    }
}

/// By loops over indices, which unroll; `map` within `map` is not inlined.
#[inline(always)]
#[allow(clippy::needless_range_loop)]
fn widened<const F: usize, const C: usize>(block: &[[f32; C]; F]) -> Block<F, C> {
    let mut wide = [[0.0; C]; F];
    for i in 0..F {
        for j in 0..C {
            wide[i][j] = f64::from(block[i][j]);
        }
    }
    wide
}
