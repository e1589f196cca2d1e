//! Good maps: overlap removal, measures, the whole way in one call.

pub mod distortion;

pub use distortion::{Benchmark, Distortion, MeasureError, measure};
pub use qembed::{self, qcurv, qmesh, qsimplify, qsolve};
use qembed::{BoundaryShape, Mixing, StageSolve, Weights};
use qmesh::{CornerData, Observer, QuadMesh, Vec2, VertexData};
use qsimplify::SimplifyOptions;
use qsolve::SolveOptions;

/// In which order overlapping vertices move (section 2.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum MoveOrder {
    /// Largest σ of Eq. 12 first.
    #[default]
    WorstFirst,
    /// In the order in which they were found.
    FirstCome,
}

/// How overlaps are removed (Eqs. 11 and 12).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OverlapOptions {
    /// λ1, for the immediate one-ring. Default 0.6.
    pub lambda1: f64,
    /// λ2, for the diagonal one-ring. Default 0.3.
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

/// What overlap removal did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OverlapReport {
    /// Corner triangles of no positive area before.
    pub before: usize,
    /// And after.
    pub after: usize,
    /// Of those after, how many no interior vertex could mend: all three corners lie on the boundary.
    pub stuck_on_boundary: usize,
    /// How many times a vertex was moved.
    pub moves: usize,
    /// Whether the bound on the moves ended it.
    pub hit_limit: bool,
}

/// Section 2.4, in place.
///
/// # Errors
/// λ1, λ2 out of range; cancelled.
pub fn remove_overlaps(
    _mesh: &QuadMesh,
    _uv: &mut VertexData<Vec2>,
    _options: &OverlapOptions,
    _observer: &dyn Observer,
) -> Result<OverlapReport, ParameterizeError> {
    unimplemented!()
}

/// Which way to a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Method {
    /// The paper's stages.
    #[default]
    Paper,
    /// Tutte 1963.
    Uniform,
    /// Floater 2003.
    MeanValue,
    /// Eck et al. 1995.
    Harmonic,
    /// Lévy et al. 2002.
    Lscm,
}

/// Everything that can be chosen.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options {
    /// Default `Paper`.
    pub method: Method,
    /// 1 angle-true (conformal), 0 area-true (authalic). Default 0.5.
    pub q: f64,
    /// Default `Circle`.
    pub boundary: BoundaryShape,
    /// Section 2.1.
    pub simplify: SimplifyOptions,
    /// `r` of Eq. 5. Default 1.
    pub exponent: f64,
    /// Weights of Eqs. 6 and 8. Default `Star4`.
    pub weights: Weights,
    /// How Eq. 10 mixes. Default `RowNormalized`.
    pub mixing: Mixing,
    /// Section 2.4; `None` leaves overlaps as they are.
    pub overlaps: Option<OverlapOptions>,
    /// How linear systems are solved.
    pub solve: SolveOptions,
    /// Whether the UVs are moved and scaled so that their bounding box starts at 0 and its longer side is 1. Default true;
    /// not done for `BoundaryShape::Fixed`.
    pub normalize: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            method: Method::default(),
            q: 0.5,
            boundary: BoundaryShape::default(),
            simplify: SimplifyOptions::default(),
            exponent: 1.0,
            weights: Weights::default(),
            mixing: Mixing::default(),
            overlaps: Some(OverlapOptions::default()),
            solve: SolveOptions::default(),
            normalize: true,
        }
    }
}

/// A map with its measures and the record of how it came about.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Parameterization {
    /// One UV per corner.
    pub uv: CornerData<Vec2>,
    /// How good it is.
    pub distortion: Distortion,
    /// How it came about.
    pub record: RunRecord,
}

/// What ran, with which reading of the paper, and what it met.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct RunRecord {
    /// Interior vertices before simplification.
    pub interior_vertices: usize,
    /// Interior vertices on the removed side of the threshold.
    pub removal_candidates: usize,
    /// Vertices removed by section 2.1 (0 for classic methods).
    pub removed_vertices: usize,
    /// Kept vertices that were cut off from the boundary.
    pub cut_off_vertices: usize,
    /// Negative weights that were met.
    pub negative_weights: usize,
    /// The linear systems.
    pub solves: Vec<StageSolve>,
    /// Overlap removal, when it ran.
    pub overlaps: Option<OverlapReport>,
}

/// The whole way: section 2 of the paper, or a classic baseline, with measures.
///
/// # Errors
/// See [`ParameterizeError`].
pub fn parameterize(
    _mesh: &QuadMesh,
    _options: &Options,
    _observer: &dyn Observer,
) -> Result<Parameterization, ParameterizeError> {
    unimplemented!()
}

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterizeError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// Simplification failed.
    #[error(transparent)]
    Simplify(#[from] qsimplify::SimplifyError),
    /// Embedding failed.
    #[error(transparent)]
    Embed(#[from] qembed::EmbedError),
    /// Measuring failed.
    #[error(transparent)]
    Measure(#[from] MeasureError),
}
