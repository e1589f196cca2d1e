//! Voronoi cells (Eqs. 3 and 4) against cells that are cut out of the triangle by its bisectors.

use proptest::prelude::*;
use qcurv::{triangle_area, voronoi_cell_area};
use qmesh::{Vec2, Vec3};

/// The area of the part of the triangle nearer to its first vertex: cut along both bisectors, then measured.
fn clipped_cell(triangle: [Vec2; 3]) -> f64 {
    let mut polygon = triangle.to_vec();
    for other in &triangle[1..] {
        let (middle, direction) = ((triangle[0] + other) / 2.0, other - triangle[0]);
        let beyond = |p: &Vec2| (p - middle).dot(&direction);
        let mut cut = Vec::new();
        for (i, p) in polygon.iter().enumerate() {
            let q = &polygon[(i + 1) % polygon.len()];
            let (at_p, at_q) = (beyond(p), beyond(q));
            if at_p <= 0.0 {
                cut.push(*p);
            }
            if (at_p < 0.0) != (at_q < 0.0) && at_p != at_q {
                cut.push(p + (q - p) * (at_p / (at_p - at_q)));
            }
        }
        polygon = cut;
    }
    let cross = |i: usize| polygon[i].perp(&polygon[(i + 1) % polygon.len()]);
    (0..polygon.len()).map(cross).sum::<f64>().abs() / 2.0
}

fn in_space(v: Vec2) -> Vec3 {
    // An isometric copy of the plane, askew in space.
    Vec3::new(2.0, 1.0, 2.0) / 3.0 * v.x + Vec3::new(-2.0, 2.0, 1.0) / 3.0 * v.y
}

fn cell([a, b, c]: [Vec2; 3]) -> f64 {
    voronoi_cell_area(in_space(b - a), in_space(c - a))
}

fn with_angles(degrees: [f64; 3]) -> [Vec2; 3] {
    let [a, b, c] = degrees.map(f64::to_radians);
    // Law of sines; A at the origin, B on the x axis.
    let (ab, ac) = (c.sin(), b.sin());
    [Vec2::zeros(), Vec2::new(ab, 0.0), Vec2::new(ac * a.cos(), ac * a.sin())]
}

/// Each kind of triangle, as a fraction of its area: nowhere obtuse, obtuse at A, at B, at C.
#[test]
fn every_obtuse_case() {
    let cases = [
        ([66., 56., 58.], 0.3554),
        ([145., 18., 17.], 0.7252),
        ([27., 139., 14.], 0.1035),
        ([27., 14., 139.], 0.1035),
    ];
    for (degrees, expected) in cases {
        let triangle = with_angles(degrees);
        let area = triangle_area(in_space(triangle[1]), in_space(triangle[2]));
        let (formula, clipped) = (cell(triangle) / area, clipped_cell(triangle) / area);
        assert!((formula - clipped).abs() < 1e-12, "{degrees:?}: {formula}, {clipped}");
        assert!((formula - expected).abs() < 1e-4, "{degrees:?}: {formula}");
    }
}

/// A right angle is the border between two formulas; there they agree.
#[test]
fn continuous_at_right_angles() {
    for (exact, beside) in [
        ([90., 50., 40.], [90.0001, 50., 39.9999]),
        ([50., 90., 40.], [50., 90.0001, 39.9999]),
        ([50., 40., 90.], [50., 39.9999, 90.0001]),
    ] {
        assert!((cell(with_angles(exact)) - cell(with_angles(beside))).abs() < 1e-5);
    }
}

proptest! {
    /// Any triangle: the formula is the cell that the bisectors cut out, and the three cells fill the triangle.
    #[test]
    fn cells_are_cut_by_the_bisectors(c in prop::array::uniform6(-1.0..1.0f64)) {
        let [a, b, c] = [Vec2::new(c[0], c[1]), Vec2::new(c[2], c[3]), Vec2::new(c[4], c[5])];
        let area = triangle_area(in_space(b - a), in_space(c - a));
        prop_assume!(area > 1e-3);
        let cells = [cell([a, b, c]), cell([b, c, a]), cell([c, a, b])];
        prop_assert!((cells[0] - clipped_cell([a, b, c])).abs() < 1e-10);
        prop_assert!((cells.iter().sum::<f64>() - area).abs() < 1e-10);
    }

    /// Needles of any width: never negative, never more than the triangle.
    #[test]
    fn cells_stay_within_the_triangle(x in -2.0..3.0f64, exponent in -320..0i32) {
        let (ab, ac) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(x, 10f64.powi(exponent), 0.0));
        let cell = voronoi_cell_area(ab, ac);
        prop_assert!((0.0..=triangle_area(ab, ac) * (1.0 + 1e-12)).contains(&cell));
    }
}
