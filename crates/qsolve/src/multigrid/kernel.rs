//! The near-kernel: what the smoother cannot see, and the next level must be able to say exactly.

use rayon::prelude::*;

use super::aggregate::NONE;
use super::block::Block;

/// A column of the near-kernel whose part outside the others is below this fraction (of squares) is left out.
const DEPENDENT: f64 = 1e-12;

/// The near-kernel of a level in the bases of its aggregates: `B = T · coarse`, `Tᵀ T = 1` within each aggregate.
pub(super) struct Tentative<const F: usize, const C: usize> {
    /// `T`, one block a row; it stands in the column of the row's aggregate.
    pub(super) blocks: Vec<Block<F, C>>,
    /// The near-kernel of the next level.
    pub(super) coarse: Vec<Block<C, C>>,
}

impl<const F: usize, const C: usize> Tentative<F, C> {
    /// In the memory of `kernel`.
    pub(super) fn new(mut kernel: Vec<Block<F, C>>, aggregate: &[u32], members: &Members) -> Self {
        let factors: Vec<(Block<C, C>, Block<C, C>)> = (0..members.count())
            .into_par_iter()
            .with_min_len(256)
            .map(|number| orthonormalize(members.of(number).iter().map(|&row| &kernel[row as usize])))
            .collect();
        kernel.par_iter_mut().with_min_len(1024).zip(aggregate).for_each(|(block, &number)| {
            let inverse = factors.get(number as usize).map(|(_, inverse)| inverse);
            *block = inverse.map_or([[0.0; C]; F], |inverse| times(block, inverse));
        });
        Self { blocks: kernel, coarse: factors.into_iter().map(|(coarse, _)| coarse).collect() }
    }
}

/// `R` and the inverse with which `B = Q R`, `QᵀQ = 1`. A dependent column of `Q` is zero, and so is its row of `R`.
fn orthonormalize<'a, const F: usize, const C: usize>(
    blocks: impl Iterator<Item = &'a Block<F, C>>,
) -> (Block<C, C>, Block<C, C>) {
    let mut gram = [[0.0; C]; C];
    for block in blocks {
        for row in block {
            for i in 0..C {
                for j in i..C {
                    gram[i][j] += row[i] * row[j];
                }
            }
        }
    }
    let mut r = [[0.0; C]; C];
    for i in 0..C {
        let pivot = gram[i][i] - (0..i).map(|k| r[k][i] * r[k][i]).sum::<f64>();
        if pivot <= DEPENDENT * gram[i][i] {
            continue;
        }
        r[i][i] = pivot.sqrt();
        for j in i + 1..C {
            r[i][j] = (gram[i][j] - (0..i).map(|k| r[k][i] * r[k][j]).sum::<f64>()) / r[i][i];
        }
    }
    (r, inverse_of_upper(&r))
}

/// With zeros for the rows and columns that have no pivot.
fn inverse_of_upper<const C: usize>(r: &Block<C, C>) -> Block<C, C> {
    let mut inverse = [[0.0; C]; C];
    for column in 0..C {
        if r[column][column] == 0.0 {
            continue;
        }
        inverse[column][column] = 1.0 / r[column][column];
        for row in (0..column).rev() {
            if r[row][row] != 0.0 {
                let known: f64 = (row + 1..=column).map(|k| r[row][k] * inverse[k][column]).sum();
                inverse[row][column] = -known / r[row][row];
            }
        }
    }
    inverse
}

fn times<const F: usize, const C: usize>(a: &Block<F, C>, b: &Block<C, C>) -> Block<F, C> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..C).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The rows of each aggregate, ascending.
#[derive(Clone, Debug)]
pub(super) struct Members {
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl Members {
    pub(super) fn new(aggregate: &[u32], count: usize) -> Self {
        let mut starts = vec![0_u32; count + 1];
        for &number in aggregate.iter().filter(|&&number| number != NONE) {
            starts[number as usize + 1] += 1;
        }
        for number in 0..count {
            starts[number + 1] += starts[number];
        }
        let mut next = starts.clone();
        let mut rows = vec![0; starts[count] as usize];
        for (row, &number) in aggregate.iter().enumerate().filter(|(_, number)| **number != NONE) {
            let place = &mut next[number as usize];
            rows[*place as usize] = row as u32;
            *place += 1;
        }
        Self { starts, rows }
    }

    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn of(&self, number: usize) -> &[u32] {
        &self.rows[self.starts[number] as usize..self.starts[number + 1] as usize]
    }
}
