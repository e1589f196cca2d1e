//! Assembly: the order of triplets does not matter for where entries are, and duplicates add up in order.

use proptest::prelude::*;
use qsolve::Triplets;
use std::collections::BTreeMap;

proptest! {
    /// Against a map as the oracle, bit for bit.
    #[test]
    fn duplicates_add_up_in_the_order_of_arrival(
        entries in prop::collection::vec((0_usize..9, 0_usize..7, -1e9..1e9), 0..200),
    ) {
        let mut triplets = Triplets::new(9, 7);
        let mut oracle: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for &(row, column, value) in &entries {
            triplets.add(row, column, value);
            oracle.entry((row, column)).and_modify(|sum| *sum += value).or_insert(value);
        }
        let matrix = triplets.build().unwrap();
        prop_assert_eq!((matrix.nrows(), matrix.ncols()), (9, 7));
        let built: Vec<_> = matrix.triplet_iter().map(|(row, column, value)| ((row, column), *value)).collect();
        prop_assert_eq!(built, oracle.into_iter().collect::<Vec<_>>());
    }
}

/// Matrices without entries, rows or columns.
#[test]
fn empty_matrices() {
    for (rows, columns) in [(0, 0), (3, 0), (0, 3), (2, 2)] {
        let matrix = Triplets::new(rows, columns).build().unwrap();
        assert_eq!((matrix.nrows(), matrix.ncols(), matrix.nnz()), (rows, columns, 0));
    }
}
