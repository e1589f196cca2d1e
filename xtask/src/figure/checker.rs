//! A polygon that has a place on a board, cut into its checks.

use qparam_cli::qmesh::Vec2;

/// A corner in the picture and its place on the board, whose checks have side 1.
#[derive(Clone, Copy)]
pub(super) struct Pin {
    pub(super) place: Vec2,
    pub(super) board: Vec2,
}

/// A part of a polygon that lies on one check.
pub(super) struct Part {
    pub(super) is_dark: bool,
    pub(super) outline: Vec<Vec2>,
}

/// The parts of the polygon, one a check.
///
/// Corners are interpolated along edges only, which neighbours share: the checks fit together across edges, and no
/// diagonal of a quad is preferred.
pub(super) fn parts(polygon: &[Pin]) -> Vec<Part> {
    let mut parts = Vec::new();
    for column in slices(polygon, 0) {
        for check in slices(&column.pins, 1) {
            parts.push(Part {
                is_dark: (column.index + check.index).rem_euclid(2) == 0,
                outline: check.pins.iter().map(|pin| pin.place).collect(),
            });
        }
    }
    parts
}

struct Slice {
    index: i64,
    pins: Vec<Pin>,
}

/// The polygon cut along the integers of one coordinate of the board.
fn slices(polygon: &[Pin], axis: usize) -> Vec<Slice> {
    let low = polygon.iter().map(|pin| pin.board[axis]).fold(f64::MAX, f64::min);
    let high = polygon.iter().map(|pin| pin.board[axis]).fold(f64::MIN, f64::max);
    (low.floor() as i64..high.ceil() as i64)
        .map(|index| {
            let above = keep(polygon, |pin| pin.board[axis] - index as f64);
            Slice { index, pins: keep(&above, |pin| (index + 1) as f64 - pin.board[axis]) }
        })
        .filter(|slice| slice.pins.len() > 2)
        .collect()
}

/// The part of the polygon where `inside` is not negative (Sutherland and Hodgman).
fn keep(polygon: &[Pin], inside: impl Fn(&Pin) -> f64) -> Vec<Pin> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (from, to) = (inside(a), inside(b));
        if from >= 0.0 {
            kept.push(*a);
        }
        if (from < 0.0) != (to < 0.0) {
            let t = from / (from - to);
            kept.push(Pin { place: a.place.lerp(&b.place, t), board: a.board.lerp(&b.board, t) });
        }
    }
    kept
}

/// Twice the signed area.
pub(super) fn doubled_area(polygon: &[Vec2]) -> f64 {
    polygon.iter().zip(polygon.iter().cycle().skip(1)).map(|(a, b)| a.perp(b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the light parts and of the dark ones.
    fn areas(polygon: &[Pin]) -> [f64; 2] {
        let mut areas = [0.0; 2];
        for part in parts(polygon) {
            areas[usize::from(part.is_dark)] += doubled_area(&part.outline) / 2.0;
        }
        areas
    }

    fn board(corners: &[[f64; 2]]) -> Vec<Pin> {
        corners.iter().map(|&[x, y]| Pin { place: Vec2::new(x, y), board: Vec2::new(x, y) }).collect()
    }

    /// Half of a board is dark, wherever it is cut from.
    #[test]
    fn an_even_board_is_half_dark() {
        for [x, y] in [[0.0, 0.0], [0.3, -2.6], [-7.25, 0.5]] {
            let [light, dark] = areas(&board(&[[x, y], [x + 4.0, y], [x + 4.0, y + 2.0], [x, y + 2.0]]));
            assert!((dark - 4.0).abs() < 1e-12 && (light - 4.0).abs() < 1e-12);
        }
    }

    /// What is dark in a polygon is dark in its parts: cutting along any edge changes nothing.
    #[test]
    fn parts_of_a_polygon_have_the_checks_of_the_whole() {
        let whole = board(&[[0.1, 0.2], [5.3, -0.4], [4.9, 3.3], [0.4, 2.8]]);
        let [one, other] = [[0, 1, 2], [0, 2, 3]].map(|half| areas(&half.map(|i| whole[i])));
        for (i, area) in areas(&whole).into_iter().enumerate() {
            assert!((one[i] + other[i] - area).abs() < 1e-12);
        }
    }

    #[test]
    fn one_check_is_dark_and_its_neighbour_is_not() {
        let check = |x: f64| areas(&board(&[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]));
        assert_eq!([check(0.0), check(1.0)], [[0.0, 1.0], [1.0, 0.0]]);
    }
}
