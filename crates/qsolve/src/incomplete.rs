//! ILU(0): an LU factorization that drops whatever falls outside the pattern of the matrix.
//!
//! Of a symmetric matrix it is the incomplete Cholesky factorization `L D Lᵀ`, so conjugate gradients can use it too.

use std::ops::Range;

use nalgebra_sparse::CsrMatrix;

/// Stands for "not in this row".
const ABSENT: u32 = u32::MAX;

/// As many looks at a table cost about as much as a search.
const FEW: usize = 8;

/// `M = L U ≈ A` on the pattern of `A`; `L` has ones on its diagonal.
#[derive(Clone, Debug)]
pub(crate) struct IncompleteLu {
    offsets: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<usize>,
    inverse_diagonal: Vec<f64>,
}

impl IncompleteLu {
    /// The factors, or nothing when a pivot vanishes or, with `positive`, is not positive.
    pub(crate) fn new(matrix: &CsrMatrix<f64>, positive: bool) -> Option<Self> {
        let (offsets, columns, values) = matrix.csr_data();
        let mut factors = Self {
            offsets: offsets.to_vec(),
            columns: columns.iter().map(|&column| column as u32).collect(),
            values: values.to_vec(),
            diagonal: Vec::with_capacity(matrix.nrows()),
            inverse_diagonal: Vec::with_capacity(matrix.nrows()),
        };
        let mut place_of = vec![ABSENT; matrix.nrows()];
        for row in 0..matrix.nrows() {
            let largest = factors.eliminate(row, &mut place_of)?;
            let pivot = factors.values[factors.diagonal[row]];
            let usable = pivot.is_finite() && pivot.abs() > 1e-12 * largest && (pivot > 0.0 || !positive);
            if !usable {
                return None;
            }
            factors.inverse_diagonal.push(pivot.recip());
        }
        Some(factors)
    }

    /// Eliminates what lies left of the diagonal of `row`; gives the row's largest entry before that.
    fn eliminate(&mut self, row: usize, place_of: &mut [u32]) -> Option<f64> {
        let range = self.offsets[row]..self.offsets[row + 1];
        for place in range.clone() {
            place_of[self.columns[place] as usize] = (place - range.start) as u32;
        }
        let largest =
            self.values[range.clone()].iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let left = self.columns[range.clone()].partition_point(|&column| (column as usize) < row);
        for place in range.start..range.start + left {
            let pivot_row = self.columns[place] as usize;
            let factor = self.values[place] * self.inverse_diagonal[pivot_row];
            self.values[place] = factor;
            self.subtract(factor, pivot_row, place + 1..range.end, range.start, place_of);
        }
        for place in range.clone() {
            place_of[self.columns[place] as usize] = ABSENT;
        }
        let diagonal = range.start + left;
        let present = diagonal < range.end && self.columns[diagonal] as usize == row;
        self.diagonal.push(diagonal);
        present.then_some(largest)
    }

    /// Subtracts `factor` times what `pivot_row` has right of its diagonal from the entries at `rest`, which are in the same columns. Goes
    /// through the shorter of the two: a row with very many entries must not be gone through for each of them.
    fn subtract(
        &mut self,
        factor: f64,
        pivot_row: usize,
        rest: Range<usize>,
        start: usize,
        place_of: &[u32],
    ) {
        let above = self.diagonal[pivot_row] + 1..self.offsets[pivot_row + 1];
        if above.len() <= FEW * rest.len() {
            for above in above {
                let target = place_of[self.columns[above] as usize];
                if target != ABSENT {
                    self.values[start + target as usize] -= factor * self.values[above];
                }
            }
            return;
        }
        for target in rest {
            if let Ok(found) = self.columns[above.clone()].binary_search(&self.columns[target]) {
                self.values[target] -= factor * self.values[above.start + found];
            }
        }
    }

    /// `z = M⁻¹ r`.
    pub(crate) fn apply(&self, r: &[f64], z: &mut [f64]) {
        for row in 0..r.len() {
            let lower = self.offsets[row]..self.diagonal[row];
            z[row] = r[row] - self.row_product(lower, z);
        }
        for row in (0..r.len()).rev() {
            let upper = self.diagonal[row] + 1..self.offsets[row + 1];
            z[row] = (z[row] - self.row_product(upper, z)) * self.inverse_diagonal[row];
        }
    }

    #[inline]
    fn row_product(&self, places: Range<usize>, z: &[f64]) -> f64 {
        let row = self.columns[places.clone()].iter().zip(&self.values[places]);
        row.map(|(&column, &value)| value * z[column as usize]).sum()
    }
}
