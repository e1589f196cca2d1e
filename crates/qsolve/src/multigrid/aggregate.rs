//! Aggregates: which rows of a level become one row of the next.

use super::block::square;
use super::matrix::BlockMatrix;

/// Stands for "in no aggregate": a row that is coupled to nothing, which the smoother solves exactly.
pub(crate) const NONE: u32 = u32::MAX;

/// Which couplings count.
#[derive(Clone, Debug)]
pub(super) enum Strong {
    /// All that the pattern has.
    All,
    /// One flag a block.
    Flagged(Vec<bool>),
}

impl Strong {
    /// `‖aᵢⱼ‖² > θ² ‖aᵢᵢ‖ ‖aⱼⱼ‖` [Vaněk, Mandel, Brezina 1996]; with θ = 0 everything in the pattern.
    pub(super) fn new<const B: usize>(matrix: &BlockMatrix<B>, theta: f64) -> Self {
        if theta <= 0.0 {
            return Self::All;
        }
        let size: Vec<f64> = (0..matrix.rows()).map(|row| square(&matrix.diagonal(row)).sqrt()).collect();
        let mut flags = Vec::with_capacity(matrix.columns.len());
        for row in 0..matrix.rows() {
            let (columns, blocks) = matrix.row(row);
            flags.extend(columns.iter().zip(blocks).map(|(&column, block)| {
                let column = column as usize;
                column == row || square(block) > theta * theta * size[row] * size[column]
            }));
        }
        Self::Flagged(flags)
    }

    /// The rows that `row` is strongly coupled to, without itself.
    pub(super) fn neighbors<'a, const B: usize>(
        &'a self,
        matrix: &'a BlockMatrix<B>,
        row: usize,
    ) -> impl Iterator<Item = usize> + 'a {
        let entries = matrix.range(row).filter(|&at| self.is(at));
        entries.map(|at| matrix.columns[at] as usize).filter(move |&column| column != row)
    }

    /// Whether block number `at` counts.
    #[inline]
    pub(super) fn is(&self, at: usize) -> bool {
        match self {
            Self::All => true,
            Self::Flagged(flags) => flags[at],
        }
    }
}

/// The aggregate of every row, and how many there are; `neighbors` are what a row is strongly coupled to, without itself.
///
/// Greedy, in the order of the rows: whoever has only free neighbours takes them all; those left over join the neighbour
/// they are tied to most often; what then still has neighbours but no aggregate founds its own.
pub(crate) fn aggregate<I: Iterator<Item = usize>>(
    rows: usize,
    neighbors: impl Fn(usize) -> I,
) -> (Vec<u32>, usize) {
    let mut of = vec![NONE; rows];
    let mut count = 0;
    for row in 0..rows {
        if of[row] == NONE && neighbors(row).next().is_some() && neighbors(row).all(|n| of[n] == NONE) {
            of[row] = count;
            neighbors(row).for_each(|n| of[n] = count);
            count += 1;
        }
    }
    let founded = of.clone();
    for row in 0..rows {
        if founded[row] == NONE {
            of[row] = most_frequent(neighbors(row).map(|n| founded[n]));
        }
    }
    for row in 0..rows {
        if of[row] == NONE && neighbors(row).next().is_some() {
            of[row] = count;
            neighbors(row).for_each(|n| {
                if of[n] == NONE {
                    of[n] = count;
                }
            });
            count += 1;
        }
    }
    (of, count as usize)
}

/// The aggregate that comes up most often, the smaller number among equals.
fn most_frequent(aggregates: impl Iterator<Item = u32>) -> u32 {
    let mut seen: Vec<(u32, u32)> = Vec::with_capacity(8);
    for aggregate in aggregates.filter(|&aggregate| aggregate != NONE) {
        match seen.iter_mut().find(|(known, _)| *known == aggregate) {
            Some((_, times)) => *times += 1,
            None => seen.push((aggregate, 1)),
        }
    }
    seen.into_iter()
        .max_by_key(|&(aggregate, times)| (times, std::cmp::Reverse(aggregate)))
        .map_or(NONE, |(aggregate, _)| aggregate)
}
