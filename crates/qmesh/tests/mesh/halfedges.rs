//! What every mesh keeps, whatever it was built from.

use proptest::prelude::*;
use qmesh::{BuildError, HalfedgeId, Id, Polygons, QuadMesh};

use crate::samples::{both, cube, grid, lists, patchwork, ring, torus};

/// The invariants of halfedge connectivity.
pub(crate) fn assert_invariants(mesh: &QuadMesh) {
    let halfedges = || (0..mesh.halfedge_count()).map(HalfedgeId::from_index);
    let mut arrived = vec![false; mesh.halfedge_count()];
    for h in halfedges() {
        let (twin, next) = (mesh.twin(h), mesh.next(h));
        assert!(twin != h && mesh.twin(twin) == h, "twin is an involution without fixed points: {h:?}");
        assert_eq!((mesh.origin(twin), mesh.target(twin)), (mesh.target(h), mesh.origin(h)));
        assert_eq!(mesh.edge(twin), mesh.edge(h));
        assert!([h, twin].contains(&mesh.halfedge(mesh.edge(h))));
        assert!(!(mesh.is_boundary_halfedge(h) && mesh.is_boundary_halfedge(twin)), "an edge without a face");

        assert_eq!(mesh.origin(next), mesh.target(h), "next starts where its predecessor ends: {h:?}");
        assert_eq!(mesh.corner(next).map(|c| mesh.face(c)), mesh.corner(h).map(|c| mesh.face(c)));
        assert!(!std::mem::replace(&mut arrived[next.index()], true), "next is a permutation: {next:?}");
    }
    assert_eq!(mesh.halfedge_count(), 2 * mesh.edge_count());
    assert_eq!(mesh.halfedge_count() - mesh.corner_count(), mesh.boundary_halfedges().len());
    for edge in mesh.edges() {
        let h = mesh.halfedge(edge);
        assert!(mesh.edge(h) == edge && !mesh.is_boundary_halfedge(h) && h.index() < mesh.corner_count());
        assert_eq!(mesh.is_boundary_edge(edge), mesh.is_boundary_halfedge(mesh.twin(h)));
    }
    assert_faces(mesh);
    assert_rotations(mesh);
    assert_loops(mesh);
}

fn assert_faces(mesh: &QuadMesh) {
    let mut corners = mesh.corners();
    for face in mesh.faces() {
        assert_eq!(mesh.face_corners(face).len(), mesh.degree(face));
        for (corner, vertex) in mesh.face_corners(face).zip(mesh.face_vertices(face)) {
            assert_eq!(corners.next(), Some(corner), "corners are numbered face after face");
            assert_eq!((mesh.face(corner), mesh.vertex(corner)), (face, vertex));
            assert_eq!(mesh.previous_corner(mesh.next_corner(corner)), corner);
            assert_eq!(mesh.next(corner.halfedge()), mesh.next_corner(corner).halfedge());
        }
    }
    assert_eq!(corners.next(), None);
}

/// Turning about each vertex meets each halfedge and each corner once, and a gap at the boundary only.
fn assert_rotations(mesh: &QuadMesh) {
    let mut halfedges_met = vec![0; mesh.halfedge_count()];
    let mut corners_met = vec![0; mesh.corner_count()];
    for vertex in mesh.vertices() {
        let outgoing: Vec<HalfedgeId> = mesh.outgoing(vertex).collect();
        for (&h, after) in outgoing.iter().zip(outgoing.iter().cycle().skip(1)) {
            assert_eq!(mesh.origin(h), vertex);
            halfedges_met[h.index()] += 1;
            if let Some(corner) = mesh.corner(h) {
                let turned = mesh.twin(mesh.previous_corner(corner).halfedge());
                assert_eq!(*after, turned, "counter-clockwise about {vertex:?}");
            }
        }
        let gaps = outgoing.iter().filter(|&&h| mesh.is_boundary_halfedge(h)).count();
        assert_eq!(gaps, usize::from(mesh.is_boundary(vertex)));
        assert!(gaps == 0 || outgoing.last().is_some_and(|&h| mesh.is_boundary_halfedge(h)));
        assert_eq!(mesh.valence(vertex), outgoing.len());
        for corner in mesh.vertex_corners(vertex) {
            assert_eq!(mesh.vertex(corner), vertex);
            corners_met[corner.index()] += 1;
        }
        assert!(mesh.neighbors(vertex).eq(outgoing.iter().map(|&h| mesh.target(h))));
    }
    assert!(halfedges_met.iter().all(|&times| times == 1));
    assert!(corners_met.iter().all(|&times| times == 1));
}

/// Boundary loops are closed walks that share out the boundary halfedges.
fn assert_loops(mesh: &QuadMesh) {
    let loops = mesh.boundary_loops();
    for walk in &loops {
        for (&h, &after) in walk.iter().zip(walk.iter().cycle().skip(1)) {
            assert_eq!(mesh.next(h), after);
        }
        let vertices = mesh.loop_vertices(walk);
        let mut distinct = vertices.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), vertices.len(), "a loop visits no vertex twice");
    }
    let mut walked: Vec<HalfedgeId> = loops.concat();
    walked.sort_unstable();
    assert!(walked.into_iter().eq(mesh.boundary_halfedges()));
}

#[test]
fn handmade_meshes_keep_the_invariants() {
    for polygons in [grid(1, 1), grid(5, 3), ring(3, 2), torus(3, 4), cube(), both(cube(), &grid(2, 2))] {
        assert_invariants(&QuadMesh::build(polygons).expect("a mesh"));
    }
}

proptest! {
    /// Any patchwork is a mesh with all invariants, or touches itself in the vertex that is named.
    #[test]
    fn patchworks_keep_the_invariants(polygons in patchwork()) {
        match QuadMesh::build(polygons.clone()) {
            Ok(mesh) => {
                assert_invariants(&mesh);
                assert_same_as_input(&mesh, &polygons);
            }
            Err(BuildError::NonManifoldVertex { vertex, faces }) => {
                let lists = lists(&polygons);
                prop_assert!(faces.iter().all(|&face| lists[face as usize].contains(&vertex)));
                prop_assert!(faces[0] != faces[1]);
            }
            Err(BuildError::NoFaces) => prop_assert!(polygons.corner_vertex.is_empty()),
            Err(other) => prop_assert!(false, "{}", other),
        }
    }
}

/// Faces keep their order, corners theirs, and vertices lead back to where they were.
fn assert_same_as_input(mesh: &QuadMesh, polygons: &Polygons) {
    assert_eq!(mesh.source_vertex_count(), polygons.positions.len());
    assert_eq!(mesh.face_count(), polygons.view().face_count());
    for (face, list) in mesh.faces().zip(lists(polygons)) {
        let sources: Vec<u32> = mesh.face_vertices(face).map(|v| mesh.source_vertex(v)).collect();
        assert_eq!(sources, list);
    }
    let sources: Vec<u32> = mesh.vertices().map(|v| mesh.source_vertex(v)).collect();
    assert!(sources.is_sorted_by(|a, b| a < b), "vertices keep their order");
    for vertex in mesh.vertices() {
        assert_eq!(mesh.position(vertex), polygons.positions[mesh.source_vertex(vertex) as usize]);
    }
}

/// The surface lies to the left of a loop's vertices: counter-clockwise outside, clockwise around a hole.
#[test]
fn loops_keep_the_surface_on_their_left() {
    let mut holed = grid(3, 3);
    let kept: Vec<Vec<u32>> =
        lists(&holed).into_iter().enumerate().filter(|(i, _)| *i != 4).map(|(_, f)| f).collect();
    holed = Polygons { positions: holed.positions, ..crate::samples::faces(kept) };
    let mesh = QuadMesh::build(holed).expect("a grid with a hole");
    let areas: Vec<f64> = mesh
        .boundary_loops()
        .iter()
        .map(|walk| {
            let points: Vec<_> = mesh.loop_vertices(walk).into_iter().map(|v| mesh.position(v)).collect();
            let pairs = points.iter().zip(points.iter().cycle().skip(1));
            pairs.map(|(p, q)| 0.5 * (p.x * q.y - p.y * q.x)).sum()
        })
        .collect();
    assert_eq!(areas, [9.0, -1.0]);
}
