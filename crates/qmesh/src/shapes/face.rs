//! A human face.

use super::anatomy::shrink_wrapped;
use super::cage::Cage;
use super::front::{self, COLUMNS, ROWS};
use crate::{QuadMesh, Vec3};

/// Angle of each column to the left of straight ahead, in degrees.
const ANGLES: [f64; COLUMNS / 2 + 1] = [0.0, 9.0, 19.0, 29.0, 39.0, 53.0, 68.0];
/// Height of each row, in decimetres above the eyes.
const HEIGHTS: [f64; ROWS + 1] =
    [0.84, 0.60, 0.38, 0.17, 0.0, -0.15, -0.29, -0.42, -0.56, -0.735, -0.88, -0.97, -1.05];

/// A human face, from hairline to chin and from ear to ear, looking along `z`: a disk whose quads run around eyes
/// and mouth. Mirror-symmetric in `x`.
///
/// `176·detail²` quads: 704 with 2, 1584 with 3, 4400 with 5, 17 600 with 10, a million with 76. `detail` is at least 1 and at most 1000 (clamped).
///
/// ```
/// let mesh = qmesh::shapes::face(3);
/// assert_eq!(mesh.face_count(), 1584);
/// assert!(mesh.topology().is_disk());
/// ```
#[must_use]
pub fn face(detail: usize) -> QuadMesh {
    let mut cage = Cage::default();
    let rows: Vec<Vec<u32>> = HEIGHTS
        .iter()
        .map(|&y| (0..=COLUMNS).map(|column| cage.vertex(rounded(column, y))).collect())
        .collect();
    front::fill(&mut cage, &rows);
    shrink_wrapped(cage.refine(detail.clamp(1, 1000)))
}

/// The point of the lattice in this column and at this height, the lattice pressed into an oval.
fn rounded(column: usize, y: f64) -> Vec3 {
    const MIDDLE: f64 = -0.14;
    const ROUNDING: f64 = 0.24;
    const HALF: usize = COLUMNS / 2;
    let degrees = if column < HALF { -ANGLES[HALF - column] } else { ANGLES[column - HALF] };
    let u = degrees / ANGLES[HALF];
    let v = (y - MIDDLE) / (HEIGHTS[0] - MIDDLE);
    let taper = 1.0 - ROUNDING * v * v - if v < 0.0 { 0.15 * v * v } else { 0.0 };
    front::around(degrees * taper, MIDDLE + (y - MIDDLE) * (1.0 - ROUNDING * u * u))
}
