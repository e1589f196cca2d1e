//! Meshes, and what tests ask of maps.
#![allow(dead_code)] // each test file uses its own part

use std::f64::consts::TAU;

use qembed::qmesh::nalgebra::Rotation3;
use qembed::qmesh::{FaceId, Id, QuadMesh, Vec2, Vec3, VertexData, VertexId, shapes};
use qembed::qsimplify::{RemovalRule, Simplified, SimplifyOptions, simplify};
use qembed::{BoundaryShape, EmbedOptions, embed};

pub(crate) fn simplified(mesh: &QuadMesh, rule: RemovalRule) -> Simplified {
    simplify(mesh, &SimplifyOptions { rule, ..Default::default() }, &()).expect("the options are in range")
}

/// The positions after `rule` and the embedding.
pub(crate) fn map(mesh: &QuadMesh, rule: RemovalRule, options: &EmbedOptions) -> VertexData<Vec2> {
    embed(mesh, &simplified(mesh, rule), options, &()).expect("the mesh is a disk").uv
}

/// Curved disks of several kinds, without symmetry where that can be had.
pub(crate) fn disks() -> Vec<(&'static str, QuadMesh)> {
    vec![
        ("jittered grid", shapes::jittered_grid(9, 7, 0.24, 1)),
        ("disk", shapes::disk(6)),
        ("cap", shapes::cap(6, 2.0)),
        ("bump", shapes::bump(10, 1.5)),
        ("nose", shapes::nose(12)),
        ("saddle", shapes::saddle(8)),
        ("strip", shapes::cylinder_strip(14, 4, 4.0)),
        ("wrinkled", wrinkled(11, 9, 3)),
    ]
}

/// A jittered grid, bent and wrinkled in space, with nothing symmetric about it.
pub(crate) fn wrinkled(columns: usize, rows: usize, seed: u64) -> QuadMesh {
    let mesh = shapes::jittered_grid(columns, rows, 0.2, seed);
    let bend = |p: &Vec3| {
        let (x, y) = (p.x / columns as f64, p.y / rows as f64);
        Vec3::new(p.x + 0.3 * y * y, p.y + 0.2 * x * x * y, (TAU * (0.7 * x + 0.3 * y)).sin() + 2.0 * x * y)
    };
    let positions = VertexData::from_vec(mesh.positions().iter().map(bend).collect());
    mesh.with_positions(positions)
}

/// The `x` and `y` of every boundary vertex, as a fixed boundary.
pub(crate) fn own_boundary(mesh: &QuadMesh) -> BoundaryShape {
    let boundary = mesh.vertices().filter(|&vertex| mesh.is_boundary(vertex));
    BoundaryShape::Fixed(boundary.map(|vertex| (vertex, mesh.position(vertex).xy())).collect())
}

/// The smallest signed area of a corner triangle.
pub(crate) fn smallest_corner(mesh: &QuadMesh, uv: &VertexData<Vec2>) -> f64 {
    let corner_area = |corner| {
        let at = |corner| uv[mesh.vertex(corner)];
        let here = at(corner);
        0.5 * (at(mesh.next_corner(corner)) - here).perp(&(at(mesh.previous_corner(corner)) - here))
    };
    mesh.corners().map(corner_area).fold(f64::INFINITY, f64::min)
}

pub(crate) fn largest_difference(a: &VertexData<Vec2>, b: &VertexData<Vec2>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

pub(crate) fn moved(mesh: &QuadMesh, to: impl Fn(&Vec3) -> Vec3) -> QuadMesh {
    let positions = VertexData::from_vec(mesh.positions().iter().map(to).collect());
    mesh.clone().with_positions(positions)
}

pub(crate) fn rotated(mesh: &QuadMesh) -> QuadMesh {
    let rotation = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    moved(mesh, |p| rotation * p + Vec3::new(3.0, -2.0, 5.0))
}

/// The same mesh with vertices numbered backwards, faces in another order, and their corners turned; and the new
/// number of each vertex.
pub(crate) fn renumbered(mesh: &QuadMesh) -> (QuadMesh, VertexData<VertexId>) {
    let count = mesh.vertex_count();
    let new = mesh.vertex_data(|vertex| VertexId((count - 1 - vertex.index()) as u32));
    let mut positions = vec![[0.0; 3]; count];
    for vertex in mesh.vertices() {
        positions[new[vertex].index()] = mesh.position(vertex).into();
    }
    let mut order: Vec<usize> = (0..mesh.face_count()).collect();
    order.sort_by_key(|face| (face * 7919) % 104_729);
    let faces = order.into_iter().map(|face| {
        let mut corners: Vec<u32> =
            mesh.face_vertices(FaceId::from_index(face)).map(|vertex| new[vertex].0).collect();
        corners.rotate_left(face % 4);
        corners
    });
    (QuadMesh::from_slices(&positions, faces).expect("only the numbers differ"), new)
}
