//! Symmetric sparse matrices of small blocks.

use std::ops::Range;

use nalgebra_sparse::CsrMatrix;
use rayon::prelude::*;

use super::block::{Block, add_times};
use crate::SolveError;

/// A symmetric sparse matrix of `B × B` blocks: of each block row, the columns ascending.
#[derive(Clone, Debug)]
pub struct BlockMatrix<const B: usize> {
    pub(crate) starts: Vec<u32>,
    pub(crate) columns: Vec<u32>,
    pub(crate) values: Vec<Block<B, B>>,
}

impl<const B: usize> BlockMatrix<B> {
    /// The zero matrix with blocks at `columns[starts[i]..starts[i + 1]]` of each block row `i`.
    ///
    /// # Errors
    /// [`SolveError::OtherPattern`] when the columns of a row do not ascend or leave out the diagonal, or `starts` does not
    /// delimit them.
    pub fn zeros(starts: Vec<u32>, columns: Vec<u32>) -> Result<Self, SolveError> {
        let rows = starts.len().saturating_sub(1);
        let delimits = starts.first() == Some(&0)
            && starts.last().is_some_and(|&end| end as usize == columns.len())
            && starts.is_sorted();
        let fits = |row: usize| {
            let columns = &columns[starts[row] as usize..starts[row + 1] as usize];
            columns.is_sorted_by(|a, b| a < b)
                && columns.last().is_some_and(|&last| (last as usize) < rows)
                && columns.binary_search(&(row as u32)).is_ok()
        };
        if !delimits || !(0..rows).into_par_iter().with_min_len(4096).all(fits) {
            return Err(SolveError::OtherPattern);
        }
        let values = vec![[[0.0; B]; B]; columns.len()];
        Ok(Self { starts, columns, values })
    }

    /// Block rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Columns and blocks of a block row.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> (&[u32], &[Block<B, B>]) {
        let range = self.range(row);
        (&self.columns[range.clone()], &self.values[range])
    }

    #[inline]
    pub(super) fn range(&self, row: usize) -> Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// Overwrites every block row, in parallel: `fill(row, columns, blocks)`.
    pub fn fill_rows(&mut self, fill: impl Fn(usize, &[u32], &mut [Block<B, B>]) + Sync) {
        let (starts, columns) = (&self.starts, &self.columns);
        for_each_row(starts, &mut self.values, |row, values| {
            fill(row, &columns[starts[row] as usize..starts[row + 1] as usize], values);
        });
    }

    /// As [`BlockMatrix::fill_rows`], with something to work in that is made once for many rows.
    pub fn fill_rows_with<S>(
        &mut self,
        scratch: impl Fn() -> S + Sync,
        fill: impl Fn(&mut S, usize, &[u32], &mut [Block<B, B>]) + Sync,
    ) {
        let (starts, columns) = (&self.starts, &self.columns);
        for_each_row_with(starts, &mut self.values, scratch, |scratch, row, values| {
            fill(scratch, row, &columns[starts[row] as usize..starts[row + 1] as usize], values);
        });
    }

    /// Sets every block to zero.
    pub fn clear(&mut self) {
        self.values.par_iter_mut().with_min_len(1 << 14).for_each(|block| *block = [[0.0; B]; B]);
    }

    /// Changes the block rows `rows`, which ascend, in parallel: `change(scratch, row, blocks)`, with something to work in that is
    /// made once for many rows. Rows out of order are left as they are.
    pub fn change_rows_with<S>(
        &mut self,
        rows: &[u32],
        scratch: impl Fn() -> S + Sync + Send,
        change: impl Fn(&mut S, usize, &mut [Block<B, B>]) + Sync + Send,
    ) {
        let mut parts = Vec::with_capacity(rows.len());
        let (mut rest, mut passed) = (&mut self.values[..], 0);
        for &row in rows {
            let Some(range) = self.starts.get(row as usize..row as usize + 2) else { continue };
            let (start, end) = (range[0] as usize, range[1] as usize);
            if start < passed {
                continue;
            }
            let (_, tail) = rest.split_at_mut(start - passed);
            let (part, tail) = tail.split_at_mut(end - start);
            parts.push((row as usize, part));
            (rest, passed) = (tail, end);
        }
        let parts = parts.into_par_iter().with_min_len(MIN_ROWS);
        parts.for_each_init(scratch, |scratch, (row, part)| change(scratch, row, part));
    }

    /// The diagonal block of a row.
    #[must_use]
    pub fn diagonal(&self, row: usize) -> Block<B, B> {
        let (columns, values) = self.row(row);
        columns.binary_search(&(row as u32)).map_or([[0.0; B]; B], |at| values[at])
    }

    /// `y = A x`; `x` and `y` have `B` entries a block row.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        let x = x.as_chunks::<B>().0;
        let y = y.as_chunks_mut::<B>().0;
        y.par_iter_mut().with_min_len(MIN_ROWS).enumerate().for_each(|(row, y)| {
            let (columns, blocks) = self.row(row);
            let mut sum = [0.0; B];
            for (&column, block) in columns.iter().zip(blocks) {
                add_times(&mut sum, block, &x[column as usize]);
            }
            *y = sum;
        });
    }
}

impl BlockMatrix<1> {
    /// The same matrix.
    pub(crate) fn from_csr(matrix: &CsrMatrix<f64>) -> Result<Self, SolveError> {
        let (offsets, columns, values) = matrix.csr_data();
        if matrix.nnz() >= u32::MAX as usize {
            return Err(SolveError::TooLarge { unknowns: matrix.nrows() });
        }
        let starts = offsets.iter().map(|&start| start as u32).collect();
        let columns = columns.iter().map(|&column| column as u32).collect();
        let mut blocks = Self::zeros(starts, columns)?;
        blocks.values.iter_mut().zip(values).for_each(|(to, &value)| *to = [[value]]);
        Ok(blocks)
    }
}

/// Rows that one task takes at least.
pub(super) const MIN_ROWS: usize = 512;

/// Runs `act(row, values of the row)` for all rows, in parallel.
pub(crate) fn for_each_row<T: Send>(starts: &[u32], values: &mut [T], act: impl Fn(usize, &mut [T]) + Sync) {
    for_each_row_with(starts, values, || (), |(), row, values| act(row, values));
}

pub(super) fn for_each_row_with<T: Send, S>(
    starts: &[u32],
    values: &mut [T],
    scratch: impl Fn() -> S + Sync,
    act: impl Fn(&mut S, usize, &mut [T]) + Sync,
) {
    chunks_of_rows(starts, values, 2048).into_par_iter().for_each(|(range, mut chunk)| {
        let mut scratch = scratch();
        for row in range {
            let (values, tail) = chunk.split_at_mut((starts[row + 1] - starts[row]) as usize);
            act(&mut scratch, row, values);
            chunk = tail;
        }
    });
}

/// Runs of so many rows, each with its values.
pub(super) fn chunks_of_rows<'a, T>(
    starts: &[u32],
    values: &'a mut [T],
    rows_per_chunk: usize,
) -> Vec<(Range<usize>, &'a mut [T])> {
    let rows = starts.len() - 1;
    let mut chunks = Vec::with_capacity(rows / rows_per_chunk + 1);
    let mut rest = values;
    for first in (0..rows).step_by(rows_per_chunk) {
        let last = (first + rows_per_chunk).min(rows);
        let (chunk, tail) = rest.split_at_mut((starts[last] - starts[first]) as usize);
        chunks.push((first..last, chunk));
        rest = tail;
    }
    chunks
}
