//! Holes stay holes: they are filled for the time of the embedding only, and Tutte's theorem holds around them.

mod common;

use common::{map, moved, smallest_corner, wrinkled};
use qembed::qmesh::{FaceId, Polygons, QuadMesh, Vec2, VertexData, shapes};
use qembed::qsimplify::RemovalRule;
use qembed::qsolve::SolveOptions;
use qembed::{BoundaryShape, Classic, EmbedOptions, embed_classic};

/// `mesh` without some of its faces.
fn without(mesh: &QuadMesh, missing: &[u32]) -> QuadMesh {
    let mut polygons =
        Polygons { positions: mesh.positions().to_vec(), face_start: vec![0], ..Default::default() };
    for face in mesh.faces().filter(|face| !missing.contains(&face.0)) {
        let vertices: Vec<u32> = mesh.face_vertices(face).map(|vertex| vertex.0).collect();
        polygons.push_face(&vertices);
    }
    QuadMesh::build(polygons).expect("holes apart from each other")
}

fn patches() -> Vec<(&'static str, QuadMesh)> {
    vec![
        ("tube", shapes::cylinder(9, 4)),
        ("one quad missing", without(&wrinkled(7, 7, 1), &[24])),
        ("holes of all shapes", without(&wrinkled(14, 12, 5), &[17, 18, 36, 61, 75, 89, 90, 91, 105, 150])),
    ]
}

#[test]
fn positive_weights_flip_no_corner_around_holes() {
    for (name, mesh) in patches() {
        let uv = map(&mesh, RemovalRule::None, &EmbedOptions::default());
        assert_eq!(uv.len(), mesh.vertex_count());
        assert!(smallest_corner(&mesh, &uv) > 0.0, "{name}");
        // With everything removed, rims that stay would hang on the few edges that lead from them to the boundary: it is
        // the filled mesh that is simplified then.
        let filled = mesh.filled().unwrap();
        for q in [1.0, 0.3] {
            let uv = map(&filled, RemovalRule::All, &EmbedOptions { q, ..Default::default() });
            let smallest = smallest_corner(&filled, &uv);
            assert!(smallest > 0.0, "{name} {q}: {smallest:e}");
        }
        let guarded = map(&mesh, RemovalRule::Guarded, &EmbedOptions::default());
        assert!(smallest_corner(&mesh, &guarded) > -1e-12, "{name}");
        for method in [Classic::Uniform, Classic::MeanValue] {
            let circle = BoundaryShape::Circle;
            let embedding = embed_classic(&mesh, method, &circle, &SolveOptions::default(), &()).unwrap();
            assert!(smallest_corner(&mesh, &embedding.uv) > 0.0, "{name} {method:?}");
        }
    }
}

/// The outer boundary lies where the shape says, the rims of the holes inside.
#[test]
fn only_the_outer_boundary_is_placed() {
    for (name, mesh) in patches() {
        let mut loops = mesh.boundary_loops();
        mesh.outer_first(&mut loops);
        let uv = map(&mesh, RemovalRule::None, &EmbedOptions::default());
        for (place, walk) in loops.iter().enumerate() {
            for vertex in mesh.loop_vertices(walk) {
                let radius = uv[vertex].norm();
                let fits = if place == 0 { (radius - 1.0).abs() < 1e-12 } else { radius < 1.0 - 1e-6 };
                assert!(fits, "{name}, loop {place}: {radius}");
            }
        }
    }
}

/// Least squares conformal maps need no filling: a flat patch with holes comes back congruent.
#[test]
fn lscm_of_a_flat_patch_with_holes_is_itself() {
    let flat = without(&shapes::jittered_grid(9, 8, 0.2, 2), &[20, 21, 40]);
    let turned = moved(&flat, |p| qembed::qmesh::Vec3::new(p.y, 0.5, p.x));
    let embedding =
        embed_classic(&turned, Classic::Lscm, &BoundaryShape::Circle, &SolveOptions::default(), &()).unwrap();
    let area = |uv: &dyn Fn(qembed::qmesh::VertexId) -> Vec2, face: FaceId| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| uv(flat.face_vertices(face).nth(k).unwrap()));
        0.5 * (c - a).perp(&(d - b))
    };
    for face in flat.faces() {
        let [there, here]: [f64; 2] =
            [area(&|v| embedding.uv[v], face), area(&|v| flat.position(v).xy(), face)];
        assert!((there - here).abs() < 1e-9, "{there} {here}");
    }
    let uv: &VertexData<Vec2> = &embedding.uv;
    for edge in flat.edges() {
        let [a, b] = flat.edge_vertices(edge);
        assert!(((uv[a] - uv[b]).norm() - flat.edge_length(edge)).abs() < 1e-9);
    }
}
