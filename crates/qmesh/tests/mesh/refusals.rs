//! Every refusal, with the elements that it has to name, in the caller's numbers.

use qmesh::{BuildError, COORDINATE_LIMIT, Polygons, QuadMesh};

use crate::samples::{both, faces, grid, lists, moebius};

fn refusal(polygons: Polygons) -> BuildError {
    QuadMesh::build(polygons).expect_err("no mesh")
}

#[test]
fn no_faces() {
    assert_eq!(refusal(Polygons::default()), BuildError::NoFaces);
    assert_eq!(
        refusal(Polygons { positions: grid(1, 1).positions, ..faces([[0u32; 0]; 0]) }),
        BuildError::NoFaces
    );
}

#[test]
fn flat_arrays_that_contradict_each_other() {
    for (face_start, entry) in
        [(vec![1, 4], 0), (vec![0, 3], 1), (vec![0, 5], 1), (vec![0, 3, 1, 4], 2), (vec![0, u32::MAX, 4], 2)]
    {
        assert_eq!(refusal(Polygons { face_start, ..grid(1, 1) }), BuildError::BadFaceStart { entry });
    }
}

#[test]
fn too_few_corners() {
    for corners in 0..3 {
        let mut polygons = grid(2, 1);
        polygons.push_face(&[0, 1][..corners.min(2)]);
        assert_eq!(refusal(polygons), BuildError::TooFewCorners { face: 2, corners });
    }
}

#[test]
fn indices_out_of_range() {
    for vertex in [6, u32::MAX] {
        let mut polygons = grid(2, 1);
        polygons.push_face(&[0, 1, vertex]);
        assert_eq!(refusal(polygons), BuildError::IndexOutOfRange { face: 2, vertex, count: 6 });
    }
}

#[test]
fn repeated_vertices() {
    let long: Vec<u32> = (0..50).chain([17]).collect();
    for (face, vertex) in [(&[0, 1, 1][..], 1), (&[0, 1, 2, 0], 0), (&[0, 1, 0, 2], 0), (&long, 17)] {
        assert_eq!(
            refusal(both(grid(1, 1), &faces([face]))),
            BuildError::RepeatedVertex { face: 1, vertex: vertex + 4 }
        );
    }
}

#[test]
fn coordinates_that_are_no_place() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.1 * COORDINATE_LIMIT, f64::MAX] {
        for axis in 0..3 {
            let mut polygons = grid(2, 2);
            polygons.positions[5][axis] = bad;
            assert_eq!(refusal(polygons), BuildError::NonFiniteCoordinate { vertex: 5 });
        }
    }
    let mut polygons = grid(1, 1);
    polygons.positions[0][0] = -COORDINATE_LIMIT;
    assert!(QuadMesh::build(polygons).is_ok());
}

/// Vertices 0 to 9 are not used: what is named are still the caller's numbers.
#[test]
fn edges_with_three_faces() {
    let polygons = faces([[10, 11, 12], [11, 10, 13], [20, 21, 22], [10, 11, 14]]);
    let expected = BuildError::NonManifoldEdge { vertices: [10, 11], faces: vec![0, 1, 3] };
    assert_eq!(refusal(polygons), expected);

    let polygons = faces([[20, 21, 22], [11, 10, 13], [10, 11, 12], [11, 10, 14]]);
    let expected = BuildError::NonManifoldEdge { vertices: [11, 10], faces: vec![1, 2, 3] };
    assert_eq!(refusal(polygons), expected);
}

#[test]
fn faces_that_run_the_same_way() {
    let polygons = faces([[30, 31, 32], [10, 11, 12], [10, 11, 13]]);
    let expected = BuildError::InconsistentOrientation { vertices: [10, 11], faces: [1, 2] };
    assert_eq!(refusal(polygons), expected);
}

/// A surface with one side has no consistent orientation, however its faces are listed.
#[test]
fn moebius_strips() {
    for length in [3, 4, 7] {
        let strip = moebius(length);
        let quads = lists(&strip);
        let BuildError::InconsistentOrientation { vertices: [a, b], faces: [f, g] } = refusal(strip) else {
            panic!("a Möbius strip of {length} quads was taken for something else");
        };
        assert_ne!(f, g);
        for face in [f, g] {
            let quad = &quads[face as usize];
            assert!(
                (0..4).any(|i| quad[i] == a && quad[(i + 1) % 4] == b),
                "face {face} runs from {a} to {b}"
            );
        }
    }
}

#[test]
fn duplicate_faces() {
    let polygons = faces([[10, 11, 12, 13], [1, 2, 3, 4], [12, 13, 10, 11]]);
    assert_eq!(refusal(polygons), BuildError::DuplicateFaces { faces: [0, 2] });
    // Back to back they are the two sides of a pillow.
    assert!(QuadMesh::build(faces([[0, 1, 2, 3], [3, 2, 1, 0]])).is_ok());
}

#[test]
fn fans_that_touch_in_a_vertex() {
    let bow_tie = faces([[40, 41, 42], [10, 11, 12], [10, 13, 14]]);
    assert_eq!(refusal(bow_tie), BuildError::NonManifoldVertex { vertex: 10, faces: [1, 2] });

    // Two closed fans: two tetrahedra that share a corner.
    let tetrahedron = |a: u32| [[10, a, a + 1], [10, a + 1, a + 2], [10, a + 2, a], [a, a + 2, a + 1]];
    let polygons = faces([tetrahedron(20), tetrahedron(30)].concat());
    assert_eq!(refusal(polygons), BuildError::NonManifoldVertex { vertex: 10, faces: [0, 4] });
}

/// What people read.
#[test]
fn messages() {
    let mut many = vec![[0, 1, 2]];
    many.extend((3..12).map(|v| [1, 0, v]));
    let mut far = grid(1, 1);
    far.positions[3].z = f64::INFINITY;
    let said: Vec<String> = [
        Polygons::default(),
        Polygons { face_start: vec![0, 9], ..grid(1, 1) },
        faces([&[0, 1][..]]),
        Polygons { positions: grid(1, 1).positions, ..faces([[0, 1, 9]]) },
        faces([[0, 1, 2, 1]]),
        far,
        faces(many),
        moebius(3),
        faces([[0, 1, 2], [1, 2, 0]]),
        faces([[0, 1, 2], [0, 3, 4]]),
    ]
    .map(|polygons| refusal(polygons).to_string())
    .into();
    insta::assert_snapshot!(said.join("\n"));
    let huge = BuildError::TooLarge { what: "corners", count: 5_000_000_000 };
    insta::assert_snapshot!(huge, @"too large: 5000000000 corners, at most 2147483647 are possible");
}
