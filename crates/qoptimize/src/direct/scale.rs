//! The scale at which a first map has the least energy.
//!
//! A start on the unit circle knows nothing of the mesh's size. Scaled first, the descent does not depend on the unit of
//! length, and begins nearer to its end.

use rayon::prelude::*;

use crate::qmesh::Vec2;

use super::Objective;
use super::element::{Edges, jacobian};
use super::energy;
use super::rest::{Corners, Rest, RestCorner};

/// Corners that one task takes.
const CHUNK: usize = 4096;

/// How the energy depends on the area factor `S` of a scaling: `a S⁻² + b S⁻¹ + c S + d S²`, up to a constant.
#[derive(Clone, Copy, Debug, Default)]
struct Powers {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
}

impl Powers {
    fn add(&mut self, objective: &Objective, rest: &RestCorner, f: Edges) {
        let [a, b, c, d] = jacobian(rest, f);
        let (norm, det) = (a * a + b * b + c * c + d * d, a * d - b * c);
        match *objective {
            Objective::Direct { q, shape, .. } => {
                let (area, dirichlet) = ((1.0 - q) * rest.share, shape * rest.weight / 4.0);
                self.a += area / (2.0 * det * det);
                self.b += dirichlet * norm / (det * det) - area / det;
                self.c += dirichlet * norm - area * det;
                self.d += area * det * det / 2.0;
            }
            Objective::Conformal { q } => {
                self.b += (1.0 - q) * rest.weight / (2.0 * det);
                self.c += (1.0 - q) * rest.weight * det / 2.0;
            }
        }
    }

    fn plus(self, other: &Self) -> Self {
        Self { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c, d: self.d + other.d }
    }

    /// A minimum over `S`: where the derivative by log S changes its sign, found by bisection.
    fn least(&self) -> Option<f64> {
        let slope = |log: f64| {
            let s = log.exp2();
            -2.0 * self.a / (s * s) - self.b / s + self.c * s + 2.0 * self.d * s * s
        };
        let [mut low, mut high] = [-200.0, 200.0];
        if !(slope(low) < 0.0 && slope(high) > 0.0) {
            return None;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if slope(middle) < 0.0 { low = middle } else { high = middle }
        }
        Some((0.5 * (low + high)).exp2())
    }
}

/// Scales `uv`, in the units of `rest`, to a scale of least energy.
pub(super) fn to_best_scale(rest: &Rest, objective: &Objective, uv: &mut [Vec2]) {
    let of_chunk = |chunk: Corners<'_>| {
        let mut powers = Powers::default();
        for (at, corner) in chunk.corners.iter().enumerate() {
            powers.add(objective, corner, chunk.edges(at, uv));
        }
        powers
    };
    // In chunks of fixed size, so that the sums do not depend on the number of threads.
    let chunks: Vec<Powers> = rest.par_chunks(CHUNK).map(of_chunk).collect();
    let powers = chunks.iter().fold(Powers::default(), Powers::plus);
    let Some(scale) = powers.least().map(f64::sqrt).filter(|scale| scale.is_normal()) else { return };
    let scaled: Vec<Vec2> = uv.iter().map(|p| p * scale).collect();
    if energy::value(objective, rest, &scaled).is_finite() {
        uv.copy_from_slice(&scaled);
        return;
    }
    // Corners at the edge of what `f64` can tell do not bear rounding; a power of two rounds nothing.
    let power = scale.log2().round().exp2();
    uv.iter_mut().for_each(|p| *p *= power);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convexity::Exempt;
    use crate::direct::{AngleTerm, find_start};
    use crate::qmesh::shapes;

    /// Slightly smaller and slightly larger is worse, and doing it again changes nothing.
    #[test]
    fn the_scale_is_a_minimum() {
        for mesh in [shapes::bump(9, 0.8), shapes::jittered_grid(6, 9, 0.3, 1), shapes::finger(2, 20)] {
            let exempt = Exempt::find(&mesh);
            let rest = Rest::new(&mesh, &exempt);
            for objective in [
                Objective::default(),
                Objective::Direct { q: 0.95, shape: 0.1, angle_term: AngleTerm::Paper },
                Objective::Conformal { q: 0.3 },
            ] {
                let mut uv = find_start(&mesh, &exempt, &()).unwrap().uv;
                to_best_scale(&rest, &objective, &mut uv);
                let energy = |factor: f64| {
                    let scaled: Vec<Vec2> = uv.iter().map(|p| p * factor).collect();
                    energy::value(&objective, &rest, &scaled)
                };
                assert!(energy(1.0) < energy(0.999).min(energy(1.001)), "{objective:?}");
                let mut again = uv.clone();
                to_best_scale(&rest, &objective, &mut again);
                let change =
                    again.iter().zip(uv.iter()).map(|(a, b)| (a - b).norm() / b.norm()).fold(0.0, f64::max);
                assert!(change < 1e-12, "{objective:?}: {change:e}");
            }
        }
    }
}
