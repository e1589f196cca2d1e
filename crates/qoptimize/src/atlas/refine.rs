//! More cuts where islands are stretched too far.

use std::ops::ControlFlow;

use qembed::qcurv::seams::{SeamCost, SeamPaths};
use qembed::qmesh::{EdgeId, Observer, QuadMesh, VertexData, VertexId};
use rayon::prelude::*;

use super::solve::{Solved, among_others, of_many};
use super::stretch::stretch;
use super::{AtlasError, AtlasOptions, tell};
use crate::direct::Continuation;
use crate::parameterize::Options;

/// Cuts per island at most.
const MOST_CUTS: usize = 24;
/// Cuts in a row that leave no island less stretched than it was.
const PATIENCE: usize = 4;

/// How an island was cut until it was stretched less.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Refinement {
    /// Its stretch before: see [`stretch()`].
    pub stretch: f64,
    /// The cuts, one after the other.
    pub cuts: Vec<Cut>,
    /// Why there are no more.
    pub end: RefinementEnd,
}

/// One more cut.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Cut {
    /// How many edges.
    pub edges: usize,
    /// Their length in space.
    pub length: f64,
    /// The stretch that was left.
    pub stretch: f64,
}

/// Why an island is cut no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum RefinementEnd {
    /// It is stretched no more than was asked for.
    Reached,
    /// Several more cuts left it as stretched as it was, and were not made.
    NothingGained,
    /// No path leads from its most stretched place to its boundary.
    NothingToCut,
    /// It has been cut as often as islands are.
    TooManyCuts,
    /// Time was up.
    OutOfTime,
}

/// Cuts each island from the inside to its boundary and maps it again, until no island is stretched beyond
/// `bound` or another cut brings nothing.
pub(super) fn refine(
    solved: Vec<Solved>,
    bound: f64,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Vec<Solved>, AtlasError> {
    tell(observer, "cuts", 0.0)?;
    let map = if solved.len() == 1 { options.map.clone() } else { of_many(options) };
    let refined: Vec<Result<Solved, AtlasError>> =
        solved.into_par_iter().map(|island| refine_one(island, bound, &map, observer)).collect();
    let refined = refined.into_iter().collect();
    tell(observer, "cuts", 1.0)?;
    refined
}

fn refine_one(
    mut island: Solved,
    bound: f64,
    map: &Options,
    observer: &dyn Observer,
) -> Result<Solved, AtlasError> {
    let mut value = island.stretch();
    if value <= bound {
        return Ok(island);
    }
    let mut refinement = Refinement { stretch: value, cuts: Vec::new(), end: RefinementEnd::TooManyCuts };
    // The least stretched of all, for when the bound is out of reach.
    let mut least = (value, island.clone(), 0);
    while refinement.cuts.len() < MOST_CUTS {
        if observer.is_late() {
            refinement.end = RefinementEnd::OutOfTime;
            break;
        }
        if refinement.cuts.len() >= least.2 + PATIENCE {
            refinement.end = RefinementEnd::NothingGained;
            break;
        }
        let Some((cut, next)) = best_cut(&island, map, observer)? else {
            refinement.end = RefinementEnd::NothingToCut;
            break;
        };
        refinement.cuts.push(cut);
        (value, island) = (cut.stretch, next);
        if value < least.0 {
            least = (value, island.clone(), refinement.cuts.len());
        }
        if value <= bound {
            refinement.end = RefinementEnd::Reached;
            island.refinement = Some(refinement);
            return Ok(island);
        }
    }
    refinement.cuts.truncate(least.2);
    Ok(Solved { refinement: Some(refinement), ..least.1 })
}

/// Of the ways to go on cutting the one that leaves least stretch.
fn best_cut(
    island: &Solved,
    map: &Options,
    observer: &dyn Observer,
) -> Result<Option<(Cut, Solved)>, AtlasError> {
    let mesh = &island.chart.mesh;
    let tries: Vec<Result<Option<(Cut, Solved)>, AtlasError>> = cuts(island)
        .into_par_iter()
        .map(|edges| {
            tell(observer, "cuts", 0.5)?;
            let mut pieces = island.chart.cut(&edges);
            // A path from the boundary to the inside never separates anything; one from loop to loop neither.
            if pieces.len() != 1 || pieces[0].mesh.vertex_count() == mesh.vertex_count() {
                return Ok(None);
            }
            let next = among_others(pieces.remove(0), &mut Continuation::default(), map, &Within(observer))?;
            let stretch = next.stretch();
            let length = edges.iter().map(|&edge| mesh.edge_length(edge)).sum();
            Ok(Some((Cut { edges: edges.len(), length, stretch }, next)))
        })
        .collect();
    let mut best: Option<(Cut, Solved)> = None;
    for next in tries {
        let Some(next) = next? else { continue };
        if best.as_ref().is_none_or(|best| next.0.stretch < best.0.stretch) {
            best = Some(next);
        }
    }
    Ok(best)
}

/// Hands on the request to stop, whatever the stage of the one map that is made.
struct Within<'a>(&'a dyn Observer);

impl Observer for Within<'_> {
    fn progress(&self, _: &'static str, _: f64) -> ControlFlow<()> {
        self.0.progress("cuts", 0.5)
    }

    fn is_late(&self) -> bool {
        self.0.is_late()
    }
}

/// Paths to the nearest boundary, and where there are several loops also on to the nearest other one: from the most stretched vertex, from the
/// one with least room, and from the one that is farthest inside. What is stretched at the boundary comes from what is inside.
fn cuts(island: &Solved) -> Vec<Vec<EdgeId>> {
    let mesh = &island.chart.mesh;
    let mut loop_of = mesh.vertex_data(|_| u32::MAX);
    for (number, walk) in mesh.boundary_loops().iter().enumerate() {
        walk.iter().for_each(|&halfedge| loop_of[mesh.origin(halfedge)] = number as u32);
    }
    let cost = SeamCost::new(mesh);
    let rim: Vec<VertexId> = mesh.vertices().filter(|&vertex| mesh.is_boundary(vertex)).collect();
    let inwards = SeamPaths::search(mesh, &cost, &rim, |_| false);
    let farthest = inwards.reached().map(|(last, _)| mesh.target(last)).rfind(|&v| !mesh.is_boundary(v));
    let found = stretch(mesh, &island.uv);
    let mut starts: Vec<VertexId> = Vec::new();
    for vertex in
        [Some(found.worst), found.worst_inside, found.smallest_inside, farthest].into_iter().flatten()
    {
        if !starts.contains(&vertex) {
            starts.push(vertex);
        }
    }
    let mut cuts: Vec<Vec<EdgeId>> = Vec::new();
    for cut in starts.into_iter().flat_map(|start| from(mesh, &cost, &loop_of, start)) {
        if !cuts.contains(&cut) {
            cuts.push(cut);
        }
    }
    cuts
}

/// From `start` to the nearest boundary, its own aside; and from a start inside on to the nearest other one, if there is one.
fn from(mesh: &QuadMesh, cost: &SeamCost, loop_of: &VertexData<u32>, start: VertexId) -> Vec<Vec<EdgeId>> {
    let home = loop_of[start];
    let paths = SeamPaths::search(mesh, cost, &[start], |_| false);
    let at = |last| loop_of[mesh.target(last)];
    let ends: Vec<_> =
        paths.reached().map(|(last, _)| last).filter(|&last| ![u32::MAX, home].contains(&at(last))).collect();
    let Some(&nearest) = ends.first() else { return Vec::new() };
    let mut cuts = vec![paths.path(mesh, nearest)];
    if home == u32::MAX
        && let Some(&other) = ends.iter().find(|&&last| at(last) != at(nearest))
    {
        let mut both = [paths.path(mesh, nearest), paths.path(mesh, other)].concat();
        both.sort_unstable();
        both.dedup();
        cuts.push(both);
    }
    cuts
}
