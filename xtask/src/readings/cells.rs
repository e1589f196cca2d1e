//! Voronoi cells: the paper's formulas, ours, and points thrown at triangles.

use qparam_cli::qcurv::{triangle_area, voronoi_cell_area};
use qparam_cli::qmesh::{Vec2, Vec3};

use super::random::Random;
use super::table::{Table, digits};

/// Points thrown at each triangle: the third digit is then off by one at most times.
const POINTS: usize = 1_000_000;

/// Angles at A, B and C in degrees.
const TRIANGLES: [[f64; 3]; 5] =
    [[66., 56., 58.], [145., 18., 17.], [120., 45., 15.], [27., 139., 14.], [27., 14., 139.]];

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(
        "angles at A, B, C | points nearest to A | `voronoi_cell_area` | Eq. 3 | Eq. 4 as printed | Eq. 4, edges exchanged",
    );
    for degrees in TRIANGLES {
        let triangle = Triangle::new(degrees);
        let obtuse = degrees.iter().any(|&angle| angle > 90.0);
        let eq4 = |exchanged: bool| if obtuse { digits(triangle.eq4(exchanged)) } else { "–".to_owned() };
        table.row(&[
            degrees.map(|angle| angle.to_string()).join(", "),
            digits(triangle.sampled()),
            digits(triangle.ours()),
            digits(triangle.eq3()),
            eq4(false),
            eq4(true),
        ]);
    }
    Ok(format!(
        "The cell of A as a fraction of its triangle: by {POINTS} random points, by the code, and by the paper's formulas \
         with γ at v_j = B and δ at v_k = C. The paper has no formula for the last two triangles.\n\n{}",
        table.text()
    ))
}

struct Triangle {
    angles: [f64; 3],
    /// B and C; A is the origin.
    sides: [Vec2; 2],
}

impl Triangle {
    fn new(degrees: [f64; 3]) -> Self {
        let angles @ [a, b, c] = degrees.map(f64::to_radians);
        // Law of sines.
        let (ab, ac) = (c.sin(), b.sin());
        Self { angles, sides: [Vec2::new(ab, 0.0), ac * Vec2::new(a.cos(), a.sin())] }
    }

    fn area(&self) -> f64 {
        0.5 * self.sides[0].perp(&self.sides[1])
    }

    fn ours(&self) -> f64 {
        let [ab, ac] = self.sides.map(|side| Vec3::new(side.x, side.y, 0.0));
        voronoi_cell_area(ab, ac) / triangle_area(ab, ac)
    }

    fn sampled(&self) -> f64 {
        let [b, c] = self.sides;
        let mut random = Random::new(7);
        let mut nearest = 0;
        for _ in 0..POINTS {
            let (mut s, mut t) = (random.unit(), random.unit());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let point = s * b + t * c;
            let here = point.norm_squared();
            nearest += usize::from(here < (point - b).norm_squared() && here < (point - c).norm_squared());
        }
        nearest as f64 / POINTS as f64
    }

    fn squares(&self) -> [f64; 2] {
        self.sides.map(|side| side.norm_squared())
    }

    /// Eq. 3 for any triangle.
    fn eq3(&self) -> f64 {
        let ([_, gamma, delta], [ab, ac]) = (self.angles, self.squares());
        (ac / gamma.tan() + ab / delta.tan()) / 8.0 / self.area()
    }

    /// Eq. 4 for any triangle; as printed γ goes with v_i v_k and δ with v_i v_j.
    fn eq4(&self, exchanged: bool) -> f64 {
        let ([_, gamma, delta], [ab, ac]) = (self.angles, self.squares());
        let [at_gamma, at_delta] = if exchanged { [ab, ac] } else { [ac, ab] };
        1.0 - (at_gamma * gamma.tan() + at_delta * delta.tan()) / 8.0 / self.area()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The code agrees with the points on every triangle, Eq. 4 as printed with none that is obtuse at B or C.
    #[test]
    fn points_decide() {
        for degrees in TRIANGLES {
            let triangle = Triangle::new(degrees);
            assert!((triangle.sampled() - triangle.ours()).abs() < 2e-3, "{degrees:?}");
        }
        let obtuse_at_b = Triangle::new([27., 139., 14.]);
        assert!((obtuse_at_b.eq4(false) - obtuse_at_b.sampled()).abs() > 1.0);
    }
}
