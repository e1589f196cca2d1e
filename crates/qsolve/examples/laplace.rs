//! The Laplace equation on a square grid with given values around it and two right-hand sides, by multigrid: seconds, iterations, memory.
//!
//! `cargo run --release -p qsolve --example laplace -- 4000 [CONTRAST] [SHUFFLE]` solves for 16 million unknowns; the springs between neighbours
//! differ at random by up to CONTRAST (1), and the unknowns are numbered at random for any SHUFFLE.

#![allow(clippy::print_stdout, reason = "that is what it is for")]

use std::time::Instant;

use qsolve::{BlockMatrix, DMatrix, LinearSolver, ScalarMultigrid};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let side: usize = arguments.next().as_deref().unwrap_or("1000").parse()?;
    let contrast: f64 = arguments.next().as_deref().unwrap_or("1").parse()?;
    let names = names(side * side, arguments.next().is_some());
    let start = Instant::now();
    let matrix = grid(side, contrast, &names)?;
    println!("{} unknowns, assembled in {:.2} s", side * side, start.elapsed().as_secs_f64());

    let start = Instant::now();
    let system = ScalarMultigrid::new(matrix, 2000)?;
    println!("{:.2} s for the levels {:?}", start.elapsed().as_secs_f64(), system.level_rows());
    drop(names);

    let rhs = DMatrix::from_fn(side * side, 2, |row, column| noise(row + column * side * side) - 0.5);
    let start = Instant::now();
    let (_, record) = system.solve(&rhs, 1e-8)?;
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{seconds:.2} s for {} iterations, relative residual {:.1e}",
        record.iterations, record.relative_residual
    );
    if let Ok(status) = std::fs::read_to_string("/proc/self/status") {
        status.lines().filter(|line| line.starts_with("VmHWM")).for_each(|line| println!("{line}"));
    }
    Ok(())
}

/// A number in [0, 1) that looks random.
fn noise(seed: usize) -> f64 {
    let mut bits = (seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The row of each node of the grid.
fn names(n: usize, shuffled: bool) -> Vec<u32> {
    let mut names: Vec<u32> = (0..n as u32).collect();
    if shuffled {
        (1..n).rev().for_each(|k| names.swap(k, (noise(k) * (k + 1) as f64) as usize));
    }
    names
}

/// Springs between neighbours, and between the outermost and the walls.
fn grid(side: usize, contrast: f64, names: &[u32]) -> Result<BlockMatrix<1>, qsolve::SolveError> {
    let mut node = vec![0_u32; names.len()];
    (0_u32..).zip(names).for_each(|(at, &name)| node[name as usize] = at);
    let stiffness = |a: usize, b: usize| contrast.powf(noise(a.min(b) * 2 + usize::from(a.abs_diff(b) == 1)));
    let neighbors = |at: usize| {
        let (x, y) = (at % side, at / side);
        [
            (x > 0).then(|| at - 1),
            (x + 1 < side).then(|| at + 1),
            (y > 0).then(|| at - side),
            (y + 1 < side).then(|| at + side),
        ]
    };
    let (mut starts, mut columns) = (vec![0], Vec::with_capacity(5 * names.len()));
    for &at in &node {
        let first = columns.len();
        columns.push(names[at as usize]);
        columns.extend(neighbors(at as usize).into_iter().flatten().map(|n| names[n]));
        columns[first..].sort_unstable();
        starts.push(columns.len() as u32);
    }
    let mut matrix = BlockMatrix::zeros(starts, columns)?;
    matrix.fill_rows(|row, columns, values| {
        let at = node[row] as usize;
        let inside = neighbors(at).into_iter().flatten();
        let walls = 4 - inside.clone().count();
        let sum = inside.map(|n| stiffness(at, n)).sum::<f64>() + walls as f64;
        for (value, &column) in values.iter_mut().zip(columns) {
            let other = node[column as usize] as usize;
            *value = [[if other == at { sum } else { -stiffness(at, other) }]];
        }
    });
    Ok(matrix)
}
