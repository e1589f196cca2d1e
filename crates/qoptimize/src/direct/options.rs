//! Start and descent in one call, with a record of both.

use crate::ParameterizeError;
use crate::convexity::Exempt;
use crate::direct::{
    AngleTerm, Descent, DescentOptions, Objective, StartError, StartMethod, find_start, minimize,
};
use crate::qmesh::{FaceId, Observer, QuadMesh, Vec2, VertexData};

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
    /// The way down.
    pub descent: Descent,
}

/// A map of the planar patch `mesh` (a disk, perhaps with holes) with a free boundary that (locally) minimises `objective`, at the scale of the mesh.
///
/// Every corner turns left, but for those of [`DirectReport::exempt_faces`]. Whether the free boundary stays clear of itself is
/// for [`Distortion`](crate::Distortion) to say. Cancelling during the descent ends it early with the map at hand.
///
/// # Errors
/// No start was found, a linear system could not be solved, or cancelled before there was a valid map.
pub fn embed(
    mesh: &QuadMesh,
    objective: &Objective,
    options: &DescentOptions,
    observer: &dyn Observer,
) -> Result<(VertexData<Vec2>, DirectReport), ParameterizeError> {
    let exempt = Exempt::find(mesh);
    let (mut uv, start) = start(mesh, &exempt, observer)?;
    let descent = minimize(mesh, &mut uv, &exempt, objective, options, observer)?;
    let report = DirectReport {
        start: start.0,
        start_smallest_corner: start.1,
        exempt_faces: exempt.faces(),
        descent,
    };
    Ok((uv, report))
}

/// A first map, how it was found, and its smallest corner. Holes are filled for this time only.
fn start(
    mesh: &QuadMesh,
    exempt: &Exempt,
    observer: &dyn Observer,
) -> Result<(VertexData<Vec2>, (StartMethod, f64)), StartError> {
    let Some(filled) = mesh.filled() else {
        let start = find_start(mesh, exempt, observer)?;
        return Ok((start.uv, (start.method, start.smallest_corner)));
    };
    let start = find_start(&filled, &Exempt::find(&filled), observer)?;
    let mut uv = start.uv.into_vec();
    uv.truncate(mesh.vertex_count());
    Ok((VertexData::from_vec(uv), (start.method, start.smallest_corner)))
}
