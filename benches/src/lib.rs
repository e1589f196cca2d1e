//! What the benches share: sizes, and a mesh of any size from a formula.

use qoptimize::qmesh::{Polygons, QuadMesh, shapes};
use qoptimize::qsolve::{CsrMatrix, Triplets};

/// Quads along one side; the number of quads is the square.
const SIDES: [usize; 4] = [32, 100, 316, 1000];

/// Quads along one side, from a thousand quads to a million, but no more quads than the environment variable
/// `QPARAM_BENCH_LARGEST` says: systems of a million unknowns take a while.
#[must_use]
pub fn sides() -> Vec<usize> {
    let largest = std::env::var("QPARAM_BENCH_LARGEST").ok().and_then(|text| text.parse().ok());
    SIDES.into_iter().filter(|side| largest.is_none_or(|largest: usize| side * side <= largest)).collect()
}

/// A smooth height field with a bump, `side × side` quads: curved everywhere, valid seen from above.
#[must_use]
pub fn face_like(side: usize) -> QuadMesh {
    shapes::bump(side, 0.5)
}

/// The polygons that `mesh` was built from.
#[must_use]
pub fn polygons(mesh: &QuadMesh) -> Polygons {
    mesh.view().to_polygons()
}

/// Unit springs between the neighbours of a `side × side` grid, and between the outermost nodes and walls around them.
///
/// # Panics
/// Never: all entries lie inside.
#[must_use]
pub fn grid_laplacian(side: usize) -> CsrMatrix<f64> {
    let n = side * side;
    let mut triplets = Triplets::with_capacity(n, n, 5 * n);
    for node in 0..n {
        let (x, y) = (node % side, node / side);
        triplets.add(node, node, 4.0);
        let inside = [(x > 0, 1, 0), (x + 1 < side, 0, 1), (y > 0, side, 0), (y + 1 < side, 0, side)];
        for (_, before, after) in inside.into_iter().filter(|(is_inside, ..)| *is_inside) {
            triplets.add(node, node + after - before, -1.0);
        }
    }
    triplets.build().expect("all entries lie inside")
}
