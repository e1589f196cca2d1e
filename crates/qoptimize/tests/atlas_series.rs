//! Maps of several charts for one q after the other.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use qoptimize::atlas::{open, unwrap_charts, unwrap_charts_from};
use qoptimize::qmesh::charts::cut;
use qoptimize::qmesh::{PolygonView, Polygons, Seams, shapes};
use qoptimize::{AtlasOptions, Continuation, Options};

/// A bump, and a sphere beside it.
fn two() -> Polygons {
    let (bump, sphere) = (shapes::bump(8, 1.0), shapes::sphere(4));
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for (mesh, x) in [(&bump, 0.0), (&sphere, 9.0)] {
        let first = positions.len() as u32;
        positions.extend(mesh.positions().iter().map(|p| [p.x + x, p.y, p.z]));
        let view: PolygonView<'_> = mesh.view();
        faces.extend((0..view.face_count()).map(|face| view.face(face).iter().map(|v| v + first).collect()));
    }
    Polygons::new(&positions, faces)
}

/// Each map of a series is certified, on the same islands and as good as the one that is computed alone.
#[test]
fn a_series_is_as_good_as_single_maps() {
    let polygons = two();
    let found = cut(polygons.view(), &Seams::default()).unwrap();
    let charts = open(found.charts, &()).expect("nobody interrupts");
    let mut before = Vec::new();
    for q in [1.0, 0.7, 0.4, 0.1] {
        let map = Options { q, ..Options::default() };
        let options = AtlasOptions { map, ..AtlasOptions::default() };
        let (view, repairs) = (polygons.view(), found.repairs.clone());
        let one = unwrap_charts(view, charts.clone(), repairs.clone(), &options, &()).unwrap();
        let next = unwrap_charts_from(&mut before, view, charts.clone(), repairs, &options, &()).unwrap();
        assert!(next.certificate.holds && before.iter().all(Continuation::is_warm));
        assert_eq!((next.islands.len(), next.seams), (one.islands.len(), one.seams));
        for (a, b) in [
            (one.distortion.angle_error, next.distortion.angle_error),
            (one.distortion.area_error, next.distortion.area_error),
        ] {
            assert!((a - b).abs() < 0.02 * a.max(1e-3), "q {q}: {a} alone, {b} in the series");
        }
    }
}
