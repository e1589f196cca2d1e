//! Pins: vertices that the caller wants in certain places.
//!
//! From a valid map the pins are drawn to their places on straight lines; the other vertices follow harmonically, then settle by
//! a few Newton steps before the next pull. No pull goes as far as the first corner that would collapse, so the map stays valid all
//! the way; where it cannot go on, the pin is named.

use crate::ParameterizeError;
use crate::qmesh::{Observer, QuadMesh, Vec2, VertexId};
use crate::qsolve::{DMatrix, SolveError, SolveOptions, Structure, Triplets, solve};

use super::hessian::Hessian;
use super::newton::descend;
use super::rest::Rest;
use super::scaffold::Scaffold;
use super::step::first_collapse;
use super::{DescentError, DescentOptions, Objective, energy};

/// Pulls at most.
const MAX_PULLS: usize = 200;
/// A pull goes this fraction of the way to the first collapse.
const COLLAPSE_FRACTION: f64 = 0.6;
/// Newton steps between two pulls.
const SETTLING_STEPS: usize = 5;
/// Pins have stopped when this many pulls in a row go less than [`LEAST_PULL`] of what is left.
const STUCK_PULLS: usize = 6;
const LEAST_PULL: f64 = 1e-4;

/// A vertex and its place.
pub(super) type Pin = (VertexId, Vec2);

/// What is wrong with the pins themselves.
pub(super) fn check(mesh: &QuadMesh, pins: &[Pin]) -> Result<(), ParameterizeError> {
    let limit = crate::qmesh::COORDINATE_LIMIT;
    let mut sorted = pins.to_vec();
    for &(vertex, place) in pins {
        if vertex.index() >= mesh.vertex_count() || !place.iter().all(|x| x.abs() <= limit) {
            return Err(ParameterizeError::BadPin { vertex });
        }
    }
    sorted.sort_by_key(|pin| pin.0);
    if let Some(twice) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(ParameterizeError::PinTwice { vertex: twice[0].0 });
    }
    sorted.sort_by(|a, b| a.1.x.total_cmp(&b.1.x).then(a.1.y.total_cmp(&b.1.y)).then(a.0.cmp(&b.0)));
    match sorted.windows(2).find(|pair| pair[0].1 == pair[1].1) {
        Some(pair) => Err(ParameterizeError::PinsMeet { vertices: [pair[0].0, pair[1].0] }),
        None => Ok(()),
    }
}

/// The similarity that brings `uv` nearest to the pins: as `z ↦ a z + b`, `[a, b]` as complex numbers. The scale is that of the pins'
/// spread, so that pins that want a bent map do not shrink it.
pub(super) fn similarity(uv: &[Vec2], pins: &[Pin]) -> [Vec2; 2] {
    let count = pins.len() as f64;
    let from = |pin: &Pin| uv[pin.0.index()];
    let (z0, w0) =
        (pins.iter().map(from).sum::<Vec2>() / count, pins.iter().map(|pin| pin.1).sum::<Vec2>() / count);
    let (mut turn, mut spread, mut wanted) = (Vec2::zeros(), 0.0, 0.0);
    for pin in pins {
        let (z, w) = (from(pin) - z0, pin.1 - w0);
        turn += Vec2::new(z.dot(&w), z.perp(&w));
        spread += z.norm_squared();
        wanted += w.norm_squared();
    }
    let turn = if turn.norm() > 0.0 { turn.normalize() } else { Vec2::x() };
    let a = turn * (wanted / spread).sqrt();
    [a, w0 - times(a, z0)]
}

pub(super) fn times(a: Vec2, z: Vec2) -> Vec2 {
    Vec2::new(a.x * z.x - a.y * z.y, a.x * z.y + a.y * z.x)
}

/// A map whose pins are to be drawn to their places; lengths in units of `rest`, which holds the pins.
pub(super) struct Pull<'a> {
    pub(super) mesh: &'a QuadMesh,
    pub(super) rest: &'a Rest,
    pub(super) pins: &'a [Pin],
    pub(super) objective: &'a Objective,
    pub(super) options: &'a DescentOptions,
    pub(super) observer: &'a dyn Observer,
    /// Whether the boundary must not pass itself on the way.
    pub(super) scaffolded: bool,
}

impl Pull<'_> {
    /// Draws the pins of `uv`, which is valid, to their places.
    pub(super) fn run(&self, uv: &mut Vec<Vec2>) -> Result<(), ParameterizeError> {
        let mut stuck = 0;
        for pull in 0..MAX_PULLS {
            let left = self.distance_left(uv);
            if left.1 == 0.0 {
                return Ok(());
            }
            if self.observer.progress("pins", pull as f64 / MAX_PULLS as f64).is_break() {
                return Err(ParameterizeError::Cancelled);
            }
            let gone = self.pull(uv).map_err(ParameterizeError::Descent)?;
            stuck = if gone < LEAST_PULL { stuck + 1 } else { 0 };
            if stuck == STUCK_PULLS {
                break;
            }
        }
        let (vertex, distance) = self.distance_left(uv);
        if distance == 0.0 {
            return Ok(());
        }
        Err(ParameterizeError::PinOutOfReach { vertex, distance: distance * self.rest.unit })
    }

    /// The pin that is farthest from its place, and how far.
    fn distance_left(&self, uv: &[Vec2]) -> (VertexId, f64) {
        let distances =
            self.pins.iter().map(|&(vertex, place)| (vertex, (place - uv[vertex.index()]).norm()));
        distances.fold((VertexId(0), 0.0), |worst, next| if next.1 > worst.1 { next } else { worst })
    }

    /// Goes part of the way and settles; how large a part.
    fn pull(&self, uv: &mut Vec<Vec2>) -> Result<f64, DescentError> {
        let scaffold = Scaffold {
            mesh: self.mesh,
            rest: self.rest,
            objective: self.objective,
            options: self.options,
            observer: self.observer,
        };
        let reach: Vec<Vec2> = self.pins.iter().map(|pin| pin.1).collect();
        let surrounded = if self.scaffolded { scaffold.surround(uv, &reach) } else { None };
        let (rest, mut points) = match &surrounded {
            Some((joined, points)) => (joined, points.clone()),
            None if self.scaffolded => return Ok(0.0),
            None => (self.rest, uv.clone()),
        };
        let direction = self.harmonic(rest, &points)?;
        let part = self.advance(rest, &mut points, &direction);
        let options = DescentOptions { max_steps: SETTLING_STEPS, ..*self.options };
        descend(rest, &mut Hessian::new(rest)?, &mut points, self.objective, &options, self.observer)?;
        points.truncate(uv.len());
        *uv = points;
        Ok(part)
    }

    /// Moves along `direction`, but not as far as a collapse; the fraction that was possible.
    fn advance(&self, rest: &Rest, points: &mut Vec<Vec2>, direction: &[Vec2]) -> f64 {
        let mut part = (COLLAPSE_FRACTION * first_collapse(rest, points, direction)).min(1.0);
        while part > f64::EPSILON {
            let mut trial: Vec<Vec2> = points.iter().zip(direction).map(|(p, d)| p + part * d).collect();
            if part == 1.0 {
                for &(vertex, place) in self.pins {
                    trial[vertex.index()] = place;
                }
            }
            if energy::value(self.objective, rest, &trial).is_finite() {
                *points = trial;
                return part;
            }
            part *= 0.5;
        }
        0.0
    }

    /// The displacement in which the pins go to their places, held vertices stay, and all others go where their neighbours go.
    fn harmonic(&self, rest: &Rest, points: &[Vec2]) -> Result<Vec<Vec2>, SolveError> {
        let mut direction = vec![Vec2::zeros(); points.len()];
        for &(vertex, place) in self.pins {
            direction[vertex.index()] = place - points[vertex.index()];
        }
        let held = &rest.constraint.held;
        let mut row = vec![usize::MAX; points.len()];
        let free: Vec<usize> = (0..points.len()).filter(|&v| !held[v]).collect();
        for (k, &v) in free.iter().enumerate() {
            row[v] = k;
        }
        if free.is_empty() {
            return Ok(direction);
        }
        let mut triplets = Triplets::with_capacity(free.len(), free.len(), 8 * rest.corners.len());
        let mut rhs = DMatrix::zeros(free.len(), 2);
        for corner in &rest.corners {
            let [here, next, previous] = corner.vertices.map(|v| v as usize);
            for [a, b] in [[here, next], [next, here], [here, previous], [previous, here]] {
                if row[a] == usize::MAX {
                    continue;
                }
                triplets.add(row[a], row[a], 1.0);
                if row[b] == usize::MAX {
                    rhs[(row[a], 0)] += direction[b].x;
                    rhs[(row[a], 1)] += direction[b].y;
                } else {
                    triplets.add(row[a], row[b], -1.0);
                }
            }
        }
        let matrix = triplets.build()?;
        let (x, _) = solve(&matrix, Structure::SymmetricPositiveDefinite, &rhs, &SolveOptions::default())?;
        for (k, &v) in free.iter().enumerate() {
            direction[v] = Vec2::new(x[(k, 0)], x[(k, 1)]);
        }
        Ok(direction)
    }
}
