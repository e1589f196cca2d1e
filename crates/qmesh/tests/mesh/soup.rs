//! Random indices: no panic, and whatever is refused deserves it.

use std::collections::HashMap;

use proptest::collection::vec;
use proptest::prelude::*;
use qmesh::{BuildError, Polygons, QuadMesh};

use crate::halfedges::assert_invariants;
use crate::samples::lists;

fn soup() -> impl Strategy<Value = Polygons> {
    (3u32..12).prop_flat_map(|count| {
        let face = vec(0..count + u32::from(count == 7), 2..6).prop_map(|mut face| {
            // Repeated vertices would hide all other faults.
            if face.len() > 2 && face[0] % 4 != 0 {
                let mut seen = Vec::new();
                face.retain(|v| {
                    !seen.contains(v) && {
                        seen.push(*v);
                        true
                    }
                });
            }
            face
        });
        vec(face, 0..9).prop_map(move |faces| {
            let mut polygons = Polygons::new(&vec![[0.5, 1.0, -2.0]; count as usize], faces);
            polygons.face_start.shrink_to_fit();
            polygons
        })
    })
}

/// The faces at each directed edge.
fn directed_edges(faces: &[Vec<u32>]) -> HashMap<[u32; 2], Vec<u32>> {
    let mut edges: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for (index, face) in faces.iter().enumerate() {
        for (i, &from) in face.iter().enumerate() {
            edges.entry([from, face[(i + 1) % face.len()]]).or_default().push(index as u32);
        }
    }
    edges
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]

    #[test]
    fn soup_is_a_mesh_or_is_refused_for_a_reason(polygons in soup()) {
        let faces = lists(&polygons);
        let edges = directed_edges(&faces);
        let along = |[a, b]: [u32; 2]| edges.get(&[a, b]).cloned().unwrap_or_default();
        match QuadMesh::build(polygons.clone()) {
            Ok(mesh) => {
                assert_invariants(&mesh);
                prop_assert!(edges.values().all(|faces| faces.len() == 1));
            }
            Err(BuildError::NoFaces) => prop_assert!(faces.is_empty()),
            Err(BuildError::TooFewCorners { face, corners }) => {
                prop_assert!(corners < 3 && faces[face as usize].len() == corners);
            }
            Err(BuildError::IndexOutOfRange { face, vertex, count }) => {
                prop_assert!(vertex as usize >= count && faces[face as usize].contains(&vertex));
            }
            Err(BuildError::RepeatedVertex { face, vertex }) => {
                prop_assert!(faces[face as usize].iter().filter(|&&v| v == vertex).count() > 1);
            }
            Err(BuildError::NonManifoldEdge { vertices: [a, b], faces }) => {
                let mut expected = [along([a, b]), along([b, a])].concat();
                expected.sort_unstable();
                prop_assert!(faces.len() > 2);
                prop_assert_eq!(faces, expected);
            }
            Err(BuildError::InconsistentOrientation { vertices, faces }) => {
                prop_assert_eq!(&along(vertices), &faces);
            }
            Err(BuildError::DuplicateFaces { faces: [a, b] }) => {
                let (a, b) = (&faces[a as usize], &faces[b as usize]);
                prop_assert!((0..a.len()).any(|shift| [&a[shift..], &a[..shift]].concat() == *b));
            }
            Err(BuildError::NonManifoldVertex { vertex, faces: [a, b] }) => {
                prop_assert!(a != b && !are_in_one_fan(&faces, vertex, a, b));
            }
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    /// Flat arrays of any kind: no panic.
    #[test]
    fn any_flat_arrays_are_a_mesh_or_are_refused(
        face_start in vec(0u32..20, 0..6),
        corner_vertex in vec(prop_oneof![0u32..9, Just(u32::MAX)], 0..20),
        count in 0usize..9,
    ) {
        let positions = vec![qmesh::Vec3::zeros(); count];
        if let Ok(mesh) = QuadMesh::build(Polygons { positions, face_start, corner_vertex }) {
            assert_invariants(&mesh);
        }
    }
}

/// Whether one gets from `a` to `b` about `vertex` through faces that share an edge there.
fn are_in_one_fan(faces: &[Vec<u32>], vertex: u32, a: u32, b: u32) -> bool {
    let spokes = |face: u32| {
        let face = &faces[face as usize];
        let at = face.iter().position(|&v| v == vertex).expect("the vertex is in the face");
        [face[(at + 1) % face.len()], face[(at + face.len() - 1) % face.len()]]
    };
    let around: Vec<u32> = (0..faces.len() as u32).filter(|&f| faces[f as usize].contains(&vertex)).collect();
    let mut reached = vec![a];
    let mut next = 0;
    while let Some(&face) = reached.get(next) {
        next += 1;
        for &other in &around {
            if !reached.contains(&other) && spokes(face).iter().any(|spoke| spokes(other).contains(spoke)) {
                reached.push(other);
            }
        }
    }
    reached.contains(&b)
}
