//! A free boundary that meets itself: back to where it did not yet, and on from there with a scaffold.

use crate::plane::outline_flaws;
use crate::qmesh::{Observer, QuadMesh, Vec2};

use super::hessian::Hessian;
use super::isotropic::symmetric_dirichlet;
use super::newton::descend;
use super::rest::Rest;
use super::scaffold::{Scaffold, ScaffoldEnd};
use super::{Descent, DescentError, DescentOptions, Objective, Stop, energy};

/// What it took to keep a free boundary clear of itself.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct BoundaryRepair {
    /// How often the boundary of the free map, the one of least energy, meets itself.
    pub free_crossings: usize,
    /// The energy of that map.
    pub free_energy: f64,
    /// Its symmetric Dirichlet energy: the area-weighted mean of `(s1² + s2² + s1⁻² + s2⁻²)/4`.
    pub free_symmetric_dirichlet: f64,
    /// The energy of the map whose boundary is clear of itself.
    pub energy: f64,
    /// Its symmetric Dirichlet energy.
    pub symmetric_dirichlet: f64,
    /// How often the surroundings were triangulated.
    pub rounds: usize,
    /// How the work with the scaffold ended.
    pub end: ScaffoldEnd,
}

/// A free problem; lengths in units of `rest`.
pub(super) struct FreeProblem<'a> {
    pub(super) mesh: &'a QuadMesh,
    pub(super) rest: &'a Rest,
    pub(super) objective: &'a Objective,
    pub(super) options: &'a DescentOptions,
    pub(super) observer: &'a dyn Observer,
}

impl FreeProblem<'_> {
    /// Where the boundary of `uv` meets itself, replaces it by a map where it does not: from `start`, which is clear of itself
    /// and from where `descent` led to `uv`. Otherwise nothing is touched.
    pub(super) fn clear(
        &self,
        start: &[Vec2],
        uv: &mut Vec<Vec2>,
        descent: &mut Descent,
    ) -> Result<Option<BoundaryRepair>, DescentError> {
        let free_crossings = outline_flaws(self.mesh, uv);
        if free_crossings == 0 || outline_flaws(self.mesh, start) > 0 {
            return Ok(None);
        }
        let free_symmetric_dirichlet = dirichlet(self.rest, uv);
        let mut clear = self.last_clear(start)?;
        let done = Scaffold {
            mesh: self.mesh,
            rest: self.rest,
            objective: self.objective,
            options: self.options,
            observer: self.observer,
        }
        .minimize(&mut clear)?;
        *uv = clear;
        let energy = energy::value(self.objective, self.rest, uv);
        let repair = BoundaryRepair {
            free_crossings,
            free_energy: descent.energy,
            free_symmetric_dirichlet,
            energy,
            symmetric_dirichlet: dirichlet(self.rest, uv),
            rounds: done.rounds,
            end: done.end,
        };
        descent.steps += done.steps;
        descent.energy = energy;
        descent.stop = match done.end {
            ScaffoldEnd::Converged => Stop::Converged,
            ScaffoldEnd::MaxRounds => Stop::MaxSteps,
            ScaffoldEnd::Tight => Stop::Stalled,
            ScaffoldEnd::Cancelled => Stop::Cancelled,
        };
        Ok(Some(repair))
    }

    /// The farthest map on the way down from `start` that is clear of itself, at 1, 2, 4, 8, … steps.
    fn last_clear(&self, start: &[Vec2]) -> Result<Vec<Vec2>, DescentError> {
        let mut hessian = Hessian::new(self.rest)?;
        let mut clear = start.to_vec();
        let mut max_steps = 1;
        loop {
            let mut further = clear.clone();
            let options = DescentOptions { max_steps, ..*self.options };
            let descent =
                descend(self.rest, &mut hessian, &mut further, self.objective, &options, self.observer)?;
            if outline_flaws(self.mesh, &further) > 0 {
                return Ok(clear);
            }
            clear = further;
            max_steps *= 2;
            if descent.stop != Stop::MaxSteps {
                return Ok(clear);
            }
        }
    }
}

/// The area-weighted mean of the symmetric Dirichlet energy.
fn dirichlet(rest: &Rest, uv: &[Vec2]) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for corner in &rest.corners {
        let stretch = super::element::stretch(corner, energy::edges(corner, uv));
        sum += corner.area * symmetric_dirichlet(stretch.s).value;
        area += corner.area;
    }
    sum / area
}
