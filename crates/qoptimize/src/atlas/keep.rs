//! UVs that are kept: faces whose corners stay where they are in the plane, while the rest of their island is mapped to meet them.

use qembed::qmesh::{Chart, Observer, PolygonView, Seams, Vec2, VertexId};

use super::AtlasError;
use super::solve::{Solved, alone};
use crate::direct::Continuation;
use crate::distortion::{check_polygons, measure};
use crate::parameterize::{Options, RunRecord};

/// For each corner of the polygons the UV that it keeps; may be empty when none does.
type Kept = [Option<Vec2>];

/// The seams without which some UVs could not be kept: where those of two faces differ, and where the rest would have to meet several
/// at one vertex. None where `kept` has not one entry per corner, or the polygons contradict themselves: [`unwrap`](super::unwrap) says so.
#[must_use]
pub fn kept_seams(polygons: PolygonView<'_>, kept: &Kept) -> Seams {
    if kept.len() != polygons.corner_count() || check_polygons(polygons).is_err() {
        return Seams::default();
    }
    let differ = |a: usize, b: usize| matches!((kept[a], kept[b]), (Some(p), Some(q)) if p != q);
    let mut seams = Seams::between(polygons, |a, b| (0..2).any(|end| differ(a[end], b[end])));
    // Vertices that have several kept UVs part with the rest.
    let mut of_vertex: Vec<Option<Vec2>> = vec![None; polygons.positions.len()];
    let mut has_several = vec![false; polygons.positions.len()];
    for (&vertex, uv) in polygons.corner_vertex.iter().zip(kept).filter_map(|(v, uv)| Some((v, (*uv)?))) {
        let known = *of_vertex[vertex as usize].get_or_insert(uv);
        has_several[vertex as usize] |= known != uv;
    }
    let is_border = |a: usize, b: usize| kept[a].is_some() != kept[b].is_some();
    let torn = Seams::between(polygons, |a, b| {
        (0..2).any(|end| is_border(a[end], b[end]) && has_several[polygons.corner_vertex[a[end]] as usize])
    });
    seams.extend(torn.iter());
    seams
}

/// Whether any corner of the chart keeps its UV.
pub(super) fn is_touched(chart: &Chart, kept: &Kept) -> bool {
    !kept.is_empty() && chart.corners.iter().any(|&corner| kept[corner as usize].is_some())
}

/// A map of a chart some of whose corners keep their UVs.
pub(super) fn solve(
    chart: Chart,
    kept: &Kept,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Solved, AtlasError> {
    let of_corner: Vec<Option<Vec2>> = chart.corners.iter().map(|&corner| kept[corner as usize]).collect();
    if let Some(face) = chart.mesh.faces().find(|&face| {
        let corners: Option<Vec<Vec2>> =
            chart.mesh.face_corners(face).map(|corner| of_corner[corner.index()]).collect();
        corners.is_some_and(|corners| area(&corners) <= 0.0)
    }) {
        return Err(AtlasError::KeptFaceFlipped { face: chart.source_face(face) });
    }
    if let Some(uv) = of_corner.iter().copied().collect::<Option<Vec<Vec2>>>() {
        let uv = chart.mesh.corner_data(|corner| uv[corner.index()]);
        let distortion = measure(chart.mesh.view(), &uv).ok();
        let record = RunRecord::default();
        return Ok(Solved {
            chart,
            uv,
            distortion,
            certificate: None,
            record,
            fallback: None,
            out_of_time: false,
            refinement: None,
        });
    }
    let mut pins: Vec<(VertexId, Vec2)> = chart
        .mesh
        .corners()
        .filter_map(|corner| Some((chart.mesh.vertex(corner), of_corner[corner.index()]?)))
        .collect();
    pins.sort_by_key(|pin| pin.0);
    pins.dedup_by_key(|pin| pin.0);
    let mut solved =
        alone(chart, &mut Continuation::default(), &Options { pins, ..options.clone() }, observer)?;
    // To the bit, whatever was rounded on the way.
    for (uv, kept) in solved.uv.iter_mut().zip(of_corner) {
        if let Some(kept) = kept.filter(|kept| kept != uv) {
            *uv = kept;
            solved.certificate = None;
        }
    }
    Ok(solved)
}

fn area(corners: &[Vec2]) -> f64 {
    let from_first = |p: &Vec2| p - corners[0];
    corners.windows(2).map(|pair| from_first(&pair[0]).perp(&from_first(&pair[1]))).sum()
}
