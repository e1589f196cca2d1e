//! What the caller chooses, and what he is told.

use crate::ParameterizeError;
use crate::direct::{AngleTerm, BoundaryRepair, Descent, DescentOptions, StartMethod, SymmetryReport, Terms};
use crate::qmesh::FaceId;

/// What the energy needs besides q, and when the descent ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct DirectOptions {
    /// Weight of the symmetric Dirichlet term, at least 0. Default 1. Smaller lets quads stretch along their edges, larger
    /// evens out all stretch.
    pub shape: f64,
    /// Default `Log`.
    pub angle_term: AngleTerm,
    /// When the descent ends.
    pub descent: DescentOptions,
}

impl Default for DirectOptions {
    fn default() -> Self {
        Self { shape: 1.0, angle_term: AngleTerm::default(), descent: DescentOptions::default() }
    }
}

impl DirectOptions {
    pub(crate) fn check(&self) -> Result<(), ParameterizeError> {
        if !(self.shape >= 0.0 && self.shape.is_finite()) {
            return Err(ParameterizeError::BadShape(self.shape));
        }
        let tolerance = self.descent.relative_decrease;
        if tolerance.is_nan() || tolerance < 0.0 {
            return Err(ParameterizeError::BadTolerance(tolerance));
        }
        Ok(())
    }
}

/// How a map of least energy came about.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct DirectReport {
    /// How the first map was found.
    pub start: StartMethod,
    /// The smallest corner of the first map over its mean corner.
    pub start_smallest_corner: f64,
    /// Quads that no map can make convex: they are held to two corners only.
    pub exempt_faces: Vec<FaceId>,
    /// The way down; its end is that of the last attempt.
    pub descent: Descent,
    /// What the energy is made of in the end.
    pub terms: Terms,
    /// What it took to keep the boundary clear of itself; `None` where it was so anyway.
    pub boundary_repair: Option<BoundaryRepair>,
    /// The mirror, when a symmetric map was asked for.
    pub symmetry: Option<SymmetryReport>,
    /// Up to which stretch the energy is elliptic: [`Objective::elliptic_limit`](super::Objective::elliptic_limit).
    pub elliptic_limit: Option<f64>,
    /// Corners that are stretched beyond it.
    pub corners_beyond_elliptic: usize,
}
