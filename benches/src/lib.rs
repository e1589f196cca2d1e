//! What the benches share: sizes, and a mesh of any size from a formula.

use qoptimize::qmesh::{Polygons, QuadMesh, shapes};

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
    let view = mesh.view();
    Polygons {
        positions: view.positions.to_vec(),
        face_start: view.face_start.to_vec(),
        corner_vertex: view.corner_vertex.to_vec(),
    }
}
