//! What is no planar patch, and what is out of range, is refused with a message that says what it is and what to do.

mod common;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::simplified;
use qembed::qmesh::{QuadMesh, Vec3, shapes};
use qembed::qsimplify::RemovalRule;
use qembed::qsolve::SolveOptions;
use qembed::{BoundaryShape, Classic, EmbedError, EmbedOptions, Mixing, Weights, embed, embed_classic};

fn refusal(mesh: &QuadMesh) -> String {
    let kept = simplified(mesh, RemovalRule::None);
    let paper = embed(mesh, &kept, &EmbedOptions::default(), &()).expect_err("no patch");
    for method in [Classic::Uniform, Classic::MeanValue, Classic::Harmonic, Classic::Lscm] {
        let classic = embed_classic(mesh, method, &BoundaryShape::Circle, &SolveOptions::default(), &());
        assert_eq!(classic.expect_err("no patch"), paper);
    }
    paper.to_string()
}

#[test]
fn what_is_no_planar_patch_is_refused() {
    insta::assert_snapshot!(refusal(&shapes::sphere(3)), @"the mesh is closed (genus 0): cut it open along seams first");
    insta::assert_snapshot!(refusal(&shapes::torus(6, 5)), @"the mesh is closed (genus 1): cut it open along seams first");
    let two = shapes::disjoint_union(&shapes::grid(2, 2), &shapes::grid(1, 1)).unwrap();
    insta::assert_snapshot!(refusal(&two), @"the mesh has 2 components, for instance those of vertices 0 and 9: map each for itself");
    insta::assert_snapshot!(refusal(&punctured_torus()), @"the mesh has a boundary, but also 1 handle(s): cut each open first");
}

/// A torus without one of its faces.
fn punctured_torus() -> QuadMesh {
    let torus = shapes::torus(6, 5);
    let positions: Vec<[f64; 3]> = torus.positions().iter().map(|&p| p.into()).collect();
    let faces = torus.faces().skip(1).map(|face| torus.face_vertices(face).map(|v| v.0).collect::<Vec<_>>());
    QuadMesh::from_slices(&positions, faces).expect("a torus with a hole")
}

#[test]
fn options_out_of_range_are_refused() {
    let mesh = shapes::grid(3, 3);
    let kept = simplified(&mesh, RemovalRule::All);
    let refused = |options: EmbedOptions| embed(&mesh, &kept, &options, &()).unwrap_err();
    for q in [-0.1, 1.1, f64::NAN] {
        assert!(matches!(refused(EmbedOptions { q, ..Default::default() }), EmbedError::BadMix(_)));
    }
    for exponent in [-1.0, f64::NAN, f64::INFINITY] {
        let refused = refused(EmbedOptions { exponent, ..Default::default() });
        assert!(matches!(refused, EmbedError::BadExponent(_)));
    }
    let other = simplified(&shapes::grid(2, 2), RemovalRule::All);
    let foreign = embed(&mesh, &other, &EmbedOptions::default(), &()).unwrap_err();
    assert!(matches!(foreign, EmbedError::OtherMesh(_)));
}

/// Large exponents and coincident vertices stay finite.
#[test]
fn extreme_springs_stay_finite() {
    let mesh = shapes::jittered_grid(6, 6, 0.2, 1);
    let mut positions = mesh.positions().clone();
    let inside: Vec<_> = mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).collect();
    positions[inside[0]] = positions[inside[1]];
    let mesh = mesh.with_positions(positions);
    for rule in [RemovalRule::None, RemovalRule::All, RemovalRule::Guarded] {
        for exponent in [0.0, 2.0, 5.0] {
            let options = EmbedOptions { exponent, ..Default::default() };
            let uv = common::map(&mesh, rule, &options);
            assert!(uv.iter().all(|p| p.norm() <= 1.0 + 1e-6), "{rule:?} {exponent}");
        }
    }
}

/// Coincident and collinear vertices, and sizes at the ends of the range: a finite map or an error, never a panic.
#[test]
fn degenerate_geometry_never_panics() {
    type Shape = fn(&Vec3) -> Vec3;
    let mesh = shapes::jittered_grid(4, 5, 0.2, 3);
    let shapes: [(&str, Shape); 6] = [
        ("one place", |_| Vec3::new(1.0, 2.0, 3.0)),
        ("one line", |p| Vec3::new(p.x + p.y, 0.0, 0.0)),
        ("two places", |p| Vec3::new(if p.x < 2.0 { 0.0 } else { 1.0 }, 0.0, 0.0)),
        ("folded", |p| Vec3::new((p.x - 2.0).abs(), p.y, 0.0)),
        ("tiny", |p| 1e-300 * p),
        ("huge", |p| 1e59 * p),
    ];
    for (name, shape) in shapes {
        let mesh = common::moved(&mesh, shape);
        let mut results = Vec::new();
        for boundary in [BoundaryShape::Circle, BoundaryShape::Square, BoundaryShape::Projection] {
            for weights in [Weights::Star4, Weights::Star1, Weights::Printed] {
                for mixing in [Mixing::RowNormalized, Mixing::Raw] {
                    for rule in
                        [RemovalRule::None, RemovalRule::All, RemovalRule::Guarded, RemovalRule::Naive]
                    {
                        let options = EmbedOptions {
                            weights,
                            mixing,
                            boundary: boundary.clone(),
                            ..Default::default()
                        };
                        results.push(embed(&mesh, &simplified(&mesh, rule), &options, &()));
                    }
                }
            }
            for method in [Classic::Uniform, Classic::MeanValue, Classic::Harmonic, Classic::Lscm] {
                results.push(embed_classic(&mesh, method, &boundary, &SolveOptions::default(), &()));
            }
        }
        assert!(results.iter().any(Result::is_ok), "{name}");
        for embedding in results.into_iter().flatten() {
            assert!(embedding.uv.iter().all(|p| p.iter().all(|x| x.is_finite())), "{name}");
        }
    }
}

/// The observer is asked several times, and stops the work whenever it says so.
#[test]
fn observers_can_stop_the_work() {
    let mesh = shapes::grid(5, 5);
    let kept = simplified(&mesh, RemovalRule::Guarded);
    let calls = AtomicUsize::new(0);
    let count = |_: &'static str, fraction: f64| {
        assert!((0.0..=1.0).contains(&fraction));
        calls.fetch_add(1, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    embed(&mesh, &kept, &EmbedOptions::default(), &count).unwrap();
    let total = calls.load(Ordering::Relaxed);
    assert!(total >= 3);
    for stop_at in 0..total {
        let calls = AtomicUsize::new(0);
        let stop = |_: &'static str, _: f64| {
            if calls.fetch_add(1, Ordering::Relaxed) == stop_at {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let stopped = embed(&mesh, &kept, &EmbedOptions::default(), &stop).unwrap_err();
        assert_eq!(stopped, EmbedError::Cancelled);
    }
    let stop = |_: &'static str, _: f64| ControlFlow::Break(());
    let stopped =
        embed_classic(&mesh, Classic::Lscm, &BoundaryShape::Circle, &SolveOptions::default(), &stop);
    assert_eq!(stopped.unwrap_err(), EmbedError::Cancelled);
}
