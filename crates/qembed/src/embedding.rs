//! What an embedding returns.

use crate::qmesh::{Vec2, VertexData};
use qsolve::SolveRecord;

/// One linear system of an embedding.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct StageSolve {
    /// `"global"`, `"local"`, or the name of the classic method.
    pub stage: &'static str,
    /// How it was solved.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub record: SolveRecord,
}

/// A map of the vertices to the plane.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Embedding {
    /// Where each vertex goes.
    pub uv: VertexData<Vec2>,
    /// The linear systems that were solved. A stage without unknowns solves none.
    pub solves: Vec<StageSolve>,
    /// Kept vertices that the removals cut off from the boundary, which the local step placed instead (rule `Naive`).
    pub cut_off: usize,
    /// Negative weights that were met (`Star1` and the harmonic map only). With one, faces may flip.
    pub negative_weights: usize,
}
