//! Making a first map more even, by what it costs to solve Tutte's system a few times more.
//!
//! After [Yoshizawa, Belyaev, Seidel 2004, "A fast and simple stretch-minimizing mesh parameterization"]: where the map has
//! crowded much surface into little room, edges are made weaker, and the next solution spreads it. Weights stay positive, so each
//! map is as valid as the first; but no step is bounded by corners about to collapse, as those of the descent are. Of the
//! armadillo with one loop at its ankle eight solutions bring the energy from 7e5 to 222, which takes the descent a hundred steps.

use crate::qmesh::{EdgeData, QuadMesh, Vec2};

use super::energy::edges;
use super::rest::Rest;

/// A map is crowded when surface lies this much denser than on average, in the mean over the surface.
const CROWDED: f64 = 8.0;
/// Solutions at most.
pub(super) const MAX_ROUNDS: usize = 10;
/// A round that betters the crowding by less than this factor is the last.
const LEAST_GAIN: f64 = 1.15;
/// Weights stay within this factor of their geometric mean: what a factorization bears.
const CONTRAST: f64 = 1e6;

/// How crowded maps are.
pub(super) struct Crowding {
    /// Per vertex, the area in the plane over that in space of the corner triangles at it, relative to all.
    room: Vec<f64>,
    /// The mean over the surface of how much denser than on average it lies; 1 where areas are kept.
    pub(super) mean: f64,
}

impl Crowding {
    pub(super) fn of(rest: &Rest, uv: &[Vec2]) -> Self {
        let mut at_rest = vec![0.0; uv.len()];
        let mut mapped = vec![0.0; uv.len()];
        let (mut total_at_rest, mut total_mapped, mut squeezed) = (0.0, 0.0, 0.0);
        for corner in &rest.corners {
            let [f1x, f1y, f0x, f0y] = edges(corner, uv);
            let area = 0.5 * (f1x * f0y - f1y * f0x).abs();
            total_at_rest += corner.area;
            total_mapped += area;
            squeezed += corner.area * corner.area / area;
            for v in corner.vertices {
                at_rest[v as usize] += corner.area;
                mapped[v as usize] += area;
            }
        }
        let scale = total_at_rest / total_mapped;
        let room = at_rest.iter().zip(&mapped).map(|(rest, mapped)| scale * mapped / rest).collect();
        Self { room, mean: squeezed / total_at_rest / scale }
    }

    pub(super) fn is_high(&self) -> bool {
        self.mean > CROWDED || self.mean.is_nan()
    }

    /// Weakens edges where there is little room.
    fn weaken(&self, mesh: &QuadMesh, weights: &mut EdgeData<f64>) {
        for edge in mesh.edges() {
            let [a, b] = mesh.edge_vertices(edge).map(|v| self.room[v.index()]);
            let factor = (a * b).powf(0.25);
            if factor.is_finite() {
                weights[edge] *= factor.max(f64::MIN_POSITIVE);
            }
        }
        let logs: f64 = weights.iter().map(|weight| weight.ln()).sum();
        let mean = (logs / mesh.edge_count() as f64).exp();
        weights.iter_mut().for_each(|weight| *weight = (*weight / mean).clamp(CONTRAST.recip(), CONTRAST));
    }
}

/// Maps with ever better weights, from `first` which has `weights`: as long as `solve` gives valid ones that are more even.
pub(super) fn evened(
    mesh: &QuadMesh,
    rest: &Rest,
    weights: &mut EdgeData<f64>,
    first: &[Vec2],
    mut solve: impl FnMut(&EdgeData<f64>) -> Option<Vec<Vec2>>,
) -> Option<Vec<Vec2>> {
    let mut crowding = Crowding::of(rest, first);
    let mut best = None;
    for _ in 0..MAX_ROUNDS {
        if !crowding.is_high() {
            break;
        }
        crowding.weaken(mesh, weights);
        let Some(uv) = solve(weights) else { break };
        let next = Crowding::of(rest, &uv);
        let gain = crowding.mean / next.mean;
        if gain > 1.0 {
            best = Some(uv);
        }
        if gain < LEAST_GAIN || gain.is_nan() {
            break;
        }
        crowding = next;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::super::find_start;
    use super::*;
    use crate::convexity::Exempt;
    use crate::qmesh::shapes::{self, Hostility, hostile_disk};

    /// An even map is not crowded, whatever its size; one that squeezes half of the surface to a hundredth of its share is, by
    /// the mean of the two densities.
    #[test]
    fn crowding_is_the_mean_density() {
        let mesh = shapes::grid(4, 2);
        let rest = Rest::new(&mesh, &Exempt::find(&mesh));
        let positions = mesh.vertices().map(|v| mesh.position(v).xy());
        let flat: Vec<Vec2> = positions.clone().map(|p| p * 7.0).collect();
        assert!((Crowding::of(&rest, &flat).mean - 1.0).abs() < 1e-12);
        let middle = 0.5 * positions.clone().map(|p| p.x).fold(0.0, f64::max);
        let squeezed: Vec<Vec2> = positions
            .map(|p| Vec2::new(if p.x > middle { middle + 0.01 * (p.x - middle) } else { p.x }, p.y))
            .collect();
        // Areas are 1/2 · 1 and 1/2 · 0.01, their sum 0.505.
        let expected = 0.5 * 0.505 + 0.5 * 50.5;
        assert!((Crowding::of(&rest, &squeezed).mean - expected).abs() < 1e-9);
    }

    /// The starts of long limbs are spread out; Tutte's embedding alone crowds them by many orders of magnitude.
    #[test]
    fn starts_of_long_limbs_are_spread_out() {
        let limbs =
            [shapes::finger(4, 60), hostile_disk(Hostility::Fingers, 1), hostile_disk(Hostility::Fingers, 2)];
        for (i, mesh) in limbs.iter().enumerate() {
            let exempt = Exempt::find(mesh);
            let start = find_start(mesh, &exempt, &()).unwrap();
            let crowding = Crowding::of(&Rest::new(mesh, &exempt), &start.uv);
            assert!(crowding.mean < 100.0, "{i}: {}", crowding.mean);
        }
    }
}
