//! The worst faces are the worst, and each is told why.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use qoptimize::qmesh::{FaceId, QuadMesh, Vec2, Vec3, VertexId, shapes};
use qoptimize::{Cause, Circumstances, Options, WorstFace, measure_faces, parameterize, worst_faces};

fn worst(mesh: &QuadMesh, circumstances: &Circumstances<'_>, count: usize) -> Vec<WorstFace> {
    let options = Options::default();
    let uv = parameterize(mesh, &options, &()).unwrap().uv;
    worst_faces(mesh, &uv, circumstances, count).unwrap()
}

/// They come in order, agree with the measures of single faces, and none that is left out is worse.
#[test]
fn the_worst_come_first() {
    let mesh = shapes::finger(2, 10);
    let uv = parameterize(&mesh, &Options::default(), &()).unwrap().uv;
    let measures = measure_faces(mesh.view(), &uv).unwrap();
    let mut expected = measures.symmetric_dirichlet.clone();
    expected.sort_by(|a, b| b.total_cmp(a));
    for count in [0, 1, 7, mesh.face_count(), mesh.face_count() + 9] {
        let found = worst_faces(&mesh, &uv, &Circumstances::default(), count).unwrap();
        let energies: Vec<f64> = found.iter().map(|face| face.symmetric_dirichlet.unwrap()).collect();
        assert_eq!(energies.len(), count.min(mesh.face_count()));
        assert!(energies.iter().zip(&expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{energies:?}");
        assert!(found.iter().all(|face| !face.causes.is_empty()));
    }
}

/// The tip of a cone is what forces the faces around it, by the curvature that the cone has there.
#[test]
fn curvature_is_named_with_its_place() {
    let mesh = shapes::bump(12, 1.5);
    let found = worst(&mesh, &Circumstances::default(), 1);
    let curved = found[0].causes.iter().find_map(|cause| match cause {
        Cause::Curvature { radians, vertex } => Some((*radians, *vertex)),
        _ => None,
    });
    let (radians, vertex) = curved.expect("a hill is curved");
    assert!(radians > 0.1 && (mesh.position(vertex) - found[0].place).norm() < 1.0, "{:?}", found[0]);
}

/// A flat mesh has no reason to be stretched but what is done to it: each circumstance is named where it acts, and only there.
#[test]
fn every_cause_is_named() {
    let mesh = shapes::grid(6, 6);
    let causes_of = |mesh: &QuadMesh, face: u32, circumstances: &Circumstances<'_>| {
        let found = worst(mesh, circumstances, mesh.face_count());
        found.into_iter().find(|worst| worst.face == FaceId(face)).unwrap().causes
    };
    assert_eq!(causes_of(&mesh, 14, &Circumstances::default()), [Cause::Surroundings]);
    let held = Circumstances { held_boundary: true, not_converged: true, ..Circumstances::default() };
    assert_eq!(causes_of(&mesh, 0, &held), [Cause::Boundary, Cause::NotConverged]);
    assert_eq!(causes_of(&mesh, 14, &held), [Cause::NotConverged]);
    let pinned = Circumstances { pinned: &[VertexId(16)], ..Circumstances::default() };
    assert_eq!(causes_of(&mesh, 14, &pinned), [Cause::Pin { vertex: VertexId(16) }]);
    assert_eq!(causes_of(&mesh, 35, &pinned), [Cause::Surroundings]);
    let exempt = Circumstances { exempt: &[FaceId(14)], ..Circumstances::default() };
    assert_eq!(causes_of(&mesh, 14, &exempt), [Cause::Exempt]);
    let moved = |vertex: u32, to: Vec3| {
        let positions = mesh.vertex_data(|v| if v == VertexId(vertex) { to } else { mesh.position(v) });
        mesh.clone().with_positions(positions)
    };
    // Vertex 0 is a corner of face 0 alone.
    let raised = causes_of(&moved(0, Vec3::z()), 0, &Circumstances::default());
    assert!(matches!(raised[0], Cause::NotPlanar { degrees } if degrees > 30.0), "{raised:?}");
    let dented = causes_of(&moved(0, Vec3::new(0.8, 0.8, 0.0)), 0, &Circumstances::default());
    assert_eq!(dented[0], Cause::Concave);
    let thin = causes_of(&moved(0, Vec3::new(0.999, 0.0, 0.0)), 0, &Circumstances::default());
    assert_eq!(thin[0], Cause::Degenerate);
}

/// A flipped face comes before all others, and has no energy.
#[test]
fn flipped_faces_are_worst() {
    let mesh = shapes::grid(4, 4);
    // The middle vertex, dragged over the opposite corner of face 10: face 5 grows, face 10 turns inside out.
    let place = |v: VertexId| if v == VertexId(12) { Vec2::new(3.2, 3.2) } else { mesh.position(v).xy() };
    let uv = mesh.to_corners(&mesh.vertex_data(place));
    let found = worst_faces(&mesh, &uv, &Circumstances::default(), 16).unwrap();
    let flipped: Vec<u32> = found
        .iter()
        .take_while(|worst| worst.symmetric_dirichlet.is_none())
        .map(|worst| worst.face.0)
        .collect();
    assert_eq!(flipped, [6, 9, 10]);
    assert!(found[3..].iter().all(|worst| worst.symmetric_dirichlet.is_some()));
}
