//! Figures of charts and of the whole.

use qembed::qcurv::surface_area;
use qembed::qmesh::{
    BuildError, Chart, FaceId, Id, PolygonView, Polygons, QuadMesh, Seams, Vec2, VertexId, charts,
};
use rayon::prelude::*;

use super::SeamLength;
use super::solve::Solved;
use crate::certificate::Certificate;

/// The area in space and in the plane.
pub(super) fn areas(mesh: &QuadMesh, uv: &[Vec2]) -> [f64; 2] {
    let face = |face| {
        let mut corners = mesh.face_corners(face);
        let Some(first) = corners.next().map(|corner| uv[corner.index()]) else { return 0.0 };
        let rest = corners.map(|corner| uv[corner.index()] - first);
        0.5 * rest.clone().zip(rest.skip(1)).map(|(a, b)| a.perp(&b)).sum::<f64>()
    };
    // By runs, so that the sum is the same for any number of threads.
    const RUN: usize = 4096;
    let run = |run: usize| {
        let faces = run * RUN..((run + 1) * RUN).min(mesh.face_count());
        faces.map(|index| face(FaceId::from_index(index))).sum::<f64>()
    };
    let runs: Vec<f64> = (0..mesh.face_count().div_ceil(RUN)).into_par_iter().map(run).collect();
    [surface_area(mesh), runs.into_iter().sum::<f64>().abs()]
}

/// The polygons' faces that run backwards in their chart, ascending.
pub(super) fn turned_faces(solved: &[Solved]) -> Vec<u32> {
    let mut turned: Vec<u32> = solved.iter().flat_map(|island| island.chart.turned_faces()).collect();
    turned.sort_unstable();
    turned
}

/// Polygons and UVs with some faces turned over, each about its first corner.
pub(super) fn oriented(polygons: PolygonView<'_>, turned: &[u32], uv: &[Vec2]) -> (Polygons, Vec<Vec2>) {
    let mut oriented = Polygons {
        positions: polygons.positions.to_vec(),
        face_start: polygons.face_start.to_vec(),
        corner_vertex: polygons.corner_vertex.to_vec(),
    };
    let mut uv = uv.to_vec();
    for &face in turned {
        let rest = polygons.corners(face as usize).start + 1..polygons.corners(face as usize).end;
        oriented.corner_vertex[rest.clone()].reverse();
        uv[rest].reverse();
    }
    (oriented, uv)
}

/// The polygons and their UVs with the faces turned over that run against their neighbours, as [`unwrap`](super::unwrap) turns them, and
/// which these are: what measures and certificates of UVs from elsewhere are about. Seams are where UVs differ.
///
/// # Errors
/// Polygons of which no charts can be made: see [`BuildError`].
///
/// # Panics
/// When there is not one UV per corner.
pub fn consistent(
    polygons: PolygonView<'_>,
    uv: &[Vec2],
) -> Result<(Polygons, Vec<Vec2>, Vec<u32>), BuildError> {
    let seams = Seams::among_all(polygons, |a, b| (0..2).any(|end| uv[a[end]] != uv[b[end]]));
    let charts = charts::cut(polygons, &seams)?.charts;
    let mut turned: Vec<u32> = charts.iter().flat_map(Chart::turned_faces).collect();
    turned.sort_unstable();
    let (polygons, uv) = oriented(polygons, &turned, uv);
    Ok((polygons, uv, turned))
}

/// A certificate of a chart with the caller's vertices.
pub(super) fn in_source_numbers(certificate: &Certificate, mesh: &QuadMesh) -> Certificate {
    let mut certificate = certificate.clone();
    for place in certificate.violations.iter_mut().flat_map(|violation| &mut violation.places) {
        place.vertex = mesh.source_vertex(VertexId(place.vertex));
        place.to_vertex = place.to_vertex.map(|vertex| mesh.source_vertex(VertexId(vertex)));
    }
    certificate
}

/// The edges that several faces share and that lie on the boundaries of islands.
pub(super) fn seam_length(polygons: PolygonView<'_>, solved: &[Solved]) -> SeamLength {
    let mut sides: Vec<[u32; 2]> = solved
        .par_iter()
        .flat_map_iter(|island| {
            let mesh = &island.chart.mesh;
            mesh.boundary_halfedges().map(move |halfedge| {
                let [a, b] = [mesh.origin(halfedge), mesh.target(halfedge)].map(|v| mesh.source_vertex(v));
                [a.min(b), a.max(b)]
            })
        })
        .collect();
    sides.par_sort_unstable();
    let mut seams = SeamLength::default();
    for group in sides.chunk_by(|a, b| a == b).filter(|group| group.len() > 1) {
        let [a, b] = group[0].map(|vertex| polygons.positions[vertex as usize]);
        seams.edges += 1;
        seams.length += (b - a).norm();
    }
    seams
}
