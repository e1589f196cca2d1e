//! Which patches each tile of a picture may see, in as much memory as there are patches: however many tiles each covers.

/// Columns and rows of tiles, first and last, in the order of the patches.
pub(super) struct Bins(Vec<Span>);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) columns: [u16; 2],
    pub(super) rows: [u16; 2],
}

impl Bins {
    pub(super) fn new(spans: Vec<Span>) -> Self {
        Self(spans)
    }

    /// The patches of a row of tiles.
    pub(super) fn band(&self, row: usize) -> Band {
        let is_here = |span: &Span| (usize::from(span.rows[0])..=usize::from(span.rows[1])).contains(&row);
        let here = self.0.iter().enumerate().filter(|(_, span)| is_here(span));
        let mut to_come: Vec<Run> =
            here.map(|(patch, span)| Run { columns: span.columns, patch: patch as u32 }).collect();
        // The first columns come last, from where they are taken.
        to_come.sort_unstable_by_key(|run| std::cmp::Reverse((run.columns[0], run.patch)));
        Band { to_come, here: Vec::new() }
    }
}

/// A patch in a row of tiles.
#[derive(Clone, Copy)]
struct Run {
    columns: [u16; 2],
    patch: u32,
}

/// A row of tiles, gone through from left to right.
pub(super) struct Band {
    to_come: Vec<Run>,
    /// By patch.
    here: Vec<Run>,
}

impl Band {
    /// The patches of the next column, ascending; columns are to be asked for from left to right.
    pub(super) fn patches(&mut self, column: usize) -> impl ExactSizeIterator<Item = u32> + '_ {
        self.here.retain(|run| usize::from(run.columns[1]) >= column);
        let known = self.here.len();
        while let Some(run) = self.to_come.pop_if(|run| usize::from(run.columns[0]) <= column) {
            self.here.push(run);
        }
        if self.here.len() > known {
            // Two ascending runs, which this sort merges.
            self.here.sort_by_key(|run| run.patch);
        }
        self.here.iter().map(|run| run.patch)
    }
}

/// The tile, of so many along a side, in which a coordinate in tiles lies; the nearest one for what lies outside.
pub(super) fn tile(x: f64, count: usize) -> u16 {
    (x.max(0.0) as usize).min(count - 1) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each tile has the patches that cover it, in their order.
    #[test]
    fn tiles_have_what_covers_them() {
        let mut seed = 5_u64;
        let mut random = |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((seed >> 33) % below) as u16
        };
        let mut side = |below: u64| {
            let (a, b) = (random(below), random(below));
            [a.min(b), a.max(b)]
        };
        let spans: Vec<Span> = (0..300).map(|_| Span { columns: side(12), rows: side(9) }).collect();
        let bins = Bins::new(spans.clone());
        for row in 0..9 {
            let mut band = bins.band(usize::from(row));
            for column in 0..12 {
                let covers = |[from, to]: [u16; 2], place: u16| from <= place && place <= to;
                let expected: Vec<u32> = (0..300)
                    .filter(|&i| covers(spans[i].columns, column) && covers(spans[i].rows, row))
                    .map(|i| i as u32)
                    .collect();
                assert_eq!(band.patches(usize::from(column)).collect::<Vec<u32>>(), expected);
            }
        }
    }

    /// More pairs of patches and tiles than 32 bits count, which would not fit into memory either.
    #[test]
    fn faces_on_top_of_each_other_take_no_more_memory() {
        const SIDE: u16 = 512;
        let all = Span { columns: [0, SIDE - 1], rows: [0, SIDE - 1] };
        let bins = Bins::new(vec![all; 20_000]);
        let mut band = bins.band(usize::from(SIDE) - 1);
        for column in 0..usize::from(SIDE) {
            assert_eq!(band.patches(column).len(), 20_000);
        }
        assert!(band.to_come.is_empty() && band.here.capacity() < 100_000);
    }

    #[test]
    fn places_beyond_the_picture_belong_to_its_rim() {
        assert_eq!([-3.0, 0.5, 2.0, 9.0, f64::NAN].map(|x| tile(x, 3)), [0, 0, 2, 2, 0]);
    }
}
