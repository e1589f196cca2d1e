//! Charts of anything: every corner lies in exactly one, neighbours agree, and whatever was mended is named.

use proptest::collection::vec;
use proptest::prelude::*;
use qmesh::charts::{Charts, cut};
use qmesh::{BuildError, Chart, Polygons, QuadMesh, Repairs, Seams};

use crate::halfedges::assert_invariants;
use crate::samples::{both, cube, faces, grid, lists, moebius, patchwork, ring, torus};

fn charts(polygons: &Polygons) -> Charts {
    cut(polygons.view(), &Seams::default()).expect("anything has charts")
}

fn opened(polygons: &Polygons, seams: &[[u32; 2]]) -> Vec<Chart> {
    cut(polygons.view(), &seams.iter().copied().collect()).expect("anything has charts").charts
}

/// What must hold for charts of any polygons.
fn assert_charts(polygons: &Polygons, cut: &Charts) {
    let view = polygons.view();
    let mut seen = vec![0; view.corner_count()];
    for chart in &cut.charts {
        let mesh = &chart.mesh;
        assert_invariants(mesh);
        assert_eq!(mesh.components().1, 1, "a chart is connected");
        assert!(chart.faces.is_sorted());
        for face in mesh.faces() {
            let source = chart.source_face(face) as usize;
            let corners: Vec<usize> =
                mesh.face_corners(face).map(|corner| chart.source_corner(corner) as usize).collect();
            assert_eq!(corners[0], view.corners(source).start, "the first corner stays the first");
            let forward: Vec<usize> = view.corners(source).collect();
            let backward: Vec<usize> =
                [forward[0]].into_iter().chain(forward[1..].iter().rev().copied()).collect();
            assert!(corners == forward || corners == backward, "a face is kept or turned over");
        }
        for corner in mesh.corners() {
            let source = chart.source_corner(corner) as usize;
            seen[source] += 1;
            let vertex = view.corner_vertex[source];
            assert_eq!(mesh.source_vertex(mesh.vertex(corner)), vertex);
            assert_eq!(mesh.position(mesh.vertex(corner)), view.positions[vertex as usize]);
        }
    }
    assert!(seen.iter().all(|&times| times == 1), "every corner lies in exactly one chart");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]

    /// Faces with random vertices, seams at random: charts, whatever it is.
    #[test]
    fn anything_has_charts(
        list in vec(vec(0..9u32, 3..6), 1..12),
        seams in vec([0..9u32, 0..9u32], 0..6),
    ) {
        let polygons = Polygons::new(&[[0.5, 1.0, -2.0]; 9], list);
        let cut = cut(polygons.view(), &seams.into_iter().collect()).expect("anything has charts");
        assert_charts(&polygons, &cut);
        // What has been cut needs no cutting.
        for chart in &cut.charts {
            let again = chart.cut(&[]);
            prop_assert_eq!(std::slice::from_ref(chart), &again[..]);
        }
    }

    /// An oriented manifold falls into its components, numbered as `build` numbers them, and needs no mending.
    #[test]
    fn the_charts_of_a_mesh_are_its_components(polygons in patchwork()) {
        let cut = charts(&polygons);
        assert_charts(&polygons, &cut);
        if let Ok(mesh) = QuadMesh::build(polygons) {
            prop_assert_eq!(&cut.repairs, &Repairs::default());
            prop_assert_eq!(cut.charts.len(), mesh.components().1);
            if cut.charts.len() == 1 {
                prop_assert_eq!(&cut.charts[0].mesh, &mesh);
            }
        } else {
            prop_assert!(!cut.repairs.is_empty());
        }
    }

    /// Turning faces over at random changes neither vertices nor edges of any chart, and each piece keeps most faces.
    #[test]
    fn orientation_is_made_consistent(turned in vec(any::<bool>(), 24)) {
        let whole = grid(6, 4);
        let list = lists(&whole).into_iter().zip(&turned).map(|(mut face, &turned)| {
            if turned { face.reverse(); }
            face
        });
        let polygons = Polygons { positions: whole.positions.clone(), ..faces(list) };
        let cut = charts(&polygons);
        assert_charts(&polygons, &cut);
        prop_assert_eq!(cut.charts.len(), 1);
        prop_assert!(cut.charts[0].mesh.topology().is_disk());
        let count = turned.iter().filter(|&&turned| turned).count();
        prop_assert_eq!(cut.repairs.flipped_faces.count, count.min(24 - count));
    }
}

/// χ of every chart tells what a cut did: a torus becomes an annulus, then a disk; a sphere a disk.
#[test]
fn cutting_changes_topology_as_it_should() {
    let around: Vec<[u32; 2]> = (0..6).map(|i| [i, (i + 1) % 6]).collect();
    let along: Vec<[u32; 2]> = (0..5).map(|j| [6 * j, 6 * ((j + 1) % 5)]).collect();
    let topology = |polygons: &Polygons, seams: &[[u32; 2]]| {
        let pieces = opened(polygons, seams);
        assert_eq!(pieces.len(), 1);
        let topology = pieces[0].mesh.topology();
        (topology.euler_characteristic, topology.boundary_loops, topology.genus)
    };
    assert_eq!(topology(&torus(6, 5), &[]), (0, 0, 1));
    assert_eq!(topology(&torus(6, 5), &around), (0, 2, 0));
    assert_eq!(topology(&torus(6, 5), &[around.clone(), along].concat()), (1, 1, 0));
    assert_eq!(topology(&ring(6, 3), &[[0, 6], [6, 12], [12, 18]]), (1, 1, 0));
    assert_eq!(topology(&cube(), &[[0, 1], [1, 2]]), (1, 1, 0));
    // Around a face: two pieces.
    assert_eq!(opened(&cube(), &[[0, 1], [1, 2], [2, 3], [3, 0]]).len(), 2);
}

/// One edge inside a surface cannot be opened, since its ends stay whole; two in a row open a slit.
#[test]
fn a_seam_that_opens_nothing_stays_closed() {
    let whole = grid(4, 4);
    assert_eq!(opened(&whole, &[[6, 7]])[0].mesh, QuadMesh::build(whole.clone()).unwrap());
    let slit = opened(&whole, &[[6, 7], [7, 8]]);
    assert_eq!(slit[0].mesh.topology().boundary_loops, 2);
    assert_eq!(slit[0].mesh.vertex_count(), 26, "vertex 7 is there twice");
}

/// A cut of a cut leads back to the first polygons.
#[test]
fn cuts_can_be_nested() {
    let whole = both(grid(2, 2), &torus(6, 5));
    let pieces = charts(&whole).charts;
    let mesh = &pieces[1].mesh;
    let ring: Vec<_> = mesh
        .edges()
        .filter(|&edge| mesh.edge_vertices(edge).iter().all(|&v| mesh.source_vertex(v) < 9 + 6))
        .collect();
    let annulus = pieces[1].cut(&ring);
    assert_eq!((annulus.len(), annulus[0].mesh.topology().boundary_loops), (1, 2));
    let all = Charts { charts: vec![pieces[0].clone(), annulus[0].clone()], repairs: Repairs::default() };
    assert_charts(&whole, &all);
}

/// One side only: one more seam makes it two-sided. A Möbius strip becomes a disk, a Klein bottle an annulus or two.
#[test]
fn one_sided_surfaces_are_opened() {
    for length in 3..12 {
        let strip = moebius(length);
        let cut = charts(&strip);
        assert_charts(&strip, &cut);
        assert_eq!(cut.repairs.one_sided_edges.count, 1, "one rung");
        assert!(cut.charts.len() == 1 && cut.charts[0].mesh.topology().is_disk());
    }
    let (columns, rows) = (9, 7);
    let at = |i: u32, j: u32| {
        if j == rows { (columns - i % columns) % columns } else { j * columns + i % columns }
    };
    let klein =
        faces((0..rows).flat_map(|j| {
            (0..columns).map(move |i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        }));
    let cut = charts(&klein);
    assert_charts(&klein, &cut);
    assert!(cut.repairs.one_sided_edges.count > 0);
    for chart in &cut.charts {
        let topology = chart.mesh.topology();
        assert!(topology.boundary_loops > 0, "{topology:?}");
    }
}

/// Each fault is counted and its first places are named.
#[test]
fn what_was_mended_is_named() {
    let repairs = |polygons: &Polygons| {
        let cut = charts(polygons);
        assert_charts(polygons, &cut);
        (cut.charts.len(), cut.repairs)
    };
    let (pieces, found) = repairs(&faces([[0, 1, 2, 3], [1, 0, 4, 5], [1, 0, 6, 7]]));
    assert_eq!((pieces, found.nonmanifold_edges.first), (3, vec![[0, 1]]));
    // Two squares at a corner, then the pinched ring of four around a missing one.
    let (pieces, found) = repairs(&faces([[0, 1, 2, 3], [2, 4, 5, 6]]));
    assert_eq!((pieces, found.nonmanifold_vertices.first), (2, vec![2]));
    let mut corner = lists(&grid(3, 3));
    corner.remove(4);
    corner.remove(0);
    let (pieces, found) = repairs(&faces(corner));
    assert_eq!((pieces, found.nonmanifold_vertices.first), (1, vec![5]));
    let (pieces, found) = repairs(&faces([[0, 1, 2, 3], [1, 2, 4, 5], [4, 5, 6, 7]]));
    assert_eq!((pieces, found.flipped_faces.first.len()), (1, 1));
    let (pieces, found) = repairs(&faces([[0, 1, 2, 3], [1, 2, 3, 0], [3, 2, 1, 0]]));
    assert_eq!((pieces, found.doubled_faces.first), (3, vec![1, 2]));
    let (pieces, found) = repairs(&faces([vec![0, 1, 2, 3], vec![1, 4, 4, 2], vec![5, 5, 5]]));
    assert_eq!((pieces, found.repeated_corner_faces.first), (3, vec![1, 2]));
    let many = (0..20).map(|i| [3 * i, 3 * i, 3 * i + 1]);
    let (pieces, found) = repairs(&faces(many));
    assert_eq!((pieces, found.repeated_corner_faces.count), (20, 20));
    assert_eq!(found.repeated_corner_faces.first, [0, 1, 2, 3, 4, 5, 6, 7]);
}

/// A leaf modelled with two sides on the same vertices falls into its sides, each whole.
#[test]
fn a_leaf_has_two_sides() {
    let front = lists(&grid(4, 3));
    let back = front.iter().map(|face| face.iter().rev().copied().collect::<Vec<_>>());
    let leaf = faces(front.iter().cloned().chain(back));
    let cut = charts(&leaf);
    assert_charts(&leaf, &cut);
    assert_eq!((cut.charts.len(), cut.repairs.doubled_faces.count), (2, 12));
    assert!(cut.charts.iter().all(|chart| chart.mesh.topology().is_disk()));
    assert_eq!((cut.repairs.nonmanifold_edges.count, cut.repairs.nonmanifold_vertices.count), (0, 0));
}

/// Seams between vertices without an edge change nothing.
#[test]
fn seams_elsewhere_are_ignored() {
    let whole = grid(3, 3);
    assert_eq!(opened(&whole, &[[0, 5], [0, 99], [4, 4]]), charts(&whole).charts);
}

#[test]
fn what_no_cut_mends_is_refused() {
    let refused = |polygons: &Polygons| cut(polygons.view(), &Seams::default()).expect_err("no charts");
    assert_eq!(refused(&Polygons::default()), BuildError::NoFaces);
    assert_eq!(refused(&faces([[0, 1]])), BuildError::TooFewCorners { face: 0, corners: 2 });
    let mut polygons = grid(1, 1);
    polygons.push_face(&[0, 1, 9]);
    assert_eq!(refused(&polygons), BuildError::IndexOutOfRange { face: 1, vertex: 9, count: 4 });
    let mut polygons = grid(1, 1);
    polygons.positions[2].x = f64::NAN;
    assert_eq!(refused(&polygons), BuildError::NonFiniteCoordinate { vertex: 2 });
}
