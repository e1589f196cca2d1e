//! Multigrid as a solver and as a preconditioner.

mod common;

use common::{Random, distance, rhs, row_normalized, spd};
use qsolve::{
    Backend, BlockMatrix, ConjugateGradients, CsrMatrix, LinearSolver, Multigrid, MultigridOptions,
    ScalarMultigrid, SolveError, SolveMethod, SolveOptions, Structure, solve,
};

const SPD: Structure = Structure::SymmetricPositiveDefinite;

fn solver(matrix: &CsrMatrix<f64>) -> ScalarMultigrid {
    ScalarMultigrid::new(blocks(matrix), 2000).expect("positive definite")
}

fn blocks(matrix: &CsrMatrix<f64>) -> BlockMatrix<1> {
    let (offsets, columns, _) = matrix.csr_data();
    let narrow = |numbers: &[usize]| numbers.iter().map(|&number| number as u32).collect();
    let mut blocks = BlockMatrix::zeros(narrow(offsets), narrow(columns)).expect("columns ascend");
    blocks.fill_rows(|row, _, values| {
        values.iter_mut().zip(matrix.row(row).values()).for_each(|(to, value)| *to = [[*value]]);
    });
    blocks
}

/// Iterations until the residual of the grid Laplacian with `side²` unknowns is at rounding.
fn iterations(matrix: &CsrMatrix<f64>) -> usize {
    let b = rhs(matrix.nrows(), 1, &mut Random::new(3));
    solver(matrix).solve(&b, 1e-11).expect("positive definite").1.iterations
}

/// The number of iterations does not grow with the grid: 60 times more unknowns take at most half as many again.
#[test]
fn iterations_are_bounded_over_sizes() {
    let counts = [32, 64, 128, 256].map(|side| iterations(&spd(side, 1.0, &mut Random::new(1))));
    assert!(counts.iter().all(|&count| count <= 24), "{counts:?}");
    assert!(2 * counts[3] <= 3 * counts[0], "{counts:?}");
}

/// Right-hand sides are solved two at a time, and each as if it were alone: also the third, and one of zeros.
#[test]
fn columns_do_not_see_each_other() {
    let matrix = spd(50, 10.0, &mut Random::new(21));
    let mut b = rhs(2500, 4, &mut Random::new(22));
    b.column_mut(1).fill(0.0);
    let solver = solver(&matrix);
    let (all, record) = solver.solve(&b, 1e-10).unwrap();
    assert!(all.column(1).iter().all(|&x| x == 0.0));
    let mut most = 0;
    for k in 0..4 {
        let one = qsolve::DMatrix::from_column_slice(2500, 1, b.column(k).as_slice());
        let (x, alone) = solver.solve(&one, 1e-10).unwrap();
        assert!(x.iter().zip(all.column(k).iter()).all(|(a, b)| a.to_bits() == b.to_bits()), "column {k}");
        most = most.max(alone.iterations);
    }
    assert_eq!(record.iterations, most);
}

/// Whatever the order of the unknowns, the answer is the same and takes about as many iterations.
#[test]
fn the_order_of_unknowns_does_not_matter() {
    let matrix = spd(128, 10.0, &mut Random::new(23));
    let n = matrix.nrows();
    let mut names: Vec<usize> = (0..n).collect();
    let mut random = Random::new(24);
    (1..n).rev().for_each(|k| names.swap(k, (random.next() * (k + 1) as f64) as usize));
    let mut triplets = qsolve::Triplets::new(n, n);
    matrix.triplet_iter().for_each(|(i, j, value)| triplets.add(names[i], names[j], *value));
    let b = rhs(n, 1, &mut random);
    let mut renamed = b.clone();
    (0..n).for_each(|row| renamed[(names[row], 0)] = b[(row, 0)]);
    let (x, before) = solver(&matrix).solve(&b, 1e-10).unwrap();
    let (y, after) = solver(&triplets.build().unwrap()).solve(&renamed, 1e-10).unwrap();
    assert!((0..n).all(|row| (x[(row, 0)] - y[(names[row], 0)]).abs() < 1e-9 * x.amax()));
    assert!(after.iterations <= before.iterations + 8, "{} and {}", before.iterations, after.iterations);
}

/// Weights that differ from edge to edge by 1e3 take a few more iterations; by 1e6, the patience with the levels and then as many as
/// sampled factors need.
#[test]
fn contrast_is_survived() {
    for (contrast, most) in [(1e3, 60), (1e6, 110)] {
        let count = iterations(&spd(96, contrast, &mut Random::new(2)));
        assert!(count <= most, "contrast {contrast:.0e}: {count} iterations");
    }
}

/// All backends give the same answer, and the record tells which one gave it.
#[test]
fn multigrid_agrees_with_factors() {
    let mut random = Random::new(9);
    let systems = [(spd(40, 1e2, &mut random), SPD), (row_normalized(40, &mut random), Structure::General)];
    for (matrix, structure) in systems {
        let b = rhs(1600, 3, &mut random);
        let with =
            |backend| solve(&matrix, structure, &b, &SolveOptions { backend, ..Default::default() }).unwrap();
        let (x, record) = with(Backend::Multigrid);
        assert_eq!(record.method, SolveMethod::Multigrid);
        assert!(record.relative_residual < 1e-11, "{record:?}");
        let (reference, _) = with(Backend::Direct);
        assert!(distance(&x, &reference) < 1e-9 * reference.amax());
    }
}

/// The Laplacian of a box of `side³` unknowns that is held at its faces.
fn volume(side: usize) -> CsrMatrix<f64> {
    let mut triplets = qsolve::Triplets::new(side.pow(3), side.pow(3));
    for row in 0..side.pow(3) {
        triplets.add(row, row, 6.0);
        for (stride, along) in [(1, row % side), (side, row / side % side), (side * side, row / side / side)]
        {
            if along + 1 < side {
                triplets.add(row, row + stride, -1.0);
                triplets.add(row + stride, row, -1.0);
            }
        }
    }
    triplets.build().expect("indices are in range")
}

/// What decides is not the number of unknowns but how many entries their factor would have: few for a surface, many for a volume.
#[test]
fn what_would_fill_in_is_not_factorized() {
    let surface = spd(465, 1.0, &mut Random::new(5));
    let box_of_springs = volume(60);
    for (matrix, method) in [(surface, SolveMethod::Cholesky), (box_of_springs, SolveMethod::Multigrid)] {
        let entries = qsolve::Symbolic::analyze(&matrix, SPD).unwrap().factor_entries().unwrap();
        let b = rhs(matrix.nrows(), 1, &mut Random::new(6));
        let (_, record) = solve(&matrix, SPD, &b, &SolveOptions::default()).unwrap();
        assert_eq!(record.method, method, "{} unknowns, {entries} entries in the factor", matrix.nrows());
        assert!(record.relative_residual < 1e-11, "{record:?}");
    }
    let general = row_normalized(8, &mut Random::new(7));
    assert_eq!(qsolve::Symbolic::analyze(&general, Structure::General).unwrap().factor_entries(), None);
}

/// A matrix that is not positive definite is refused, after the factorization has been asked too.
#[test]
fn an_indefinite_matrix_is_refused() {
    let mut matrix = spd(30, 10.0, &mut Random::new(4));
    let place =
        matrix.row_offsets()[450] + matrix.row(450).col_indices().iter().position(|&c| c == 450).unwrap();
    matrix.values_mut()[place] *= -1.0;
    let refused = ScalarMultigrid::new(blocks(&matrix), 100).unwrap_err();
    assert_eq!(refused, SolveError::NotPositiveDefinite { row: Some(450) });
    let b = rhs(900, 1, &mut Random::new(5));
    let options = SolveOptions { backend: Backend::Multigrid, ..Default::default() };
    assert!(matches!(solve(&matrix, SPD, &b, &options), Err(SolveError::NotPositiveDefinite { .. })));
}

/// A free elastic sheet: springs along edges and diagonals of a grid, two unknowns a vertex. Its kernel is spanned by two
/// translations and a rotation.
fn sheet(side: usize) -> (BlockMatrix<2>, Vec<[[f64; 3]; 2]>) {
    let n = side * side;
    let place = |v: usize| [(v % side) as f64, (v / side) as f64];
    let neighbors = |v: usize| -> Vec<usize> {
        let (x, y) = ((v % side) as i64, (v / side) as i64);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
        let inside = |&(x, y): &(i64, i64)| (0..side as i64).contains(&x) && (0..side as i64).contains(&y);
        around.filter(inside).map(|(x, y)| y as usize * side + x as usize).collect()
    };
    let (mut starts, mut columns) = (vec![0], Vec::new());
    for v in 0..n {
        columns.extend(neighbors(v).into_iter().map(|w| w as u32));
        starts.push(columns.len() as u32);
    }
    let mut matrix = BlockMatrix::zeros(starts, columns).expect("columns ascend");
    matrix.fill_rows(|v, columns, blocks| {
        let own = columns.partition_point(|&w| (w as usize) < v);
        for (at, &w) in columns.iter().enumerate().filter(|(at, _)| *at != own) {
            let [[vx, vy], [wx, wy]] = [place(v), place(w as usize)];
            let d = [wx - vx, wy - vy];
            for i in 0..2 {
                for j in 0..2 {
                    blocks[at][i][j] -= d[i] * d[j];
                    blocks[own][i][j] += d[i] * d[j];
                }
            }
        }
    });
    let kernel = (0..n)
        .map(|v| {
            let [x, y] = place(v);
            [[1.0, 0.0, -y], [0.0, 1.0, x]]
        })
        .collect();
    (matrix, kernel)
}

const FREE: MultigridOptions = MultigridOptions { strength: 0.0, shift: 1e-5, floating: true };

/// A right-hand side without a part in the kernel: what random displacements call for, and noise shows all frequencies.
fn balanced(matrix: &BlockMatrix<2>) -> Vec<f64> {
    let displaced: Vec<f64> = rhs(2 * matrix.rows(), 1, &mut Random::new(6)).iter().copied().collect();
    let mut b = vec![0.0; displaced.len()];
    matrix.multiply(&displaced, &mut b);
    b
}

/// With the rotation among the near-kernel, a free sheet of any size is solved to a tenth in a few iterations, and to 1e-6 in
/// a number that hardly grows.
#[test]
fn a_free_sheet_takes_few_iterations_at_any_size() {
    let mut tight = Vec::new();
    for side in [24, 72, 144] {
        let (matrix, kernel) = sheet(side);
        let multigrid = Multigrid::new(matrix, kernel, FREE).unwrap();
        let mut cg = ConjugateGradients::new(&multigrid, balanced(multigrid.matrix()));
        while cg.relative_residual() > 0.1 && cg.advance() {}
        assert!(cg.iterations() <= 4, "side {side}: {} iterations to a tenth", cg.iterations());
        while cg.relative_residual() > 1e-6 && cg.advance() {}
        tight.push(cg.iterations());
    }
    assert!(tight[2] <= 40 && tight[2] <= 2 * tight[0], "{tight:?}");
}

/// The part of the answer that is still missing is estimated within a factor of three, and what is there never overshoots.
#[test]
fn the_energy_that_is_left_is_known() {
    let (matrix, kernel) = sheet(60);
    let multigrid = Multigrid::new(matrix, kernel, FREE).unwrap();
    let b = balanced(multigrid.matrix());
    let mut exact = ConjugateGradients::new(&multigrid, b.clone());
    while exact.relative_residual() > 1e-9 && exact.advance() {}
    let mut cg = ConjugateGradients::new(&multigrid, b);
    while cg.relative_residual() > 1e-3 && cg.advance() {
        let left = exact.energy() - cg.energy();
        assert!(left >= 0.0, "iterates approach from below");
        let ratio = cg.energy_left() / left;
        assert!((1.0 / 3.0..3.0).contains(&ratio), "after {}: {ratio}", cg.iterations());
    }
}

/// New values on a kept pattern give what a fresh hierarchy of the same values gives, but for the power iteration's start.
#[test]
fn a_refreshed_hierarchy_serves_like_a_fresh_one() {
    let (matrix, kernel) = sheet(50);
    let b = balanced(&matrix);
    let count = |multigrid: &Multigrid<2, 3>| {
        let mut cg = ConjugateGradients::new(multigrid, b.clone());
        while cg.relative_residual() > 1e-6 && cg.advance() {}
        cg.iterations()
    };
    let fresh = Multigrid::new(matrix.clone(), kernel.clone(), FREE).unwrap();
    let mut other = Multigrid::new(matrix, kernel.clone(), FREE).unwrap();
    other
        .matrix_mut()
        .fill_rows(|_, _, blocks| blocks.iter_mut().flatten().flatten().for_each(|x| *x *= 3.0));
    other.refresh(kernel).unwrap();
    assert!(count(&fresh).abs_diff(count(&other)) <= 1);
}

/// One thread and two give the same bits.
#[test]
fn threads_do_not_change_the_bits() {
    let scalar = spd(120, 10.0, &mut Random::new(25));
    let b = rhs(scalar.nrows(), 3, &mut Random::new(26));
    let (matrix, kernel) = sheet(120);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut multigrid = Multigrid::new(matrix.clone(), kernel.clone(), FREE).unwrap();
            multigrid.refresh(kernel.clone()).unwrap();
            let mut cg = ConjugateGradients::new(&multigrid, balanced(multigrid.matrix()));
            (0..6).for_each(|_| assert!(cg.advance()));
            let (x, _) = solver(&scalar).solve(&b, 1e-10).unwrap();
            cg.solution().iter().chain(&x).map(|x| x.to_bits()).collect::<Vec<_>>()
        })
    };
    assert!(run(1) == run(2));
}

/// A matrix without couplings is solved by the smoother alone, and one row is solved too.
#[test]
fn what_is_not_coupled_needs_no_levels() {
    for n in [1, 5, 700] {
        let matrix = CsrMatrix::identity(n);
        let b = rhs(n, 1, &mut Random::new(7));
        let options = SolveOptions { backend: Backend::Multigrid, ..Default::default() };
        let (x, record) = solve(&matrix, SPD, &b, &options).unwrap();
        assert_eq!(record.method, SolveMethod::Multigrid);
        assert!(distance(&x, &b) < 1e-12);
    }
}

/// The same answer in any unit: a matrix of another magnitude has the same bits in its answer, but for the exponent.
#[test]
fn the_magnitude_of_the_matrix_does_not_matter() {
    let matrix = spd(40, 100.0, &mut Random::new(11));
    let b = rhs(1600, 3, &mut Random::new(12));
    let (x, record) = solver(&matrix).solve(&b, 1e-10).unwrap();
    for exponent in [-900, -166, -100, -2, 2, 100, 166, 900] {
        let factor = f64::from(exponent).exp2();
        let mut scaled = matrix.clone();
        scaled.values_mut().iter_mut().for_each(|value| *value *= factor);
        let (y, again) = solver(&scaled).solve(&b, 1e-10).unwrap();
        assert_eq!((y * factor, again), (x.clone(), record.clone()), "2^{exponent}");
    }
    for (entry, b) in [(1e50, 1.0), (1e-50, 1.0), (1e-300, 1e-300), (1e300, 1e300), (5e-324, 5e-324)] {
        let (x, _) = single(entry).solve(&qsolve::DMatrix::from_element(1, 1, b), 1e-10).unwrap();
        assert!((x[(0, 0)] * entry / b - 1.0).abs() < 1e-12, "{entry:e} x = {b:e}: {}", x[(0, 0)]);
    }
}

/// An answer beyond the range of numbers is none.
#[test]
fn infinite_answers_are_refused() {
    let refused = single(1e-30).solve(&qsolve::DMatrix::from_element(1, 1, 1e308), 1e-8);
    assert_eq!(refused.unwrap_err(), SolveError::Singular { row: None });
}

fn single(entry: f64) -> ScalarMultigrid {
    let mut matrix = BlockMatrix::zeros(vec![0, 1], vec![0]).expect("one entry");
    matrix.fill_rows(|_, _, values| values[0] = [[entry]]);
    ScalarMultigrid::new(matrix, 100).expect("a positive entry")
}
