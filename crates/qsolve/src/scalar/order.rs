//! An order of the rows in which neighbours are near each other, where the given one has them anywhere.

use std::collections::VecDeque;

use super::level::chunk_of;
use super::sparse::Sparse;

/// The part of the couplings that may leave the smoother's chunks. A grid row by row has some per cent there, vertices in the order
/// of a shuffle nearly all: then Gauss–Seidel amounts to a lazy Jacobi, and every access to memory misses the cache.
const FAR: f64 = 0.2;

/// Which old row becomes each new one; nothing where the order is good as it is.
pub(super) fn better_order(matrix: &Sparse<f64>) -> Option<Vec<u32>> {
    let chunk = chunk_of(matrix.rows());
    let is_far = |row: usize, column: u32| row.abs_diff(column as usize) >= chunk;
    let far = |row: usize| matrix.row(row).0.iter().filter(|&&column| is_far(row, column)).count();
    let all: usize = (0..matrix.rows()).map(far).sum();
    (all as f64 > FAR * matrix.columns.len() as f64).then(|| breadth_first(matrix))
}

/// Ring after ring [Cuthill, McKee 1969] from a row at the edge: the last one that is met from row 0. One component after the other.
fn breadth_first(matrix: &Sparse<f64>) -> Vec<u32> {
    let mut seen = vec![false; matrix.rows()];
    let mut order = Vec::with_capacity(matrix.rows());
    for row in 0..matrix.rows() as u32 {
        if seen[row as usize] {
            continue;
        }
        let first = order.len();
        visit(matrix, row, &mut seen, &mut order);
        let last = order[order.len() - 1];
        order.drain(first..).for_each(|row| seen[row as usize] = false);
        visit(matrix, last, &mut seen, &mut order);
    }
    order
}

fn visit(matrix: &Sparse<f64>, from: u32, seen: &mut [bool], order: &mut Vec<u32>) {
    seen[from as usize] = true;
    let mut queue = VecDeque::from([from]);
    while let Some(row) = queue.pop_front() {
        order.push(row);
        for &column in matrix.row(row as usize).0 {
            if !std::mem::replace(&mut seen[column as usize], true) {
                queue.push_back(column);
            }
        }
    }
}

/// The matrix with its rows and columns in another order.
pub(super) fn permuted(matrix: &Sparse<f64>, order: &[u32]) -> Sparse<f64> {
    let mut place = vec![0_u32; order.len()];
    for (new, &old) in (0_u32..).zip(order) {
        place[old as usize] = new;
    }
    let mut sorted = Sparse {
        starts: Vec::with_capacity(order.len() + 1),
        columns: Vec::with_capacity(matrix.columns.len()),
        values: Vec::with_capacity(matrix.columns.len()),
    };
    sorted.starts.push(0);
    let mut entries: Vec<(u32, f64)> = Vec::new();
    for &old in order {
        let (columns, values) = matrix.row(old as usize);
        entries.extend(columns.iter().map(|&column| place[column as usize]).zip(values.iter().copied()));
        entries.sort_unstable_by_key(|entry| entry.0);
        sorted.columns.extend(entries.iter().map(|entry| entry.0));
        sorted.values.extend(entries.drain(..).map(|entry| entry.1));
        sorted.starts.push(sorted.columns.len() as u32);
    }
    sorted
}
