//! What the benches share: sizes, and a mesh of any size from a formula.

use qoptimize::qmesh::{Polygons, QuadMesh, shapes};

/// Quads along one side; the number of quads is the square.
pub const SIZES: [usize; 3] = [32, 100, 316];

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
