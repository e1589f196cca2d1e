//! From a mesh to a map: a start, the descent, and what it takes to heed the caller's wishes.

use std::borrow::Cow;
use std::sync::Arc;

use crate::ParameterizeError;
use crate::convexity::Exempt;
use crate::plane::outline_flaws;
use crate::qembed::BoundaryShape;
use crate::qmesh::{Observer, QuadMesh, Vec2, VertexData, VertexId};

use super::clear::FreeProblem;
use super::continuation::Continuation;
use super::energy;
use super::held::HeldBoundary;
use super::hessian::Hessian;
use super::mirrored;
use super::newton::descend;
use super::pull::{self, Pin, Pull};
use super::rest::{Rest, unit_length};
use super::start::{Origin, find_start_on, find_start_with_holes};
use super::{Descent, DescentOptions, DirectReport, Objective, Start, StartError, Terms};

/// What a map has to heed besides its energy.
#[derive(Clone, Copy, Debug)]
pub struct Wishes<'a> {
    /// `Auto` and `Free` leave the boundary free. Held boundaries are those around the patch; the rims of holes are free always.
    pub boundary: &'a BoundaryShape,
    /// Vertices with their places, which they take exactly.
    pub pins: &'a [(VertexId, Vec2)],
    /// Whether the map is to be mirrored by `u ↦ −u` exactly: for free boundaries without pins.
    pub symmetric: bool,
}

impl Default for Wishes<'_> {
    fn default() -> Self {
        Self { boundary: &BoundaryShape::Auto, pins: &[], symmetric: false }
    }
}

/// A map of the planar patch `mesh` (a disk, perhaps with holes) that (locally) minimises `objective`.
///
/// Every corner turns left, but for those of [`DirectReport::exempt_faces`], and the boundary stays clear of itself: where that of
/// the map of least energy does not, [`DirectReport::boundary_repair`] says what it cost. Cancelling during the descent ends it
/// early with the map at hand.
///
/// # Scale
/// A free map has the scale of the mesh. On a held boundary the surface counts as scaled to the area that the boundary encloses, so
/// that the energy compares shapes and not sizes. One pin only moves the map. Two or more also turn and scale it: by the
/// similarity that brings the map nearest to them, at whose scale the energy is then measured. Two pins therefore bend nothing.
///
/// # Errors
/// No start was found, a wish cannot be granted, a linear system could not be solved, or cancelled before there was a valid map.
pub fn embed(
    mesh: &QuadMesh,
    objective: &Objective,
    wishes: &Wishes<'_>,
    options: &DescentOptions,
    observer: &dyn Observer,
) -> Result<(VertexData<Vec2>, DirectReport), ParameterizeError> {
    embed_from(&mut Continuation::for_one(), mesh, objective, wishes, options, observer)
}

/// The same for several objectives, one after the other: with a free boundary and no symmetry asked for, each map starts from the
/// one before. Neighbouring maps then lie in the same valley, and cost a fraction of the first.
///
/// `mesh` is to be the same in all calls with one `continuation`.
///
/// # Errors
/// As [`embed`].
pub fn embed_from(
    continuation: &mut Continuation,
    mesh: &QuadMesh,
    objective: &Objective,
    wishes: &Wishes<'_>,
    options: &DescentOptions,
    observer: &dyn Observer,
) -> Result<(VertexData<Vec2>, DirectReport), ParameterizeError> {
    pull::check(mesh, wishes.pins)?;
    let is_free = matches!(wishes.boundary, BoundaryShape::Auto | BoundaryShape::Free);
    if wishes.symmetric && !(is_free && wishes.pins.is_empty()) {
        return Err(ParameterizeError::SymmetricAndHeld);
    }
    let exempt = continuation.exempt(mesh);
    let mut run = Run { mesh, exempt, objective: &objective.clamped(), options, observer };
    let symmetrized = if wishes.symmetric { Some(mirrored::symmetrized(mesh)?) } else { None };
    let (mut map, mut report) = match (&symmetrized, wishes.boundary) {
        (Some((even, mirror)), _) => {
            run.mesh = even;
            run.mirrored(mirror)?
        }
        (None, _) if is_free => continuation.free(&run)?,
        (None, shape) => run.held(shape)?,
    };
    match wishes.pins {
        [] => {}
        [pin] if map.rest.constraint.held.is_empty() => {
            let shift = pin.1 / map.rest.unit - map.uv[pin.0.index()];
            map.uv.iter_mut().for_each(|p| *p += shift);
            map.uv[pin.0.index()] = pin.1 / map.rest.unit;
        }
        pins => run.pin(&mut map, pins, &mut report)?,
    }
    report.elliptic_limit = objective.elliptic_limit();
    (report.terms, report.corners_beyond_elliptic) =
        energy::terms(objective, &map.rest, &map.uv, report.elliptic_limit);
    let unit = map.rest.unit;
    Ok((VertexData::from_vec(map.uv.iter().map(|p| p * unit).collect()), report))
}

/// A map in units of its problem.
pub(super) struct Map {
    pub(super) uv: Vec<Vec2>,
    pub(super) rest: Arc<Rest>,
}

/// What one call works with.
pub(super) struct Run<'a> {
    pub(super) mesh: &'a QuadMesh,
    pub(super) exempt: Exempt,
    /// Clamped.
    pub(super) objective: &'a Objective,
    pub(super) options: &'a DescentOptions,
    pub(super) observer: &'a dyn Observer,
}

impl Run<'_> {
    /// A first map, on a circle.
    pub(super) fn start(&self) -> Result<Start, StartError> {
        find_start_with_holes(self.mesh, &self.exempt, self.observer)
    }

    fn held(&self, shape: &BoundaryShape) -> Result<(Map, DirectReport), ParameterizeError> {
        let filled = self.mesh.filled().map_or(Cow::Borrowed(self.mesh), Cow::Owned);
        let filled_exempt = Exempt::find(&filled);
        let boundary = HeldBoundary::new(&filled, &filled_exempt, shape)?;
        let start = find_start_on(&filled, &filled_exempt, &boundary.places, self.observer);
        let start = start.map_err(|error| error.outside_of_fillings(self.mesh, &filled))?;
        let start = start.truncated(self.mesh.vertex_count());
        let rest = boundary.rest(self.mesh, &self.exempt, &filled);
        let first: Vec<Vec2> = start.uv.iter().map(|p| p / rest.unit).collect();
        let mut uv = first.clone();
        let mut report = self.report(start.origin(), self.descend(&rest, &mut uv)?);
        report.boundary_repair = self.problem(&rest).clear(&first, &mut uv, &mut report.descent)?;
        Ok((Map { uv, rest: Arc::new(rest) }, report))
    }

    /// Draws the pins of a valid map to their places.
    fn pin(&self, map: &mut Map, pins: &[Pin], report: &mut DirectReport) -> Result<(), ParameterizeError> {
        let held = &map.rest.constraint.held;
        if held.is_empty() {
            fit(map, pins);
        } else if let Some(&(vertex, _)) = pins.iter().find(|pin| held[pin.0.index()]) {
            return Err(ParameterizeError::PinOnHeldBoundary { vertex });
        }
        let held = &mut Arc::make_mut(&mut map.rest).constraint.held;
        held.resize(map.uv.len(), false);
        for (vertex, _) in pins {
            held[vertex.index()] = true;
        }
        let pins: Vec<Pin> = pins.iter().map(|&(vertex, place)| (vertex, place / map.rest.unit)).collect();
        let pull = Pull {
            mesh: self.mesh,
            rest: &map.rest,
            pins: &pins,
            objective: self.objective,
            options: self.options,
            observer: self.observer,
            scaffolded: false,
        };
        let mut uv = map.uv.clone();
        pull.run(&mut uv)?;
        let first = report.descent.energy_before;
        let earlier = report.descent.steps;
        report.descent = self.descend(&map.rest, &mut uv)?;
        if outline_flaws(self.mesh, &uv) > 0 && outline_flaws(self.mesh, &map.uv) == 0 {
            let mut kept_apart = map.uv.clone();
            Pull { scaffolded: true, ..pull }.run(&mut kept_apart)?;
            report.boundary_repair =
                self.problem(&map.rest).clear(&kept_apart, &mut uv, &mut report.descent)?;
        }
        report.descent.energy_before = first;
        report.descent.steps += earlier;
        map.uv = uv;
        Ok(())
    }

    pub(super) fn descend(&self, rest: &Rest, uv: &mut [Vec2]) -> Result<Descent, ParameterizeError> {
        let mut hessian = Hessian::new(rest).map_err(super::DescentError::from)?;
        Ok(descend(rest, &mut hessian, uv, self.objective, self.options, self.observer)?)
    }

    pub(super) fn problem<'a>(&'a self, rest: &'a Rest) -> FreeProblem<'a> {
        FreeProblem {
            mesh: self.mesh,
            rest,
            objective: self.objective,
            options: self.options,
            observer: self.observer,
        }
    }

    pub(super) fn report(&self, origin: Origin, descent: Descent) -> DirectReport {
        DirectReport {
            start: origin.method,
            start_smallest_corner: origin.smallest_corner,
            exempt_faces: self.exempt.faces(),
            descent,
            terms: Terms { angle: 0.0, area: 0.0, shape: 0.0 },
            boundary_repair: None,
            symmetry: None,
            elliptic_limit: None,
            corners_beyond_elliptic: 0,
        }
    }
}

/// Turns, moves and scales a free map to be as near to its pins as it gets, and its problem with it.
fn fit(map: &mut Map, pins: &[Pin]) {
    let unit = map.rest.unit;
    let uv: Vec<Vec2> = map.uv.iter().map(|p| p * unit).collect();
    let [a, b] = pull::similarity(&uv, pins);
    let area =
        a.norm_squared() * map.rest.corners.iter().map(|corner| corner.area).sum::<f64>() * unit * unit;
    let rest = Arc::make_mut(&mut map.rest);
    rest.unit = unit_length(0.5 * area);
    rest.scale(a.norm() * unit / rest.unit);
    map.uv = uv.iter().map(|&p| (pull::times(a, p) + b) / map.rest.unit).collect();
}
