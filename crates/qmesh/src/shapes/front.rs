//! What face and head have in common: the layout of quads around eyes and mouth.

use super::anatomy::{EYE, EYE_OPENING, MOUTH, MOUTH_HEIGHT, at_height, from_front, shrink_wrap};
use super::cage::Cage;
use super::elementary::sin_cos;
use crate::Vec3;

/// Columns of quads from one temple to the other.
pub(crate) const COLUMNS: usize = 12;
/// Rows of quads from forehead to chin.
pub(crate) const ROWS: usize = 12;
/// Columns and rows of the blocks that become rings.
const EYES: [[[usize; 2]; 2]; 2] = [[[2, 5], [3, 5]], [[7, 10], [3, 5]]];
const LIPS: [[usize; 2]; 2] = [[4, 8], [8, 10]];

/// The part of a lattice of vertices between two columns and two rows.
fn block(rows: &[Vec<u32>], [columns, range]: [[usize; 2]; 2]) -> Vec<Vec<u32>> {
    rows[range[0]..=range[1]].iter().map(|row| row[columns[0]..=columns[1]].to_vec()).collect()
}

/// Fills `ROWS + 1` rows of `COLUMNS + 1` vertices with quads that run around eyes and mouth.
pub(crate) fn fill(cage: &mut Cage, rows: &[Vec<u32>]) {
    for row in 0..ROWS {
        let mut column = 0;
        while column < COLUMNS {
            let inset = EYES.iter().chain([&LIPS]).find(|[columns, range]| {
                (columns[0]..columns[1]).contains(&column) && (range[0]..range[1]).contains(&row)
            });
            let end = inset.map_or(column + 1, |[columns, _]| columns[1]);
            if inset.is_none() {
                cage.fill(&block(rows, [[column, end], [row, row + 1]]));
            }
            column = end;
        }
    }
    for (eye, side) in EYES.into_iter().zip([-1.0, 1.0]) {
        cage.fill_with_inset(&block(rows, eye), |place| {
            // Smoothing shrinks the lens: this much larger, its rim ends on the lids.
            let [width, height] = EYE_OPENING.map(|half| 1.2 * half);
            let [x, y] = lens(place, width, [height; 2]);
            from_front(side * EYE[0] + x, EYE[1] + y)
        });
    }
    cage.fill_with_inset(&block(rows, LIPS), |place| {
        let [x, y] = lens(place, MOUTH[0], [MOUTH[1], MOUTH[2]]);
        from_front(x, MOUTH_HEIGHT + y)
    });
}

/// A square pressed into a lens with its tips left and right.
fn lens([u, v]: [f64; 2], width: f64, [above, below]: [f64; 2]) -> [f64; 2] {
    let x = u * (1.0 - 0.25 * v * v);
    [width * x, v * (1.0 - x * x) * if v > 0.0 { above } else { below }]
}

/// The point of the head at an angle, in degrees, to the left of straight ahead, and a height.
pub(crate) fn around(degrees: f64, y: f64) -> Vec3 {
    at_height(y, sin_cos(degrees / 360.0))
}

/// The same for the jaw, which slants: where the ray goes that aims at `y` at a distance of `radius` from the axis.
pub(crate) fn around_jaw(degrees: f64, y: f64, radius: f64) -> Vec3 {
    let [sine, cosine] = sin_cos(degrees / 360.0);
    shrink_wrap(Vec3::new(radius * sine, y, radius * cosine))
}
