//! Fewer vertices: removal of vertices of low Gaussian curvature (section 2.1 of the paper).

use qcurv::VertexArea;
pub use qcurv::{self, qmesh};
use qmesh::{Observer, Polygons, QuadMesh, VertexData, VertexId};

/// What keeps the simplified graph fit for section 2.2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum RemovalRule {
    /// Pure deletion that keeps the polygon graph 3-connected.
    #[default]
    Guarded,
    /// Deletion, then the neighbours are joined in a ring.
    Ring,
    /// Eq. 5 on the full graph; only kept vertices keep their positions.
    Carrier,
    /// Deletion as printed, with nothing guarded.
    Naive,
    /// Every interior vertex goes; only the boundary is kept.
    All,
    /// Nothing is removed: Eq. 5 alone.
    None,
}

/// Which curvature decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum CurvatureMeasure {
    /// |K| of Eq. 2, times total area / 4π.
    #[default]
    Normalized,
    /// |K̄| of Eq. 1.
    Integrated,
}

/// Where low curvature ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Threshold {
    /// Remove vertices below this value of the measure.
    Value(f64),
    /// Remove this fraction of the interior vertices, in order (0 to 1).
    Fraction(f64),
}

/// Which side of the threshold is removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum RemovedSide {
    /// Low curvature goes, as the paper's text says six times.
    #[default]
    Low,
    /// High curvature goes, as step 3 of section 2.1 is printed.
    High,
}

/// How to simplify.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SimplifyOptions {
    /// Default `Guarded`.
    pub rule: RemovalRule,
    /// Default `Normalized`.
    pub measure: CurvatureMeasure,
    /// Default `Voronoi`.
    pub area: VertexArea,
    /// Default: half of the interior vertices are candidates.
    pub threshold: Threshold,
    /// Default `Low`.
    pub side: RemovedSide,
}

impl Default for SimplifyOptions {
    fn default() -> Self {
        Self {
            rule: RemovalRule::default(),
            measure: CurvatureMeasure::default(),
            area: VertexArea::default(),
            threshold: Threshold::Fraction(0.5),
            side: RemovedSide::default(),
        }
    }
}

/// The simplified mesh and the record of what was removed.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// Whether each vertex is kept. Boundary vertices always are.
    pub kept: VertexData<bool>,
    /// The removed vertices in the order of their removal.
    pub removed: Vec<VertexId>,
    /// How many interior vertices lay on the removed side of the threshold.
    pub candidates: usize,
    /// The edges of Eq. 5, each once, smaller vertex first, sorted. With rule `Carrier`, those of the full mesh.
    pub springs: Vec<[VertexId; 2]>,
    /// The faces of the simplified polygon mesh over the vertices of the full mesh, flat as in [`Polygons`].
    pub face_start: Vec<u32>,
    /// The vertices of those faces.
    pub face_vertex: Vec<VertexId>,
}

impl Simplified {
    /// The simplified mesh as polygons, vertices renumbered, for looking at it.
    #[must_use]
    pub fn polygons(&self, _mesh: &QuadMesh) -> Polygons {
        unimplemented!()
    }
}

/// Why nothing was simplified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimplifyError {
    /// The threshold is not a number, negative, or a fraction above one.
    #[error("the threshold {0} is out of range: a value must be at least 0, a fraction between 0 and 1")]
    BadThreshold(f64),
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Section 2.1.
///
/// # Errors
/// See [`SimplifyError`].
pub fn simplify(
    _mesh: &QuadMesh,
    _options: &SimplifyOptions,
    _observer: &dyn Observer,
) -> Result<Simplified, SimplifyError> {
    unimplemented!()
}
