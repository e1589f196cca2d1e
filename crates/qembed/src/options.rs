//! What the caller chooses.

use crate::qmesh::{Vec2, VertexId};
use qsolve::SolveOptions;

/// Where the boundary goes.
///
/// All shapes run counter-clockwise. They start at the boundary vertex that lies farthest from the boundary's
/// centroid (the lowest index among those within 1e-9), so that neither rotating nor renumbering the mesh turns the map.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum BoundaryShape {
    /// What suits the method: free where the method moves the boundary itself, the circle elsewhere.
    #[default]
    Auto,
    /// Wherever the method moves it. Only for methods that do: direct, conformal, and least squares conformal maps.
    Free,
    /// The unit circle around the origin, by arc length. Edges shorter than a thousandth of the mean count as that
    /// long, so that the polygon stays strictly convex.
    Circle,
    /// The unit square `[0, 1]²`, each side by arc length. Boundary vertices with a single face become corners;
    /// missing corners are put where the boundary is sharpest, in the middle third of the longest stretch.
    Square,
    /// Orthogonal projection, in the unit of the mesh, to the plane in which the boundary encloses the largest area;
    /// refused when the boundary meets itself there. It need not be convex, so faces may flip.
    Projection,
    /// Positions for every boundary vertex, given by the caller. Not checked for crossings.
    Fixed(Vec<(VertexId, Vec2)>),
}

/// Edge weights of Eqs. 6 and 8.
///
/// The paper's text leaves open which angles α, β, γ, δ are. *Star* angles are those of the corner triangles of
/// `v_i`: with `v_{j−1}`, `v_j`, `v_{j+1}` successive immediate neighbours, α is the angle at `v_{j+1}` in the triangle
/// `v_i v_j v_{j+1}`, β that at `v_{j−1}` in `v_i v_{j−1} v_j`, and γ, δ are the angles at `v_j` in the same two triangles.
/// Angles are kept 1e-6 away from 0 and π, so every weight is finite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Weights {
    /// Star angles with the printed quarter and half, `cot α/4` and `cot γ/2`: always positive.
    #[default]
    Star4,
    /// Star angles, plain `cot α` and `cot γ`: the only reading that reproduces flat meshes; weights may be negative.
    Star1,
    /// Quad-corner angles with the printed quarter and half: α and β are the means of the two corners opposite the
    /// edge in the face on its left and right, γ and δ the corners at `v_j` of these faces. Always positive, but blind to
    /// lengths: every rectangle has the same conformal weights.
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
    /// The energies are added as printed. Eq. 6 has no unit and Eq. 8 is one over an area, so the result depends on
    /// the unit of length.
    Raw,
}

/// How to embed (sections 2.2 and 2.3).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, rename_all = "kebab-case"))]
pub struct EmbedOptions {
    /// `q` of Eq. 10: 1 conformal, 0 authalic, as Eq. 10 and Table 1 have it; the captions of Fig. 3 have the two
    /// swapped. Default 0.5. Acts on removed vertices only.
    pub q: f64,
    /// Default `Auto`, which is the circle.
    pub boundary: BoundaryShape,
    /// `r` of Eq. 5, at least 0. Default 1.
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
            boundary: BoundaryShape::Auto,
            exponent: 1.0,
            weights: Weights::Star4,
            mixing: Mixing::RowNormalized,
            solve: SolveOptions::default(),
        }
    }
}
