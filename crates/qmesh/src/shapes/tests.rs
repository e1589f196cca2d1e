//! What every shape promises: quads, orientation, topology, symmetry, and no input that panics.

use std::collections::HashMap;

use super::*;
use crate::{FaceId, QuadMesh, Vec3};

/// Components, boundary loops and `χ` of a disk.
const DISK: [i64; 3] = [1, 1, 1];

/// Twice the area of a quad as a vector along its normal.
fn area_vector(mesh: &QuadMesh, face: FaceId) -> Vec3 {
    let p: Vec<Vec3> = mesh.face_vertices(face).map(|v| mesh.position(v)).collect();
    (p[2] - p[0]).cross(&(p[3] - p[1]))
}

fn center(mesh: &QuadMesh, face: FaceId) -> Vec3 {
    mesh.face_vertices(face).map(|v| mesh.position(v)).sum::<Vec3>() / 4.0
}

/// Quads only, the stated topology, positive areas, strictly convex corners, normals along `outward`.
fn check(name: &str, mesh: &QuadMesh, topology: [i64; 3], outward: impl Fn(Vec3) -> Vec3) {
    let found = mesh.topology();
    let found_counts = [found.components as i64, found.boundary_loops as i64, found.euler_characteristic];
    assert_eq!(found_counts, topology, "{name}: components, loops, χ");
    assert_eq!(mesh.source_vertex_count(), mesh.vertex_count(), "{name}: every vertex is used");
    for face in mesh.faces() {
        assert_eq!(mesh.degree(face), 4, "{name}: {face:?}");
        let normal = area_vector(mesh, face);
        assert!(normal.dot(&outward(center(mesh, face))) > 0.0, "{name}: {face:?} looks the wrong way");
        for corner in mesh.face_corners(face) {
            let [a, b] = mesh.corner_vectors(corner);
            assert!(a.cross(&b).dot(&normal) > 0.0, "{name}: {face:?} is not convex at {corner:?}");
        }
    }
}

fn up(_: Vec3) -> Vec3 {
    Vec3::z()
}

/// Mirroring maps the set of vertices onto itself.
fn check_mirror(name: &str, mesh: &QuadMesh, axis: usize) {
    const DIGITS: f64 = 1e7;
    let key = |p: Vec3| [p.x, p.y, p.z].map(|c| (c * DIGITS).round() as i64);
    // Rounding may part twins: their neighbours in the lattice of keys count as well.
    let mut vertices: HashMap<[i64; 3], usize> = HashMap::new();
    for p in mesh.positions().iter() {
        *vertices.entry(key(*p)).or_default() += 1;
    }
    for (vertex, p) in mesh.positions().entries() {
        let mut mirrored = *p;
        mirrored[axis] = -mirrored[axis];
        let k = key(mirrored);
        let near = (0..27).map(|n| [k[0] + n % 3 - 1, k[1] + n / 3 % 3 - 1, k[2] + n / 9 - 1]);
        assert!(
            near.into_iter().any(|k| vertices.contains_key(&k)),
            "{name}: {vertex:?} has no mirror image"
        );
    }
}

#[test]
fn flat_shapes_and_height_fields_face_up() {
    for (columns, rows) in [(0, 0), (1, 1), (1, 9), (7, 3), (16, 16)] {
        let name = format!("{columns} × {rows}");
        check(&name, &grid(columns, rows), DISK, up);
        assert_eq!(grid(columns, rows).face_count(), columns.max(1) * rows.max(1), "{name}");
        for ratio in [1.0, 0.5, 1.3, 1e300, -1.0, f64::NAN] {
            check(&format!("graded {name} by {ratio}"), &graded_grid(columns, rows, ratio), DISK, up);
        }
        for amount in [0.0, 0.1, 0.24, 99.0, f64::NAN, f64::INFINITY] {
            for seed in [0, 1, 42] {
                let mesh = jittered_grid(columns, rows, amount, seed);
                check(&format!("jittered {name} by {amount}, seed {seed}"), &mesh, DISK, up);
            }
        }
    }
    for cells in [0, 1, 2, 5, 10, 33] {
        for height in [0.0, 0.5, -0.5, 3.0, f64::NAN, f64::NEG_INFINITY] {
            check(&format!("bump {cells}, {height}"), &bump(cells, height), DISK, up);
        }
        for (name, mesh) in [("nose", nose(cells)), ("saddle", saddle(cells))] {
            check(&format!("{name} {cells}"), &mesh, DISK, up);
            check_mirror(name, &mesh, 0);
        }
        check_mirror("saddle", &saddle(cells), 1);
    }
}

#[test]
fn round_shapes_face_outwards() {
    let from_axis = |p: Vec3| Vec3::new(p.x, p.y, 0.0);
    for rings in [0, 1, 2, 5, 9] {
        let name = format!("{rings} rings");
        check(&format!("disk of {name}"), &disk(rings), DISK, up);
        assert_eq!(disk(rings).face_count(), 12 * rings.max(1).pow(2));
        for angle in [0.0, 0.3, 1.5, 2.6, 3.0, f64::NAN, f64::INFINITY] {
            check(&format!("cap of {name}, {angle} rad"), &cap(rings, angle), DISK, |p| p);
        }
        for rows in [0, 1, 30] {
            let mesh = finger(rings, rows);
            let tip = mesh.positions().iter().map(|p| p.z).fold(0.0, f64::max) - 1.0;
            let outward = |p: Vec3| Vec3::new(p.x, p.y, (p.z - tip).max(0.0));
            check(&format!("finger of {name}, {rows} rows"), &mesh, DISK, outward);
        }
        for (name, mesh) in [("disk", disk(rings)), ("cap", cap(rings, 1.2)), ("finger", finger(rings, 5))] {
            check_mirror(name, &mesh, 0);
            check_mirror(name, &mesh, 1);
        }
    }
    for cells in [0, 1, 2, 3, 4, 7, 12] {
        let mesh = sphere(cells);
        check(&format!("sphere of {cells}"), &mesh, [1, 0, 2], |p| p);
        assert_eq!(mesh.face_count(), 6 * cells.max(1).pow(2));
        (0..3).for_each(|axis| check_mirror("sphere", &mesh, axis));
    }
    for (columns, rows) in [(0, 0), (3, 1), (5, 3), (24, 10)] {
        let name = format!("{columns} × {rows}");
        check(&format!("cylinder {name}"), &cylinder(columns, rows), [1, 2, 0], from_axis);
        // The centres of faces lie over the chords of the circle that the tube is wound around.
        let apothem = (std::f64::consts::PI / columns.max(3) as f64).cos();
        let ring = |p: Vec3| p - from_axis(p) * (apothem / from_axis(p).norm());
        check(&format!("torus {name}"), &torus(columns, rows), [1, 0, 0], ring);
        assert_eq!(torus(columns, rows).topology().genus, 1);
        for angle in [0.0, 1.0, 4.5, 6.2, f64::NAN, f64::INFINITY] {
            // With one or two columns, a chord can pass on the other side of the axis.
            let mesh = cylinder_strip(columns.max(3), rows, angle);
            check(&format!("strip {name}, {angle} rad"), &mesh, DISK, from_axis);
        }
    }
}

/// The strip is developable: flat squares of one size, so it unrolls onto the grid.
#[test]
fn a_cylinder_strip_is_made_of_equal_flat_squares() {
    let mesh = cylinder_strip(20, 7, 5.0);
    let side = mesh.edge_length(crate::EdgeId(0));
    for edge in mesh.edges() {
        assert!((mesh.edge_length(edge) - side).abs() < 1e-13, "{edge:?}");
    }
    for corner in mesh.corners() {
        let [a, b] = mesh.corner_vectors(corner);
        assert!(a.dot(&b).abs() < 1e-13, "{corner:?}");
    }
}

/// Face and head are seen from their middle: every normal leaves the axis, or points down under nose, chin and ears.
#[test]
fn face_and_head_are_clean_disks_at_every_resolution() {
    for detail in [0, 1, 2, 3, 5] {
        for (name, mesh, quads) in [("face", face(detail), 176), ("head", head(detail), 680)] {
            let name = format!("{name} of detail {detail}");
            assert_eq!(mesh.face_count(), quads * detail.max(1).pow(2), "{name}");
            check(&name, &mesh, DISK, |p| p - anatomy::origin(p));
            check_mirror(&name, &mesh, 0);
            let mut areas: Vec<f64> = mesh.faces().map(|face| area_vector(&mesh, face).norm()).collect();
            areas.sort_unstable_by(f64::total_cmp);
            assert!(areas[areas.len() - 1] < 100.0 * areas[0], "{name}: areas differ too much");
        }
    }
}

/// The mesh converges to one surface: more detail moves no point of it by more than a small part of a quad.
#[test]
fn more_detail_refines_the_same_head() {
    let (coarse, fine) = (head(2), head(4));
    let shared = head(1).vertex_count();
    for (a, b) in coarse.positions().iter().zip(fine.positions().iter()).take(shared) {
        assert!((a - b).norm() < 1e-9, "the vertices of the cage come first and stay");
    }
    for vertex in coarse.vertices() {
        let away = |p: &Vec3| (p - coarse.position(vertex)).norm();
        let nearest = fine.positions().iter().map(away).fold(f64::INFINITY, f64::min);
        let longest = coarse.outgoing(vertex).map(|h| coarse.edge_length(coarse.edge(h))).fold(0.0, f64::max);
        assert!(nearest < 1e-9 * longest, "{vertex}: {nearest} of {longest}");
    }
}

/// In decimetres, what makes a head a head: the order of its features from above, and the nose as the foremost point.
#[test]
fn a_head_has_human_proportions() {
    let mesh = head(4);
    let foremost = |low: f64, high: f64| {
        let middle = mesh.positions().iter().filter(|p| p.x.abs() < 0.03 && p.y > low && p.y < high);
        middle.map(|p| p.z).fold(f64::MIN, f64::max)
    };
    let [forehead, root, nose, lip, chin] =
        [(0.2, 0.5), (0.0, 0.1), (-0.5, -0.3), (-0.8, -0.65), (-1.1, -0.95)].map(|(a, b)| foremost(a, b));
    assert!(nose > lip && lip > chin && nose > forehead && forehead > root - 0.05, "profile");
    let extent = |axis: usize| mesh.positions().iter().map(|p| p[axis]).fold(f64::MIN, f64::max);
    assert!((extent(2) - nose).abs() < 1e-12, "nothing reaches farther than the nose");
    assert!((1.0..1.2).contains(&extent(1)) && (0.7..0.85).contains(&extent(0)), "crown and ears");
    let [rim] = &mesh.boundary_loops()[..] else { panic!("one loop") };
    assert!(rim.iter().all(|&h| mesh.position(mesh.origin(h)).y < -1.6), "the neck is the boundary");
}

#[test]
fn a_union_keeps_both_parts_clear_of_each_other() {
    let both = disjoint_union(&torus(6, 4), &sphere(2)).unwrap();
    let topology = both.topology();
    assert_eq!((topology.components, topology.genus, topology.euler_characteristic), (2, 1, 2));
    let (first, second) = both.positions().split_at(24);
    let right = first.iter().map(|p| p.x).fold(f64::MIN, f64::max);
    assert!(second.iter().all(|p| p.x > right));
    let at = |x: f64| grid(1, 1).with_positions(crate::VertexData::filled(4, Vec3::repeat(x)));
    let error = disjoint_union(&at(1e300), &grid(1, 1)).unwrap_err();
    assert_eq!(error, crate::BuildError::NonFiniteCoordinate { vertex: 0 });
}
