//! What must hold of curvature on any mesh: Gauss-Bonnet, convergence on the sphere, invariance.

mod common;

use std::f64::consts::TAU;

use common::{ball, bumpy, patch, tube, wavy_torus};
use proptest::prelude::*;
use qcurv::{
    VertexArea, corner_angles, face_defects, gaussian_curvature, integrated_curvature, vertex_areas,
};
use qmesh::nalgebra::{Rotation3, Vector3};
use qmesh::{Polygons, QuadMesh};

fn sum(values: &[f64]) -> f64 {
    values.iter().sum()
}

/// `Σ_v K̄_v − Σ_f δ_f = 2πχ`, closed or open. Without the faces' share the sum is wrong as soon as quads are skew.
#[test]
fn gauss_bonnet() {
    let mixed = QuadMesh::from_slices(
        &[
            [0., 0., 0.],
            [1., 0., 0.2],
            [2., 0., 0.],
            [0., 1., 0.],
            [1., 1., 0.7],
            [2., 1., 0.1],
            [1., 2., 0.],
        ],
        [vec![0, 1, 4], vec![0, 4, 3], vec![1, 2, 5, 6, 4], vec![3, 4, 6]],
    )
    .unwrap();
    let meshes = [
        ("bumpy", bumpy(7, 5), 1),
        ("torus", wavy_torus(12, 8), 0),
        ("tube", tube(9, 4), 0),
        ("ball", ball(4, 2.0), 2),
        ("mixed faces", mixed, 1),
    ];
    for (name, mesh, euler) in meshes {
        assert_eq!(mesh.euler_characteristic(), euler, "{name}");
        let total = sum(&integrated_curvature(&mesh)) - sum(&face_defects(&mesh));
        assert!((total - TAU * euler as f64).abs() < 1e-9, "{name}: {total}");
        assert!(sum(&face_defects(&mesh)).abs() > 1e-3, "{name}: the faces' share is put to the test");
    }
}

/// A flat mesh has no curvature inside, whatever the shape of its quads.
#[test]
fn flat_is_flat() {
    let mesh =
        patch(8, 6, [false, false], |s, t| [s + 0.1 * (7.0 * t).sin(), t + 0.05 * (5.0 * s).cos(), 0.0]);
    let integrated = integrated_curvature(&mesh);
    for vertex in mesh.vertices().filter(|&v| !mesh.is_boundary(v)) {
        assert!(integrated[vertex].abs() < 1e-13);
    }
    assert!(face_defects(&mesh).iter().all(|d| d.abs() < 1e-13));
}

/// On a sphere of radius R, `K → 1/R²` with the square of the mesh size where the quads tend to rectangles.
#[test]
fn sphere_has_curvature_one_over_radius_squared() {
    let radius = 3.0;
    let error = |n| {
        let mesh = patch(n, n, [false, false], |s, t| {
            let (longitude, latitude) = (2.0 * s, 2.0 * t - 1.0);
            let ring = radius * latitude.cos();
            [ring * longitude.cos(), ring * longitude.sin(), radius * latitude.sin()]
        });
        let k = gaussian_curvature(&mesh, VertexArea::Voronoi);
        let inner = mesh.vertices().filter(|&v| !mesh.is_boundary(v));
        inner.map(|v| (k[v] * radius * radius - 1.0).abs()).fold(0.0, f64::max)
    };
    let errors = [8, 16, 32, 64].map(error);
    assert!(errors.windows(2).all(|pair| pair[1] < 0.3 * pair[0]), "{errors:?}");
    assert!(errors[3] < 1e-3, "{errors:?}");
}

/// Where quads stay rhombic they stay skew as well, at any fineness, and K is too large by the faces' share.
#[test]
fn sphere_of_skew_quads_is_off_by_the_faces_share() {
    let mesh = ball(32, 3.0);
    let (k, s) = (gaussian_curvature(&mesh, VertexArea::Voronoi), vertex_areas(&mesh, VertexArea::Voronoi));
    let mean = k.iter().zip(s.iter()).map(|(k, s)| k * 9.0 * s).sum::<f64>() / sum(&s);
    let share = sum(&face_defects(&mesh)) / (2.0 * TAU);
    assert!((0.02..0.05).contains(&share), "{share}");
    assert!((mean - share - 1.0).abs() < 0.002, "{mean} {share}");
}

/// Right-angled quads share their area equally among their corners; so the cells of a box-like mesh cover it once.
#[test]
fn cells_of_rectangles_cover_the_surface() {
    let mesh = patch(5, 4, [false, false], |s, t| [s * s + s, 2.0 * t, 0.0]);
    let cells = sum(&vertex_areas(&mesh, VertexArea::Voronoi));
    assert!((cells - qcurv::surface_area(&mesh)).abs() < 1e-12);
    assert!((sum(&vertex_areas(&mesh, VertexArea::FaceSum)) - 4.0 * cells).abs() < 1e-11);
}

/// Bits do not depend on the number of threads.
#[test]
fn threads_change_nothing() {
    let mesh = bumpy(80, 70);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            gaussian_curvature(&mesh, VertexArea::Voronoi).iter().map(|k| k.to_bits()).collect::<Vec<_>>()
        })
    };
    assert_eq!(run(1), run(7));
}

fn moved(mesh: &QuadMesh, scale: f64, turn: [f64; 3], shift: [f64; 3]) -> QuadMesh {
    let rotation = Rotation3::new(Vector3::from(turn));
    mesh.clone().with_positions(
        mesh.vertex_data(|v| rotation * mesh.position(v) * scale + Vector3::from(shift) * scale),
    )
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9 * (1.0 + a.abs().max(b.abs()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Turning and moving change no curvature; scaling by s divides K by s² and leaves K̄.
    #[test]
    fn moving_and_scaling(exponent in -20..20i32, turn in [-3.0..3.0, -3.0..3.0, -3.0..3.0], shift in [-9.0..9.0, -9.0..9.0, -9.0..9.0]) {
        let (mesh, scale) = (bumpy(6, 5), 10f64.powi(exponent));
        let other = moved(&mesh, scale, turn, shift);
        for area in [VertexArea::Voronoi, VertexArea::FaceSum] {
            let (a, b) = (gaussian_curvature(&mesh, area), gaussian_curvature(&other, area));
            prop_assert!(a.iter().zip(b.iter()).all(|(a, b)| close(*a, b * scale * scale)));
        }
        let (a, b) = (integrated_curvature(&mesh), integrated_curvature(&other));
        prop_assert!(a.iter().zip(b.iter()).all(|(a, b)| close(*a, *b)));
    }

    /// Renumbering vertices and faces and turning the faces' first corner permutes the values, nothing else.
    #[test]
    fn renumbering(order in Just((0..42u32).collect::<Vec<_>>()).prop_shuffle(), first in 0..4usize) {
        let mesh = bumpy(6, 5);
        let mut positions = vec![[0.0; 3]; 42];
        for v in mesh.vertices() {
            positions[order[v.index()] as usize] = mesh.position(v).into();
        }
        let faces = mesh.faces().rev().map(|face| {
            let mut corners: Vec<u32> = mesh.face_vertices(face).map(|v| order[v.index()]).collect();
            corners.rotate_left(first);
            corners
        });
        let other = QuadMesh::build(Polygons::new(&positions, faces)).unwrap();
        let area = VertexArea::Voronoi;
        let (a, b) = (gaussian_curvature(&mesh, area), gaussian_curvature(&other, area));
        for (v, &k) in a.entries() {
            prop_assert!(close(k, b[qmesh::VertexId(order[v.index()])]));
        }
    }

    /// Vertices anywhere, coincident ones included: every value stays finite, areas are not negative, angles in [0, π].
    #[test]
    fn degenerate_meshes_have_finite_values(
        choice in prop::collection::vec(0..6usize, 20),
        exponent in -200..60i32,
    ) {
        let scale = 10f64.powi(exponent);
        let places = [[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [1.0, 1e-17, 0.0], [-1.0, 0.0, 0.0], [0.3, 0.7, -0.2]];
        let mesh = bumpy(4, 3);
        let mesh = mesh.clone().with_positions(mesh.vertex_data(|v| Vector3::from(places[choice[v.index()]]) * scale));
        prop_assert!(corner_angles(&mesh).iter().all(|a| (0.0..=std::f64::consts::PI).contains(a)));
        for area in [VertexArea::Voronoi, VertexArea::FaceSum] {
            prop_assert!(vertex_areas(&mesh, area).iter().all(|s| *s >= 0.0 && s.is_finite()));
            prop_assert!(gaussian_curvature(&mesh, area).iter().all(|k| k.is_finite()));
        }
        prop_assert!(face_defects(&mesh).iter().all(|d| d.is_finite()));
    }
}
