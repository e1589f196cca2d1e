//! Dials set for a purpose.

use crate::direct::{AngleTerm, DirectOptions};
use crate::parameterize::{Method, Options};

/// Settings of method, `q`, `shape` and angle term that serve a purpose.
///
/// What each gives, measured against other tools, is in the project's comparison tables. All but [`Preset::PaperErrors`]
/// are elliptic (well-posed on fine meshes) for s1/s2 up to [`Objective::elliptic_limit`](crate::direct::Objective::elliptic_limit).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Preset {
    /// The default: no worse than SLIM in angles, areas and symmetric Dirichlet at once (q 0.6, shape 1).
    Balanced,
    /// MIPS: angles above all, areas as they come (method conformal, q 1). Polyconvex.
    Conformal,
    /// As rigid as possible: nearly the angles of a conformal map with far smaller changes of area (q 0.95, shape 1).
    ArapLike,
    /// One texel density everywhere (q 0.5, shape 0.5).
    EvenTexels,
    /// The least symmetric Dirichlet energy: cloth, peeling, remeshing (q 0.5, shape 10).
    LeastStretch,
    /// Eqs. 13 and 14 themselves before all else: coarse meshes only (q 0.5, shape 0.1, angles compared as printed).
    PaperErrors,
}

impl Preset {
    /// All of them, the default first.
    pub const ALL: [Self; 6] = [
        Self::Balanced,
        Self::Conformal,
        Self::ArapLike,
        Self::EvenTexels,
        Self::LeastStretch,
        Self::PaperErrors,
    ];

    /// The method that it runs.
    #[must_use]
    pub fn method(self) -> Method {
        if self == Self::Conformal { Method::Conformal } else { Method::Direct }
    }

    /// 1 angle-true, 0 area-true.
    #[must_use]
    pub fn q(self) -> f64 {
        match self {
            Self::Conformal => 1.0,
            Self::ArapLike => 0.95,
            Self::Balanced => 0.6,
            _ => 0.5,
        }
    }

    /// Weight of the symmetric Dirichlet term; [`Preset::Conformal`] does not read it.
    #[must_use]
    pub fn shape(self) -> f64 {
        match self {
            Self::EvenTexels => 0.5,
            Self::LeastStretch => 10.0,
            Self::PaperErrors => 0.1,
            _ => 1.0,
        }
    }

    /// How angles are compared; [`Preset::Conformal`] does not read it.
    #[must_use]
    pub fn angle_term(self) -> AngleTerm {
        if self == Self::PaperErrors { AngleTerm::Paper } else { AngleTerm::Log }
    }

    /// Options with these dials and everything else at its default.
    ///
    /// ```
    /// use qoptimize::{Options, Preset};
    /// assert_eq!(Preset::Balanced.options(), Options::default());
    /// ```
    #[must_use]
    pub fn options(self) -> Options {
        let direct =
            DirectOptions { shape: self.shape(), angle_term: self.angle_term(), ..DirectOptions::default() };
        Options { method: self.method(), q: self.q(), direct, ..Options::default() }
    }
}
