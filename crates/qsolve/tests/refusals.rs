//! What cannot be solved is refused with a reason, and nothing panics.

mod common;

use common::{Random, spd};
use qsolve::{Backend, CsrMatrix, DMatrix, SolveError, SolveOptions, Structure, Symbolic, Triplets, solve};

const SPD: Structure = Structure::SymmetricPositiveDefinite;

fn matrix(rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> CsrMatrix<f64> {
    let mut triplets = Triplets::new(rows, columns);
    for &(row, column, value) in entries {
        triplets.add(row, column, value);
    }
    triplets.build().expect("all entries lie inside")
}

fn refusal(matrix: &CsrMatrix<f64>, structure: Structure, rhs: &DMatrix<f64>) -> SolveError {
    let errors = [Backend::Auto, Backend::Direct].map(|backend| {
        let options = SolveOptions { backend, ..Default::default() };
        solve(matrix, structure, rhs, &options).expect_err("no answer exists")
    });
    assert_eq!(errors[0], errors[1]);
    errors[0].clone()
}

fn ones(rows: usize) -> DMatrix<f64> {
    DMatrix::from_element(rows, 1, 1.0)
}

/// Shapes and numbers that are no system.
#[test]
fn bad_systems_are_named() {
    let unit = matrix(2, 2, &[(0, 0, 1.0), (1, 1, 1.0)]);
    for structure in [SPD, Structure::General] {
        let flat = matrix(2, 3, &[(0, 0, 1.0), (1, 2, 1.0)]);
        assert_eq!(refusal(&flat, structure, &ones(2)), SolveError::NotSquare { rows: 2, columns: 3 });
        assert_eq!(
            refusal(&unit, structure, &ones(3)),
            SolveError::WrongRightHandSide { expected: 2, found: 3 }
        );
        let infinite = matrix(2, 2, &[(0, 0, 1.0), (1, 0, f64::INFINITY), (1, 1, 1.0)]);
        assert_eq!(refusal(&infinite, structure, &ones(2)), SolveError::NonFiniteEntry { row: 1, column: 0 });
        let mut rhs = DMatrix::zeros(2, 2);
        rhs[(1, 1)] = f64::NAN;
        assert_eq!(refusal(&unit, structure, &rhs), SolveError::NonFiniteRightHandSide { row: 1, column: 1 });
        let empty_row = matrix(2, 2, &[(0, 0, 1.0), (0, 1, 1.0)]);
        assert_eq!(refusal(&empty_row, structure, &ones(2)), SolveError::Singular { row: Some(1) });
        assert!(Symbolic::analyze(&flat, structure).is_err());
    }
    let mut outside = Triplets::new(2, 2);
    outside.add(0, 2, 1.0);
    assert_eq!(outside.build(), Err(SolveError::OutOfRange { row: 0, column: 2, rows: 2, columns: 2 }));
    for bound in [0.0, -1.0, f64::NAN] {
        let options = SolveOptions { residual_bound: bound, ..Default::default() };
        let refused = solve(&unit, SPD, &ones(2), &options).unwrap_err();
        assert!(matches!(refused, SolveError::BadBound(_)), "{refused}");
    }
}

/// Indefinite matrices have no Cholesky factor, and the row without a pivot is named.
#[test]
fn indefinite_matrices_are_refused() {
    let mut random = Random::new(1);
    for side in [3, 80] {
        let mut indefinite = spd(side, 2.0, &mut random);
        let bad = side + 1;
        let (offsets, columns, values) = indefinite.csr_data_mut();
        for place in offsets[bad]..offsets[bad + 1] {
            if columns[place] == bad {
                values[place] = -1.0;
            }
        }
        let expected = SolveError::NotPositiveDefinite { row: Some(bad) };
        assert_eq!(refusal(&indefinite, SPD, &ones(side * side)), expected);
    }
}

/// A free Laplacian determines nothing; with a right-hand side that does not add up to zero there is no answer.
#[test]
fn singular_matrices_are_refused() {
    let n = 50;
    let mut entries = Vec::new();
    for i in 0..n {
        let j = (i + 1) % n;
        entries.extend([(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)]);
    }
    let free = matrix(n, n, &entries);
    for structure in [SPD, Structure::General] {
        for backend in [Backend::Auto, Backend::Direct, Backend::Iterative] {
            let options = SolveOptions { backend, max_iterations: 200, ..Default::default() };
            let refused = solve(&free, structure, &ones(n), &options).unwrap_err();
            let said = matches!(
                refused,
                SolveError::Inaccurate { .. }
                    | SolveError::Singular { .. }
                    | SolveError::NotPositiveDefinite { .. }
            );
            assert!(said, "{structure:?} {backend:?}: {refused}");
        }
    }
}

/// Two equal rows leave no pivot.
#[test]
fn dependent_rows_are_refused() {
    let twice = matrix(2, 2, &[(0, 0, 1.0), (0, 1, 2.0), (1, 0, 1.0), (1, 1, 2.0)]);
    assert!(matches!(
        refusal(&twice, Structure::General, &DMatrix::from_vec(2, 1, vec![1.0, 2.5])),
        SolveError::Singular { .. } | SolveError::Inaccurate { .. }
    ));
    let one_column = matrix(3, 3, &[(0, 0, 1.0), (1, 0, 2.0), (2, 2, 1.0)]);
    assert!(matches!(refusal(&one_column, Structure::General, &ones(3)), SolveError::Singular { .. }));
}

/// The bound decides: a hopeless system (a Hilbert matrix, condition 1e18) passes no bound of rounding size.
#[test]
fn the_bound_refuses_a_hopeless_system() {
    let n = 14;
    let entries: Vec<_> = (0..n * n).map(|k| (k / n, k % n, 1.0 / ((k / n + k % n + 1) as f64))).collect();
    let hilbert = matrix(n, n, &entries);
    let options = SolveOptions { residual_bound: 1e-15, ..Default::default() };
    let rhs = DMatrix::from_fn(n, 1, |row, _| if row % 2 == 0 { 1.0 } else { -1.0 });
    match solve(&hilbert, Structure::General, &rhs, &options) {
        Err(SolveError::Inaccurate { residual, bound }) => assert!(residual > bound && bound == 1e-15),
        other => panic!("{other:?}"),
    }
}

/// An asymmetric matrix that is passed off as symmetric is found out by its residual.
#[test]
fn asymmetry_is_found_out() {
    let tilted = matrix(2, 2, &[(0, 0, 2.0), (0, 1, -1.0), (1, 1, 2.0)]);
    assert!(matches!(refusal(&tilted, SPD, &ones(2)), SolveError::Inaccurate { .. }));
}
