//! The cells that are taken.

use std::collections::HashMap;

use super::cover::Cover;

/// With more islands than this, islands of one size look for room only above the last of them.
const MANY: usize = 2000;

/// Rows of cells, 64 to a word; bit `x % 64` of word `x / 64` is cell `x`.
pub(super) struct Bitmap {
    width: u32,
    words: usize,
    height: Option<u32>,
    rows: Vec<u64>,
    /// For covers of a size, the first row where there may be room.
    hints: Option<HashMap<[u32; 2], u32>>,
}

impl Bitmap {
    pub(super) fn new(width: u32, height: Option<u32>, islands: usize) -> Self {
        let words = (width as usize).div_ceil(64);
        Self { width, words, height, rows: Vec::new(), hints: (islands > MANY).then(HashMap::new) }
    }

    /// Takes the cells of `cover` in the lowest row, and there at the leftmost place, that has room. The lower left cell
    /// of the place; nothing when there is none.
    pub(super) fn put(&mut self, cover: &Cover) -> Option<[u32; 2]> {
        let last_x = self.width.checked_sub(cover.width())?;
        let last_y = match self.height {
            Some(height) => height.checked_sub(cover.height())?,
            None => u32::MAX,
        };
        let size = [cover.width(), cover.height()];
        let from = self.hints.as_ref().and_then(|hints| hints.get(&size)).copied().unwrap_or(0);
        // Long runs are the most likely to be in the way.
        let mut order: Vec<u32> = (0..cover.height()).collect();
        let longest = |row: u32| cover.row(row).iter().map(|run| run[1] - run[0]).max().unwrap_or(0);
        order.sort_by_key(|&row| std::cmp::Reverse(longest(row)));
        let mut scratch = vec![0; self.words];
        let mut blocked = vec![0; self.words];
        for y in from..=last_y {
            if let Some(x) = self.first_place(cover, y, last_x, &order, &mut blocked, &mut scratch) {
                self.take(cover, x, y);
                if let Some(hints) = &mut self.hints {
                    hints.insert(size, y);
                }
                return Some([x, y]);
            }
        }
        None
    }

    fn first_place(
        &self,
        cover: &Cover,
        y: u32,
        last_x: u32,
        order: &[u32],
        blocked: &mut [u64],
        scratch: &mut [u64],
    ) -> Option<u32> {
        blocked.fill(0);
        for &row in order {
            let Some(taken) = self.row(y + row) else { continue };
            for &[from, to] in cover.row(row) {
                shift_down(taken, from, scratch);
                // Any of the cells from .. to, by doubling.
                let (mut length, total) = (1, to - from);
                while length < total {
                    let step = length.min(total - length);
                    or_shifted_down(scratch, step);
                    length += step;
                }
                blocked.iter_mut().zip(scratch.iter()).for_each(|(blocked, word)| *blocked |= word);
            }
            first_free(blocked, last_x)?;
        }
        first_free(blocked, last_x)
    }

    /// The words of a row; nothing above the highest one that has a taken cell.
    fn row(&self, y: u32) -> Option<&[u64]> {
        let start = y as usize * self.words;
        self.rows.get(start..start + self.words)
    }

    fn take(&mut self, cover: &Cover, x: u32, y: u32) {
        let needed = (y + cover.height()) as usize * self.words;
        if self.rows.len() < needed {
            self.rows.resize(needed, 0);
        }
        for row in 0..cover.height() {
            let start = (y + row) as usize * self.words;
            for cell in cover.row(row).iter().flat_map(|&[from, to]| from + x..to + x) {
                self.rows[start + cell as usize / 64] |= 1 << (cell % 64);
            }
        }
    }
}

/// The first cell up to `last` whose bit is not set.
fn first_free(blocked: &[u64], last: u32) -> Option<u32> {
    let place = blocked.iter().position(|&word| word != u64::MAX)?;
    let cell = place as u32 * 64 + blocked[place].trailing_ones();
    (cell <= last).then_some(cell)
}

/// Bit `x` of the target is bit `x + by` of the source.
fn shift_down(source: &[u64], by: u32, target: &mut [u64]) {
    let (words, bits) = ((by / 64) as usize, by % 64);
    for (i, word) in target.iter_mut().enumerate() {
        let here = source.get(i + words).copied().unwrap_or(0);
        let above = source.get(i + words + 1).copied().unwrap_or(0);
        *word = if bits == 0 { here } else { here >> bits | above << (64 - bits) };
    }
}

/// Adds to each bit `x` the bit `x + by`.
fn or_shifted_down(words: &mut [u64], by: u32) {
    let (whole, bits) = ((by / 64) as usize, by % 64);
    // Upwards, so that what is read has not been written yet.
    for i in 0..words.len() {
        let here = words.get(i + whole).copied().unwrap_or(0);
        let above = words.get(i + whole + 1).copied().unwrap_or(0);
        words[i] |= if bits == 0 { here } else { here >> bits | above << (64 - bits) };
    }
}
