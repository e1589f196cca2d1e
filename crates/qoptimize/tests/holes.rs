//! Patches with holes: every method maps them, and holes stay holes.

use qoptimize::qembed::qsimplify::RemovalRule;
use qoptimize::qmesh::{Polygons, QuadMesh, shapes};
use qoptimize::{Method, Options, parameterize};

/// `mesh` without some of its faces.
fn without(mesh: &QuadMesh, missing: &[u32]) -> QuadMesh {
    let mut polygons =
        Polygons { positions: mesh.positions().to_vec(), face_start: vec![0], ..Polygons::default() };
    for face in mesh.faces().filter(|face| !missing.contains(&face.0)) {
        let vertices: Vec<u32> = mesh.face_vertices(face).map(|vertex| vertex.0).collect();
        polygons.push_face(&vertices);
    }
    QuadMesh::build(polygons).expect("holes apart from each other")
}

#[test]
fn every_method_maps_patches_with_holes() {
    let patches = [
        ("tube", shapes::cylinder(12, 4), 2),
        ("bump", without(&shapes::bump(12, 0.8), &[27, 28, 70, 100, 101, 113]), 4),
        ("a quad missing from a cap", without(&shapes::cap(6, 1.8), &[0]), 2),
    ];
    for (name, mesh, loops) in &patches {
        for method in [
            Method::Paper,
            Method::Direct,
            Method::Conformal,
            Method::Uniform,
            Method::MeanValue,
            Method::Harmonic,
            Method::Lscm,
        ] {
            let mut options = Options { method, ..Options::default() };
            options.simplify.rule = RemovalRule::All;
            let map = parameterize(mesh, &options, &())
                .unwrap_or_else(|error| panic!("{name} {method:?}: {error}"));
            let found = &map.distortion;
            assert_eq!((found.islands, found.boundary_loops), (1, *loops), "{name} {method:?}");
            if !matches!(method, Method::Harmonic | Method::Lscm) {
                assert_eq!(found.flipped_corners, 0, "{name} {method:?}");
            }
        }
    }
}

/// A flat patch with holes has an isometry, and the descent finds it.
#[test]
fn the_descent_ends_at_an_isometry() {
    let flat = without(&shapes::jittered_grid(8, 8, 0.15, 4), &[9, 20, 21, 28, 45]);
    let mut options = Options { method: Method::Direct, ..Options::default() };
    options.direct.descent.relative_decrease = 1e-12;
    let map = parameterize(&flat, &options, &()).unwrap();
    assert!(map.distortion.symmetric_dirichlet.unwrap() < 1.0 + 1e-6, "{:?}", map.distortion);
    assert_eq!(map.distortion.boundary_crossings, 0);
}
