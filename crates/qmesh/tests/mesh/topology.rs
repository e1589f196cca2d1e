//! `χ = #V − #E + #F = 2·(components − genus) − loops`.

use proptest::prelude::*;
use qmesh::{Polygons, QuadMesh, Topology};

use crate::samples::{both, cube, faces, grid, lists, patchwork, ring, torus};

fn numbers(polygons: Polygons) -> (usize, usize, i64, i64) {
    let Topology { components, boundary_loops, euler_characteristic, genus, .. } =
        QuadMesh::build(polygons).expect("a mesh").topology();
    (components, boundary_loops, euler_characteristic, genus)
}

/// Two tori with a face removed from each, glued along the gap: a surface of genus 2.
fn double_torus() -> Polygons {
    let mut first = lists(&torus(4, 4));
    let gap = first.remove(0);
    let mut second = lists(&torus(4, 4));
    let other_gap = second.remove(0);
    // Seen from the other side, the gap runs the other way.
    let glue = |v: u32| match other_gap.iter().position(|&w| w == v) {
        Some(i) => gap[(4 - i) % 4],
        None => v + 16,
    };
    first.extend(second.iter().map(|face| face.iter().map(|&v| glue(v)).collect::<Vec<u32>>()));
    faces(first)
}

#[test]
fn components_loops_characteristic_and_genus() {
    let pillow = || faces([[0, 1, 2, 3], [3, 2, 1, 0]]);
    assert_eq!(numbers(grid(4, 3)), (1, 1, 1, 0));
    assert_eq!(numbers(ring(5, 2)), (1, 2, 0, 0));
    assert_eq!(numbers(cube()), (1, 0, 2, 0));
    assert_eq!(numbers(pillow()), (1, 0, 2, 0));
    assert_eq!(numbers(torus(3, 5)), (1, 0, 0, 1));
    assert_eq!(numbers(double_torus()), (1, 0, -2, 2));
    assert_eq!(numbers(both(double_torus(), &both(cube(), &grid(1, 1)))), (3, 1, 1, 2));
    let open = |polygons: Polygons| faces(lists(&polygons).split_off(1));
    assert_eq!(numbers(open(cube())), (1, 1, 1, 0));
    assert_eq!(numbers(open(torus(4, 4))), (1, 1, -1, 1));
}

#[test]
fn only_one_piece_without_holes_and_handles_is_a_disk() {
    let is_disk = |polygons| QuadMesh::build(polygons).expect("a mesh").topology().is_disk();
    assert!(is_disk(grid(1, 1)) && is_disk(faces(lists(&cube()).split_off(1))));
    assert!(!is_disk(cube()) && !is_disk(ring(4, 1)) && !is_disk(both(grid(1, 1), &grid(1, 1))));
    assert!(!is_disk(faces(lists(&torus(4, 4)).split_off(1))), "one loop, but a handle");
}

#[test]
fn components_are_numbered_by_their_first_face() {
    let mesh = QuadMesh::build(faces([[0, 1, 2], [9, 10, 11], [2, 1, 3], [11, 10, 12], [20, 21, 22]]))
        .expect("a mesh");
    let (components, count) = mesh.components();
    assert_eq!((components.to_vec(), count), (vec![0, 1, 0, 1, 2], 3));
}

#[test]
fn faces_are_counted_by_kind() {
    let mesh = QuadMesh::build(faces([vec![0, 1, 2], vec![2, 1, 3, 4], vec![4, 3, 5, 6, 7], vec![8, 9, 10]]))
        .expect("a mesh");
    let counts = mesh.face_counts();
    assert_eq!((counts.triangles, counts.quads, counts.polygons), (2, 1, 1));
}

/// A permutation of `count` things.
fn permutation(count: usize, seed: u64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..count as u32).collect();
    order.sort_by_key(|&i| {
        (u64::from(i) + seed).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(seed as u32 % 64)
    });
    order
}

proptest! {
    /// Other numbers for vertices, another order of faces and another first corner are the same surface.
    #[test]
    fn numbering_means_nothing(polygons in patchwork(), seed in any::<u64>()) {
        let vertices = permutation(polygons.positions.len(), seed);
        let order = permutation(polygons.view().face_count(), seed ^ 77);
        let mut renumbered = Polygons { positions: polygons.positions.clone(), ..Polygons::default() };
        for (position, &new) in polygons.positions.iter().zip(&vertices) {
            renumbered.positions[new as usize] = *position;
        }
        for &face in &order {
            let mut list: Vec<u32> = polygons.view().face(face as usize).iter().map(|&v| vertices[v as usize]).collect();
            list.rotate_left(seed as usize % 3);
            renumbered.push_face(&list);
        }
        match (QuadMesh::build(polygons), QuadMesh::build(renumbered)) {
            (Ok(one), Ok(other)) => {
                prop_assert_eq!(one.topology(), other.topology());
                prop_assert_eq!(one.face_counts(), other.face_counts());
                let signature = |mesh: &QuadMesh, name: &dyn Fn(u32) -> u32| {
                    let mut rings: Vec<_> = mesh.vertices().map(|v| {
                        let mut ring: Vec<u32> = mesh.neighbors(v).map(|n| name(mesh.source_vertex(n))).collect();
                        ring.sort_unstable();
                        (name(mesh.source_vertex(v)), mesh.is_boundary(v), ring)
                    }).collect();
                    rings.sort();
                    rings
                };
                prop_assert_eq!(signature(&one, &|v| vertices[v as usize]), signature(&other, &|v| v));
            }
            (Err(one), Err(other)) => {
                prop_assert_eq!(std::mem::discriminant(&one), std::mem::discriminant(&other));
            }
            (one, other) => prop_assert!(false, "{:?} but {:?}", one.err(), other.err()),
        }
    }

    /// The components of a mesh are meshes whose numbers add up to its own.
    #[test]
    fn numbers_add_up_over_components(one in patchwork(), other in patchwork()) {
        if let (Ok(a), Ok(b)) = (QuadMesh::build(one.clone()), QuadMesh::build(other.clone())) {
            let (a, b) = (a.topology(), b.topology());
            let sum = (a.components + b.components, a.boundary_loops + b.boundary_loops, a.euler_characteristic + b.euler_characteristic, a.genus + b.genus);
            prop_assert_eq!(numbers(both(one, &other)), sum);
            prop_assert!(a.genus >= 0 && 2 * (a.components as i64 - a.genus) - a.boundary_loops as i64 == a.euler_characteristic);
        }
    }
}

/// Filling holes makes a disk that contains the mesh, corner for corner; without holes there is nothing to fill.
#[test]
fn filled_holes_leave_the_mesh_as_it_is() {
    for (polygons, holes) in [
        (ring(6, 2), 1),
        (
            faces(
                lists(&grid(7, 7))
                    .into_iter()
                    .enumerate()
                    .filter(|(i, _)| ![8, 10, 24, 25].contains(i))
                    .map(|(_, face)| face),
            ),
            3,
        ),
    ] {
        let mesh = QuadMesh::build(polygons).expect("a mesh");
        let filled = mesh.filled().expect("there are holes");
        assert!(filled.topology().is_disk());
        assert_eq!(filled.vertex_count(), mesh.vertex_count() + holes);
        assert_eq!(filled.view().corner_vertex[..mesh.corner_count()], *mesh.view().corner_vertex);
        assert!(mesh.vertices().all(|vertex| filled.position(vertex) == mesh.position(vertex)));
        let outer = |mesh: &QuadMesh| {
            let mut loops = mesh.boundary_loops();
            mesh.outer_first(&mut loops);
            mesh.loop_vertices(&loops[0])
        };
        assert_eq!(outer(&filled), outer(&mesh), "the longest loop stays");
    }
    assert_eq!(QuadMesh::build(grid(2, 2)).expect("a mesh").filled(), None);
    assert_eq!(QuadMesh::build(cube()).expect("a mesh").filled(), None);
}
