//! Thresholds, order and the six rules.
#![allow(clippy::unwrap_used)] // in helpers: helpers of tests are tests too

mod common;

use std::ops::ControlFlow;

use common::{bumpy, flat, lifted, torus, tube};
use proptest::prelude::*;
use qcurv::qmesh::nalgebra::{Rotation3, Vector3};
use qcurv::qmesh::{Polygons, QuadMesh, VertexId};
use qsimplify::{
    Connectivity, CurvatureMeasure, RemovalRule, RemovedSide, Simplified, SimplifyError, SimplifyOptions,
    Threshold, VertexArea, removal_order, simplify,
};

const RULES: [RemovalRule; 6] = [
    RemovalRule::Guarded,
    RemovalRule::Ring,
    RemovalRule::Carrier,
    RemovalRule::Naive,
    RemovalRule::All,
    RemovalRule::None,
];

fn options(rule: RemovalRule, fraction: f64) -> SimplifyOptions {
    SimplifyOptions { rule, threshold: Threshold::Fraction(fraction), ..Default::default() }
}

fn run(mesh: &QuadMesh, rule: RemovalRule, fraction: f64) -> Simplified {
    simplify(mesh, &options(rule, fraction), &()).unwrap()
}

fn faces(simplified: &Simplified) -> Vec<Vec<u32>> {
    let polygon = |pair: &[u32]| {
        simplified.face_vertex[pair[0] as usize..pair[1] as usize].iter().map(|v| v.0).collect()
    };
    simplified.face_start.windows(2).map(polygon).collect()
}

fn interior(mesh: &QuadMesh) -> usize {
    mesh.vertices().filter(|&v| !mesh.is_boundary(v)).count()
}

/// Every rule keeps the boundary, lists each removed vertex once, and has springs between kept vertices only (`Carrier`
/// apart, whose springs are those of the full mesh).
#[test]
fn what_holds_for_every_rule() {
    for mesh in [bumpy(9, 7), tube(8, 6), torus(8, 7)] {
        for rule in RULES {
            let simplified = run(&mesh, rule, 0.6);
            assert!(mesh.vertices().filter(|&v| mesh.is_boundary(v)).all(|v| simplified.kept[v]));
            let mut removed = simplified.removed.clone();
            removed.sort_unstable();
            let gone: Vec<VertexId> = mesh.vertices().filter(|&v| !simplified.kept[v]).collect();
            assert_eq!(removed, gone, "{rule:?}");
            assert!(simplified.springs.is_sorted() && simplified.springs.iter().all(|[a, b]| a < b));
            if rule == RemovalRule::Carrier {
                assert_eq!(simplified.springs.len(), mesh.edge_count());
            } else {
                assert!(simplified.springs.iter().flatten().all(|&v| simplified.kept[v]), "{rule:?}");
            }
        }
    }
}

/// The removed vertices are candidates, in the order of ascending measure; with `High` descending.
#[test]
fn order_is_by_curvature() {
    let mesh = bumpy(12, 11);
    for measure in [CurvatureMeasure::Normalized, CurvatureMeasure::Integrated] {
        for side in [RemovedSide::Low, RemovedSide::High] {
            for area in [VertexArea::Voronoi, VertexArea::FaceSum] {
                let options = SimplifyOptions { measure, side, area, ..options(RemovalRule::Guarded, 0.5) };
                let order = removal_order(&mesh, &options).unwrap();
                let value =
                    |v: &VertexId| order.measure[*v] * if side == RemovedSide::Low { 1.0 } else { -1.0 };
                assert!(order.candidates.is_sorted_by_key(value));
                assert_eq!(order.limit, order.candidates.last().map(|&v| order.measure[v]));
                let left = mesh.vertices().filter(|v| !mesh.is_boundary(*v) && !order.candidates.contains(v));
                assert!(left.into_iter().all(|v| value(&v) >= value(order.candidates.last().unwrap())));
                let removed = simplify(&mesh, &options, &()).unwrap().removed;
                let mut rest = order.candidates.iter();
                assert!(removed.iter().all(|v| rest.any(|c| c == v)), "a subsequence of the candidates");
            }
        }
    }
}

/// A fraction counts interior vertices; a value is a strict bound on either side, and free of units.
#[test]
fn thresholds() {
    let mesh = bumpy(10, 9);
    let count = interior(&mesh);
    for (fraction, expected) in [(0.0, 0), (0.25, count / 4), (0.5, count / 2), (1.0, count)] {
        assert_eq!(run(&mesh, RemovalRule::Naive, fraction).removed.len(), expected);
    }
    let order = removal_order(&mesh, &options(RemovalRule::Naive, 1.0)).unwrap();
    let value = order.measure[order.candidates[20]];
    let at = |side| {
        let options = SimplifyOptions { threshold: Threshold::Value(value), side, ..Default::default() };
        removal_order(&mesh, &options).unwrap().candidates
    };
    assert_eq!(at(RemovedSide::Low), order.candidates[..20]);
    let mut high = order.candidates[21..].to_vec();
    high.reverse();
    assert_eq!(at(RemovedSide::High), high);
}

/// On a sphere the normalised measure is 1 whatever the radius: |K| · 4πR² / 4π.
#[test]
fn normalized_measure_has_no_unit() {
    for radius in [0.01, 7.0] {
        // All of the sphere but small caps at the poles.
        let mesh = common::patch(48, 24, [true, false], |s, t| {
            let (longitude, latitude) = (std::f64::consts::TAU * s, 3.0 * (t - 0.5));
            let ring = radius * latitude.cos();
            [ring * longitude.cos(), ring * longitude.sin(), radius * latitude.sin()]
        });
        let order = removal_order(&mesh, &options(RemovalRule::Naive, 1.0)).unwrap();
        assert!(order.candidates.iter().all(|&v| (order.measure[v] - 1.0).abs() < 0.03));
    }
}

/// Meshes without any extent have no curvature; every rule then goes by index and ends as elsewhere.
#[test]
fn meshes_without_extent() {
    let mesh = bumpy(6, 6);
    let point = mesh.clone().with_positions(mesh.vertex_data(|_| Vector3::new(1.0, 2.0, 3.0)));
    for measure in [CurvatureMeasure::Normalized, CurvatureMeasure::Integrated] {
        for rule in RULES {
            let simplified =
                simplify(&point, &SimplifyOptions { measure, ..options(rule, 1.0) }, &()).unwrap();
            assert!(simplified.removed.is_sorted() && simplified.connectivity(&point).interior <= 25);
        }
    }
}

/// Thresholds out of range are refused, for every rule; so are negative and missing numbers.
#[test]
fn bad_thresholds() {
    let mesh = bumpy(3, 3);
    for rule in RULES {
        let bad = [
            Threshold::Value(-1.0),
            Threshold::Value(f64::NAN),
            Threshold::Fraction(1.5),
            Threshold::Fraction(-0.1),
            Threshold::Fraction(f64::NAN),
        ];
        for threshold in bad {
            let refused = simplify(&mesh, &SimplifyOptions { rule, threshold, ..Default::default() }, &());
            assert!(matches!(refused, Err(SimplifyError::BadThreshold(_))), "{rule:?} {threshold:?}");
        }
    }
    let all = SimplifyOptions { threshold: Threshold::Value(f64::INFINITY), ..Default::default() };
    assert_eq!(removal_order(&mesh, &all).unwrap().candidates.len(), interior(&mesh));
}

/// In a row of three interior vertices the first two go; with the third the merged face would be all there is.
#[test]
fn guarded_by_hand() {
    let mesh = flat(4, 2); // interior vertices 6, 7, 8
    let simplified = run(&mesh, RemovalRule::Guarded, 1.0);
    assert_eq!((&simplified.removed[..], simplified.candidates), (&[VertexId(6), VertexId(7)][..], 3));
    let mut faces = faces(&simplified);
    faces.sort();
    let merged = vec![0, 1, 2, 3, 8, 13, 12, 11, 10, 5];
    assert_eq!(faces, [merged, vec![3, 4, 9, 8], vec![8, 9, 14, 13]]);
}

/// Around a vertex of four quads the ring is a quad that stands on its corner, and four triangles are left.
#[test]
fn ring_by_hand() {
    let mesh = flat(4, 4);
    let middle = lifted(&mesh, &[[0.0; 12].as_slice(), &[1.0], &[0.0; 12]].concat());
    let options = SimplifyOptions { side: RemovedSide::High, ..options(RemovalRule::Ring, 1.0 / 9.0) };
    let simplified = simplify(&middle, &options, &()).unwrap();
    assert_eq!(simplified.removed, [VertexId(12)]);
    let faces = faces(&simplified);
    assert_eq!(faces.len(), 17);
    let ring = faces.iter().find(|f| f.len() == 4 && f.contains(&7) && f.contains(&17)).unwrap();
    assert!(ring.contains(&11) && ring.contains(&13));
    assert_eq!(faces.iter().filter(|f| f.len() == 3).count(), 4);
}

/// Deletion as printed: the four neighbours of a vertex go, and it has no edge left; the merged face does not show it.
#[test]
fn naive_by_hand() {
    let mesh = flat(6, 6);
    let around = [17, 23, 25, 31]; // the neighbours of vertex 24 in a grid of 7 by 7 vertices
    // A plateau in the shape of a plus: its middle is flat, its arms turn most.
    let mut heights = [0.0; 49];
    heights[24] = 9.0;
    around.iter().for_each(|&v| heights[v] = 9.0);
    let options = SimplifyOptions {
        side: RemovedSide::High,
        measure: CurvatureMeasure::Integrated,
        ..options(RemovalRule::Naive, 4.0 / 25.0)
    };
    let simplified = simplify(&lifted(&mesh, &heights), &options, &()).unwrap();
    let mut removed = simplified.removed.clone();
    removed.sort_unstable();
    assert_eq!(removed, around.map(|v| VertexId(v as u32)));
    let expected = Connectivity { interior: 21, isolated: 1, degree_1: 0, degree_2: 4, cut_off: 1 };
    assert_eq!(simplified.connectivity(&mesh), expected);
    let faces = faces(&simplified);
    assert_eq!(faces.len(), 36 - 12 + 1);
    assert!(faces.iter().any(|f| f.len() == 16 && !f.contains(&24)));
}

/// Chains of kept vertices into a merged region are not part of its polygon, and every polygon is simple.
#[test]
fn naive_faces_are_simple_polygons() {
    for (seed, mesh) in [bumpy(14, 12), tube(12, 10), torus(12, 12)].iter().enumerate() {
        for fraction in [0.1, 0.3, 0.5, 0.8, 1.0] {
            let simplified = run(mesh, RemovalRule::Naive, fraction);
            for mut face in faces(&simplified) {
                assert!(face.len() >= 3);
                face.sort_unstable();
                face.dedup_by(|a, b| {
                    assert_ne!(a, b, "mesh {seed}, fraction {fraction}");
                    false
                });
            }
        }
    }
}

/// `All` keeps the boundary alone, which is one polygon; `None` keeps everything as it is; `Carrier` changes `kept` only.
#[test]
fn the_simple_rules() {
    let mesh = bumpy(6, 5);
    let all = run(&mesh, RemovalRule::All, 0.2);
    assert_eq!((all.removed.len(), all.candidates), (interior(&mesh), interior(&mesh)));
    assert_eq!(faces(&all).iter().map(Vec::len).collect::<Vec<_>>(), [22]);
    assert_eq!(all.springs.len(), 22);

    let none = run(&mesh, RemovalRule::None, 0.2);
    assert_eq!((none.removed.len(), none.candidates), (0, 0));
    assert_eq!(none.polygons(&mesh).view().corner_vertex, mesh.view().corner_vertex);
    assert_eq!(none.springs.len(), mesh.edge_count());

    let carrier = run(&mesh, RemovalRule::Carrier, 0.2);
    assert_eq!((&carrier.springs, &carrier.face_vertex), (&none.springs, &none.face_vertex));
    assert_eq!(carrier.removed, run(&mesh, RemovalRule::Naive, 0.2).removed);
    assert_eq!(carrier.polygons(&mesh), none.polygons(&mesh));
}

/// `polygons` holds the kept vertices in their order, isolated ones too.
#[test]
fn polygons_are_renumbered() {
    let mesh = bumpy(12, 9);
    for rule in [RemovalRule::Guarded, RemovalRule::Ring, RemovalRule::Naive] {
        let simplified = run(&mesh, rule, 0.7);
        let polygons = simplified.polygons(&mesh);
        let kept: Vec<_> =
            mesh.vertices().filter(|&v| simplified.kept[v]).map(|v| mesh.position(v)).collect();
        assert_eq!(polygons.positions, kept);
        let corners = simplified.face_vertex.iter().zip(&polygons.corner_vertex);
        assert!(corners.into_iter().all(|(&v, &n)| mesh.position(v) == polygons.positions[n as usize]));
    }
}

/// The observer hears fractions that rise to 1, and is obeyed at once.
#[test]
fn observer() {
    let mesh = bumpy(10, 10);
    let heard = std::sync::Mutex::new(Vec::new());
    let listen = |_: &'static str, fraction: f64| {
        heard.lock().unwrap().push(fraction);
        ControlFlow::Continue(())
    };
    simplify(&mesh, &SimplifyOptions::default(), &listen).unwrap();
    let heard = heard.into_inner().unwrap();
    assert!(heard.is_sorted() && heard.last() == Some(&1.0));
    for rule in RULES {
        let stop = |_: &'static str, _: f64| ControlFlow::Break(());
        assert_eq!(simplify(&mesh, &options(rule, 0.5), &stop), Err(SimplifyError::Cancelled));
    }
}

/// Bits do not depend on the number of threads.
#[test]
fn threads_change_nothing() {
    let mesh = bumpy(70, 60);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&mesh, RemovalRule::Guarded, 1.0))
    };
    assert_eq!(with(1), with(6));
}

#[cfg(feature = "serde")]
#[test]
fn serde_round_trip() {
    let mesh = bumpy(5, 5);
    let chosen =
        SimplifyOptions { rule: RemovalRule::Ring, threshold: Threshold::Value(0.25), ..Default::default() };
    let text = serde_json::to_string(&chosen).unwrap();
    assert_eq!(
        text,
        r#"{"rule":"ring","measure":"normalized","area":"voronoi","threshold":{"value":0.25},"side":"low"}"#
    );
    assert_eq!(serde_json::from_str::<SimplifyOptions>(&text).unwrap(), chosen);
    assert_eq!(serde_json::from_str::<SimplifyOptions>("{}").unwrap(), SimplifyOptions::default());
    let simplified = simplify(&mesh, &chosen, &()).unwrap();
    let text = serde_json::to_string(&simplified).unwrap();
    assert_eq!(serde_json::from_str::<Simplified>(&text).unwrap(), simplified);
}

fn moved(mesh: &QuadMesh, scale: f64, turn: [f64; 3]) -> QuadMesh {
    let rotation = Rotation3::new(Vector3::from(turn));
    mesh.clone().with_positions(mesh.vertex_data(|v| rotation * mesh.position(v) * scale))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Scaling and turning change nothing at all, also where every curvature is tied: on a plane, and on a tube
    /// with many equal vertices.
    #[test]
    fn scale_and_turn(exponent in -9..9i32, turn in [-3.0..3.0, -3.0..3.0, -3.0..3.0]) {
        let ring = common::patch(12, 6, [true, false], |s, t| {
            let (angle, radius) = (std::f64::consts::TAU * s, 1.0 + t * t);
            [radius * angle.cos(), radius * angle.sin(), 2.0 * t]
        });
        for mesh in [flat(8, 7), bumpy(8, 7), ring] {
            let other = moved(&mesh, 1.37 * 10f64.powi(exponent), turn);
            for rule in RULES {
                prop_assert_eq!(run(&mesh, rule, 0.5), run(&other, rule, 0.5));
            }
        }
    }

    /// Renumbering vertices and faces permutes the result, where no two curvatures are tied.
    #[test]
    fn renumbering(order in Just((0..72u32).collect::<Vec<_>>()).prop_shuffle(), first in 0..4usize) {
        let mesh = bumpy(8, 7);
        let mut positions = vec![[0.0; 3]; 72];
        for v in mesh.vertices() {
            positions[order[v.index()] as usize] = mesh.position(v).into();
        }
        let quads = mesh.faces().rev().map(|face| {
            let mut corners: Vec<u32> = mesh.face_vertices(face).map(|v| order[v.index()]).collect();
            corners.rotate_left(first);
            corners
        });
        let other = QuadMesh::build(Polygons::new(&positions, quads)).unwrap();
        for rule in RULES {
            let renumbered: Vec<VertexId> =
                run(&mesh, rule, 0.6).removed.iter().map(|v| VertexId(order[v.index()])).collect();
            prop_assert_eq!(renumbered, run(&other, rule, 0.6).removed);
        }
    }
}
