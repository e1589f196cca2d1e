//! The whole way: theorems, invariances, refusals, and stopping at any point.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use qoptimize::qembed::{BoundaryShape, EmbedError, Weights};
use qoptimize::qmesh::obj::ObjDocument;
use qoptimize::qmesh::{BuildError, QuadMesh, Vec2, Vec3, shapes};
use qoptimize::qsimplify::RemovalRule;
use qoptimize::{Method, Options, OverlapOptions, ParameterizeError, parameterize};

const METHODS: [Method; 7] = [
    Method::Direct,
    Method::Paper,
    Method::Conformal,
    Method::Uniform,
    Method::MeanValue,
    Method::Harmonic,
    Method::Lscm,
];

/// How exactly two ways to the same map agree: a descent ends where it is good enough, so its last digits are free.
fn tolerance(method: Method) -> f64 {
    if matches!(method, Method::Direct | Method::Conformal) { 1e-6 } else { 1e-9 }
}

fn disks() -> Vec<(&'static str, QuadMesh)> {
    vec![
        ("grid", shapes::grid(7, 5)),
        ("jittered grid", shapes::jittered_grid(8, 8, 0.2, 5)),
        ("bump", shapes::bump(12, 0.6)),
        ("saddle", shapes::saddle(9)),
        ("cap", shapes::cap(5, 1.4)),
        ("cylinder strip", shapes::cylinder_strip(9, 5, 2.0)),
    ]
}

fn with(method: Method) -> Options {
    Options { method, ..Options::default() }
}

fn largest_difference(a: &[Vec2], b: &[Vec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max)
}

fn scaled(mesh: &QuadMesh, factor: f64) -> QuadMesh {
    let positions = mesh.vertex_data(|v| mesh.position(v) * factor);
    mesh.clone().with_positions(positions)
}

/// Every method maps every disk: finite, inside the unit square with the longer side 1, one UV per vertex.
#[test]
fn every_method_maps_every_disk() {
    for (name, mesh) in disks() {
        for method in METHODS {
            let map = parameterize(&mesh, &with(method), &()).unwrap();
            let low = map.uv.iter().copied().reduce(|a, b| a.inf(&b)).unwrap();
            let high = map.uv.iter().copied().reduce(|a, b| a.sup(&b)).unwrap();
            assert_eq!(low, Vec2::zeros(), "{name} {method:?}");
            assert_eq!(high.max(), 1.0, "{name} {method:?}");
            assert_eq!(map.distortion.islands, 1, "{name} {method:?}");
            for vertex in mesh.vertices() {
                let mut at = mesh.vertex_corners(vertex).map(|corner| map.uv[corner]);
                let first = at.next().unwrap();
                assert!(at.all(|uv| uv == first), "{name} {method:?}: one UV at {vertex:?}");
            }
        }
    }
}

/// Tutte 1963, Floater 2003: positive weights and a convex boundary give no flips. On a circle no boundary corner is
/// straight, so nothing is degenerate either, and the map is proven injective.
#[test]
fn positive_weights_on_a_circle_are_injective() {
    for (name, mesh) in disks() {
        for method in [Method::Uniform, Method::MeanValue] {
            let map = parameterize(&mesh, &with(method), &()).unwrap();
            assert!(map.certificate.holds, "{name} {method:?}: {}", map.certificate);
        }
    }
}

/// What the paper's last stage is for: whatever simplification did, nothing overlaps on a circle in the end.
#[test]
fn the_papers_method_ends_without_overlaps_on_a_circle() {
    for (name, mesh) in disks() {
        for rule in [RemovalRule::Guarded, RemovalRule::All, RemovalRule::None] {
            let mut options = with(Method::Paper);
            options.simplify.rule = rule;
            let map = parameterize(&mesh, &options, &()).unwrap();
            assert_eq!(map.record.overlaps.unwrap().after, 0, "{name} {rule:?}");
            assert!(map.certificate.holds, "{name} {rule:?}");
        }
    }
}

/// UVs are free of the unit of length, however odd it is.
#[test]
fn scaling_the_mesh_changes_nothing() {
    for (name, mesh) in disks() {
        for method in METHODS {
            let expected = parameterize(&mesh, &with(method), &()).unwrap();
            for factor in [1000.0, 0.0254, 1e-40, 3e50] {
                let map = parameterize(&scaled(&mesh, factor), &with(method), &()).unwrap();
                let difference = largest_difference(&map.uv, &expected.uv);
                assert!(difference < tolerance(method), "{name} {method:?} × {factor}: {difference:e}");
                let [a, b] = [&map, &expected].map(|map| map.distortion.angle_error);
                assert!((a - b).abs() <= 1e-6 * b.max(1.0), "{name} {method:?} × {factor}: {a} {b}");
            }
        }
    }
}

/// A whole number times the smallest positive `f64` is exact, so even a grid of subnormal size maps as its large sibling.
#[test]
fn a_mesh_of_subnormal_size_is_as_good_as_any() {
    const SMALLEST: f64 = f64::from_bits(1);
    let mesh = shapes::grid(6, 5);
    for method in METHODS {
        let expected = parameterize(&mesh, &with(method), &()).unwrap();
        let map = parameterize(&scaled(&mesh, SMALLEST), &with(method), &()).unwrap();
        let difference = largest_difference(&map.uv, &expected.uv);
        assert!(difference < tolerance(method), "{method:?}: {difference:e}");
        assert!(map.certificate.holds, "{method:?}");
    }
}

/// Turning and moving the mesh changes nothing that does not look at coordinates.
#[test]
fn turning_the_mesh_changes_nothing() {
    for (name, mesh) in disks() {
        let turned = mesh.vertex_data(|v| {
            let p = mesh.position(v);
            Vec3::new(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z) + Vec3::new(3.0, -7.0, 11.0)
        });
        let turned = mesh.clone().with_positions(turned);
        for method in [Method::Uniform, Method::MeanValue, Method::Harmonic] {
            let maps = [&mesh, &turned].map(|mesh| parameterize(mesh, &with(method), &()).unwrap());
            let difference = largest_difference(&maps[0].uv, &maps[1].uv);
            assert!(difference < 1e-9, "{name} {method:?}: {difference:e}");
        }
    }
}

/// The oracle of flatness: a flat mesh with its own boundary given comes back as itself, unnormalised, whatever q.
#[test]
fn a_flat_mesh_with_its_own_boundary_is_itself() {
    let mesh = shapes::graded_grid(9, 7, 1.3);
    let own = mesh.vertices().filter(|&v| mesh.is_boundary(v)).map(|v| (v, mesh.position(v).xy())).collect();
    let mut options =
        Options { boundary: BoundaryShape::Fixed(own), weights: Weights::Star1, ..with(Method::Paper) };
    options.simplify.rule = RemovalRule::All;
    let expected: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy()).collect();
    for q in [1.0, 0.5, 0.0] {
        let map = parameterize(&mesh, &Options { q, ..options.clone() }, &()).unwrap();
        let difference = largest_difference(&map.uv, &expected);
        assert!(difference < 1e-9, "q = {q}: {difference:e}");
        assert!(map.distortion.symmetric_dirichlet.unwrap() - 1.0 < 1e-9);
    }
}

/// Meshes without any interior vertex: one quad, one triangle, a strip.
#[test]
fn everything_on_the_boundary() {
    let quad = QuadMesh::from_slices(
        &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.5]],
        [[0_u32, 1, 2, 3]],
    );
    let triangle =
        QuadMesh::from_slices(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]], [[0_u32, 1, 2]]);
    for mesh in [quad.unwrap(), triangle.unwrap(), shapes::grid(6, 1), shapes::grid(1, 1)] {
        for method in METHODS {
            let map = parameterize(&mesh, &with(method), &()).unwrap();
            assert!(map.certificate.holds, "{method:?}: {}", map.certificate);
            assert_eq!(map.record.interior_vertices, 0);
        }
    }
}

/// One thread and two give the same bits.
#[test]
fn same_bits_for_any_number_of_threads() {
    let mesh = shapes::bump(60, 0.7);
    for method in METHODS {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let map = parameterize(&mesh, &with(method), &()).unwrap();
                let bits: Vec<[u64; 2]> = map.uv.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect();
                (bits, format!("{:?}", map.distortion))
            })
        };
        assert!(on(1) == on(2), "{method:?}");
    }
}

/// Whoever watches can stop the work at every single report, and always gets `Cancelled`.
#[test]
fn every_report_can_cancel() {
    let mesh = shapes::bump(10, 0.6);
    for method in METHODS {
        let options = with(method);
        let calls = AtomicUsize::new(0);
        let count = |_: &'static str, _: f64| {
            calls.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        parameterize(&mesh, &options, &count).unwrap();
        let total = calls.into_inner();
        assert!(total >= 2, "{method:?}");
        for stop_at in 0..total {
            let calls = AtomicUsize::new(0);
            let stop = |_: &'static str, _: f64| match calls.fetch_add(1, Ordering::Relaxed) {
                call if call >= stop_at => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            };
            let stopped = parameterize(&mesh, &options, &stop).map(|map| map.uv);
            assert_eq!(stopped, Err(ParameterizeError::Cancelled), "{method:?}, report {stop_at}");
        }
    }
}

/// Each stage is told of once, without a break, the paper's last two at the end; fractions stay in [0, 1], never fall,
/// and end at 1.
#[test]
fn stages_in_order() {
    let heard = Mutex::new(Vec::<(&'static str, f64)>::new());
    let listen = |stage: &'static str, fraction: f64| {
        heard.lock().unwrap().push((stage, fraction));
        ControlFlow::Continue(())
    };
    parameterize(&shapes::bump(12, 0.6), &with(Method::Paper), &listen).unwrap();
    let heard = heard.into_inner().unwrap();
    let runs: Vec<&[(&str, f64)]> = heard.chunk_by(|a, b| a.0 == b.0).collect();
    let stages: Vec<&str> = runs.iter().map(|run| run[0].0).collect();
    assert!(stages.ends_with(&["overlaps", "measure"]), "{stages:?}");
    assert_eq!(stages.iter().collect::<BTreeSet<_>>().len(), stages.len(), "{stages:?}");
    for run in runs {
        assert!(run.iter().all(|(_, fraction)| (0.0..=1.0).contains(fraction)), "{run:?}");
        assert!(run.is_sorted_by(|a, b| a.1 <= b.1), "{run:?}");
        assert_eq!(run[run.len() - 1].1, 1.0, "{run:?}");
    }
}

/// A mesh that is no disk is told what it is; an option out of range, what it may be.
#[test]
fn refusals_say_what_is_wrong() {
    let error = |mesh: &QuadMesh| parameterize(mesh, &Options::default(), &()).unwrap_err();
    let two = shapes::disjoint_union(&shapes::grid(2, 2), &shapes::grid(3, 1)).unwrap();
    let handle = one_loop_of_genus_one().unwrap();
    let refused = |mesh: &QuadMesh| match error(mesh) {
        ParameterizeError::Embed(error) => error,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(&shapes::sphere(3)), EmbedError::Closed { genus: 0 });
    assert_eq!(refused(&shapes::torus(6, 5)), EmbedError::Closed { genus: 1 });
    assert!(matches!(refused(&two), EmbedError::SeveralComponents { components: 2, .. }));
    assert_eq!(refused(&handle), EmbedError::Handles { genus: 1 });
    let mesh = shapes::grid(3, 3);
    let error = |options: Options| parameterize(&mesh, &options, &()).unwrap_err();
    for q in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            error(Options { q, ..Options::default() }),
            ParameterizeError::Embed(EmbedError::BadMix(_))
        ));
    }
    let exponent = f64::NAN;
    assert!(matches!(
        error(Options { exponent, ..Options::default() }),
        ParameterizeError::Embed(EmbedError::BadExponent(_))
    ));
    let overlaps = Some(OverlapOptions { lambda1: 0.7, lambda2: 0.7, ..Default::default() });
    assert!(matches!(error(Options { overlaps, ..Options::default() }), ParameterizeError::BadLambda { .. }));
}

/// A torus with one quad taken out.
fn one_loop_of_genus_one() -> Result<QuadMesh, BuildError> {
    let torus = shapes::torus(6, 5);
    let view = torus.view();
    let faces: Vec<&[u32]> = (1..view.face_count()).map(|face| view.face(face)).collect();
    let positions: Vec<[f64; 3]> = torus.positions().iter().map(|p| [p.x, p.y, p.z]).collect();
    QuadMesh::from_slices(&positions, faces)
}

/// Real faces and heads: finite, nothing overlaps, and the record is complete.
#[test]
fn real_meshes() {
    let Some(folder) = std::env::var_os("QPARAM_MESHES") else {
        println!("skipped: QPARAM_MESHES is not set");
        return;
    };
    for name in ["face_makehuman_disk.obj", "head_soma.obj"] {
        let file = std::fs::File::open(std::path::Path::new(&folder).join(name)).unwrap();
        let document = ObjDocument::read(file).unwrap();
        let mesh = QuadMesh::build(document.polygons()).unwrap();
        for method in METHODS {
            let map = parameterize(&mesh, &with(method), &()).unwrap();
            assert!(map.uv.iter().all(|p| p.iter().all(|x| x.is_finite())), "{name} {method:?}");
            assert!(!map.record.solves.is_empty() || map.record.direct.is_some(), "{name} {method:?}");
            if map.record.direct.is_some() {
                assert!(map.certificate.holds, "{name} {method:?}");
            }
            if method == Method::Paper {
                assert_eq!(map.distortion.flipped_corners, 0, "{name}");
                assert_eq!(map.distortion.boundary_crossings, 0, "{name}");
                assert!(map.record.removed_vertices > 0 && map.record.removal_candidates > 0);
            }
        }
    }
}
