//! The next level's matrix, `Pᵀ A P`.
//!
//! It is made patch by patch: a run of coarse rows, and the fine rows that share in them. Fine rows at a rim are multiplied once for each of
//! their patches; in return `A P`, which is larger than A, is never held as a whole.

use std::ops::Range;

use rayon::prelude::*;

use super::block::{Block, add_product, add_transposed_product};
use super::matrix::{BlockMatrix, chunks_of_rows};
use super::pattern::Transposed;
use super::prolongation::Prolongation;

/// For each run of `coarse_rows` coarse rows the fine rows that share in them, ascending.
#[derive(Clone, Debug)]
pub(super) struct Patches {
    coarse_rows: usize,
    fine_rows: Vec<Vec<u32>>,
}

impl Patches {
    pub(super) fn new(transposed: &Transposed) -> Self {
        let rows = transposed.rows();
        // Few rims, and yet some patches for every thread.
        let coarse_rows = (rows / 24).clamp(512, 4096);
        let fine_rows = (0..rows.div_ceil(coarse_rows)).into_par_iter().map(|patch| {
            let coarse = patch * coarse_rows..((patch + 1) * coarse_rows).min(rows);
            let mut fine: Vec<u32> =
                coarse.flat_map(|row| transposed.row(row)).map(|&(fine, _)| fine).collect();
            fine.sort_unstable();
            fine.dedup();
            fine.shrink_to_fit();
            fine
        });
        Self { coarse_rows, fine_rows: fine_rows.collect() }
    }

    /// Overwrites `coarse` with `Pᵀ A P`. Where the near-kernel of a coarse row lacks a direction, the diagonal gets a one.
    pub(super) fn galerkin<const F: usize, const C: usize>(
        &self,
        matrix: &BlockMatrix<F>,
        prolongation: &Prolongation<F, C>,
        kernel: &[Block<C, C>],
        coarse: &mut BlockMatrix<C>,
    ) {
        let BlockMatrix { starts, columns, values } = coarse;
        let patches = chunks_of_rows(starts, values, self.coarse_rows).into_par_iter().zip(&self.fine_rows);
        patches.for_each(|((rows, blocks), fine_rows)| {
            blocks.fill([[0.0; C]; C]);
            let mut patch = Patch { first: starts[rows.start] as usize, rows, starts, columns, blocks };
            let mut product = ProductRow { columns: Vec::new(), blocks: Vec::new() };
            for &fine in fine_rows {
                product.multiply(matrix.row(fine as usize), prolongation);
                patch.add(prolongation.row(fine as usize), &product);
            }
            patch.complete(kernel);
        });
    }
}

/// A row of `A P`.
struct ProductRow<const F: usize, const C: usize> {
    columns: Vec<u32>,
    blocks: Vec<Block<F, C>>,
}

impl<const F: usize, const C: usize> ProductRow<F, C> {
    fn multiply(&mut self, (columns, blocks): (&[u32], &[Block<F, F>]), prolongation: &Prolongation<F, C>) {
        self.columns.clear();
        self.blocks.clear();
        for (&column, a) in columns.iter().zip(blocks) {
            let (numbers, values) = prolongation.row(column as usize);
            for (&number, p) in numbers.iter().zip(values) {
                let at = self.columns.iter().position(|&known| known == number).unwrap_or_else(|| {
                    self.columns.push(number);
                    self.blocks.push([[0.0; C]; F]);
                    self.columns.len() - 1
                });
                add_product(&mut self.blocks[at], a, &p);
            }
        }
    }
}

/// Coarse rows in the making.
struct Patch<'a, const C: usize> {
    rows: Range<usize>,
    starts: &'a [u32],
    columns: &'a [u32],
    blocks: &'a mut [Block<C, C>],
    /// The number of the first of `blocks` in the whole matrix.
    first: usize,
}

impl<const C: usize> Patch<'_, C> {
    /// The share of one fine row: the transpose of its row of P, times its row of `A P`.
    fn add<const F: usize>(
        &mut self,
        (rows, values): (&[u32], impl Iterator<Item = Block<F, C>>),
        product: &ProductRow<F, C>,
    ) {
        for (&row, p) in rows.iter().zip(values) {
            if !self.rows.contains(&(row as usize)) {
                continue;
            }
            let (columns, blocks) = self.row(row as usize);
            for (number, block) in product.columns.iter().zip(&product.blocks) {
                if let Some(at) = columns.iter().position(|column| column == number) {
                    add_transposed_product(&mut blocks[at], &p, block);
                }
            }
        }
    }

    fn complete(&mut self, kernel: &[Block<C, C>]) {
        for row in self.rows.clone() {
            let (columns, blocks) = self.row(row);
            let Ok(at) = columns.binary_search(&(row as u32)) else { continue };
            for k in 0..C {
                if kernel[row][k][k] == 0.0 {
                    blocks[at][k][k] = 1.0;
                }
            }
        }
    }

    fn row(&mut self, row: usize) -> (&[u32], &mut [Block<C, C>]) {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        (&self.columns[range.clone()], &mut self.blocks[range.start - self.first..range.end - self.first])
    }
}
