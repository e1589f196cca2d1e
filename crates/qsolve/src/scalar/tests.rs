//! What only this module sees: levels, cycles, orders.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use super::conjugate::{Preconditioner, multiply};
use super::elimination::{Eliminated, Elimination};
use super::hierarchy::{Cycles, Hierarchy};
use super::level::Level;
use super::order::{better_order, permuted};
use super::sparse::{Sparse, Sums, Transposed};

/// Springs of a `side × side` grid that nothing holds, of stiffness 1 to 3, and `held` more on the diagonal.
fn grid(side: usize, held: f64) -> Sparse<f64> {
    let n = side * side;
    let stiffness = |a: usize, b: usize| 1.0 + ((a.min(b) * 7 + a.max(b) * 13) % 5) as f64 / 2.0;
    let mut matrix = Sparse { starts: vec![0], columns: Vec::new(), values: Vec::new() };
    for row in 0..n {
        let (x, y) = (row % side, row / side);
        let inside = [
            (y > 0).then(|| row - side),
            (x > 0).then(|| row - 1),
            (x + 1 < side).then(|| row + 1),
            (y + 1 < side).then(|| row + side),
        ];
        let neighbors: Vec<usize> = inside.into_iter().flatten().collect();
        let sum: f64 = neighbors.iter().map(|&other| stiffness(row, other)).sum();
        let mut entries: Vec<(usize, f64)> = neighbors.iter().map(|&n| (n, -stiffness(row, n))).collect();
        entries.push((row, sum + held));
        entries.sort_by_key(|entry| entry.0);
        matrix.columns.extend(entries.iter().map(|entry| entry.0 as u32));
        matrix.values.extend(entries.iter().map(|entry| entry.1));
        matrix.starts.push(matrix.columns.len() as u32);
    }
    matrix
}

/// Numbers that look random, in `[-1, 1)`.
fn noise(n: usize, seed: u64) -> Vec<[f64; 1]> {
    let hash = |k: u64| (k + 1 + seed * 7919).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 11;
    (0..n as u64).map(|k| [hash(hash(k)) as f64 / (1_u64 << 52) as f64 - 1.0]).collect()
}

/// Constants pass the transfer between levels unchanged, so the coarse matrix of a free net maps them to zero too; and it is symmetric.
#[test]
fn a_free_net_stays_free_on_the_next_level() {
    let (level, coarse) = Level::new(grid(40, 0.0), 0.08).unwrap();
    let mut fine = vec![[0.0_f32]; 1600];
    level.prolong(&vec![[1.0_f32]; coarse.rows()], &mut fine);
    assert!(fine.iter().all(|x| (x[0] - 1.0).abs() < 1e-6));
    assert!((150..600).contains(&coarse.rows()), "{} of 1600 rows", coarse.rows());
    for row in 0..coarse.rows() {
        let (columns, values) = coarse.row(row);
        let (sum, size) = values.iter().fold((0.0, 0.0), |(sum, size), v| (sum + v, size + v.abs()));
        assert!(sum.abs() < 1e-5 * size, "row {row}");
        for (&column, &value) in columns.iter().zip(values) {
            let (others, mirrored) = coarse.row(column as usize);
            let mirrored = mirrored[others.binary_search(&(row as u32)).unwrap()];
            assert!((mirrored - value).abs() <= 1e-6 * value.abs().max(1.0), "entry ({row}, {column})");
        }
    }
}

/// A cycle and a solve with sampled factors are symmetric positive definite operations up to the rounding of single precision.
#[test]
fn preconditioners_are_symmetric_and_positive() {
    let hierarchy = Hierarchy::new(grid(60, 0.1)).unwrap();
    is_symmetric_and_positive(&mut Cycles::new(&hierarchy), 3600);
    // Far from the hierarchy's reach: entries that differ by 1e6 at random.
    let mut wild = grid(60, 0.1);
    let stiffness =
        |a: usize, b: usize| 10.0_f64.powf(6.0 * (noise(1, (a + b + a * b) as u64)[0][0] + 1.0) / 2.0);
    for row in 0..wild.rows() {
        let mut sum = 0.1;
        for at in wild.range(row).filter(|&at| wild.columns[at] as usize != row) {
            wild.values[at] = -stiffness(row, wild.columns[at] as usize);
            sum -= wild.values[at];
        }
        let own = wild.range(row).find(|&at| wild.columns[at] as usize == row).unwrap();
        wild.values[own] = sum;
    }
    is_symmetric_and_positive(&mut Eliminated::new(&Elimination::new(&wild)), 3600);
}

fn is_symmetric_and_positive(preconditioner: &mut impl Preconditioner<1>, n: usize) {
    let mut cycle = |b: &[[f64; 1]]| -> Vec<f64> {
        preconditioner.apply(b);
        preconditioner.z().iter().map(|x| f64::from(x[0])).collect()
    };
    let dot = |a: &[[f64; 1]], b: &[f64]| a.iter().zip(b).map(|(a, b)| a[0] * b).sum::<f64>();
    for seed in 0..5 {
        let (a, b) = (noise(n, seed), noise(n, seed + 100));
        let (ma, mb) = (cycle(&a), cycle(&b));
        let (size, positive) = (dot(&a, &ma) + dot(&b, &mb), dot(&a, &ma).min(dot(&b, &mb)));
        assert!(positive > 0.0);
        assert!((dot(&a, &mb) - dot(&b, &ma)).abs() < 1e-5 * size);
    }
}

/// Rows of a grid are left in their order; shuffled ones are put in one where neighbours are near, and nothing is lost on the way.
#[test]
fn a_shuffle_is_undone() {
    let matrix = grid(90, 1.0);
    assert!(better_order(&matrix).is_none());
    let mut shuffle: Vec<u32> = (0..8100).collect();
    shuffle.sort_by_key(|&row| u64::from(row + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let shuffled = permuted(&matrix, &shuffle);
    let order = better_order(&shuffled).unwrap();
    let mut sorted = order.clone();
    sorted.sort_unstable();
    assert!(sorted.into_iter().eq(0..8100));
    let tidy = permuted(&shuffled, &order);
    assert!(better_order(&tidy).is_none());
    for (row, &middle) in order.iter().enumerate() {
        let original = shuffle[middle as usize] as usize;
        assert_eq!(tidy.diagonal(row), matrix.diagonal(original));
    }
}

/// Where eliminating fills nothing in, nothing is sampled, and the factors are exact: along a chain, and in a tree.
#[test]
fn elimination_is_exact_without_fill() {
    let parent = |row: usize| if row.is_multiple_of(2) { row / 4 } else { row - 1 };
    // Powers of two, so that rows add up to exactly nothing in single precision too.
    let weight = |row: usize| ((row % 9) as f64 - 4.0).exp2();
    let n = 500;
    let matrix = Sparse::of_rows(n, |row, sums: &mut Sums| {
        let mut tie = |other: usize, weight: f64| {
            sums.add(row as u32, weight);
            sums.add(other as u32, -weight);
        };
        (1..n).filter(|&child| parent(child) == row).for_each(|child| tie(child, weight(child)));
        if row > 0 {
            tie(parent(row), weight(row));
        } else {
            sums.add(0, 0.5);
        }
    });
    let Sparse { starts, columns, values } = matrix;
    let matrix = Sparse { starts, columns, values: values.into_iter().map(f64::from).collect() };
    let exact = noise(n, 3);
    let mut b = vec![[0.0]; n];
    multiply(&matrix, &exact, &mut b);
    let factors = Elimination::new(&matrix);
    let mut solve = Eliminated::new(&factors);
    solve.apply(&b);
    let largest = (0..n).map(|row| matrix.diagonal(row)).fold(0.0, f64::max);
    for (z, exact) in solve.z().iter().zip(&exact) {
        assert!((f64::from(z[0]) / largest - exact[0]).abs() < 1e-3, "{} {}", z[0], exact[0]);
    }
}

/// A transposed pattern finds the entries of each column, of rows with more than 255 entries too.
#[test]
fn columns_find_their_entries() {
    let matrix = Sparse::of_rows(300, |row, sums: &mut Sums| {
        (0..900).filter(|k| (k + row) % 3 < 2).for_each(|k| sums.add(k as u32, (1000 * row + k) as f64));
    });
    let transposed = Transposed::new(&matrix, 900);
    for column in 0..900 {
        let rows = (0..300).filter(|row| (column + row) % 3 < 2);
        let expected = rows.map(|row| (row as u32, (1000 * row + column) as f32));
        assert!(transposed.entries(&matrix, column).eq(expected), "column {column}");
    }
}

/// Sums of any number of columns, however they collide, are those of a plain list.
#[test]
fn sums_add_up() {
    let columns = |k: u32| [k % 700, (k * k) % 131 * 1024, 5];
    let sums = Sparse::of_rows(3, |row, sums: &mut Sums| {
        for k in 0..2000 * row as u32 {
            columns(k).iter().for_each(|&column| sums.add(column, 1.0));
        }
    });
    for row in 0..3 {
        let mut expected = std::collections::BTreeMap::new();
        for column in (0..2000 * row as u32).flat_map(columns) {
            *expected.entry(column).or_insert(0.0_f32) += 1.0;
        }
        let (columns, values) = sums.row(row);
        assert!(columns.iter().copied().zip(values.iter().copied()).eq(expected));
    }
}
