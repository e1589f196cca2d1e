//! One level: its matrix, its smoother, and the way to the next level and back.

use rayon::prelude::*;

use super::aggregate::{NONE, Strong, aggregate};
use super::block::{Block, add_product, add_times, add_transposed_product, add_transposed_times, inverse};
use super::kernel::{Members, Tentative};
use super::matrix::{BlockMatrix, MIN_ROWS, for_each_row};
use super::pattern::{Pattern, Transposed};
use super::smoother::Smoother;
use crate::SolveError;

/// How far the prolongation is smoothed, over the largest eigenvalue [Vaněk, Mandel, Brezina 1996].
const DAMPING: f64 = 4.0 / 3.0;

/// A level whose rows have `F` unknowns, and `C` in the next coarser one.
#[derive(Clone, Debug)]
pub(super) struct Level<const F: usize, const C: usize> {
    pub(super) matrix: BlockMatrix<F>,
    pub(super) smoother: Smoother<F>,
    strong: Strong,
    aggregate: Vec<u32>,
    members: Members,
    /// Pattern and values of the prolongation.
    pattern: Pattern,
    values: Vec<Block<F, C>>,
    transposed: Transposed,
    /// The pattern of matrix times prolongation.
    product: Pattern,
}

impl<const F: usize, const C: usize> Level<F, C> {
    /// Chooses aggregates by pattern and strength; nothing is computed from the values yet.
    pub(super) fn new(matrix: BlockMatrix<F>, theta: f64) -> Self {
        let strong = Strong::new(&matrix, theta);
        let (aggregate, count) = aggregate(matrix.rows(), |row| strong.neighbors(&matrix, row));
        let members = Members::new(&aggregate, count);
        let pattern = Pattern::prolongation(&matrix, &strong, &aggregate);
        let transposed = Transposed::new(&pattern, count);
        let product = pattern.product(&matrix);
        let values = vec![[[0.0; C]; F]; pattern.columns.len()];
        let smoother = Smoother::new(&matrix);
        Self { matrix, smoother, strong, aggregate, members, pattern, values, transposed, product }
    }

    /// The next level's matrix, still zero.
    pub(super) fn coarse_zeros(&self) -> Result<BlockMatrix<C>, SolveError> {
        let pattern = self.product.galerkin(&self.transposed);
        BlockMatrix::zeros(pattern.starts, pattern.columns)
    }

    /// Everything that depends on values: smoother, prolongation, the next level's matrix and its near-kernel.
    pub(super) fn refresh(
        &mut self,
        kernel: &[Block<F, C>],
        coarse: &mut BlockMatrix<C>,
    ) -> Result<Vec<Block<C, C>>, SolveError> {
        self.smoother.refresh(&self.matrix)?;
        let tentative = Tentative::new(kernel, &self.aggregate, &self.members);
        self.smooth_prolongation(&tentative.blocks);
        self.galerkin(coarse, &tentative.coarse);
        Ok(tentative.coarse)
    }

    /// `P = (1 − ω D⁻¹ A) T`, A without its weak couplings, which are added to its diagonal.
    fn smooth_prolongation(&mut self, tentative: &[Block<F, C>]) {
        let omega = DAMPING / self.smoother.largest_eigenvalue();
        let Self { matrix, strong, aggregate, pattern, values, .. } = self;
        let columns = &pattern.columns;
        for_each_row(&pattern.starts, values, |row, blocks| {
            let first = pattern.starts[row] as usize;
            let numbers = &columns[first..first + blocks.len()];
            blocks.fill([[0.0; C]; F]);
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
            let scaled = inverse(&diagonal).unwrap_or([[0.0; F]; F]);
            for (block, &number) in blocks.iter_mut().zip(numbers) {
                let product =
                    std::mem::replace(block, if number == own { tentative[row] } else { [[0.0; C]; F] });
                add_product(block, &scaled.map(|row| row.map(|value| -omega * value)), &product);
            }
        });
    }

    /// `Pᵀ A P`; a direction that an aggregate does not have gets a diagonal of one.
    fn galerkin(&self, coarse: &mut BlockMatrix<C>, kernel: &[Block<C, C>]) {
        let product = self.product_values();
        coarse.fill_rows(|row, columns, blocks| {
            blocks.fill([[0.0; C]; C]);
            for &(fine, at) in self.transposed.row(row) {
                let p = &self.values[at as usize];
                let first = self.product.starts[fine as usize] as usize;
                for (offset, number) in self.product.row(fine as usize).iter().enumerate() {
                    if let Some(to) = columns.iter().position(|column| column == number) {
                        add_transposed_product(&mut blocks[to], p, &product[first + offset]);
                    }
                }
            }
            if let Ok(at) = columns.binary_search(&(row as u32)) {
                for k in 0..C {
                    if kernel[row][k][k] == 0.0 {
                        blocks[at][k][k] = 1.0;
                    }
                }
            }
        });
    }

    /// `A P`.
    fn product_values(&self) -> Vec<Block<F, C>> {
        let mut product = vec![[[0.0; C]; F]; self.product.columns.len()];
        for_each_row(&self.product.starts, &mut product, |row, blocks| {
            let numbers = self.product.row(row);
            let (columns, matrix) = self.matrix.row(row);
            for (&column, a) in columns.iter().zip(matrix) {
                let first = self.pattern.starts[column as usize] as usize;
                for (offset, number) in self.pattern.row(column as usize).iter().enumerate() {
                    if let Some(to) = numbers.iter().position(|n| n == number) {
                        add_product(&mut blocks[to], a, &self.values[first + offset]);
                    }
                }
            }
        });
        product
    }

    /// `coarse = Pᵀ r`.
    pub(super) fn restrict(&self, r: &[[f64; F]], coarse: &mut [[f64; C]]) {
        coarse.par_iter_mut().with_min_len(MIN_ROWS / 4).enumerate().for_each(|(row, to)| {
            let mut sum = [0.0; C];
            for &(fine, at) in self.transposed.row(row) {
                add_transposed_times(&mut sum, &self.values[at as usize], &r[fine as usize]);
            }
            *to = sum;
        });
    }

    /// `x += P coarse`.
    pub(super) fn prolong(&self, coarse: &[[f64; C]], x: &mut [[f64; F]]) {
        x.par_iter_mut().with_min_len(MIN_ROWS).enumerate().for_each(|(row, x)| {
            let first = self.pattern.starts[row] as usize;
            for (offset, &number) in self.pattern.row(row).iter().enumerate() {
                add_times(x, &self.values[first + offset], &coarse[number as usize]);
            }
        });
    }
}
