//! Where the blocks of prolongation and coarse matrix stand: found once, filled often.

use rayon::prelude::*;

use super::aggregate::{NONE, Strong};
use super::matrix::BlockMatrix;

/// Rows of column numbers, each ascending.
#[derive(Clone, Debug)]
pub(super) struct Pattern {
    pub(super) starts: Vec<u32>,
    pub(super) columns: Vec<u32>,
}

impl Pattern {
    #[inline]
    pub(super) fn row(&self, row: usize) -> &[u32] {
        &self.columns[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// `collect(row, list)` adds the columns of a row to `list`, in any order and with repetitions.
    fn of_rows(rows: usize, collect: impl Fn(usize, &mut Vec<u32>) + Sync) -> Self {
        const ROWS: usize = 2048;
        let chunks: Vec<(Vec<u32>, Vec<u32>)> = (0..rows.div_ceil(ROWS))
            .into_par_iter()
            .map(|chunk| {
                let (mut ends, mut columns, mut list) = (Vec::with_capacity(ROWS), Vec::new(), Vec::new());
                for row in chunk * ROWS..((chunk + 1) * ROWS).min(rows) {
                    list.clear();
                    collect(row, &mut list);
                    list.sort_unstable();
                    list.dedup();
                    columns.extend_from_slice(&list);
                    ends.push(columns.len() as u32);
                }
                (ends, columns)
            })
            .collect();
        let mut starts = Vec::with_capacity(rows + 1);
        starts.push(0);
        let mut columns = Vec::with_capacity(chunks.iter().map(|(_, columns)| columns.len()).sum());
        for (ends, chunk) in chunks {
            let first = columns.len() as u32;
            starts.extend(ends.into_iter().map(|end| first + end));
            columns.extend(chunk);
        }
        Self { starts, columns }
    }

    /// Of `(1 − ω D⁻¹ A) T`: the aggregates of a row's strong neighbours.
    pub(super) fn prolongation<const B: usize>(
        matrix: &BlockMatrix<B>,
        strong: &Strong,
        aggregate: &[u32],
    ) -> Self {
        Self::of_rows(matrix.rows(), |row, list| {
            let strong = matrix.range(row).filter(|&at| strong.is(at));
            let aggregates = strong.map(|at| aggregate[matrix.columns[at] as usize]);
            list.extend(aggregates.filter(|&number| number != NONE));
        })
    }

    /// Of the product of `matrix` with what has this pattern.
    pub(super) fn product<const B: usize>(&self, matrix: &BlockMatrix<B>) -> Self {
        Self::of_rows(matrix.rows(), |row, list| {
            for &column in matrix.row(row).0 {
                list.extend_from_slice(self.row(column as usize));
            }
        })
    }

    /// Of `Pᵀ Q`, `transposed` being that of P and `self` that of Q.
    pub(super) fn galerkin(&self, transposed: &Transposed) -> Self {
        Self::of_rows(transposed.rows(), |row, list| {
            list.push(row as u32);
            for &(fine, _) in transposed.row(row) {
                list.extend_from_slice(self.row(fine as usize));
            }
        })
    }
}

/// A pattern by column: which rows have a block there, and where among all blocks it stands.
#[derive(Clone, Debug)]
pub(super) struct Transposed {
    starts: Vec<u32>,
    places: Vec<(u32, u32)>,
}

impl Transposed {
    pub(super) fn new(pattern: &Pattern, columns: usize) -> Self {
        let mut starts = vec![0_u32; columns + 1];
        for &column in &pattern.columns {
            starts[column as usize + 1] += 1;
        }
        for column in 0..columns {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut places = vec![(0, 0); pattern.columns.len()];
        for row in 0..pattern.starts.len() - 1 {
            for at in pattern.starts[row]..pattern.starts[row + 1] {
                let place = &mut next[pattern.columns[at as usize] as usize];
                places[*place as usize] = (row as u32, at);
                *place += 1;
            }
        }
        Self { starts, places }
    }

    pub(super) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Pairs (row, place) of a column of the pattern, rows ascending.
    #[inline]
    pub(super) fn row(&self, column: usize) -> &[(u32, u32)] {
        &self.places[self.starts[column] as usize..self.starts[column + 1] as usize]
    }
}
