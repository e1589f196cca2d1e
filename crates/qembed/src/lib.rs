//! First maps of a quad mesh to the plane.

use qmesh::{Observer, QuadMesh, Vec2, VertexData, VertexId};
use qsimplify::Simplified;
pub use qsolve::{self, qcurv, qmesh, qsimplify};
use qsolve::{SolveOptions, SolveRecord};

/// Where the boundary goes.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum BoundaryShape {
    /// The unit circle, by arc length.
    #[default]
    Circle,
    /// The unit square.
    Square,
    /// The best-fit plane; refused when the boundary folds there.
    Projection,
    /// Positions for every boundary vertex, given by the caller.
    Fixed(Vec<(VertexId, Vec2)>),
}

/// Edge weights of Eqs. 6 and 8.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Weights {
    /// Star angles with the printed quarter and half: always positive.
    #[default]
    Star4,
    /// Star angles, plain cotangents: exact on flat meshes, may be negative.
    Star1,
    /// Quad-corner angles as printed.
    Printed,
}

/// How Eq. 10 mixes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Mixing {
    /// Each family's weights are divided by their sum at the vertex first: free of units.
    #[default]
    RowNormalized,
    /// The energies are added as printed: the result depends on the unit of length.
    Raw,
}

/// How to embed (sections 2.2 and 2.3).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EmbedOptions {
    /// 1 conformal, 0 authalic. Default 0.5.
    pub q: f64,
    /// Default `Circle`.
    pub boundary: BoundaryShape,
    /// `r` of Eq. 5. Default 1.
    pub exponent: f64,
    /// Default `Star4`.
    pub weights: Weights,
    /// Default `RowNormalized`.
    pub mixing: Mixing,
    /// How the linear systems are solved.
    pub solve: SolveOptions,
}
impl Default for EmbedOptions {
    fn default() -> Self {
        Self {
            q: 0.5,
            boundary: BoundaryShape::Circle,
            exponent: 1.0,
            weights: Weights::Star4,
            mixing: Mixing::RowNormalized,
            solve: SolveOptions::default(),
        }
    }
}

/// One linear system of an embedding.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// The linear systems that were solved.
    pub solves: Vec<StageSolve>,
    /// Kept vertices that the removals cut off from the boundary, which the local step placed instead (rule `Naive`).
    pub cut_off: usize,
    /// Negative weights that were met (`Star1` only).
    pub negative_weights: usize,
}

/// Sections 2.2 and 2.3.
///
/// # Errors
/// See [`EmbedError`].
pub fn embed(
    _mesh: &QuadMesh,
    _simplified: &Simplified,
    _options: &EmbedOptions,
    _observer: &dyn Observer,
) -> Result<Embedding, EmbedError> {
    unimplemented!()
}

/// The methods that the paper compares itself with, on the full mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Classic {
    /// Tutte 1963: all weights one.
    Uniform,
    /// Floater 2003.
    MeanValue,
    /// Eck et al. 1995: cotangents.
    Harmonic,
    /// Lévy et al. 2002: free boundary, least squares.
    Lscm,
}

/// A classic baseline. `boundary` is not used by LSCM, whose boundary is free.
///
/// # Errors
/// See [`EmbedError`].
pub fn embed_classic(
    _mesh: &QuadMesh,
    _method: Classic,
    _boundary: &BoundaryShape,
    _solve: &SolveOptions,
    _observer: &dyn Observer,
) -> Result<Embedding, EmbedError> {
    unimplemented!()
}

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EmbedError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A linear system had no acceptable answer.
    #[error(transparent)]
    Solve(#[from] qsolve::SolveError),
}
