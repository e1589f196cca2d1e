//! Random systems of the kind that meshes give.
#![allow(dead_code)] // each test file uses its own part

use qsolve::{CsrMatrix, DMatrix, Triplets};

/// Numbers in `[0, 1)` from a seed (xorshift, so that no version of a library changes them).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The edges of a grid, each once; vertices that lie outside are `None`.
pub(crate) fn grid_edges(side: usize) -> Vec<[Option<usize>; 2]> {
    let at = |x: usize, y: usize| {
        let inside = (1..=side).contains(&x) && (1..=side).contains(&y);
        inside.then(|| (y - 1) * side + x - 1)
    };
    let all = (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y)));
    all.flat_map(|(x, y)| [[at(x, y), at(x + 1, y)], [at(x, y), at(x, y + 1)]]).collect()
}

/// The Laplacian of a grid with random weights and Dirichlet values around: a symmetric M-matrix.
pub(crate) fn spd(side: usize, contrast: f64, random: &mut Random) -> CsrMatrix<f64> {
    let n = side * side;
    let mut triplets = Triplets::new(n, n);
    for edge in grid_edges(side) {
        let weight = contrast.powf(random.next());
        for (here, there) in [(edge[0], edge[1]), (edge[1], edge[0])] {
            if let Some(here) = here {
                triplets.add(here, here, weight);
                if let Some(there) = there {
                    triplets.add(here, there, -weight);
                }
            }
        }
    }
    triplets.build().expect("all entries lie inside")
}

/// `I − Λ` with random Λ of row sum at most one: the row-normalised system of a grid, not symmetric.
pub(crate) fn row_normalized(side: usize, random: &mut Random) -> CsrMatrix<f64> {
    let n = side * side;
    let mut weights = vec![Vec::new(); n];
    for edge in grid_edges(side) {
        for (here, there) in [(edge[0], edge[1]), (edge[1], edge[0])] {
            if let Some(here) = here {
                weights[here].push((there, 0.2 + random.next()));
            }
        }
    }
    let mut triplets = Triplets::new(n, n);
    for (here, row) in weights.iter().enumerate() {
        let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
        triplets.add(here, here, 1.0);
        for &(there, weight) in row {
            if let Some(there) = there {
                triplets.add(here, there, -weight / sum);
            }
        }
    }
    triplets.build().expect("all entries lie inside")
}

/// Right-hand sides with entries in `[-1, 1)`.
pub(crate) fn rhs(rows: usize, columns: usize, random: &mut Random) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| 2.0 * random.next() - 1.0)
}

/// The largest difference of two answers.
pub(crate) fn distance(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    (a - b).amax()
}

/// The matrix with all its zeros.
pub(crate) fn dense(matrix: &CsrMatrix<f64>) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(matrix.nrows(), matrix.ncols());
    for (row, column, value) in matrix.triplet_iter() {
        dense[(row, column)] = *value;
    }
    dense
}
