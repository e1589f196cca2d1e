//! Every backend against an independent one.

mod common;

use common::{Random, dense, distance, rhs, row_normalized, spd};
use proptest::prelude::*;
use qsolve::nalgebra_sparse::{CscMatrix, factorization::CscCholesky};
use qsolve::{
    Backend, CsrMatrix, DMatrix, Krylov, LinearSolver, SolveError, SolveMethod, SolveOptions, Structure,
    Symbolic, Triplets, solve,
};

const SPD: Structure = Structure::SymmetricPositiveDefinite;

fn options(backend: Backend) -> SolveOptions {
    SolveOptions { backend, ..Default::default() }
}

fn bits(matrix: &DMatrix<f64>) -> Vec<u64> {
    matrix.iter().map(|value| value.to_bits()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// On symmetric M-matrices both backends agree with the Cholesky factorization of nalgebra-sparse.
    #[test]
    fn symmetric_systems_agree_with_the_oracle(side in 1_usize..14, contrast in 1.0..1e4, seed in 1_u64..1000) {
        let mut random = Random::new(seed);
        let matrix = spd(side, contrast, &mut random);
        let b = rhs(side * side, 3, &mut random);
        let oracle = CscCholesky::factor(&CscMatrix::from(&matrix)).unwrap().solve(&b);
        for (backend, method) in
            [(Backend::Auto, SolveMethod::Cholesky), (Backend::Iterative, SolveMethod::ConjugateGradient)]
        {
            let (x, record) = solve(&matrix, SPD, &b, &options(backend)).unwrap();
            prop_assert_eq!(record.method, method);
            prop_assert!(record.relative_residual < 1e-12);
            prop_assert!(distance(&x, &oracle) < 1e-9 * (1.0 + oracle.amax()), "{:?}", method);
        }
    }

    /// On row-normalised systems LU and BiCGStab agree with dense LU.
    #[test]
    fn general_systems_agree_with_dense_lu(side in 1_usize..10, seed in 1_u64..1000) {
        let mut random = Random::new(seed);
        let matrix = row_normalized(side, &mut random);
        let b = rhs(side * side, 2, &mut random);
        let oracle = dense(&matrix).lu().solve(&b).unwrap();
        for (backend, method) in
            [(Backend::Auto, SolveMethod::Lu), (Backend::Iterative, SolveMethod::BiCgStab)]
        {
            let (x, record) = solve(&matrix, Structure::General, &b, &options(backend)).unwrap();
            prop_assert_eq!(record.method, method);
            prop_assert!(distance(&x, &oracle) < 1e-9 * (1.0 + oracle.amax()), "{:?}", method);
        }
    }

    /// Any matrix, symmetric in nothing: the residual is the true one, or there is an error.
    #[test]
    fn the_residual_is_true(entries in prop::collection::vec((0_usize..12, 0_usize..12, -1.0..1.0), 0..80), seed in 1_u64..99) {
        let mut triplets = Triplets::new(12, 12);
        for (row, column, value) in entries {
            triplets.add(row, column, value);
        }
        let matrix = triplets.build().unwrap();
        let b = rhs(12, 2, &mut Random::new(seed));
        for structure in [SPD, Structure::General] {
            for backend in [Backend::Auto, Backend::Direct, Backend::Iterative] {
                if let Ok((x, record)) = solve(&matrix, structure, &b, &options(backend)) {
                    let r = &b - dense(&matrix) * &x;
                    for k in 0..2 {
                        let residual = r.column(k).norm() / b.column(k).norm();
                        prop_assert!(residual <= 1e-8);
                        prop_assert!(residual <= record.relative_residual + 1e-13 * (1.0 + x.amax()));
                    }
                }
            }
        }
    }
}

/// Weights that differ by twelve orders of magnitude still give small residuals.
#[test]
fn contrast_does_not_spoil_the_residual() {
    let mut random = Random::new(5);
    let matrix = spd(40, 1e12, &mut random);
    let b = DMatrix::from_fn(1600, 2, |row, k| matrix.row(row).values().iter().sum::<f64>() * (k + 1) as f64);
    let (x, record) = solve(&matrix, SPD, &b, &SolveOptions::default()).unwrap();
    assert!(record.relative_residual < 1e-12, "{record:?}");
    assert!(x.column(0).iter().all(|x| (x - 1.0).abs() < 1e-3), "constant functions solve this system");
}

/// Iterations that do not arrive are followed by a factorization, and the record says so.
#[test]
fn failed_iterations_fall_back_to_factors() {
    let mut random = Random::new(4);
    for (matrix, structure, method) in [
        (spd(20, 10.0, &mut random), SPD, SolveMethod::Cholesky),
        (row_normalized(20, &mut random), Structure::General, SolveMethod::Lu),
    ] {
        let b = rhs(400, 2, &mut random);
        let hurried = SolveOptions { backend: Backend::Iterative, max_iterations: 1, ..Default::default() };
        assert_eq!(solve(&matrix, structure, &b, &hurried).unwrap().1.method, method);
        let krylov = Krylov::new(&matrix, structure, 1).unwrap();
        assert!(matches!(krylov.solve(&b, 1e-8), Err(SolveError::Inaccurate { .. })));
    }
}

/// A permutation matrix has no diagonal at all: LU has to pivot, and BiCGStab to do without ILU(0).
#[test]
fn pivots_are_found_off_the_diagonal() {
    let mut triplets = Triplets::new(5, 5);
    for row in 0..5 {
        triplets.add(row, (row + 2) % 5, (row + 1) as f64);
    }
    let matrix = triplets.build().unwrap();
    let b = DMatrix::from_fn(5, 1, |row, _| (row + 1) as f64);
    for backend in [Backend::Direct, Backend::Iterative] {
        let (x, _) = solve(&matrix, Structure::General, &b, &options(backend)).unwrap();
        assert!(distance(&x, &DMatrix::from_element(5, 1, 1.0)) < 1e-12);
    }
}

/// Each right-hand side is solved for itself, so company does not change its bits.
#[test]
fn several_right_hand_sides_equal_single_ones() {
    let mut random = Random::new(7);
    for (matrix, structure) in
        [(spd(30, 10.0, &mut random), SPD), (row_normalized(30, &mut random), Structure::General)]
    {
        let b = rhs(900, 3, &mut random);
        for backend in [Backend::Direct, Backend::Iterative] {
            let (together, _) = solve(&matrix, structure, &b, &options(backend)).unwrap();
            for k in 0..3 {
                let single = DMatrix::from_column_slice(900, 1, b.column(k).as_slice());
                let (alone, _) = solve(&matrix, structure, &single, &options(backend)).unwrap();
                assert_eq!(
                    bits(&alone),
                    bits(&DMatrix::from_column_slice(900, 1, together.column(k).as_slice()))
                );
            }
        }
    }
}

/// A reused symbolic step gives the same bits as a fresh one.
#[test]
fn a_reused_symbolic_step_equals_a_fresh_one() {
    let (mut first, mut second) = (Random::new(1), Random::new(2));
    let matrices = [spd(25, 100.0, &mut first), spd(25, 100.0, &mut second)];
    let symbolic = Symbolic::analyze(&matrices[0], SPD).unwrap();
    for matrix in &matrices {
        let b = rhs(625, 2, &mut first);
        let (reused, _) = symbolic.factor(matrix).unwrap().solve(&b, 1e-8).unwrap();
        let (fresh, _) = solve(matrix, SPD, &b, &options(Backend::Direct)).unwrap();
        assert_eq!(bits(&reused), bits(&fresh));
    }
    let other = row_normalized(24, &mut first);
    assert_eq!(symbolic.factor(&other).unwrap_err(), SolveError::OtherPattern);
}

/// The same bits for one thread and for two, in systems large enough to be cut into chunks.
#[test]
fn threads_do_not_change_the_bits() {
    let mut random = Random::new(3);
    let systems =
        [(spd(110, 10.0, &mut random), SPD), (row_normalized(110, &mut random), Structure::General)];
    let b = rhs(110 * 110, 2, &mut random);
    for (matrix, structure) in &systems {
        for backend in [Backend::Direct, Backend::Iterative] {
            let run = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let (x, record) = pool.install(|| solve(matrix, *structure, &b, &options(backend))).unwrap();
                (bits(&x), record.relative_residual.to_bits(), record.iterations)
            };
            assert!(run(1) == run(2), "{structure:?} {backend:?}");
        }
    }
}

/// Nothing to solve is solved.
#[test]
fn an_empty_system_has_an_empty_answer() {
    let matrix = CsrMatrix::zeros(0, 0);
    for structure in [SPD, Structure::General] {
        for backend in [Backend::Auto, Backend::Direct, Backend::Iterative] {
            let (x, record) = solve(&matrix, structure, &DMatrix::zeros(0, 2), &options(backend)).unwrap();
            assert_eq!((x.shape(), record.relative_residual), ((0, 2), 0.0));
        }
        let symbolic = Symbolic::analyze(&matrix, structure).unwrap();
        assert_eq!(
            symbolic.factor(&matrix).unwrap().solve(&DMatrix::zeros(0, 1), 1e-8).unwrap().0.shape(),
            (0, 1)
        );
        let krylov = Krylov::new(&matrix, structure, 10).unwrap();
        assert_eq!(krylov.solve(&DMatrix::zeros(0, 1), 1e-8).unwrap().0.shape(), (0, 1));
    }
    let matrix = spd(3, 1.0, &mut Random::new(1));
    let (x, _) = solve(&matrix, SPD, &DMatrix::zeros(9, 0), &SolveOptions::default()).unwrap();
    assert_eq!(x.shape(), (9, 0));
}

/// A right-hand side of zeros has the answer zero, exactly.
#[test]
fn zero_gives_zero() {
    let matrix = row_normalized(6, &mut Random::new(1));
    for backend in [Backend::Direct, Backend::Iterative] {
        let (x, record) =
            solve(&matrix, Structure::General, &DMatrix::zeros(36, 2), &options(backend)).unwrap();
        assert_eq!((x.amax(), record.relative_residual), (0.0, 0.0));
    }
}

/// Kept factors solve with the matrix that they were made of, whatever has become of it; those of another pattern are refused.
#[test]
fn kept_factors_outlive_their_matrix() {
    let mut random = Random::new(5);
    let matrix = spd(9, 10.0, &mut random);
    let b = rhs(81, 1, &mut random);
    let symbolic = Symbolic::analyze(&matrix, SPD).unwrap();
    let factor = symbolic.factor(&matrix).unwrap();
    let (x, _) = factor.solve(&b, 1e-10).unwrap();
    let kept = factor.into_factors();
    let mut y = b.as_slice().to_vec();
    symbolic.solve_in_place(&kept, &mut y).unwrap();
    assert!(y.iter().zip(x.iter()).all(|(y, x)| (y - x).abs() < 1e-12 * (1.0 + x.abs())));
    let other = Symbolic::analyze(&spd(8, 10.0, &mut random), SPD).unwrap();
    assert_eq!(other.solve_in_place(&kept, &mut y[..64]), Err(SolveError::OtherPattern));
    assert!(matches!(
        symbolic.solve_in_place(&kept, &mut y[..64]),
        Err(SolveError::WrongRightHandSide { .. })
    ));
}

/// Factors of another analysis are refused, however alike: of LU in another size and in the same, of Cholesky with as many entries elsewhere,
/// and of the very same matrix analysed again.
#[test]
fn factors_of_another_analysis_are_refused() {
    let mut random = Random::new(6);
    let chain = |links: &[usize]| {
        let mut triplets = Triplets::new(links.len(), links.len());
        for (row, &other) in links.iter().enumerate() {
            triplets.add(row, row, 4.0);
            if other != row {
                triplets.add(row, other, -1.0);
                triplets.add(other, row, -1.0);
            }
        }
        triplets.build().unwrap()
    };
    let large = row_normalized(9, &mut random);
    for (structure, made, used) in [
        (Structure::General, large.clone(), row_normalized(8, &mut random)),
        (Structure::General, large.clone(), spd(9, 10.0, &mut random)),
        (Structure::General, large.clone(), large),
        (SPD, chain(&[0, 0, 1, 2]), chain(&[0, 0, 0, 0])),
    ] {
        let kept = Symbolic::analyze(&made, structure).unwrap().factor(&made).unwrap().into_factors();
        let other = Symbolic::analyze(&used, structure).unwrap();
        let refused = other.solve_in_place(&kept, &mut vec![1.0; used.nrows()]);
        assert_eq!(refused, Err(SolveError::OtherPattern), "{structure:?}, {} rows", used.nrows());
    }
}

/// This would not end if each of its neighbours went through all entries of the first row.
#[test]
fn a_hub_with_very_many_neighbors_is_preconditioned() {
    let n = 400_000;
    let mut triplets = Triplets::new(n, n);
    triplets.add(0, 0, n as f64);
    for row in 1..n {
        triplets.add(row, row, 2.0);
        triplets.add(0, row, -1.0);
        triplets.add(row, 0, -1.0);
    }
    let matrix = triplets.build().unwrap();
    let b = DMatrix::from_element(n, 1, 1.0);
    let (_, record) = Krylov::new(&matrix, SPD, 50).unwrap().solve(&b, 1e-7).unwrap();
    assert!(record.iterations < 20, "{record:?}");
}
