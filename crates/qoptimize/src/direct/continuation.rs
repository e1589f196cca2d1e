//! From one map to the next of the same surface: what does not depend on the dials is kept, and each descent starts where the last
//! one ended.

use std::sync::Arc;

use crate::ParameterizeError;
use crate::convexity::Exempt;
use crate::plane::outline_flaws;
use crate::qmesh::{QuadMesh, Vec2};

use super::coarse::{Sizes, arrive};
use super::embed::{Map, Run};
use super::hessian::Hessian;
use super::learnt::Learnt;
use super::newton::descend;
use super::predict::Series;
use super::rest::Rest;
use super::scale::to_best_scale;
use super::start::{Origin, judge};
use super::tail::Tail;
use super::{
    Descent, DescentError, DescentOptions, DirectReport, Objective, Start, StartMethod, Stop, energy,
};

/// What maps of one surface with a free boundary hand on to each other: see [`embed_from`](super::embed_from).
#[derive(Default)]
pub struct Continuation {
    kept: Option<Kept>,
    /// There is no next map: what is not needed any more is freed.
    is_last: bool,
}

struct Kept {
    origin: Origin,
    exempt: Exempt,
    rest: Arc<Rest>,
    hessian: Hessian,
    /// The first map at true scale, in units of `rest`.
    first: Vec<Vec2>,
    /// The maps of least energy, whether their boundaries were clear of themselves or not.
    series: Series,
    learnt: Learnt,
    /// The last map whose boundary had to be cleared.
    cleared: Option<Vec<Vec2>>,
}

impl std::fmt::Debug for Continuation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Continuation").field("is_warm", &self.is_warm()).finish()
    }
}

impl Continuation {
    /// For one map only.
    pub(crate) fn for_one() -> Self {
        Self { is_last: true, ..Self::default() }
    }

    /// Whether there is a map to start from.
    #[must_use]
    pub fn is_warm(&self) -> bool {
        self.kept.as_ref().is_some_and(|kept| !kept.series.is_empty())
    }

    /// Which quads of `mesh` cannot be convex.
    pub(super) fn exempt(&self, mesh: &QuadMesh) -> Exempt {
        match &self.kept {
            Some(kept) if kept.is_of(mesh) => kept.exempt.clone(),
            _ => Exempt::find(mesh),
        }
    }

    /// The free map of least energy, from the last one if there is one.
    pub(super) fn free(&mut self, run: &Run<'_>) -> Result<(Map, DirectReport), ParameterizeError> {
        let mut kept = match self.kept.take().filter(|kept| kept.is_of(run.mesh)) {
            Some(kept) => kept,
            None => Kept::new(run)?,
        };
        // From inside the pool, where short parallel loops do not have to wake it first.
        let (mut uv, descent) = rayon::scope(|_| kept.least(run))?;
        if !self.is_last {
            kept.series.remember(run.objective, &mut uv);
        }
        let mut report = run.report(kept.origin, descent);
        if outline_flaws(run.mesh, &uv) > 0 {
            let mut clear = kept.clear_map(run)?;
            to_best_scale(&kept.rest, run.objective, &mut clear);
            report.boundary_repair = run.problem(&kept.rest).clear(&clear, &mut uv, &mut report.descent)?;
        }
        let rest = kept.rest.clone();
        if !self.is_last {
            if report.boundary_repair.is_some() {
                kept.cleared = Some(uv.clone());
            }
            self.kept = Some(kept);
        }
        Ok((Map { uv, rest }, report))
    }
}

impl Kept {
    fn new(run: &Run<'_>) -> Result<Self, ParameterizeError> {
        let rest = Rest::new(run.mesh, &run.exempt);
        let sizes = Sizes::default();
        let arrived =
            rayon::scope(|_| arrive(run.mesh, &run.exempt, &rest, run.objective, sizes, run.observer));
        let (origin, first) = match arrived {
            Some(uv) => {
                let smallest_corner = judge(&rest, &uv).valid().unwrap_or(0.0);
                (Origin { method: StartMethod::CoarseToFine, smallest_corner }, uv)
            }
            None => {
                let start = run.start()?;
                (start.origin(), in_units(&rest, &start))
            }
        };
        let hessian = Hessian::new(&rest).map_err(DescentError::from)?;
        Ok(Self {
            origin,
            exempt: run.exempt.clone(),
            rest: Arc::new(rest),
            hessian,
            first,
            series: Series::default(),
            learnt: Learnt::default(),
            cleared: None,
        })
    }

    /// The map of least energy.
    fn least(&mut self, run: &Run<'_>) -> Result<(Vec<Vec2>, Descent), ParameterizeError> {
        let walked = self.walked(run)?;
        if let Some((uv, descent)) = walked.as_ref().filter(|(_, descent)| descent.stop != Stop::MaxSteps) {
            return Ok((uv.clone(), descent.clone()));
        }
        let mut uv = self.nearest(run.objective);
        let (mut made, mut energy_before) = (0, None);
        if let Some((further, descent)) = walked
            && descent.energy < energy::value(run.objective, &self.rest, &uv)
        {
            (uv, made, energy_before) = (further, descent.steps, Some(descent.energy_before));
        }
        let options =
            DescentOptions { max_steps: run.options.max_steps.saturating_sub(made), ..*run.options };
        let mut descent =
            descend(&self.rest, &mut self.hessian, &mut uv, run.objective, &options, run.observer)?;
        descent.steps += made;
        descent.energy_before = energy_before.unwrap_or(descent.energy_before);
        Ok((uv, descent))
    }

    /// How far one gets from where the other maps say that this one lies; `None` where they say nothing of use.
    fn walked(&mut self, run: &Run<'_>) -> Result<Option<(Vec<Vec2>, Descent)>, DescentError> {
        let predicted = self.series.predicted(run.objective);
        if let Some(walked) = predicted.map(|uv| self.walked_from(uv, run)).transpose()?.flatten() {
            return Ok(Some(walked));
        }
        // Where corners are squeezed a prediction may go too far.
        let nearest = self.series.nearest(run.objective).map(<[Vec2]>::to_vec);
        Ok(nearest.map(|uv| self.walked_from(uv, run)).transpose()?.flatten())
    }

    /// How far one gets from `uv`; `None` where that is too far from the minimum to begin.
    fn walked_from(
        &mut self,
        mut uv: Vec<Vec2>,
        run: &Run<'_>,
    ) -> Result<Option<(Vec<Vec2>, Descent)>, DescentError> {
        let Self { rest, hessian, learnt, .. } = self;
        let mut tail = Tail { rest, hessian, learnt, objective: run.objective };
        match tail.walk(&mut uv, run.options, run.observer) {
            Ok(Descent { steps: 0, stop: Stop::MaxSteps, .. }) | Err(DescentError::InvalidStart(_)) => {
                Ok(None)
            }
            Ok(descent) => Ok(Some((uv, descent))),
            Err(error) => Err(error),
        }
    }

    /// The map for the objective most like this one, or the first map, at its best scale.
    fn nearest(&self, objective: &Objective) -> Vec<Vec2> {
        let mut nearest = self.series.nearest(objective).unwrap_or(&self.first).to_vec();
        to_best_scale(&self.rest, objective, &mut nearest);
        nearest
    }

    /// A map whose boundary is clear of itself.
    fn clear_map(&self, run: &Run<'_>) -> Result<Vec<Vec2>, ParameterizeError> {
        let known = self.cleared.iter().chain([&self.first]).find(|uv| outline_flaws(run.mesh, uv) == 0);
        match known {
            Some(uv) => Ok(uv.clone()),
            None => Ok(in_units(&self.rest, &run.start()?)),
        }
    }

    /// As far as can be told without comparing all of the surface: the caller promises the rest.
    fn is_of(&self, mesh: &QuadMesh) -> bool {
        self.rest.vertex_count == mesh.vertex_count() && self.rest.ids.len() <= mesh.corner_count()
    }
}

/// The unit is a power of two, so dividing by it rounds nothing.
fn in_units(rest: &Rest, start: &Start) -> Vec<Vec2> {
    start.uv.iter().map(|p| p / rest.unit).collect()
}
