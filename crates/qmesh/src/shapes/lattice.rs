//! Columns times rows of quads: flat, closed to a tube, or closed to a ring of tubes.

use crate::{Polygons, QuadMesh, Vec3};

/// The most columns; more are clamped.
pub(crate) const MOST_COLUMNS: usize = 1 << 24;
/// The most faces of a lattice; rows beyond it are clamped away, so that `u32` corner ids suffice.
pub(crate) const MOST_FACES: usize = 1 << 28;

/// A lattice of `columns` × `rows` quads whose columns or rows may close up.
#[derive(Clone, Copy)]
pub(crate) struct Lattice {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    columns_close: bool,
    rows_close: bool,
}

impl Lattice {
    /// A rectangle.
    pub(crate) fn open(columns: usize, rows: usize) -> Self {
        Self::clamped([columns, rows], [false, false])
    }

    /// A square of at most [`MOST_FACES`] faces.
    pub(crate) fn square(cells: usize) -> Self {
        let cells = cells.min(1 << 14);
        Self::open(cells, cells)
    }

    /// A tube: the last column meets the first.
    pub(crate) fn tube(columns: usize, rows: usize) -> Self {
        Self::clamped([columns, rows], [true, false])
    }

    /// A torus: rows close up as well.
    pub(crate) fn torus(columns: usize, rows: usize) -> Self {
        Self::clamped([columns, rows], [true, true])
    }

    /// Three columns are needed to close up: with two, a pair of edges would share both ends.
    fn clamped([columns, rows]: [usize; 2], [columns_close, rows_close]: [bool; 2]) -> Self {
        let least = |closes: bool| if closes { 3 } else { 1 };
        let columns = columns.clamp(least(columns_close), MOST_COLUMNS);
        let rows = rows.clamp(least(rows_close), MOST_FACES / columns);
        Self { columns, rows, columns_close, rows_close }
    }

    /// Puts vertex (column, row) at `position([column / columns, row / rows])`; quads run counter-clockwise in
    /// the plane of columns (to the right) and rows (up).
    pub(crate) fn mesh(self, mut position: impl FnMut([f64; 2]) -> Vec3) -> QuadMesh {
        let across = self.columns + usize::from(!self.columns_close);
        let up = self.rows + usize::from(!self.rows_close);
        let mut polygons = Polygons::default();
        polygons.positions.reserve(across * up);
        for row in 0..up {
            for column in 0..across {
                let fraction = [column as f64 / self.columns as f64, row as f64 / self.rows as f64];
                polygons.positions.push(position(fraction));
            }
        }
        let vertex = |column: usize, row: usize| ((row % up) * across + column % across) as u32;
        polygons.corner_vertex.reserve(4 * self.columns * self.rows);
        for row in 0..self.rows {
            for column in 0..self.columns {
                let (right, above) = (column + 1, row + 1);
                polygons.push_face(&[
                    vertex(column, row),
                    vertex(right, row),
                    vertex(right, above),
                    vertex(column, above),
                ]);
            }
        }
        built(polygons)
    }
}

/// The mesh of polygons that are one by construction.
pub(crate) fn built(polygons: Polygons) -> QuadMesh {
    match QuadMesh::build(polygons) {
        Ok(mesh) => mesh,
        Err(error) => unreachable!("a shape is a manifold by construction: {error}"),
    }
}
