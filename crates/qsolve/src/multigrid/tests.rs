//! What the levels promise each other.

use std::collections::HashMap;

use super::aggregate::{Strong, aggregate};
use super::kernel::{Members, Tentative};
use super::level::Level;
use super::matrix::BlockMatrix;

/// A strip of nodes, each coupled to the nodes up to two places away.
fn strip(rows: usize) -> BlockMatrix<2> {
    let (mut starts, mut columns) = (vec![0], Vec::new());
    for row in 0..rows {
        columns.extend((row.saturating_sub(2)..(row + 3).min(rows)).map(|column| column as u32));
        starts.push(columns.len() as u32);
    }
    BlockMatrix::zeros(starts, columns).expect("columns ascend")
}

/// The near-kernel is in the range of the tentative prolongation, exactly: `T · coarse = kernel`, also far from the origin.
#[test]
fn the_near_kernel_is_carried_exactly() {
    for offset in [0.0, 1e4] {
        let rows = 1000;
        let kernel: Vec<[[f64; 3]; 2]> = (0..rows)
            .map(|row| {
                let (x, y) = (offset + row as f64, offset - (0.1 * row as f64).sin());
                [[1.0, 0.0, -y], [0.0, 1.0, x]]
            })
            .collect();
        let matrix = strip(rows);
        let (of, count) = aggregate(matrix.rows(), |row| Strong::All.neighbors(&matrix, row));
        assert!(3 * count <= rows, "{count} aggregates of {rows} rows");
        let tentative = Tentative::new(kernel.clone(), &of, &Members::new(&of, count));
        for row in 0..rows {
            let coarse = &tentative.coarse[of[row] as usize];
            for (block, kernel) in tentative.blocks[row].iter().zip(&kernel[row]) {
                for (k, expected) in kernel.iter().enumerate() {
                    let carried: f64 = block.iter().zip(coarse).map(|(t, c)| t * c[k]).sum();
                    let error = (carried - expected).abs();
                    assert!(error <= 1e-9 * (1.0 + expected.abs()), "row {row}: {error}");
                }
            }
        }
    }
}

/// The next level's matrix is `Pᵀ A P` entry by entry, also where several patches meet.
#[test]
fn the_coarse_matrix_is_the_galerkin_product() {
    let rows = 12_000;
    let mut matrix = strip(rows);
    matrix.fill_rows(|row, columns, blocks| {
        for (&column, block) in columns.iter().zip(blocks) {
            let apart = row.abs_diff(column as usize) as f64;
            let off = -1.0 - 0.3 * ((row + column as usize) as f64).sin();
            *block = if apart == 0.0 { [[6.0, 0.5], [0.5, 7.0]] } else { [[off, 0.1], [0.1, 0.8 * off]] };
        }
    });
    let kernel = (0..rows).map(|row| [[1.0, 0.0, 0.0], [0.0, 1.0, (0.01 * row as f64).cos()]]).collect();
    let mut level: Level<2, 3> = Level::new(matrix, 0.0);
    let mut coarse = level.coarse_zeros().expect("a pattern");
    level.refresh(kernel, &mut coarse).expect("positive definite");
    assert!(coarse.rows() > 1500, "{} coarse rows are one patch", coarse.rows());
    let scalar_row = |row: usize, i: usize| -> Vec<(usize, f64)> {
        let (columns, blocks) = level.prolongation.row(row);
        let entries = columns.iter().zip(blocks);
        entries.flat_map(|(&column, p)| (0..3).map(move |k| (3 * column as usize + k, p[i][k]))).collect()
    };
    let mut product: HashMap<(usize, usize), f64> = HashMap::new();
    for row in 0..rows {
        let (columns, blocks) = level.matrix.row(row);
        for (&column, a) in columns.iter().zip(blocks) {
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                for (left, p) in scalar_row(row, i) {
                    for (right, q) in scalar_row(column as usize, j) {
                        *product.entry((left, right)).or_default() += p * a[i][j] * q;
                    }
                }
            }
        }
    }
    for row in 0..coarse.rows() {
        let (columns, blocks) = coarse.row(row);
        for (&column, block) in columns.iter().zip(blocks) {
            for (k, l) in (0..9).map(|entry| (entry / 3, entry % 3)) {
                let expected = product.remove(&(3 * row + k, 3 * column as usize + l)).unwrap_or(0.0);
                let error = (block[k][l] - expected).abs();
                assert!(
                    error <= 1e-12 || (row == column as usize && k == l && block[k][l] == 1.0),
                    "{row} {column}: {error}"
                );
            }
        }
    }
    assert!(product.is_empty(), "{} entries of the product have no place", product.len());
}

/// Every coupled row is in exactly one aggregate, and each aggregate is in one piece.
#[test]
fn aggregates_cover() {
    let matrix = strip(500);
    let (of, count) = aggregate(matrix.rows(), |row| Strong::All.neighbors(&matrix, row));
    let members = Members::new(&of, count);
    let mut seen = vec![0; 500];
    for number in 0..count {
        let rows = members.of(number);
        rows.iter().for_each(|&row| seen[row as usize] += 1);
        assert!(rows.windows(2).all(|pair| pair[1] - pair[0] <= 2), "aggregate {number}: {rows:?}");
    }
    assert!(seen.iter().all(|&times| times == 1));
}

/// Only the rows that are named change, each once, with what is theirs; rows out of order or out of range are left alone.
#[test]
fn only_the_named_rows_change() {
    let mut matrix = strip(3000);
    let named: Vec<u32> = (0..3000).filter(|row| row % 7 == 3 || row % 11 == 0).collect();
    let mut asked = named.clone();
    asked.extend([5, 4000]);
    for _ in 0..2 {
        matrix.change_rows_with(
            &asked,
            || (),
            |(), row, blocks| {
                blocks.iter_mut().flatten().flatten().for_each(|value| *value += row as f64);
            },
        );
    }
    for row in 0..3000 {
        let expected = if named.contains(&(row as u32)) { 2.0 * row as f64 } else { 0.0 };
        assert!(matrix.row(row).1.iter().flatten().flatten().all(|&value| value == expected), "{row}");
    }
    matrix.clear();
    assert!((0..3000).all(|row| matrix.row(row).1.iter().flatten().flatten().all(|&value| value == 0.0)));
}
