//! What only this module sees: levels, cycles, orders.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use super::hierarchy::{Hierarchy, Work};
use super::level::Level;
use super::order::{better_order, permuted};
use super::sparse::{Sparse, Sums};

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
            let mirrored = coarse.at(column as usize, row as u32);
            assert!((mirrored - value).abs() <= 1e-6 * value.abs().max(1.0), "entry ({row}, {column})");
        }
    }
}

/// One cycle is a symmetric positive definite operation up to the rounding of single precision, also where chunks of the smoother meet.
#[test]
fn a_cycle_is_symmetric_and_positive() {
    let hierarchy = Hierarchy::new(grid(60, 0.1)).unwrap();
    let mut work = Work::<1>::new(&hierarchy);
    let mut cycle = |b: &[[f64; 1]]| -> Vec<f64> {
        hierarchy.cycle(b, &mut work);
        work.x().iter().map(|x| f64::from(x[0])).collect()
    };
    let dot = |a: &[[f64; 1]], b: &[f64]| a.iter().zip(b).map(|(a, b)| a[0] * b).sum::<f64>();
    for seed in 0..5 {
        let (a, b) = (noise(3600, seed), noise(3600, seed + 100));
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
