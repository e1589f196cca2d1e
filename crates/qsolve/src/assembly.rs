//! From triplets to a sparse matrix.

use nalgebra_sparse::CsrMatrix;
use rayon::prelude::*;

use crate::SolveError;

/// Entries of a matrix in any order; entries of the same place add up.
///
/// ```
/// let mut triplets = qsolve::Triplets::new(2, 2);
/// triplets.add(0, 0, 1.0);
/// triplets.add(1, 1, 3.0);
/// triplets.add(0, 0, 1.0);
/// let matrix = triplets.build()?;
/// assert_eq!(matrix.values(), [2.0, 3.0]);
/// # Ok::<(), qsolve::SolveError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Triplets {
    rows: usize,
    columns: usize,
    entries: Vec<(u32, u32, f64)>,
    outside: Option<[usize; 2]>,
}

impl Triplets {
    /// No entries yet, of a matrix with `rows` rows and `columns` columns.
    #[must_use]
    pub fn new(rows: usize, columns: usize) -> Self {
        Self::with_capacity(rows, columns, 0)
    }

    /// As [`Triplets::new`], with room for `entries` entries.
    #[must_use]
    pub fn with_capacity(rows: usize, columns: usize, entries: usize) -> Self {
        Self { rows, columns, entries: Vec::with_capacity(entries), outside: None }
    }

    /// Adds `value` to the entry at (`row`, `column`). An entry outside the matrix is remembered, and
    /// [`Triplets::build`] refuses.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let fits = u32::MAX as usize;
        if row >= self.rows || column >= self.columns || row >= fits || column >= fits {
            self.outside.get_or_insert([row, column]);
        } else {
            self.entries.push((row as u32, column as u32, value));
        }
    }

    /// The matrix. Values of one place are added up in the order in which they came, so the same calls give the
    /// same bits. Entries that add up to zero stay in the pattern.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`] when some entry lay outside.
    pub fn build(&self) -> Result<CsrMatrix<f64>, SolveError> {
        if let Some([row, column]) = self.outside {
            return Err(SolveError::OutOfRange { row, column, rows: self.rows, columns: self.columns });
        }
        let (starts, mut sorted) = self.by_row();
        sort_rows(&starts, &mut sorted);
        Ok(compress(self.rows, self.columns, &starts, &sorted))
    }

    /// A counting sort by row that keeps the order inside each row.
    fn by_row(&self) -> (Vec<usize>, Vec<(u32, f64)>) {
        let mut starts = vec![0_usize; self.rows + 1];
        for &(row, _, _) in &self.entries {
            starts[row as usize + 1] += 1;
        }
        for row in 0..self.rows {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut sorted = vec![(0_u32, 0.0); self.entries.len()];
        for &(row, column, value) in &self.entries {
            let place = &mut next[row as usize];
            sorted[*place] = (column, value);
            *place += 1;
        }
        (starts, sorted)
    }
}

/// Sorts every row by column; a stable sort, so duplicates stay in the order in which they came.
fn sort_rows(starts: &[usize], entries: &mut [(u32, f64)]) {
    let mut rows: Vec<&mut [(u32, f64)]> = Vec::with_capacity(starts.len() - 1);
    let mut rest = entries;
    for pair in starts.windows(2) {
        let (row, tail) = rest.split_at_mut(pair[1] - pair[0]);
        rows.push(row);
        rest = tail;
    }
    rows.par_iter_mut().with_min_len(1024).for_each(|row| {
        if !row.is_sorted_by_key(|entry| entry.0) {
            row.sort_by_key(|entry| entry.0);
        }
    });
}

fn compress(rows: usize, columns: usize, starts: &[usize], sorted: &[(u32, f64)]) -> CsrMatrix<f64> {
    let mut offsets = Vec::with_capacity(rows + 1);
    let mut indices: Vec<usize> = Vec::with_capacity(sorted.len());
    let mut values: Vec<f64> = Vec::with_capacity(sorted.len());
    offsets.push(0);
    for pair in starts.windows(2) {
        let first = indices.len();
        for &(column, value) in &sorted[pair[0]..pair[1]] {
            match values.last_mut() {
                Some(last) if indices.len() > first && indices[indices.len() - 1] == column as usize => {
                    *last += value;
                }
                _ => {
                    indices.push(column as usize);
                    values.push(value);
                }
            }
        }
        offsets.push(indices.len());
    }
    CsrMatrix::try_from_csr_data(rows, columns, offsets, indices, values)
        .expect("rows are sorted, duplicates are merged and columns were checked")
}
