//! The weights of one vertex: Eq. 6 (conformal), Eq. 8 (authalic), and their mixture, Eq. 10.

use std::f64::consts::PI;

use crate::qcurv::corner_angle;
use crate::qmesh::{CornerId, HalfedgeId, QuadMesh, Vec3, VertexId};

use crate::{EmbedOptions, Mixing, Weights};

/// Angles are kept this far, in radians, away from 0 and π, where cotangents are infinite.
const SMALLEST_ANGLE: f64 = 1e-6;
/// Lengths shorter than this fraction of the mesh's mean edge length count as that long.
pub(crate) const SHORTEST_EDGE: f64 = 1e-6;
/// A sum below this fraction of the sum of magnitudes is one of rounding errors.
const VANISHING: f64 = 1e-9;

/// The equation `Σⱼ λᵢⱼ uⱼ = d uᵢ` of one vertex; `d` is the sum of the λ.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// The immediate neighbours with their λ, counter-clockwise.
    pub(crate) neighbors: Vec<(VertexId, f64)>,
    /// 1, but for a raw mixture whose sum vanishes.
    pub(crate) diagonal: f64,
    /// How many weights were negative.
    pub(crate) negative: usize,
}

/// `λᵢⱼ` of Eq. 10 at an interior vertex. `mean_edge` is the mean edge length of the mesh.
///
/// Row-normalised: `λᵢⱼ = q wᴬᵢⱼ / Σₖ wᴬᵢₖ + (1 − q) wˣᵢⱼ / Σₖ wˣᵢₖ`, so that the λ add up to one. A family whose sum vanishes (star angles with
/// plain cotangents only) has no such weights; it counts as uniform at this vertex. Raw: `λᵢⱼ ∝ q wᴬᵢⱼ + (1 − q) wˣᵢⱼ`.
pub(crate) fn row(mesh: &QuadMesh, vertex: VertexId, options: &EmbedOptions, mean_edge: f64) -> Row {
    let star = Star::new(mesh, vertex, options.weights, mean_edge);
    let count = star.edges.len();
    let family = |share: f64, weight: &dyn Fn(usize) -> f64| {
        // The family that has no share is not asked: its sum may vanish.
        if share > 0.0 { (0..count).map(weight).collect() } else { vec![0.0; count] }
    };
    let q = options.q;
    let mut conformal: Vec<f64> = family(q, &|k| star.conformal(k));
    let mut authalic: Vec<f64> = family(1.0 - q, &|k| star.authalic(k));
    let negative = conformal.iter().chain(&authalic).filter(|&&weight| weight < 0.0).count();
    if options.mixing == Mixing::RowNormalized {
        for (family, share) in [(&mut conformal, q), (&mut authalic, 1.0 - q)] {
            if share > 0.0 {
                normalize(family);
            }
        }
    }
    let mut mixed: Vec<f64> = conformal.iter().zip(&authalic).map(|(a, x)| q * a + (1.0 - q) * x).collect();
    // Dividing an equation by a number does not change its solution, but lets the solver see rows of one size.
    let diagonal = divide_by_sum(&mut mixed).unwrap_or(1.0);
    let neighbors = star.edges.iter().map(|&edge| mesh.target(edge)).zip(mixed).collect();
    Row { neighbors, diagonal, negative }
}

/// Makes the weights add up to 1; uniform where their sum vanishes.
fn normalize(weights: &mut [f64]) {
    if divide_by_sum(weights).is_some() {
        weights.fill(1.0 / weights.len() as f64);
    }
}

/// Makes the weights add up to 1. Where the sum vanishes, it is their magnitudes that add up to 1 then, and what the
/// sum is like that is returned.
fn divide_by_sum(weights: &mut [f64]) -> Option<f64> {
    let magnitude: f64 = weights.iter().map(|weight| weight.abs()).sum();
    let sum: f64 = weights.iter().sum();
    let vanishing = sum.abs() <= VANISHING * magnitude;
    let divisor = if vanishing { magnitude.max(f64::MIN_POSITIVE) } else { sum };
    for weight in weights.iter_mut() {
        *weight /= divisor;
    }
    vanishing.then_some(sum / divisor)
}

/// An interior vertex with its edges, counter-clockwise.
struct Star<'a> {
    mesh: &'a QuadMesh,
    edges: Vec<HalfedgeId>,
    center: Vec3,
    around: Vec<Vec3>,
    weights: Weights,
    shortest: f64,
}

impl<'a> Star<'a> {
    fn new(mesh: &'a QuadMesh, vertex: VertexId, weights: Weights, mean_edge: f64) -> Self {
        let edges: Vec<HalfedgeId> = mesh.outgoing(vertex).collect();
        let around = edges.iter().map(|&edge| mesh.position(mesh.target(edge))).collect();
        let shortest = SHORTEST_EDGE * mean_edge;
        Self { mesh, edges, center: mesh.position(vertex), around, weights, shortest }
    }

    /// Eq. 6: `cot α/4 + cot β/4`, or with plain cotangents for [`Weights::Star1`].
    fn conformal(&self, k: usize) -> f64 {
        let part = if self.weights == Weights::Star1 { 1.0 } else { 0.25 };
        let [alpha, beta] = match self.weights {
            Weights::Star4 | Weights::Star1 => {
                let [before, here, after] = self.three(k);
                [angle(after, self.center, here), angle(before, self.center, here)]
            }
            Weights::Printed => {
                self.sides(k).map(|[_, across, beside]| 0.5 * (self.corner(across) + self.corner(beside)))
            }
        };
        cotangent(alpha, part) + cotangent(beta, part)
    }

    /// Eq. 8: `(cot γ/2 + cot δ/2) / |vᵢ − vⱼ|²`, or with plain cotangents for [`Weights::Star1`].
    fn authalic(&self, k: usize) -> f64 {
        let part = if self.weights == Weights::Star1 { 1.0 } else { 0.5 };
        let [before, here, after] = self.three(k);
        let [gamma, delta] = match self.weights {
            Weights::Star4 | Weights::Star1 => {
                [angle(here, self.center, after), angle(here, self.center, before)]
            }
            Weights::Printed => self.sides(k).map(|[at_neighbor, _, _]| self.corner(at_neighbor)),
        };
        let length = (here - self.center).norm().max(self.shortest);
        (cotangent(gamma, part) + cotangent(delta, part)) / (length * length)
    }

    /// `v_{j−1}`, `v_j`, `v_{j+1}`.
    fn three(&self, k: usize) -> [Vec3; 3] {
        let count = self.around.len();
        [self.around[(k + count - 1) % count], self.around[k], self.around[(k + 1) % count]]
    }

    /// In the faces left and right of edge `k`: the corner at `v_j`, the one beyond it, and the one beyond `v_i`.
    /// In a triangle the last two are the same.
    fn sides(&self, k: usize) -> [[Option<CornerId>; 3]; 2] {
        let mesh = self.mesh;
        let left = mesh.corner(self.edges[k]);
        let right = mesh.corner(mesh.twin(self.edges[k]));
        let left_side = [
            left.map(|corner| mesh.next_corner(corner)),
            left.map(|corner| mesh.next_corner(mesh.next_corner(corner))),
            left.map(|corner| mesh.previous_corner(corner)),
        ];
        let right_side = [
            right,
            right.map(|corner| mesh.previous_corner(corner)),
            right.map(|corner| mesh.next_corner(mesh.next_corner(corner))),
        ];
        [left_side, right_side]
    }

    fn corner(&self, corner: Option<CornerId>) -> f64 {
        corner.map_or(PI / 2.0, |corner| corner_angle(self.mesh, corner))
    }
}

/// The angle at `apex` between the directions to `a` and `b`, in `[0, π]`.
pub(crate) fn angle(apex: Vec3, a: Vec3, b: Vec3) -> f64 {
    let (a, b) = (a - apex, b - apex);
    a.cross(&b).norm().atan2(a.dot(&b))
}

/// `cot(part · angle)`, with the angle kept away from 0 and π.
fn cotangent(angle: f64, part: f64) -> f64 {
    let (sine, cosine) = (part * angle.clamp(SMALLEST_ANGLE, PI - SMALLEST_ANGLE)).sin_cos();
    cosine / sine
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::qmesh::shapes::{grid, jittered_grid};
    use crate::qmesh::{Vec2, VertexData};

    fn interior(mesh: &QuadMesh) -> Vec<VertexId> {
        mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).collect()
    }

    fn options(weights: Weights, mixing: Mixing, q: f64) -> EmbedOptions {
        EmbedOptions { weights, mixing, q, ..Default::default() }
    }

    const ALL: [Weights; 3] = [Weights::Star4, Weights::Star1, Weights::Printed];

    /// Row-normalised λ add up to one, for every reading and q.
    #[test]
    fn rows_add_up_to_one() {
        let mesh = jittered_grid(7, 6, 0.24, 3);
        for weights in ALL {
            for q in [0.0, 0.3, 1.0] {
                for vertex in interior(&mesh) {
                    let row = row(&mesh, vertex, &options(weights, Mixing::RowNormalized, q), 1.0);
                    let sum: f64 = row.neighbors.iter().map(|(_, weight)| weight).sum();
                    assert!((sum - 1.0).abs() < 1e-12 && row.diagonal == 1.0);
                }
            }
        }
    }

    /// With plain cotangents of star angles both families reproduce linear functions: a flat star is balanced.
    #[test]
    fn star1_is_linearly_precise() {
        let mesh = jittered_grid(7, 6, 0.24, 5);
        for q in [0.0, 0.5, 1.0] {
            for mixing in [Mixing::RowNormalized, Mixing::Raw] {
                for vertex in interior(&mesh) {
                    let row = row(&mesh, vertex, &options(Weights::Star1, mixing, q), 1.0);
                    let mean: Vec3 = row.neighbors.iter().map(|&(j, weight)| weight * mesh.position(j)).sum();
                    assert!((mean - mesh.position(vertex)).norm() < 1e-12);
                }
            }
        }
    }

    /// The values on a regular grid, by hand: all angles of the quads are π/2, those of the star π/4.
    #[test]
    fn weights_of_a_square_grid() {
        let mesh = grid(2, 2)
            .with_positions(VertexData::from_vec(grid(2, 2).positions().iter().map(|p| 2.0 * p).collect()));
        let center = interior(&mesh)[0];
        let cot = |angle: f64| 1.0 / angle.tan();
        for (weights, conformal, authalic) in [
            (Weights::Star4, 2.0 * cot(PI / 16.0), 2.0 * cot(PI / 8.0) / 4.0),
            (Weights::Star1, 2.0, 2.0 / 4.0),
            (Weights::Printed, 2.0 * cot(PI / 8.0), 2.0 * cot(PI / 4.0) / 4.0),
        ] {
            let star = Star::new(&mesh, center, weights, 2.0);
            for k in 0..4 {
                assert!((star.conformal(k) - conformal).abs() < 1e-12, "{weights:?}");
                assert!((star.authalic(k) - authalic).abs() < 1e-12, "{weights:?}");
            }
        }
    }

    /// α and β lie across the edge, γ and δ at its far end; a skew star tells them apart.
    #[test]
    fn angles_are_those_of_the_corner_triangles() {
        let mesh = jittered_grid(2, 2, 0.24, 9);
        let center = interior(&mesh)[0];
        let star = Star::new(&mesh, center, Weights::Star1, 1.0);
        let flat = |vertex: VertexId| Vec2::new(mesh.position(vertex).x, mesh.position(vertex).y);
        let cot =
            |apex: Vec2, a: Vec2, b: Vec2| (a - apex).dot(&(b - apex)) / (a - apex).perp(&(b - apex)).abs();
        let around: Vec<Vec2> = star.edges.iter().map(|&edge| flat(mesh.target(edge))).collect();
        let i = flat(center);
        for k in 0..4 {
            let (before, j, after) = (around[(k + 3) % 4], around[k], around[(k + 1) % 4]);
            assert!((star.conformal(k) - cot(after, i, j) - cot(before, i, j)).abs() < 1e-12);
            let authalic = (cot(j, i, after) + cot(j, i, before)) / (j - i).norm_squared();
            assert!((star.authalic(k) - authalic).abs() < 1e-12);
        }
    }

    /// Coincident and collinear vertices, and edges folded back, give finite weights; the positive readings stay positive.
    #[test]
    fn degenerate_stars_have_finite_weights() {
        for place in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [5.0, 5.0, 0.0]] {
            let mesh = grid(2, 2);
            let center = interior(&mesh)[0];
            let mut positions = mesh.positions().clone();
            positions[center] = Vec3::from(place);
            let mesh = mesh.with_positions(positions);
            for weights in ALL {
                for mixing in [Mixing::RowNormalized, Mixing::Raw] {
                    let row = row(&mesh, center, &options(weights, mixing, 0.5), 1.0);
                    assert!(row.neighbors.iter().all(|(_, weight)| weight.is_finite()));
                    assert!(
                        weights == Weights::Star1 || row.neighbors.iter().all(|(_, weight)| *weight > 0.0)
                    );
                }
            }
        }
    }
}
