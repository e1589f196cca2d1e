//! Islands upright, at their density, and packed.

use qembed::qmesh::Vec2;
use qembed::qmesh::obj::UvPrecision;
use rayon::prelude::*;

use super::keep::is_touched;
use super::solve::Solved;
use super::upright::{rotation, turned};
use super::{AtlasOptions, Density, Layout, measures};
use crate::pack::{Packed, Shape, lay_out, pack};
use crate::rounding::mend;

/// Turns, scales and places all islands.
pub(super) fn arrange(solved: &mut [Solved], options: &AtlasOptions) -> Layout {
    let up = options.up.unwrap_or_default();
    let areas: Vec<[f64; 2]> =
        solved.par_iter().map(|island| measures::areas(&island.chart.mesh, &island.uv)).collect();
    let total: f64 = areas.iter().map(|area| area[0]).sum();
    solved.par_iter_mut().zip(&areas).for_each(|(island, &areas)| {
        let rotation = rotation(&island.chart.mesh, &island.uv, up);
        let factor = factor(areas, total, options);
        place(island, |p| factor * turned(p, rotation));
    });
    let shapes: Vec<Shape<'_>> = solved
        .iter()
        .map(|island| Shape { face_start: island.chart.mesh.view().face_start, uv: &island.uv })
        .collect();
    let packed = match (options.true_scale, options.density) {
        (true, _) => lay_out(&shapes, 1.0, (1.2 * total).sqrt(), &options.pack),
        (false, Density::Texels(texels)) => {
            lay_out(&shapes, texels / f64::from(options.pack.resolution), 1.0, &options.pack)
        }
        _ => pack(&shapes, &options.pack),
    };
    let Packed { scale, offsets, .. } = &packed;
    solved.par_iter_mut().zip(offsets).for_each(|(island, offset)| {
        place(island, |p| *scale * p + offset);
    });
    layout(solved, &packed, options)
}

/// Leaves islands with kept UVs where they are, and lays the others out above them at their mean density.
pub(super) fn beside(solved: &mut [Solved], options: &AtlasOptions) {
    let mut kept = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY), [0.0; 2]);
    let mut others: Vec<&mut Solved> = Vec::new();
    for island in solved {
        let areas = measures::areas(&island.chart.mesh, &island.uv);
        if is_touched(&island.chart, &options.keep) {
            kept.0 = island.uv.iter().fold(kept.0, |low, p| low.inf(p));
            kept.1 = island.uv.iter().fold(kept.1, |high, p| high.sup(p));
            kept.2 = [kept.2[0] + areas[0], kept.2[1] + areas[1]];
            continue;
        }
        let rotation = rotation(&island.chart.mesh, &island.uv, options.up.unwrap_or_default());
        let factor = factor(areas, areas[0], options);
        place(island, |p| factor * turned(p, rotation));
        others.push(island);
    }
    let (low, high, [space, plane]) = kept;
    let density = (plane / space).sqrt();
    let scale = if density.is_finite() && density > 0.0 { density } else { 1.0 };
    let width = (high - low).x;
    let shapes: Vec<Shape<'_>> = others
        .iter()
        .map(|island| Shape { face_start: island.chart.mesh.view().face_start, uv: &island.uv })
        .collect();
    if shapes.is_empty() {
        return;
    }
    let packed = lay_out(&shapes, scale, if width > 0.0 { width } else { 1.0 }, &options.pack);
    let above = Vec2::new(low.x, high.y + width * options.pack.margin / f64::from(options.pack.resolution));
    for (island, offset) in others.into_iter().zip(&packed.offsets) {
        place(island, |p| packed.scale * p + offset + above);
    }
}

/// Moves an island; faces that the rounding of its new coordinates turned over are mended.
fn place(island: &mut Solved, to: impl Fn(Vec2) -> Vec2) {
    let before = island.uv.to_vec();
    island.uv.iter_mut().for_each(|p| *p = to(*p));
    mend(island.chart.mesh.view(), &before, &mut island.uv, UvPrecision::Double);
}

/// What an island is scaled by before it is packed: to its area in space, or to equal areas.
fn factor([space, plane]: [f64; 2], total: f64, options: &AtlasOptions) -> f64 {
    let factor = match options.density {
        Density::PerIsland if !options.true_scale => (total / plane).sqrt(),
        _ => (space / plane).sqrt(),
    };
    // A surface of no area is kept visible, but small.
    let least = 1e-3 * (total / plane).sqrt();
    if factor.is_finite() && factor > least {
        factor
    } else if least.is_finite() && least > 0.0 {
        least
    } else {
        1.0
    }
}

fn layout(solved: &[Solved], packed: &Packed, options: &AtlasOptions) -> Layout {
    let fitted = !options.true_scale && !matches!(options.density, Density::Texels(_));
    let extent = if fitted { Vec2::repeat(1.0) } else { packed.extent };
    let covered: f64 = solved.iter().map(|island| measures::areas(&island.chart.mesh, &island.uv)[1]).sum();
    let equal = options.density != Density::PerIsland && !options.true_scale;
    Layout {
        fitted,
        width: packed.extent.x,
        height: packed.extent.y,
        filled: covered / (extent.x * extent.y),
        margin: packed.margin,
        texels_per_unit: equal.then_some(packed.scale * f64::from(options.pack.resolution)),
    }
}
