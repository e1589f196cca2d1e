//! Vertices with very many edges. These tests would not end if building took quadratic time.

use qmesh::QuadMesh;

use crate::halfedges::assert_invariants;
use crate::samples::faces;

/// `K(2, n)` on the sphere: two poles, and `n` quads between them.
#[test]
fn two_poles_of_valence_two_hundred_thousand() {
    let n = 200_000;
    let mesh = QuadMesh::build(faces((0..n).map(|i| [n, i, n + 1, (i + 1) % n]))).expect("a mesh");
    assert_eq!(mesh.topology().genus, 0);
    assert_eq!(mesh.vertices().map(|v| mesh.valence(v)).max(), Some(n as usize));
}

/// `K(n, n)` with even `n` fills a closed surface with quads (Ringel 1965): turn one way about the even vertices of
/// both sides and the other way about the odd ones. Every edge then has two poles.
#[test]
fn complete_bipartite_graphs() {
    for (n, check) in [(4u32, true), (10, true), (300, false)] {
        let mesh = QuadMesh::build(faces(complete_bipartite(n))).expect("a mesh");
        let n = i64::from(n);
        let numbers = (mesh.vertex_count() as i64, mesh.edge_count() as i64, mesh.face_count() as i64);
        assert_eq!(numbers, (2 * n, n * n, n * n / 2));
        assert_eq!(mesh.topology().genus, (n - 2) * (n - 2) / 4);
        if check {
            assert_invariants(&mesh);
        }
    }
}

fn complete_bipartite(n: u32) -> Vec<[u32; 4]> {
    let turn =
        |about: u32, from: u32| if about.is_multiple_of(2) { (from + 1) % n } else { (from + n - 1) % n };
    let mut seen = vec![false; (n * n) as usize];
    let mut quads = Vec::new();
    for a in 0..n {
        for b in 0..n {
            // Arrive at b from a, turn to c; arrive at c, turn to d; and so on back to a.
            let c = turn(b, a);
            let d = turn(c, b);
            assert_eq!((turn(d, c), turn(a, d)), (a, b), "the face closes after four edges");
            if !std::mem::replace(&mut seen[(a * n + b) as usize], true) {
                seen[(c * n + d) as usize] = true;
                quads.push([a, n + b, c, n + d]);
            }
        }
    }
    quads
}

/// A face with very many corners, and a vertex that is named very often.
#[test]
fn one_large_face() {
    let n = 100_000;
    let mesh = QuadMesh::build(faces([(0..n).collect::<Vec<u32>>()])).expect("a mesh");
    assert_eq!((mesh.edge_count(), mesh.boundary_loops().len()), (n as usize, 1));
}
