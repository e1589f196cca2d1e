//! From a mesh to a map: a start, the descent, and what it takes to keep the boundary clear of itself.

use crate::ParameterizeError;
use crate::convexity::Exempt;
use crate::qmesh::{Observer, QuadMesh, Vec2, VertexData};

use super::clear::FreeProblem;
use super::elliptic::corners_beyond;
use super::rest::Rest;
use super::scale::to_best_scale;
use super::{DescentOptions, DirectReport, Objective, Start, StartError, find_start, minimize};

/// A map of the planar patch `mesh` (a disk, perhaps with holes) with a free boundary that (locally) minimises `objective`, at the scale of the mesh.
///
/// Every corner turns left, but for those of [`DirectReport::exempt_faces`], and the boundary stays clear of itself: where that of
/// the map of least energy does not, [`DirectReport::boundary_repair`] says what it cost. Cancelling during the descent ends it
/// early with the map at hand.
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
    let mut start = start(mesh, &exempt, observer)?;
    let rest = Rest::new(mesh, &exempt);
    // The unit is a power of two, so neither division nor multiplication rounds.
    start.uv.iter_mut().for_each(|p| *p /= rest.unit);
    to_best_scale(&rest, &objective.clamped(), &mut start.uv);
    start.uv.iter_mut().for_each(|p| *p *= rest.unit);
    let mut uv = start.uv.clone();
    let mut descent = minimize(mesh, &mut uv, &exempt, objective, options, observer)?;
    let problem = FreeProblem { mesh, rest: &rest, objective: &objective.clamped(), options, observer };
    let in_units = |uv: &VertexData<Vec2>| uv.iter().map(|p| p / rest.unit).collect::<Vec<_>>();
    let mut map = in_units(&uv);
    let boundary_repair = problem.clear(&in_units(&start.uv), &mut map, &mut descent)?;
    if boundary_repair.is_some() {
        uv = VertexData::from_vec(map.iter().map(|p| p * rest.unit).collect());
    }
    let elliptic_limit = objective.elliptic_limit();
    let corners_beyond_elliptic = elliptic_limit.map_or(0, |limit| corners_beyond(&rest, &uv, limit));
    let report = DirectReport {
        start: start.method,
        start_smallest_corner: start.smallest_corner,
        exempt_faces: exempt.faces(),
        descent,
        boundary_repair,
        elliptic_limit,
        corners_beyond_elliptic,
    };
    Ok((uv, report))
}

/// A first map. Holes are filled for this time only.
fn start(mesh: &QuadMesh, exempt: &Exempt, observer: &dyn Observer) -> Result<Start, StartError> {
    let Some(filled) = mesh.filled() else { return find_start(mesh, exempt, observer) };
    let start = find_start(&filled, &Exempt::find(&filled), observer)?;
    let mut uv = start.uv.into_vec();
    uv.truncate(mesh.vertex_count());
    Ok(Start { uv: VertexData::from_vec(uv), ..start })
}
