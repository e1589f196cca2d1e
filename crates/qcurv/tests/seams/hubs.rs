//! Vertices with very many edges. These tests would not end if a search took quadratic time in the valence.

use std::f64::consts::{PI, TAU};

use qcurv::qmesh::{Chart, Polygons, QuadMesh};
use qcurv::seams::opening;

/// An ellipsoid of `rings` rings of `around` faces, the first and the last of which are triangles at a pole on its short axis.
fn ellipsoid(rings: u32, around: u32) -> Polygons {
    let mut positions = Vec::new();
    for ring in 1..rings {
        let (z, r) = (
            (PI * f64::from(ring) / f64::from(rings)).cos(),
            (PI * f64::from(ring) / f64::from(rings)).sin(),
        );
        positions.extend((0..around).map(|k| {
            let turn = TAU * f64::from(k) / f64::from(around);
            [5.0 * r * turn.cos(), r * turn.sin(), z]
        }));
    }
    let (north, south) = (positions.len() as u32, positions.len() as u32 + 1);
    positions.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let at = |ring: u32, k: u32| (ring - 1) * around + k % around;
    let mut polygons = Polygons::new(&positions, Vec::<Vec<u32>>::new());
    for k in 0..around {
        polygons.push_face(&[north, at(1, k), at(1, k + 1)]);
        (1..rings - 1).for_each(|ring| {
            polygons.push_face(&[at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)]);
        });
        polygons.push_face(&[south, at(rings - 1, k + 1), at(rings - 1, k)]);
    }
    polygons
}

/// Seams pass through poles whose valence is beyond what pairs of edges allow.
#[test]
fn poles_of_valence_twelve_thousand() {
    let mesh = QuadMesh::build(ellipsoid(4, 12_000)).unwrap();
    let pieces = Chart::whole(mesh.clone()).cut(&opening(&mesh, &()).unwrap());
    assert!(pieces.len() == 1 && pieces[0].mesh.topology().is_disk());
}

/// The same with a handle: two quads of opposite sides give way to a tube between them.
#[test]
fn poles_on_a_surface_with_a_handle() {
    let whole = ellipsoid(4, 4_000);
    let quads: Vec<usize> =
        (0..whole.view().face_count()).filter(|&f| whole.view().face(f).len() == 4).collect();
    let gone = [quads[0], quads[quads.len() / 2]];
    let mut polygons = Polygons { positions: whole.positions.clone(), ..Polygons::default() };
    (0..whole.view().face_count())
        .filter(|face| !gone.contains(face))
        .for_each(|face| polygons.push_face(whole.view().face(face)));
    let [a, b] = gone.map(|face| whole.view().face(face));
    (0..4).for_each(|i| polygons.push_face(&[a[i], a[(i + 1) % 4], b[(4 - i) % 4], b[(5 - i) % 4]]));
    let mesh = QuadMesh::build(polygons).unwrap();
    assert_eq!(mesh.topology().genus, 1);
    let pieces = Chart::whole(mesh.clone()).cut(&opening(&mesh, &()).unwrap());
    assert!(pieces.len() == 1 && pieces[0].mesh.topology().genus == 0);
}
