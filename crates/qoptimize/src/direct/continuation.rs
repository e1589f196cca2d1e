//! From one map to the next of the same surface: what does not depend on the dials is kept, and each descent starts where the last
//! one ended.

use crate::ParameterizeError;
use crate::plane::outline_flaws;
use crate::qmesh::Vec2;

use super::coarse::{Sizes, arrive};
use super::embed::{Map, Run};
use super::hessian::Hessian;
use super::newton::descend;
use super::rest::Rest;
use super::scale::to_best_scale;
use super::start::{Origin, judge};
use super::{DescentError, DirectReport, Start, StartMethod};

/// What maps of one surface with a free boundary hand on to each other: see [`embed_from`](super::embed_from).
#[derive(Default)]
pub struct Continuation {
    kept: Option<Kept>,
    /// There is no next map: what is not needed any more is freed.
    is_last: bool,
}

struct Kept {
    origin: Origin,
    rest: Rest,
    hessian: Hessian,
    /// The first map at true scale, in units of `rest`.
    first: Vec<Vec2>,
    /// The last map of least energy, whether its boundary was clear of itself or not.
    last: Option<Vec<Vec2>>,
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
        self.kept.as_ref().is_some_and(|kept| kept.last.is_some())
    }

    /// The free map of least energy, from the last one if there is one.
    pub(super) fn free(&mut self, run: &Run<'_>) -> Result<(Map, DirectReport), ParameterizeError> {
        let mut kept = match self.kept.take().filter(|kept| kept.belongs_to(run)) {
            Some(kept) => kept,
            None => Kept::new(run)?,
        };
        let mut uv = kept.last.clone().unwrap_or_else(|| kept.first.clone());
        to_best_scale(&kept.rest, run.objective, &mut uv);
        // From inside the pool, where short parallel loops do not have to wake it first.
        let descent = rayon::scope(|_| {
            descend(&kept.rest, &mut kept.hessian, &mut uv, run.objective, run.options, run.observer)
        })?;
        if !self.is_last {
            kept.last = Some(uv.clone());
        }
        let mut report = run.report(kept.origin, descent);
        if outline_flaws(run.mesh, &uv) > 0 {
            let mut clear = kept.clear_map(run)?;
            to_best_scale(&kept.rest, run.objective, &mut clear);
            report.boundary_repair = run.problem(&kept.rest).clear(&clear, &mut uv, &mut report.descent)?;
        }
        if self.is_last {
            return Ok((Map { uv, rest: kept.rest }, report));
        }
        if report.boundary_repair.is_some() {
            kept.cleared = Some(uv.clone());
        }
        let rest = kept.rest.clone();
        self.kept = Some(kept);
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
        Ok(Self { origin, rest, hessian, first, last: None, cleared: None })
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
    fn belongs_to(&self, run: &Run<'_>) -> bool {
        self.rest.vertex_count == run.mesh.vertex_count() && self.rest.ids.len() <= run.mesh.corner_count()
    }
}

/// The unit is a power of two, so dividing by it rounds nothing.
fn in_units(rest: &Rest, start: &Start) -> Vec<Vec2> {
    start.uv.iter().map(|p| p / rest.unit).collect()
}
