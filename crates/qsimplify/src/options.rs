//! The choices of section 2.1, each reading of the paper among them.

use qcurv::VertexArea;

use crate::error::SimplifyError;

/// What keeps the simplified graph fit for section 2.2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum RemovalRule {
    /// Pure deletion that keeps the polygon graph 3-connected.
    ///
    /// A vertex goes if the union of its faces is a simple polygon, its interior neighbours keep three edges, and
    /// every other face, the outer ones included, meets the union in nothing, in one vertex or in one path. Ends near a
    /// fifth of the interior vertices on real quad meshes (20-24 %), and never far above a third. To keep the time
    /// linear, unions of more than 64 corners and next to vertices of more than 1024 edges are not made.
    #[default]
    Guarded,
    /// Deletion, then the neighbours are joined in a ring.
    ///
    /// The faces at the vertex lose it (triangles vanish) and the ring becomes a face. A vertex goes if the ring is a
    /// simple polygon that every other face, the outer ones included, meets in nothing, in one vertex or in one path
    /// (so no edge is doubled), and its interior neighbours keep three edges. Ends near 95 % on real quad meshes.
    /// Next to vertices of more than 1024 edges nothing is removed, to keep the time linear.
    Ring,
    /// Eq. 5 on the full graph; only kept vertices keep their positions.
    Carrier,
    /// Deletion as printed, with nothing guarded: faces merge, and the graph may fall apart.
    Naive,
    /// Every interior vertex goes, whatever the threshold; only the boundary is kept.
    All,
    /// Nothing is removed, whatever the threshold: Eq. 5 alone.
    None,
}

/// Which curvature decides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum CurvatureMeasure {
    /// |K| of Eq. 2, times total area / 4π: free of units, and 1 everywhere on a sphere.
    #[default]
    Normalized,
    /// |K̄| of Eq. 1, in radians.
    Integrated,
}

/// Where low curvature ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Threshold {
    /// Remove vertices strictly below this value of the measure (strictly above, with [`RemovedSide::High`]).
    Value(f64),
    /// Remove this fraction of the interior vertices, in order (0 to 1), rounded to whole vertices.
    Fraction(f64),
}

/// Which side of the threshold is removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum RemovedSide {
    /// Low curvature goes, lowest first, as the paper's text says six times.
    #[default]
    Low,
    /// High curvature goes, highest first, as step 3 of section 2.1 is printed.
    High,
}

/// How to simplify.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, rename_all = "kebab-case"))]
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

impl SimplifyOptions {
    pub(crate) fn check(&self) -> Result<(), SimplifyError> {
        match self.threshold {
            Threshold::Value(value) if value >= 0.0 => Ok(()),
            Threshold::Fraction(fraction) if (0.0..=1.0).contains(&fraction) => Ok(()),
            Threshold::Value(bad) | Threshold::Fraction(bad) => Err(SimplifyError::BadThreshold(bad)),
        }
    }
}
