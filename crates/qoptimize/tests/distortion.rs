//! Measures: agreement with an independent slow implementation, and what theorems say about them.

mod common;

use common::{Measures, Random, random_map, slow_measures};
use proptest::prelude::*;
use qoptimize::distortion::{Distortion, MeasureError, measure, measure_faces, measure_worst_faces};
use qoptimize::qmesh::nalgebra::Rotation2;
use qoptimize::qmesh::{PolygonView, Polygons, QuadMesh, Vec2, Vec3, shapes};
use qoptimize::{certify, judge};

fn is_certified(polygons: PolygonView<'_>, uv: &[Vec2]) -> bool {
    certify(polygons, uv, 1).is_ok_and(|certificate| certificate.holds)
}

fn by_name(d: &Distortion) -> Measures {
    let counts = [
        ("angle_clamped", d.angle_clamped),
        ("area_clamped", d.area_clamped),
        ("flipped_corners", d.flipped_corners),
        ("flipped_faces", d.flipped_faces),
        ("folded_faces", d.folded_faces),
        ("negative_faces", d.negative_faces),
        ("islands", d.islands),
        ("mirrored_islands", d.mirrored_islands),
        ("boundary_crossings", d.boundary_crossings),
    ];
    let values = [
        ("angle_error", Some(d.angle_error)),
        ("angle_error_mean", Some(d.angle_error_mean)),
        ("angle_error_median", Some(d.angle_error_median)),
        ("angle_error_p99", Some(d.angle_error_p99)),
        ("angle_error_symmetric", Some(d.angle_error_symmetric)),
        ("angle_rms_degrees", Some(d.angle_rms_degrees)),
        ("area_error", Some(d.area_error)),
        ("area_error_mean", Some(d.area_error_mean)),
        ("area_error_median", Some(d.area_error_median)),
        ("area_error_p99", Some(d.area_error_p99)),
        ("area_error_symmetric", d.area_error_symmetric),
        ("area_error_best_scale", Some(d.area_error_best_scale)),
        ("symmetric_dirichlet", d.symmetric_dirichlet),
        ("symmetric_dirichlet_max", d.symmetric_dirichlet_max),
        ("mips", d.mips),
        ("arap", d.arap),
        ("singular_ratio_mean", d.singular_ratio_mean),
        ("singular_ratio_p99", d.singular_ratio_p99),
        ("singular_ratio_max", d.singular_ratio_max),
        ("stretch_l2", Some(d.stretch_l2)),
        ("stretch_linf", Some(d.stretch_linf)),
    ];
    let counts = counts.into_iter().map(|(name, count)| (name, count as f64));
    counts.chain(values.into_iter().filter_map(|(name, value)| Some((name, value?)))).collect()
}

/// Every measure, up to a relative difference (or an absolute one, near 0).
fn assert_same(found: &Measures, expected: &Measures, tolerance: f64) {
    assert!(found.keys().eq(expected.keys()), "{found:?}\n{expected:?}");
    for (name, value) in expected {
        let difference = (found[name] - value).abs();
        assert!(difference <= tolerance * value.abs().max(1.0), "{name}: {}, expected {value}", found[name]);
    }
}

fn corner_uv(mesh: &QuadMesh, uv: impl Fn(Vec3) -> Vec2) -> Vec<Vec2> {
    mesh.corners().map(|corner| uv(mesh.position(mesh.vertex(corner)))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..Default::default() })]

    /// Two implementations of the definitions agree to 1e-9: on quads, triangles and hexagons, with flips, zero
    /// areas and angles, islands, mirrored islands, and crossing boundaries.
    #[test]
    fn agrees_with_the_slow_ruler(seed: u64, noise in 0_u32..9, seams: bool) {
        let (polygons, uv) = random_map(seed, noise, seams);
        let found = measure(polygons.view(), &uv).unwrap();
        assert_same(&by_name(&found), &slow_measures(polygons.view(), &uv), 1e-9);
    }

    /// Scaling, turning, moving and mirroring U, and scaling, turning and moving T, change nothing.
    #[test]
    fn invariant_under_similarities(seed: u64, noise in 0_u32..3, angle in 0.0..6.3, scale in -9.0..9.0) {
        let (polygons, uv) = random_map(seed, noise, true);
        let expected = by_name(&measure(polygons.view(), &uv).unwrap());
        // By a quarter turn and a power of two nothing is rounded: islands and flips are the same, bit by bit.
        let power = f64::exp2(f64::round(4.0 * scale));
        let quarter: Vec<Vec2> = uv.iter().map(|p| Vec2::new(-p.y, p.x) * power).collect();
        assert_same(&by_name(&measure(polygons.view(), &quarter).unwrap()), &expected, 1e-9);
        let mirrored: Vec<Vec2> = uv.iter().map(|p| Vec2::new(p.y, p.x)).collect();
        let found = measure(polygons.view(), &mirrored).unwrap();
        prop_assert_eq!(found.mirrored_islands + expected["mirrored_islands"] as usize, found.islands);
        let mut found = by_name(&found);
        found.insert("mirrored_islands", expected["mirrored_islands"]);
        assert_same(&found, &expected, 1e-9);
        // By any turn coordinates are rounded: a zero area may become a flip, and edges that touch may part.
        if expected["area_clamped"] == 0.0 {
            let turn = Rotation2::new(angle);
            let size = f64::exp2(scale);
            let turned: Vec<Vec2> = uv.iter().map(|p| turn * p * size + Vec2::new(3.0, -1.0)).collect();
            let mut space = polygons.clone();
            let moved = |p: &Vec3| Vec3::new(p.z, p.x, p.y) * 1e3 + Vec3::new(5.0, 6.0, 7.0);
            space.positions.iter_mut().for_each(|p| *p = moved(p));
            let mut found = by_name(&measure(space.view(), &turned).unwrap());
            found.insert("boundary_crossings", expected["boundary_crossings"]);
            assert_same(&found, &expected, 1e-9);
        }
    }

    /// The order of the faces, and the corner at which each begins, are no part of a map.
    #[test]
    fn invariant_under_renumbering(seed: u64, noise in 0_u32..9) {
        let (polygons, uv) = random_map(seed, noise, true);
        let view = polygons.view();
        let mut random = Random::new(seed);
        let mut order: Vec<usize> = (0..view.face_count()).collect();
        order.sort_by_cached_key(|_| random.below(1 << 20));
        let mut shuffled = Polygons { positions: polygons.positions.clone(), ..Polygons::default() };
        let mut shuffled_uv = Vec::new();
        for face in order {
            let mut corners: Vec<usize> = view.corners(face).collect();
            let begin = random.below(corners.len() as u32) as usize;
            corners.rotate_left(begin);
            shuffled.push_face(&corners.iter().map(|&c| view.corner_vertex[c]).collect::<Vec<_>>());
            shuffled_uv.extend(corners.iter().map(|&c| uv[c]));
        }
        let found = measure(shuffled.view(), &shuffled_uv).unwrap();
        assert_same(&by_name(&found), &by_name(&measure(view, &uv).unwrap()), 1e-11);
    }

    /// Whatever finite UVs come, no measure is infinite or not a number.
    #[test]
    fn always_finite(seed: u64, exponents in proptest::array::uniform2(-300_i32..300)) {
        let (mut polygons, mut uv) = random_map(seed, 8, true);
        let [space, plane] = exponents.map(|exponent| 10_f64.powi(exponent));
        polygons.positions.iter_mut().for_each(|p| *p *= space);
        uv.iter_mut().for_each(|p| *p *= plane);
        uv[0] = Vec2::zeros();
        let found = measure(polygons.view(), &uv).unwrap();
        for (name, value) in by_name(&found) {
            prop_assert!(value.is_finite(), "{name}: {value}");
        }
    }

    /// A map that is certified, without concave corners, covers no point twice: the signed areas of its faces, all positive, sum to the
    /// area inside its one boundary curve, and no two faces share an interior point (here: no center of a corner
    /// triangle lies in another face).
    #[test]
    fn injective_means_no_face_on_another(seed: u64, noise in 0_u32..5) {
        let (polygons, uv) = random_map(seed, noise, false);
        let found = measure(polygons.view(), &uv).unwrap();
        if found.flipped_corners == 0 && is_certified(polygons.view(), &uv) {
            let view = polygons.view();
            let inside = |face: usize, p: Vec2| {
                let c: Vec<usize> = view.corners(face).collect();
                (0..c.len()).all(|i| {
                    let (a, b) = (uv[c[i]], uv[c[(i + 1) % c.len()]]);
                    (b - a).perp(&(p - a)) > 1e-9
                })
            };
            for face in 0..view.face_count() {
                let c: Vec<usize> = view.corners(face).collect();
                for i in 0..c.len() {
                    let center = (uv[c[i]] + uv[c[(i + 1) % c.len()]] + uv[c[(i + 2) % c.len()]]) / 3.0;
                    for other in (0..view.face_count()).filter(|&other| other != face) {
                        prop_assert!(!inside(other, center), "faces {face} and {other}");
                    }
                }
            }
        }
    }
}

/// A flat mesh over itself: no error, and every normalised measure at its minimum.
#[test]
fn identity_has_no_distortion() {
    let mesh = shapes::jittered_grid(9, 7, 0.25, 3);
    let uv = corner_uv(&mesh, |p| p.xy() * 5.0);
    let found = measure(mesh.view(), &uv).unwrap();
    let near =
        |value: f64, expected: f64| assert!((value - expected).abs() < 1e-12, "{value}, expected {expected}");
    near(found.angle_error, 0.0);
    near(found.area_error, 0.0);
    near(found.area_error_best_scale, 0.0);
    near(found.angle_rms_degrees, 0.0);
    near(found.symmetric_dirichlet.unwrap(), 1.0);
    near(found.symmetric_dirichlet_max.unwrap(), 1.0);
    near(found.mips.unwrap(), 1.0);
    near(found.singular_ratio_max.unwrap(), 1.0);
    near(found.stretch_l2, 1.0);
    near(found.stretch_linf, 1.0);
    near(found.benchmark.symmetric_dirichlet_energy.unwrap(), 2.0);
    near(found.benchmark.max_area_distortion.unwrap(), 0.0);
    near(found.benchmark.max_angle_distortion.unwrap(), 0.0);
    near(found.benchmark.average_area_discrepancy, 0.0);
    near(found.benchmark.average_angle_discrepancy, 0.0);
    assert!(is_certified(mesh.view(), &uv));
}

/// The blind spot of the paper's errors: squares stretched λ × 1/λ along their edges keep every corner angle and
/// every corner area, so Eqs. 13 and 14 are 0, and yet this is no isometry.
#[test]
fn stretched_squares_are_invisible_to_the_papers_errors() {
    let mesh = shapes::grid(6, 6);
    let lambda = 3.0;
    let found = measure(mesh.view(), &corner_uv(&mesh, |p| Vec2::new(lambda * p.x, p.y / lambda))).unwrap();
    assert!(found.angle_error < 1e-24 && found.area_error < 1e-24);
    let dirichlet = (lambda * lambda + 1.0 / (lambda * lambda)) / 2.0;
    assert!((found.symmetric_dirichlet.unwrap() - dirichlet).abs() < 1e-12);
    assert!((found.singular_ratio_mean.unwrap() - lambda * lambda).abs() < 1e-12);
}

/// A parallelogram's fan triangles are mapped by one matrix, so the benchmark's measures have closed forms.
#[test]
fn benchmark_measures_of_an_affine_map() {
    let square =
        Polygons::new(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]], [[0, 1, 2, 3]]);
    let uv = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]].map(Vec2::from);
    let found = measure(square.view(), &uv).unwrap().benchmark;
    let near =
        |value: f64, expected: f64| assert!((value - expected).abs() < 1e-12, "{value}, expected {expected}");
    near(found.min_singular_value, 0.5);
    near(found.max_singular_value, 2.0);
    near(found.max_angle_distortion.unwrap(), 4.0 + 0.25 - 2.0);
    near(found.symmetric_dirichlet_energy.unwrap(), 4.0 + 0.25);
    // A side of length 2 fits into 1/4 of the unit square's side.
    near(found.resolution.unwrap(), 8.0);
    let change = (0.25_f64.atan() - std::f64::consts::FRAC_PI_4).abs();
    near(found.average_angle_discrepancy, 2.0 * change);
    near(found.proportion_flipped_triangles, 0.0);
}

/// One quad of four is turned over: signs, and who is counted as what.
#[test]
fn a_concave_and_a_folded_quad() {
    let mesh = shapes::grid(3, 3);
    let place = |middle: Vec2| {
        let center = mesh.position(mesh.vertices().nth(5).unwrap());
        corner_uv(&mesh, |p| if p == center { middle } else { p.xy() })
    };
    let cell = mesh.edge_length(mesh.edges().next().unwrap());
    let center = mesh.position(mesh.vertices().nth(5).unwrap()).xy();
    let moved = |x: f64, y: f64| measure(mesh.view(), &place(center + Vec2::new(x, y) * cell)).unwrap();
    assert_eq!(moved(0.2, 0.1).flipped_corners, 0);
    // Past the diagonal of the next quad: concave there, but one of its diagonals still gives two positive triangles.
    let concave = moved(0.7, 0.7);
    assert_eq!((concave.flipped_corners, concave.flipped_faces, concave.folded_faces), (1, 1, 0));
    assert_eq!(concave.newly_flipped_corners, 1);
    assert!(!is_certified(mesh.view(), &place(center + Vec2::new(0.7, 0.7) * cell)));
    // Beyond the next quad: no diagonal helps.
    assert!(moved(2.4, 0.3).folded_faces > 0);
    // Onto a neighbour: two quads with an edge of no length, and no triangle at its ends.
    assert_eq!(moved(1.0, 0.0).area_clamped, 4);
}

/// All corners of a pentagram turn left, but it covers its middle twice.
#[test]
fn a_pentagram_is_not_injective() {
    let point = |i: usize, step: usize| {
        let t = std::f64::consts::TAU * (i * step) as f64 / 5.0;
        [t.cos(), t.sin()]
    };
    let pentagon =
        Polygons::new(&[0, 1, 2, 3, 4].map(|i| [point(i, 1)[0], point(i, 1)[1], 0.0]), [[0, 1, 2, 3, 4]]);
    let uv = |step: usize| [0, 1, 2, 3, 4].map(|i| Vec2::from(point(i, step)));
    let star = measure(pentagon.view(), &uv(2)).unwrap();
    assert_eq!((star.flipped_corners, star.wound_faces, star.boundary_crossings), (0, 1, 5));
    assert!(!is_certified(pentagon.view(), &uv(2)));
    assert!(is_certified(pentagon.view(), &uv(1)));
}

/// A strip of positive quads wound round a center by more than a full turn: no flip, but the ends cross.
#[test]
fn a_spiral_is_locally_but_not_globally_injective() {
    let mesh = shapes::grid(40, 2);
    let spiral = |turns: f64| {
        let wind = |p: Vec3| {
            let (t, radius) = (-turns * std::f64::consts::TAU * p.x, 3.0 + p.y);
            Vec2::new(t.cos(), t.sin()) * radius
        };
        judge(mesh.view(), &corner_uv(&mesh, wind), 1).unwrap()
    };
    let width = mesh.positions().iter().map(|p| p.x).fold(0.0, f64::max);
    let (crossing, certificate) = spiral(1.1 / width);
    assert_eq!((crossing.flipped_corners, crossing.boundary_loops), (0, 1));
    assert!(crossing.boundary_crossings > 0 && !certificate.holds);
    assert!(spiral(0.9 / width).1.holds);
}

/// Three quads at one edge, a face turned over, an island apart: counted, never refused.
#[test]
fn any_soup_is_measured() {
    let soup = Polygons::new(
        &[
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [1.0, -1.0, 0.0],
            [0.0, -1.0, 0.0],
            [9.0, 9.0, 9.0],
        ],
        [
            vec![0, 1, 2, 3],
            vec![1, 0, 5, 4],
            vec![1, 0, 7, 6],
            vec![2, 3, 0],
            vec![0, 1],
            vec![4, 4, 4, 4],
            vec![],
        ],
    );
    let uv: Vec<Vec2> = soup.corner_vertex.iter().map(|&v| soup.positions[v as usize].xy()).collect();
    let found = measure(soup.view(), &uv).unwrap();
    assert_eq!(found.faces, 7);
    assert!(found.nonmanifold_edges > 0 && !is_certified(soup.view(), &uv));
    assert!(by_name(&found).values().all(|value| value.is_finite()));
}

/// Each refusal names what is wrong.
#[test]
fn refusals() {
    let square =
        Polygons::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2, 3]]);
    let uv = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
    let error = |polygons: &Polygons, uv: &[Vec2]| measure(polygons.view(), uv).unwrap_err();
    assert_eq!(error(&Polygons::default(), &[]), MeasureError::NoFaces);
    assert_eq!(error(&square, &uv[..3]), MeasureError::UvCount { expected: 4, found: 3 });
    assert_eq!(error(&square, &[Vec2::zeros(); 4]), MeasureError::NoArea);
    let mut bad = uv;
    bad[2].y = f64::INFINITY;
    assert_eq!(error(&square, &bad), MeasureError::NonFinite { corner: 2 });
    let change = |change: &dyn Fn(&mut Polygons)| {
        let mut changed = square.clone();
        change(&mut changed);
        error(&changed, &uv)
    };
    assert_eq!(change(&|p| p.positions[1].z = f64::NAN), MeasureError::NonFinitePosition { vertex: 1 });
    assert_eq!(change(&|p| p.positions.fill(Vec3::zeros())), MeasureError::NoSurface);
    assert_eq!(
        change(&|p| p.corner_vertex[3] = 4),
        MeasureError::IndexOutOfRange { corner: 3, vertex: 4, count: 4 }
    );
    for (starts, entry) in [(vec![1, 4], 0), (vec![0, 3], 1), (vec![0, 3, 2, 4], 2), (vec![0, 9, 4], 2)] {
        assert_eq!(change(&|p| p.face_start = starts.clone()), MeasureError::BadFaceStart { entry });
    }
}

/// One thread and three give the same bits.
#[test]
fn same_bits_for_any_number_of_threads() {
    let mesh = shapes::jittered_grid(120, 90, 0.2, 1);
    let uv = corner_uv(&mesh, |p| Vec2::new(p.x + 0.1 * (9.0 * p.y).sin(), p.y * p.y + p.x));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| format!("{:?}", measure(mesh.view(), &uv).unwrap()))
    };
    assert_eq!(on(1), on(3));
}

/// The worst faces are those of all faces measured and sorted: with a flip, mirrored, and with triangles among the quads.
#[test]
fn the_worst_faces_are_the_worst_of_all() {
    for (mesh, flip, mirror) in [
        (shapes::bump(6, 0.7), false, 1.0),
        (shapes::bump(7, 0.7), true, 1.0),
        (shapes::bump(7, 0.7), true, -1.0),
        (shapes::finger(2, 10), false, -1.0),
    ] {
        let mut uv = corner_uv(&mesh, |p| {
            Vec2::new(mirror * (p.x + 0.2 * p.y * p.z), p.y - 0.1 * p.x * p.x + 0.3 * p.z)
        });
        if flip {
            uv[0] = uv[2] * 1.5 - uv[0] * 0.5;
        }
        let all = measure_faces(mesh.view(), &uv).unwrap();
        let order = qoptimize::worst::rank_faces(&all, mesh.face_count());
        for count in [0, 3, mesh.face_count() + 1] {
            let worst = measure_worst_faces(mesh.view(), &uv, count).unwrap();
            assert_eq!(worst.len(), count.min(mesh.face_count()));
            for (&(face, measure), &expected) in worst.iter().zip(&order) {
                // Rounding may exchange faces that are alike.
                let [a, b] = [face, expected].map(|face| all.symmetric_dirichlet[face]);
                assert!(a == b || (a / b - 1.0).abs() < 1e-6, "{face} {expected}: {a} {b}");
                assert_eq!(measure.symmetric_dirichlet, all.symmetric_dirichlet[face]);
                assert_eq!(measure.angle_degrees, all.angle_degrees[face]);
                assert_eq!(measure.area_ratio, all.area_ratio[face]);
                assert_eq!(measure.flipped, all.flipped[face]);
            }
        }
    }
}

/// What faces have adds up to what the whole map has: areas to equal areas, the largest ratio of stretches to the largest
/// of all, angle errors to their mean; and the faces with a flipped corner are as many.
#[test]
fn measures_of_faces_add_up() {
    let mesh = shapes::bump(6, 0.7);
    for flip in [false, true] {
        let mut uv = corner_uv(&mesh, |p| Vec2::new(p.x + 0.2 * p.y * p.z, p.y - 0.1 * p.x * p.x));
        if flip {
            uv[0] = uv[2] * 1.5 - uv[0] * 0.5;
        }
        let (whole, faces) = (measure(mesh.view(), &uv).unwrap(), measure_faces(mesh.view(), &uv).unwrap());
        assert_eq!(faces.flipped.iter().filter(|&&flipped| flipped).count(), whole.flipped_faces);
        assert_eq!((faces.island.len(), faces.islands), (mesh.face_count(), whole.islands));
        if flip {
            assert!(faces.symmetric_dirichlet[0].is_infinite() && faces.flipped[0]);
            continue;
        }
        let largest = faces.singular_ratio.iter().copied().fold(1.0, f64::max);
        assert!((largest - whole.singular_ratio_max.unwrap()).abs() < 1e-12);
        // All faces are quads: the mean over faces is the mean over corners, which bounds the root mean square from below.
        let mean = faces.angle_degrees.iter().sum::<f64>() / mesh.face_count() as f64;
        assert!(mean > 0.0 && mean <= whole.angle_rms_degrees);
        assert!(faces.symmetric_dirichlet.iter().all(|&sd| sd >= 1.0 - 1e-12));
        assert!(
            faces.symmetric_dirichlet.iter().copied().fold(1.0, f64::max)
                <= whole.symmetric_dirichlet_max.unwrap() + 1e-12
        );
    }
    // Twice as wide to the right of the middle: areas are off by a factor of two between the halves, by 4/3 and 2/3 of the mean.
    let flat = shapes::grid(4, 4);
    let uv = corner_uv(&flat, |p| Vec2::new(p.x + (p.x - 2.0).max(0.0), p.y));
    let faces = measure_faces(flat.view(), &uv).unwrap();
    for (face, ratio) in faces.area_ratio.iter().enumerate() {
        let expected = if face % 4 < 2 { 2.0 / 3.0 } else { 4.0 / 3.0 };
        assert!((ratio - expected).abs() < 1e-12 && faces.angle_degrees[face] < 1e-6, "face {face}: {ratio}");
    }
}
