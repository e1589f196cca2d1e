//! Coarse to fine: the way down is walked where steps are cheap.
//!
//! The paper's future work, "a good hierarchical solver". Vertices are joined to clusters, and where three or more of
//! them meet in a face, a coarser mesh has a triangle ([`clusters`], [`dual`]). Its map is found first, by the same means; what is
//! minimised there is the energy of the finest mesh, each triangle standing for the quads around its middle ([`sampled`]), since
//! triangles by themselves would measure angles that the quads do not have. Then its *shape* is carried up, not its places: every
//! vertex gets the derivative that the coarse map has there, and one sparse system finds the places that fit best ([`carry`],
//! [`fit`]). What flips on the way is unfolded where it lies ([`repair`]).
//!
//! On smooth surfaces the map arrives within a thousandth of the least energy, and two or three steps are left of sixteen.

mod carry;
mod clusters;
mod dual;
mod fit;
mod repair;
mod sampled;
mod surface;

#[cfg(test)]
mod tests;

use std::ops::ControlFlow;

use crate::convexity::Exempt;
use crate::qmesh::{Observer, QuadMesh, Vec2, Vec3};

use super::hessian::Hessian;
use super::newton::descend;
use super::rest::Rest;
use super::scale::to_best_scale;
use super::start::{find_start_with_holes, judge};
use super::{DescentOptions, Objective};
use carry::carried;
use repair::repair;
use surface::Surface;

/// Where coarse descents end, relative: what is below is for the finer ones.
const DECREASE: f64 = 1e-3;
const MAX_STEPS: usize = 60;
/// The part of the work on all coarse meshes that the last of them takes, and the part of that for its start.
const LAST: f64 = 0.8;
const START: f64 = 0.3;

/// How many vertices meshes have on which the work is worth it, or not worth it any more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    /// Finest meshes with fewer are mapped at once.
    least: usize,
    /// The same for surfaces as [open](is_open) as a disk.
    least_open: usize,
    /// A coarse mesh with more is mapped by way of a coarser one. Below, surfaces with thin limbs would lose their shape.
    coarsest: usize,
}

impl Default for Sizes {
    fn default() -> Self {
        Self { least: 12_000, least_open: 3_000, coarsest: 30_000 }
    }
}

/// The square of the boundary's length over the area is 4π for a flat disk and 16 for a square, and small for bags like heads.
const OPEN: f64 = 6.0;

/// Whether a surface has much boundary for its area, and in one piece: it then has no limbs that coarse meshes would lose.
fn is_open(mesh: &QuadMesh) -> bool {
    let [outline] = &mesh.boundary_loops()[..] else { return false };
    let places: Vec<Vec3> =
        mesh.loop_vertices(outline).into_iter().map(|vertex| mesh.position(vertex)).collect();
    let next = places.iter().cycle().skip(1);
    let length: f64 = places.iter().zip(next).map(|(a, b)| (b - a).norm()).sum();
    length * length >= OPEN * crate::qcurv::surface_area(mesh)
}

/// A map of the planar patch `mesh` by way of coarser meshes, in units of `rest`, in which every corner turns left; `None` where there
/// is none to be had that way.
pub(super) fn arrive(
    mesh: &QuadMesh,
    exempt: &Exempt,
    rest: &Rest,
    objective: &Objective,
    sizes: Sizes,
    observer: &dyn Observer,
) -> Option<Vec<Vec2>> {
    let count = mesh.vertex_count();
    if count < sizes.least && (count < sizes.least_open || !is_open(mesh)) {
        return None;
    }
    let finest = Finest { mesh, exempt, unit: rest.unit, objective, sizes };
    let mut uv = finest.by_way_of_coarser(&Surface::new(mesh), &Within { observer, from: 0.0, to: 1.0 })?;
    repair(rest, &mut uv, observer);
    (judge(rest, &uv).bad == 0).then_some(uv)
}

/// What all levels need to know of the finest.
struct Finest<'a> {
    mesh: &'a QuadMesh,
    exempt: &'a Exempt,
    unit: f64,
    objective: &'a Objective,
    sizes: Sizes,
}

impl Finest<'_> {
    /// A map of `surface` by way of the next coarser one; corners may be flipped.
    fn by_way_of_coarser(&self, surface: &Surface<'_>, watch: &Within<'_>) -> Option<Vec<Vec2>> {
        let (coarse, clusters) = dual::coarsened(surface)?;
        let rest = sampled::rest(&coarse, self.mesh, self.exempt, self.unit);
        let uv = self.minimal(&coarse, &rest, watch)?;
        Some(carried(surface, &coarse, &clusters.of, self.unit, &uv))
    }

    /// The map of least energy of a coarse surface.
    fn minimal(&self, coarse: &Surface<'_>, rest: &Rest, watch: &Within<'_>) -> Option<Vec<Vec2>> {
        let (before, last) = watch.split(LAST);
        let (mut uv, watch) = match self.by_way_of_still_coarser(coarse, rest, &before) {
            Some(uv) => (uv, last),
            None => {
                let (start, descent) = watch.split(1.0 - START);
                (find_start_with_holes(&coarse.mesh, &Exempt::default(), &start).ok()?.uv.into_vec(), descent)
            }
        };
        to_best_scale(rest, self.objective, &mut uv);
        let mut hessian = Hessian::new(rest).ok()?;
        let options = DescentOptions { max_steps: MAX_STEPS, relative_decrease: DECREASE };
        descend(rest, &mut hessian, &mut uv, self.objective, &options, &watch).ok()?;
        Some(uv)
    }

    /// A map of a coarse surface that is large enough for a still coarser one, in which every corner turns left.
    fn by_way_of_still_coarser(
        &self,
        coarse: &Surface<'_>,
        rest: &Rest,
        watch: &Within<'_>,
    ) -> Option<Vec<Vec2>> {
        if coarse.mesh.vertex_count() <= self.sizes.coarsest {
            return None;
        }
        let mut uv = self.by_way_of_coarser(coarse, watch)?;
        repair(rest, &mut uv, &watch.end());
        (judge(rest, &uv).bad == 0).then_some(uv)
    }
}

/// Tells of all work on coarse meshes as of one stage.
struct Within<'a> {
    observer: &'a dyn Observer,
    from: f64,
    to: f64,
}

impl Within<'_> {
    /// The time before, and the last `part`.
    fn split(&self, part: f64) -> (Self, Self) {
        let middle = self.to - part * (self.to - self.from);
        (Self { to: middle, ..*self }, Self { from: middle, ..*self })
    }

    fn end(&self) -> Self {
        Self { from: self.to, ..*self }
    }
}

impl Observer for Within<'_> {
    fn progress(&self, _: &'static str, fraction: f64) -> ControlFlow<()> {
        self.observer.progress("coarse", self.from + (self.to - self.from) * fraction)
    }
}
