//! Overlap removal (section 2.4 of the paper): vertices of overlapping corner triangles, and the vertices around
//! them, move towards their neighbours until nothing overlaps.
//!
//! The paper's formula has the old positions on its right; with a queue that tests again after every move there is no
//! "old", so moves use the current positions (Gauss-Seidel). A vertex *overlaps* when it belongs to a corner triangle
//! of no positive area, zero included; the sign is exact, so the tiny areas at the far end of a long limb are none.
//! Overlapping vertices and the immediate one-rings of them move; the boundary never does.
//!
//! With λ2 = 0 and every interior vertex moving, this would be Tutte's embedding, solved step by step, and end without
//! overlaps on a convex boundary. For λ2 > 0 no theorem is known. On a boundary that is not convex there may be no
//! way out: corner triangles with all three vertices on the boundary stay as they are, and are counted.

mod queue;
mod state;

use qembed::qmesh::{Observer, QuadMesh, Vec2, VertexData};

use self::queue::Queue;
use self::state::State;
use crate::error::ParameterizeError;

/// In which order overlapping vertices move (section 2.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum MoveOrder {
    /// Largest σ of Eq. 12 first; of equal ones, the first vertex.
    #[default]
    WorstFirst,
    /// In the order in which they were found.
    FirstCome,
}

/// How overlaps are removed (Eqs. 11 and 12).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct OverlapOptions {
    /// λ1, for the immediate one-ring: at least 0. Default 0.6.
    pub lambda1: f64,
    /// λ2, for the diagonal one-ring: at least 0, and 0 < λ1 + λ2 < 1. Default 0.3.
    pub lambda2: f64,
    /// Default `WorstFirst`.
    pub order: MoveOrder,
    /// Moves at most, as a multiple of the number of vertices. Default 20.
    pub max_moves_per_vertex: f64,
}

impl Default for OverlapOptions {
    fn default() -> Self {
        Self { lambda1: 0.6, lambda2: 0.3, order: MoveOrder::WorstFirst, max_moves_per_vertex: 20.0 }
    }
}

impl OverlapOptions {
    pub(crate) fn check(&self) -> Result<(), ParameterizeError> {
        let (lambda1, lambda2) = (self.lambda1, self.lambda2);
        let sum = lambda1 + lambda2;
        if !(lambda1 >= 0.0 && lambda2 >= 0.0 && sum > 0.0 && sum < 1.0) {
            return Err(ParameterizeError::BadLambda { lambda1, lambda2 });
        }
        let limit = self.max_moves_per_vertex;
        if limit.is_nan() || limit < 0.0 {
            return Err(ParameterizeError::BadMoveLimit(limit));
        }
        Ok(())
    }
}

/// What overlap removal did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OverlapReport {
    /// Corner triangles of no positive area, before.
    pub before: usize,
    /// And after.
    pub after: usize,
    /// Of those after, how many no interior vertex could mend: all three corners lie on the boundary.
    pub stuck_on_boundary: usize,
    /// Of those after, how many no map at all could mend: their quad shares its opposite vertices with another, so the
    /// two cannot both be convex ([`Exempt`](crate::Exempt)). Nothing is moved for their sake.
    pub impossible: usize,
    /// How many times a vertex was moved.
    pub moves: usize,
    /// Whether the bound on the moves ended it. If not, and more than `stuck_on_boundary` and `impossible` are left, all vertices that
    /// may move have come to rest.
    pub hit_limit: bool,
}

/// Section 2.4, in place: moves interior vertices until no corner triangle overlaps, or the bound on the moves is
/// reached. A map that is mirrored as a whole stays so.
///
/// Progress is told as stage `"overlaps"`. The moves are made one after the other: same input, same bytes.
///
/// # Errors
/// λ1 and λ2 out of range, a UV that is not finite, not one UV per vertex; cancelled, which leaves `uv` half done.
pub fn remove_overlaps(
    mesh: &QuadMesh,
    uv: &mut VertexData<Vec2>,
    options: &OverlapOptions,
    observer: &dyn Observer,
) -> Result<OverlapReport, ParameterizeError> {
    const MOVES_PER_REPORT: usize = 1024;
    options.check()?;
    check_uv(mesh, uv)?;
    let watch = |fraction: f64| match observer.progress("overlaps", fraction) {
        std::ops::ControlFlow::Continue(()) => Ok(()),
        std::ops::ControlFlow::Break(()) => Err(ParameterizeError::Cancelled),
    };
    watch(0.0)?;
    let limit = (options.max_moves_per_vertex * mesh.vertex_count() as f64).ceil() as usize;
    let mut state = State::new(mesh, uv, options);
    let mut report = OverlapReport { before: state.overlaps(), ..Default::default() };
    let mut queue = Queue::new(options.order, mesh.vertex_count());
    mesh.vertices().filter(|&v| state.is_active(v)).for_each(|v| queue.push(v, state.sigma(v)));

    let mut done = 0.0_f64;
    let mut wake = Vec::new();
    while let Some(vertex) = queue.pop() {
        if !state.is_active(vertex) || !state.would_move(vertex) {
            continue;
        }
        if report.moves == limit {
            report.hit_limit = true;
            break;
        }
        wake.clear();
        state.relax(vertex, &mut wake);
        report.moves += 1;
        wake.retain(|&v| state.is_active(v));
        wake.iter().for_each(|&v| queue.push(v, state.sigma(v)));
        if report.moves.is_multiple_of(MOVES_PER_REPORT) {
            done = done.max(1.0 - state.overlaps() as f64 / report.before as f64);
            watch(done)?;
        }
    }
    report.after = state.overlaps();
    report.stuck_on_boundary = state.stuck_on_boundary();
    report.impossible = state.impossible();
    watch(1.0)?;
    Ok(report)
}

fn check_uv(mesh: &QuadMesh, uv: &VertexData<Vec2>) -> Result<(), ParameterizeError> {
    if uv.len() != mesh.vertex_count() {
        return Err(ParameterizeError::UvCount { expected: mesh.vertex_count(), found: uv.len() });
    }
    let finite = |p: &Vec2| p.iter().all(|x| x.is_finite());
    match uv.entries().find(|(_, p)| !finite(p)) {
        Some((vertex, _)) => Err(ParameterizeError::NonFiniteUv { vertex }),
        None => Ok(()),
    }
}
