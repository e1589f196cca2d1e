//! More cuts where islands are stretched too far.

use qembed::qcurv::seams::{SeamCost, SeamPaths};
use qembed::qmesh::{EdgeId, Observer};
use rayon::prelude::*;

use super::solve::{Solved, among_others, of_many};
use super::stretch::stretch;
use super::{AtlasError, AtlasOptions, tell};
use crate::parameterize::Options;

/// Cuts per island at most.
const MOST_CUTS: usize = 24;

/// Cuts each island from its most stretched place to its boundary and maps it again, until no island is stretched beyond
/// `bound` or another cut brings nothing.
pub(super) fn refine(
    solved: Vec<Solved>,
    bound: f64,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Vec<Solved>, AtlasError> {
    tell(observer, "cuts", 0.0)?;
    let map = of_many(options);
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
    for _ in 0..MOST_CUTS {
        if stretch(&island.chart.mesh, &island.uv).quantile <= bound {
            break;
        }
        let mut best: Option<(f64, Solved)> = None;
        for cut in cuts(&island) {
            tell(observer, "cuts", 0.5)?;
            let mut pieces = island.chart.cut(&cut);
            // A path from the boundary to the inside never separates anything; one from loop to loop neither.
            if pieces.len() != 1 || pieces[0].mesh.vertex_count() == island.chart.mesh.vertex_count() {
                continue;
            }
            let next = among_others(pieces.remove(0), map, &())?;
            let value = stretch(&next.chart.mesh, &next.uv).quantile;
            if best.as_ref().is_none_or(|best| value < best.0) {
                best = Some((value, next));
            }
        }
        match best {
            Some((_, next)) => island = next,
            None => break,
        }
    }
    Ok(island)
}

/// From the most stretched vertex to the nearest boundary; and, where there are several loops, on to the nearest other
/// one.
fn cuts(island: &Solved) -> Vec<Vec<EdgeId>> {
    let mesh = &island.chart.mesh;
    let worst = stretch(mesh, &island.uv).worst;
    let mut loop_of = mesh.vertex_data(|_| u32::MAX);
    for (number, walk) in mesh.boundary_loops().iter().enumerate() {
        walk.iter().for_each(|&halfedge| loop_of[mesh.origin(halfedge)] = number as u32);
    }
    let home = loop_of[worst];
    let paths = SeamPaths::search(mesh, &SeamCost::new(mesh), &[worst], |_| false);
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
