//! Free boundaries that must not pass themselves, after [Jiang, Schaefer, Panozzo 2017, "Simplicial complex augmentation
//! framework for bijective maps"].
//!
//! What the map leaves free, up to a frame that stays, is triangulated, and the triangles get a weak energy that keeps them
//! positive. Then no corner of map or surroundings can flip, so the boundary cannot pass itself. Each triangle is measured
//! against its own present shape, so it pulls nowhere; it only resists. As the map moves, the surroundings are triangulated anew.
//!
//! We depart from the paper in one point: heights count as at least [`CLEARANCE`]. What comes closer is pushed apart, so the
//! boundary settles next to itself instead of creeping into contact, and rounding breaks nothing.

mod surroundings;

use std::ops::ControlFlow;

use crate::plane::outline_flaws;
use crate::qmesh::{CornerId, Observer, QuadMesh, Vec2};

use super::hessian::Hessian;
use super::newton::descend;
use super::rest::{Rest, RestCorner};
use super::{DescentError, DescentOptions, Objective, Stop, energy};
use surroundings::Surroundings;

/// The weight of the surroundings over that of the map: much more slows boundaries that slide along each other.
const WEIGHT: f64 = 0.005;
/// The height that triangles between two parts of the boundary want at least, over the mean edge of the boundary.
const CLEARANCE: f64 = 0.02;
/// Newton steps between two triangulations.
const STEPS_PER_ROUND: usize = 6;
/// Triangulations at most, unless the options allow fewer steps.
const MAX_ROUNDS: usize = 150;
/// The map is at rest when this many rounds in a row lower its energy by less than [`LEAST_GAIN`] of itself.
const CALM_ROUNDS: usize = 2;
const LEAST_GAIN: f64 = 1e-5;

/// How the work with a scaffold ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum ScaffoldEnd {
    /// The energy falls no further.
    Converged,
    /// The bound on the rounds ended it.
    MaxRounds,
    /// The boundary came too close to itself; the last map that was clear of that is kept.
    Tight,
    /// The observer asked to stop; the map at hand is clear of itself.
    Cancelled,
}

/// A problem whose boundary has to stay clear of itself; lengths in units of `rest`.
pub(super) struct Scaffold<'a> {
    pub(super) mesh: &'a QuadMesh,
    pub(super) rest: &'a Rest,
    pub(super) objective: &'a Objective,
    pub(super) options: &'a DescentOptions,
    pub(super) observer: &'a dyn Observer,
}

/// What happened.
pub(super) struct Scaffolded {
    pub(super) rounds: usize,
    pub(super) steps: usize,
    pub(super) end: ScaffoldEnd,
}

impl Scaffold<'_> {
    /// Minimises from `uv`, which is valid and clear of itself, and stays so.
    pub(super) fn minimize(&self, uv: &mut Vec<Vec2>) -> Result<Scaffolded, DescentError> {
        let mut done = Scaffolded { rounds: 0, steps: 0, end: ScaffoldEnd::MaxRounds };
        let mut energy = energy::value(self.objective, self.rest, uv);
        let mut calm = 0;
        while done.rounds < MAX_ROUNDS.min(self.options.max_steps) {
            let Some((joined, points)) = self.surround(uv, &[]) else {
                return Ok(Scaffolded { end: ScaffoldEnd::Tight, ..done });
            };
            let (points, steps, stop) = self.round(&joined, points, uv.len(), done.rounds)?;
            if outline_flaws(self.mesh, &points) > 0 {
                return Ok(Scaffolded { end: ScaffoldEnd::Tight, ..done });
            }
            *uv = points;
            done.rounds += 1;
            done.steps += steps;
            let before = std::mem::replace(&mut energy, energy::value(self.objective, self.rest, uv));
            calm = if before - energy < LEAST_GAIN * energy { calm + 1 } else { 0 };
            if stop == Stop::Cancelled {
                return Ok(Scaffolded { end: ScaffoldEnd::Cancelled, ..done });
            }
            if calm == CALM_ROUNDS {
                return Ok(Scaffolded { end: ScaffoldEnd::Converged, ..done });
            }
        }
        Ok(done)
    }

    /// Map and surroundings as one problem, with its vertices: those of the map first. The frame encloses `reach`, too.
    pub(super) fn surround(&self, uv: &[Vec2], reach: &[Vec2]) -> Option<(Rest, Vec<Vec2>)> {
        let edges = free_edges(self.mesh);
        let around = Surroundings::triangulate(&edges, uv, reach)?;
        let clearance = CLEARANCE * mean_length(&edges, uv);
        Some((join(self.rest, &around, uv, self.objective, clearance), [uv, &around.points].concat()))
    }

    /// A few steps with one triangulation: where the `count` vertices of the map end, the steps made, and why they ended.
    fn round(
        &self,
        joined: &Rest,
        mut points: Vec<Vec2>,
        count: usize,
        round: usize,
    ) -> Result<(Vec<Vec2>, usize, Stop), DescentError> {
        let options = DescentOptions { max_steps: STEPS_PER_ROUND, ..*self.options };
        let observer = |_: &'static str, _: f64| -> ControlFlow<()> {
            self.observer.progress("scaffold", round as f64 / MAX_ROUNDS as f64)
        };
        let mut hessian = Hessian::new(joined)?;
        let descent = descend(joined, &mut hessian, &mut points, self.objective, &options, &observer)?;
        points.truncate(count);
        Ok((points, descent.steps, descent.stop))
    }
}

/// The boundary edges, each with the free side on its left.
fn free_edges(mesh: &QuadMesh) -> Vec<[u32; 2]> {
    mesh.boundary_halfedges().map(|h| [mesh.origin(h).0, mesh.target(h).0]).collect()
}

fn mean_length(edges: &[[u32; 2]], uv: &[Vec2]) -> f64 {
    let length = |&[a, b]: &[u32; 2]| (uv[a as usize] - uv[b as usize]).norm();
    edges.iter().map(length).sum::<f64>() / edges.len().max(1) as f64
}

/// Map and surroundings as one problem, the frame held.
fn join(rest: &Rest, around: &Surroundings, uv: &[Vec2], objective: &Objective, clearance: f64) -> Rest {
    let mut joined = rest.clone();
    joined.vertex_count += around.points.len();
    joined.constraint.held.resize(uv.len(), false);
    joined.constraint.held.resize(uv.len() + around.frame, true);
    joined.constraint.held.resize(joined.vertex_count, false);
    let at = |v: u32| uv.get(v as usize).copied().unwrap_or_else(|| around.points[v as usize - uv.len()]);
    let corners: Vec<RestCorner> =
        around.triangles.iter().map(|&triangle| present_shape(triangle, &at, clearance)).collect();
    let area: f64 = corners.iter().map(|corner| corner.area).sum();
    let factor = match *objective {
        // The symmetric Dirichlet term alone reads the weight, times `shape`.
        Objective::Direct { shape, .. } => WEIGHT / (shape * area),
        Objective::Conformal { .. } => WEIGHT / area,
    };
    joined.ids.resize(rest.ids.len() + corners.len(), CornerId(0));
    joined
        .corners
        .extend(corners.into_iter().map(|corner| RestCorner { weight: factor * corner.area, ..corner }));
    joined
}

/// A triangle that is at rest as it is; its height over its longest side counts as at least `clearance`.
fn present_shape(mut triangle: [u32; 3], at: &impl Fn(u32) -> Vec2, clearance: f64) -> RestCorner {
    let length = |[a, b, _]: [u32; 3]| (at(b) - at(a)).norm_squared();
    for _ in 0..2 {
        let [a, b, c] = triangle;
        if length([b, c, a]) > length(triangle) || length([c, a, b]) > length(triangle) {
            triangle = [b, c, a];
        }
    }
    let [here, next, previous] = triangle.map(at);
    let (f1, f0) = (next - here, previous - here);
    let base = f1.norm();
    let (x, y) = (f1.dot(&f0) / base, (f1.perp(&f0) / base).max(clearance));
    RestCorner {
        vertices: triangle,
        angle: y.atan2(x),
        area: 0.5 * base * y,
        inverse: [1.0 / base, -x / (base * y), 1.0 / y],
        share: 0.0,
        weight: 0.0,
    }
}
