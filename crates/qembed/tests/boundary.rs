//! Where boundaries go.

mod common;

use std::f64::consts::TAU;

use common::{map, moved, smallest_corner, wrinkled};
use qembed::qmesh::{QuadMesh, Vec2, VertexData, VertexId, shapes};
use qembed::qsimplify::RemovalRule;
use qembed::qsolve::SolveOptions;
use qembed::{BoundaryShape, Classic, EmbedError, EmbedOptions, embed_classic};

/// The boundary positions of a map, along the boundary.
fn outline(mesh: &QuadMesh, shape: &BoundaryShape) -> Result<Vec<(VertexId, Vec2)>, EmbedError> {
    let uv = embed_classic(mesh, Classic::Uniform, shape, &SolveOptions::default(), &())?.uv;
    let rim = mesh.loop_vertices(&mesh.boundary_loops()[0]);
    Ok(rim.into_iter().map(|vertex| (vertex, uv[vertex])).collect())
}

fn area(outline: &[(VertexId, Vec2)]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| 0.5 * a.1.perp(&b.1)).sum()
}

/// Angles on the circle are to `2π` as arc lengths are to the whole boundary.
#[test]
fn the_circle_keeps_arc_lengths() {
    let mesh = wrinkled(7, 5, 1);
    let outline = outline(&mesh, &BoundaryShape::Circle).unwrap();
    let next = outline.iter().cycle().skip(1);
    let edges: Vec<_> = outline.iter().zip(next).collect();
    let length = |a: VertexId, b: VertexId| (mesh.position(b) - mesh.position(a)).norm();
    let total: f64 = edges.iter().map(|((a, _), (b, _))| length(*a, *b)).sum();
    for ((a, p), (b, q)) in edges {
        let angle = p.perp(q).atan2(p.dot(q));
        assert!((p.norm() - 1.0).abs() < 1e-15);
        assert!((angle - TAU * length(*a, *b) / total).abs() < 1e-12);
    }
}

/// Edges without length keep a small share, so that the circle stays strictly convex.
#[test]
fn coincident_boundary_vertices_stay_apart() {
    let mesh = shapes::jittered_grid(8, 8, 0.2, 5);
    let [a, b, c] = [VertexId(2), VertexId(3), VertexId(4)];
    let mut positions = mesh.positions().clone();
    positions[b] = positions[a];
    positions[c] = positions[a];
    let mesh = mesh.with_positions(positions);
    for shape in [BoundaryShape::Circle, BoundaryShape::Square] {
        let options = EmbedOptions { boundary: shape.clone(), ..Default::default() };
        for rule in [RemovalRule::None, RemovalRule::All] {
            assert!(smallest_corner(&mesh, &map(&mesh, rule, &options)) > 0.0, "{shape:?} {rule:?}");
        }
    }
    let nowhere = moved(&mesh, |p| p * 0.0);
    let outline = outline(&nowhere, &BoundaryShape::Circle).unwrap();
    assert!(area(&outline) > 3.0, "all in one place: equal steps");
}

/// The four vertices with a single face are the corners of the square, and its sides keep their arc lengths.
#[test]
fn the_corners_of_a_grid_become_those_of_the_square() {
    let mesh = shapes::graded_grid(6, 4, 1.2);
    let outline = outline(&mesh, &BoundaryShape::Square).unwrap();
    assert!((area(&outline) - 1.0).abs() < 1e-12);
    for (vertex, p) in &outline {
        let (position, corner) = (mesh.position(*vertex), mesh.valence(*vertex) == 2);
        // The map of the rectangle to the square, up to a quarter turn.
        let expected = Vec2::new(position.x / 6.0, position.y / 4.0) - Vec2::new(0.5, 0.5);
        let found = p - Vec2::new(0.5, 0.5);
        let turned = [found, Vec2::new(-found.y, found.x), -found, Vec2::new(found.y, -found.x)];
        assert!(turned.iter().any(|turned| (turned - expected).norm() < 1e-12));
        assert_eq!(corner, found.iter().all(|x| (x.abs() - 0.5).abs() < 1e-12));
    }
}

/// Without vertices of a single face the corners spread: each side gets about a quarter of the length.
#[test]
fn a_round_boundary_gets_evenly_spread_corners() {
    let mesh = shapes::disk(8);
    let single =
        mesh.vertices().filter(|&vertex| mesh.is_boundary(vertex) && mesh.valence(vertex) == 2).count();
    assert!(single <= 4);
    let outline = outline(&mesh, &BoundaryShape::Square).unwrap();
    let corner = |p: &Vec2| p.iter().all(|x| *x == 0.0 || *x == 1.0);
    assert_eq!(outline.iter().filter(|(_, p)| corner(p)).count(), 4);
    let bottom = outline.iter().filter(|(_, p)| p.y == 0.0).count();
    let quarter = outline.len() / 4;
    assert!((quarter / 2..2 * quarter).contains(&bottom), "{bottom} of {}", outline.len());
}

/// A staircase has more corners than a square.
#[test]
fn five_single_faces_are_too_many_for_a_square() {
    let mesh = QuadMesh::from_slices(
        &[
            [0., 0., 0.],
            [1., 0., 0.],
            [2., 0., 0.],
            [0., 1., 0.],
            [1., 1., 0.],
            [2., 1., 0.],
            [0., 2., 0.],
            [1., 2., 0.],
        ],
        [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6]],
    )
    .unwrap();
    let refused = outline(&mesh, &BoundaryShape::Square).unwrap_err();
    assert!(matches!(refused, EmbedError::TooManyCorners { count: 5, .. }), "{refused}");
}

/// A single quad fills its shapes.
#[test]
fn a_single_quad() {
    let mesh = shapes::grid(1, 1);
    for (shape, expected) in
        [(BoundaryShape::Circle, 2.0), (BoundaryShape::Square, 1.0), (BoundaryShape::Projection, 1.0)]
    {
        assert!((area(&outline(&mesh, &shape).unwrap()) - expected).abs() < 1e-12, "{shape:?}");
    }
}

/// The projection of a flat boundary is congruent to it, wherever the plane lies.
#[test]
fn the_projection_of_a_flat_mesh_is_congruent() {
    let mesh = common::rotated(&shapes::jittered_grid(7, 5, 0.2, 8));
    let outline = outline(&mesh, &BoundaryShape::Projection).unwrap();
    assert!((area(&outline) - 35.0).abs() < 1e-10);
    for (a, p) in &outline {
        for (b, q) in &outline {
            let expected = (mesh.position(*a) - mesh.position(*b)).norm();
            assert!(((p - q).norm() - expected).abs() < 1e-12);
        }
    }
}

/// A boundary that folds over itself in its best plane is refused, and the edges are named.
#[test]
fn folded_projections_are_refused() {
    // A strip that winds once and a half around the axis: its boundary crosses itself seen from anywhere.
    let wound = shapes::cylinder_strip(60, 2, 9.0);
    let refused = outline(&wound, &BoundaryShape::Projection).unwrap_err();
    let EmbedError::BoundaryFolds { edges } = refused else { panic!("{refused}") };
    assert!(edges.iter().flatten().all(|&vertex| wound.is_boundary(vertex)));
    let flat = moved(&shapes::grid(3, 3), |p| qembed::qmesh::Vec3::new(p.x, 0.0, 0.0));
    assert_eq!(outline(&flat, &BoundaryShape::Projection), Err(EmbedError::NoPlane));
}

type Positions = Vec<(VertexId, Vec2)>;

/// Fixed positions are kept to the bit, and have to be complete.
#[test]
fn fixed_boundaries_are_kept_exactly() {
    let mesh = shapes::jittered_grid(4, 3, 0.2, 1);
    let boundary: Vec<VertexId> = mesh.vertices().filter(|&vertex| mesh.is_boundary(vertex)).collect();
    let given: Vec<(VertexId, Vec2)> = boundary
        .iter()
        .map(|&vertex| (vertex, 1e5 * mesh.position(vertex).xy() + Vec2::new(1e7 + 0.1, 3.3)))
        .collect();
    let uv = map(
        &mesh,
        RemovalRule::All,
        &EmbedOptions { boundary: BoundaryShape::Fixed(given.clone()), ..Default::default() },
    );
    for (vertex, position) in &given {
        assert_eq!(uv[*vertex], *position);
    }

    let refusal = |change: &dyn Fn(&mut Positions)| {
        let mut positions = given.clone();
        change(&mut positions);
        outline(&mesh, &BoundaryShape::Fixed(positions)).unwrap_err()
    };
    let inside = mesh.vertices().find(|&vertex| !mesh.is_boundary(vertex)).unwrap();
    let first = given[0].0;
    assert_eq!(
        refusal(&|list| list.push((inside, Vec2::zeros()))),
        EmbedError::FixedInside { vertex: inside }
    );
    let beyond = VertexId(99);
    assert_eq!(
        refusal(&|list| list.push((beyond, Vec2::zeros()))),
        EmbedError::FixedInside { vertex: beyond }
    );
    assert_eq!(refusal(&|list| list.push(list[0])), EmbedError::FixedTwice { vertex: first });
    let missing = refusal(&|list| *list = list.split_off(1));
    assert_eq!(missing, EmbedError::FixedMissing { vertex: first, count: boundary.len() });
    for bad in [f64::NAN, f64::INFINITY, 1e200] {
        assert_eq!(refusal(&|list| list[0].1.y = bad), EmbedError::FixedNotFinite { vertex: first });
    }
}

/// All boundary vertices given one place: everything goes there, without an error.
#[test]
fn a_collapsed_fixed_boundary_collapses_the_map() {
    let mesh = shapes::grid(3, 3);
    let here = Vec2::new(2.0, 5.0);
    let boundary = mesh.vertices().filter(|&vertex| mesh.is_boundary(vertex)).map(|vertex| (vertex, here));
    let options = EmbedOptions { boundary: BoundaryShape::Fixed(boundary.collect()), ..Default::default() };
    let uv: VertexData<Vec2> = map(&mesh, RemovalRule::Guarded, &options);
    assert!(uv.iter().all(|p| (p - here).norm() < 1e-12));
}
