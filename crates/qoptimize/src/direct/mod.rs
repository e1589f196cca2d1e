//! Injective maps of least error: the paper's future work, "a better objective function".
//!
//! Instead of linear stand-ins for the angle and area errors (sections 2.2 and 2.3), the errors themselves are minimised, in
//! a well-posed form, over maps that stay injective and whose boundary is free:
//!
//! ```text
//! E(u) = q · mean log²(θ/φ)  +  (1 − q) · mean ½[(r − 1)² + (1/r − 1)²]  +  shape · Σ w (SD − 1),   r = A(T)/A(U)
//! ```
//!
//! over the corner triangles: four a quad, both diagonals, so none is preferred. θ and φ are the corner's angle in space and in
//! the plane (Eq. 13), A(T) and A(U) its areas (Eq. 14), SD its symmetric Dirichlet energy `(s1² + s2² + s1⁻² + s2⁻²)/4`, and w is
//! 0.9 · share of the area + 0.1 / number of corners. The last term closes a blind spot: with every quad stretched λ × 1/λ along
//! its edges, Eqs. 13 and 14 are both zero. It also keeps the energy elliptic (rank-one convex), without which fine meshes grow
//! shear bands while the printed errors still fall: see [`AngleTerm`].
//!
//! Gauss–Newton for the two error terms, projected Newton for the third ([`minimize`]); every step is bounded by the first corner
//! area that would reach zero, so no corner ever flips. Calm steps are conjugate to the one before, which makes up for what
//! Gauss–Newton leaves out.

mod clear;
mod coarse;
mod conjugate;
mod constraint;
mod continuation;
mod element;
mod elliptic;
mod embed;
mod energy;
mod even;
mod held;
mod hessian;
mod isotropic;
mod kernel;
mod layout;
mod learnt;
mod mirrored;
mod newton;
mod options;
mod predict;
mod pull;
pub(crate) mod rest;
mod scaffold;
mod scale;
mod slow;
mod start;
mod step;
mod system;
mod tail;
mod untangle;

#[cfg(test)]
mod tests;

pub use clear::BoundaryRepair;
pub use continuation::Continuation;
pub use embed::{Wishes, embed, embed_from};
pub use energy::Terms;
pub use mirrored::SymmetryReport;
pub use newton::{Descent, DescentError, DescentOptions, Stop, minimize};
pub use options::{DirectOptions, DirectReport};
pub use scaffold::ScaffoldEnd;
pub use start::{Start, StartMethod, find_start};

use crate::qmesh::{CornerId, QuadMesh, Topology};
use crate::qsolve::SolveError;

/// Why there is no first map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StartError {
    /// The observer asked to stop before there was a valid map.
    #[error("cancelled")]
    Cancelled,
    /// The mesh is no disk.
    #[error("the mesh is no disk: {0:?}")]
    NotADisk(Topology),
    /// No way led to a map without flips.
    #[error("no map without flipped corners was found: {count} corners are left, the worst is {corner}")]
    Tangled {
        /// The worst corner.
        corner: CornerId,
        /// How many corners do not turn left.
        count: usize,
    },
    /// A linear system could not be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

impl StartError {
    /// The same about `patch`, of which `filled` is the mesh without holes: what is wrong in a filling is told of a corner at its rim.
    pub(crate) fn outside_of_fillings(self, patch: &QuadMesh, filled: &QuadMesh) -> Self {
        match self {
            Self::Tangled { corner, count } if corner.index() >= patch.corner_count() => {
                let rim =
                    filled.face_vertices(filled.face(corner)).find(|v| v.index() < patch.vertex_count());
                let corner = rim.and_then(|vertex| patch.vertex_corners(vertex).next());
                Self::Tangled { corner: corner.unwrap_or(CornerId(0)), count }
            }
            other => other,
        }
    }
}

/// How the angle term measures θ against φ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum AngleTerm {
    /// `log²(θ/φ)`: elliptic for stretches s1/s2 up to 10 when `shape ≥ q`, up to 20 when `shape ≥ 1.5 q`.
    #[default]
    Log,
    /// `(θ/φ − 1)²`, Eq. 13 itself: elliptic only up to s1/s2 = 2 when `shape ≥ 0.9 q`, as by default, up to 3 when `shape ≥ 2.1 q`. For
    /// coarse meshes.
    Paper,
}

/// What is minimised.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Objective {
    /// The energy of this module's documentation.
    Direct {
        /// 1 angle-true, 0 area-true.
        q: f64,
        /// Weight of the symmetric Dirichlet term.
        shape: f64,
        /// How angles are compared.
        angle_term: AngleTerm,
    },
    /// `q · MIPS + (1 − q) · (det + 1/det)/2`, weighted like the symmetric Dirichlet term: the classical family.
    Conformal {
        /// 1 conformal, 0 area-true.
        q: f64,
    },
}

impl Objective {
    /// Below this q the angles, above its complement the areas, would be free to degenerate.
    pub const Q_MARGIN: f64 = 1e-5;
    /// The least weight of the symmetric Dirichlet term.
    pub const LEAST_SHAPE: f64 = 1e-4;

    /// The same objective with its dials moved into the range in which a minimum exists.
    #[must_use]
    pub fn clamped(self) -> Self {
        let inside = |q: f64| q.clamp(Self::Q_MARGIN, 1.0 - Self::Q_MARGIN);
        match self {
            Self::Direct { q, shape, angle_term } => {
                Self::Direct { q: inside(q), shape: shape.max(Self::LEAST_SHAPE), angle_term }
            }
            Self::Conformal { q } => Self::Conformal { q: inside(q) },
        }
    }
}

impl Default for Objective {
    fn default() -> Self {
        Self::Direct { q: 0.6, shape: 1.0, angle_term: AngleTerm::Log }
    }
}
