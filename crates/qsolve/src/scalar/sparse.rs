//! Sparse matrices of one number an entry, with 32-bit indices.

use rayon::prelude::*;

use crate::SolveError;

/// Rows that one task takes.
const ROWS: usize = 2048;

/// A stored number: what is kept in single precision and what is kept in double.
pub(super) trait Value: Copy + Send + Sync {
    fn single(self) -> f32;
    fn double(self) -> f64;
}

impl Value for f32 {
    #[inline(always)]
    fn single(self) -> f32 {
        self
    }
    #[inline(always)]
    fn double(self) -> f64 {
        f64::from(self)
    }
}

impl Value for f64 {
    #[inline(always)]
    fn single(self) -> f32 {
        self as f32
    }
    #[inline(always)]
    fn double(self) -> f64 {
        self
    }
}

/// Of each row the columns, ascending, and their values.
#[derive(Clone, Debug)]
pub(super) struct Sparse<T> {
    pub(super) starts: Vec<u32>,
    pub(super) columns: Vec<u32>,
    pub(super) values: Vec<T>,
}

impl<T: Value> Sparse<T> {
    pub(super) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    #[inline(always)]
    pub(super) fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    #[inline(always)]
    pub(super) fn row(&self, row: usize) -> (&[u32], &[T]) {
        let range = self.range(row);
        (&self.columns[range.clone()], &self.values[range])
    }

    /// Zero where the pattern has no diagonal.
    pub(super) fn diagonal(&self, row: usize) -> f64 {
        let (columns, values) = self.row(row);
        columns.binary_search(&(row as u32)).map_or(0.0, |at| values[at].double())
    }
}

impl Sparse<f64> {
    pub(super) fn check_finite(&self) -> Result<(), SolveError> {
        let bad = |row: usize| {
            let (columns, values) = self.row(row);
            let at = values.iter().position(|value| !value.is_finite())?;
            Some(SolveError::NonFiniteEntry { row, column: columns[at] as usize })
        };
        let rows = (0..self.rows()).into_par_iter().with_min_len(ROWS);
        rows.filter_map(bad).find_first(|_| true).map_or(Ok(()), Err)
    }

    /// Divides by a power of two near the largest entry, so that single precision has room on both sides, and gives its exponent.
    /// That is even: square roots are divided exactly too.
    pub(super) fn normalize(&mut self) -> i32 {
        let sizes = self.values.par_iter().with_min_len(ROWS).map(|value| value.abs());
        let largest = sizes.reduce(|| 0.0, f64::max);
        if largest == 0.0 {
            return 0;
        }
        let exponent = 2 * (0.5 * largest.log2()).round() as i32;
        let values = self.values.par_iter_mut().with_min_len(ROWS);
        values.for_each(|value| *value = times_power_of_two(*value, -exponent));
        exponent
    }
}

/// `x · 2^exponent`: infinite where that is out of range.
pub(super) fn times_power_of_two(mut x: f64, mut exponent: i32) -> f64 {
    // In steps that are numbers themselves.
    while exponent != 0 {
        let step = exponent.clamp(-1000, 1000);
        x *= f64::from(step).exp2();
        exponent -= step;
    }
    x
}

impl Sparse<f32> {
    /// `collect(row, sums)` adds up the entries of a row, in any order.
    pub(super) fn of_rows(rows: usize, collect: impl Fn(usize, &mut Sums) + Sync) -> Self {
        let chunks: Vec<(Vec<u32>, Vec<u32>, Vec<f32>)> = (0..rows.div_ceil(ROWS))
            .into_par_iter()
            .map_init(Sums::default, |sums, chunk| {
                let range = chunk * ROWS..((chunk + 1) * ROWS).min(rows);
                let (mut ends, mut columns, mut values) = (Vec::with_capacity(ROWS), Vec::new(), Vec::new());
                for row in range {
                    collect(row, sums);
                    sums.drain(|column, value| {
                        columns.push(column);
                        values.push(value as f32);
                    });
                    ends.push(columns.len() as u32);
                }
                (ends, columns, values)
            })
            .collect();
        let entries = chunks.iter().map(|(_, columns, _)| columns.len()).sum();
        let mut joined = Self {
            starts: Vec::with_capacity(rows + 1),
            columns: Vec::with_capacity(entries),
            values: Vec::with_capacity(entries),
        };
        joined.starts.push(0);
        for (ends, columns, values) in chunks {
            let first = joined.columns.len() as u32;
            joined.starts.extend(ends.into_iter().map(|end| first + end));
            joined.columns.extend(columns);
            joined.values.extend(values);
        }
        joined
    }
}

/// A pattern by column: the rows that have an entry there, ascending, and where it stands in its row.
#[derive(Clone, Debug)]
pub(super) struct Transposed {
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// How many entries stand before it; of those further behind, the last number.
    offsets: Vec<u8>,
}

impl Transposed {
    pub(super) fn new(matrix: &Sparse<f32>, columns: usize) -> Self {
        // Starts of the columns, one place late, so that filling moves them where they belong.
        let mut starts = vec![0_u32; columns + 2];
        for &column in &matrix.columns {
            starts[column as usize + 2] += 1;
        }
        for column in 0..columns {
            starts[column + 2] += starts[column + 1];
        }
        let (mut rows, mut offsets) = (vec![0; matrix.columns.len()], vec![0; matrix.columns.len()]);
        for row in 0..matrix.rows() {
            for (offset, &column) in matrix.row(row).0.iter().enumerate() {
                let place = &mut starts[column as usize + 1];
                rows[*place as usize] = row as u32;
                offsets[*place as usize] = offset.min(usize::from(u8::MAX)) as u8;
                *place += 1;
            }
        }
        starts.pop();
        Self { starts, rows, offsets }
    }

    pub(super) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// The rows that have an entry in `column` of `matrix`, which this was made of, with that entry.
    #[inline(always)]
    pub(super) fn entries<'a>(
        &'a self,
        matrix: &'a Sparse<f32>,
        column: usize,
    ) -> impl Iterator<Item = (u32, f32)> + 'a {
        let range = self.starts[column] as usize..self.starts[column + 1] as usize;
        self.rows[range.clone()].iter().zip(&self.offsets[range]).map(move |(&row, &offset)| {
            let (columns, values) = matrix.row(row as usize);
            let offset = match offset {
                u8::MAX => columns.partition_point(|&other| (other as usize) < column),
                offset => usize::from(offset),
            };
            (row, values[offset])
        })
    }
}

/// Stands for an empty place in the table.
const EMPTY: u32 = u32::MAX;

/// The entries of one row as they add up: a hash table of columns.
#[derive(Debug)]
pub(super) struct Sums {
    entries: Vec<(u32, f64)>,
    /// Places in `entries`, at the hash of the column or after it; a power of two of them, half of them empty at least.
    table: Vec<u32>,
}

impl Default for Sums {
    fn default() -> Self {
        Self { entries: Vec::new(), table: vec![EMPTY; 64] }
    }
}

impl Sums {
    #[inline]
    pub(super) fn add(&mut self, column: u32, value: f64) {
        let place = self.place(column);
        match self.table[place] {
            EMPTY => {
                self.table[place] = self.entries.len() as u32;
                self.entries.push((column, value));
                if 2 * self.entries.len() > self.table.len() {
                    self.grow();
                }
            }
            at => self.entries[at as usize].1 += value,
        }
    }

    /// Where `column` stands in the table, or is to stand.
    #[inline]
    fn place(&self, column: u32) -> usize {
        let mask = self.table.len() - 1;
        let mut place = (column.wrapping_mul(0x9E37_79B1) >> 7) as usize & mask;
        while self.table[place] != EMPTY && self.entries[self.table[place] as usize].0 != column {
            place = (place + 1) & mask;
        }
        place
    }

    fn grow(&mut self) {
        self.table = vec![EMPTY; 2 * self.table.len()];
        for at in 0..self.entries.len() {
            let place = self.place(self.entries[at].0);
            self.table[place] = at as u32;
        }
    }

    /// Gives the entries by ascending column, and is empty then.
    fn drain(&mut self, mut give: impl FnMut(u32, f64)) {
        // Before they are sorted: places are found by the numbers that entries have now.
        for at in (0..self.entries.len()).rev() {
            let place = self.place(self.entries[at].0);
            self.table[place] = EMPTY;
        }
        self.entries.sort_unstable_by_key(|entry| entry.0);
        self.entries.drain(..).for_each(|(column, value)| give(column, value));
    }
}
