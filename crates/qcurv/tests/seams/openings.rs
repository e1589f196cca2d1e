//! Automatic seams: whatever closed surface or handle there is, one cut leaves one planar patch, and Euler's formula
//! counts its loops.

use qcurv::qmesh::{Chart, EdgeId, Polygons, QuadMesh, Vec3, VertexId, shapes};
use qcurv::seams::{SeamCost, cheapest_path, creases, tips};

/// The surface of a plate of unit cubes with `holes` holes in a row, each face cut into `n × n` quads: genus `holes`.
fn plate(holes: usize, n: usize) -> QuadMesh {
    let (width, depth) = (2 * holes + 1, 3);
    let solid = |x: i64, y: i64, z: i64| {
        (0..width as i64).contains(&x) && (0..depth).contains(&y) && z == 0 && !(y == 1 && x % 2 == 1)
    };
    let mut number = std::collections::BTreeMap::new();
    let mut polygons = Polygons { face_start: vec![0], ..Polygons::default() };
    let n = n as i64;
    let mut vertex = |p: [i64; 3], positions: &mut Vec<Vec3>| {
        *number.entry(p).or_insert_with(|| {
            positions.push(Vec3::new(p[0] as f64, p[1] as f64, p[2] as f64) / n as f64);
            positions.len() as u32 - 1
        })
    };
    for (x, y) in (0..width as i64).flat_map(|x| (0..depth).map(move |y| (x, y))) {
        if !solid(x, y, 0) {
            continue;
        }
        for axis in 0..3 {
            for side in [-1, 1] {
                let mut there = [x, y, 0];
                there[axis] += side;
                if solid(there[0], there[1], there[2]) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                    let corner = |di: i64, dj: i64| {
                        let mut p = [n * x, n * y, 0];
                        p[axis] += if side > 0 { n } else { 0 };
                        p[u] += i + di;
                        p[v] += j + dj;
                        p
                    };
                    let mut corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    if side < 0 {
                        corners.reverse();
                    }
                    let face = corners.map(|p| vertex(p, &mut polygons.positions));
                    polygons.push_face(&face);
                }
            }
        }
    }
    QuadMesh::build(polygons).expect("a closed surface")
}

fn opening(mesh: &QuadMesh) -> Vec<EdgeId> {
    qcurv::seams::opening(mesh, &()).expect("nobody interrupts")
}

fn closed() -> Vec<(String, QuadMesh)> {
    let mut all = vec![
        ("sphere".to_owned(), shapes::sphere(7)),
        ("smallest cube".to_owned(), shapes::sphere(1)),
        ("torus".to_owned(), shapes::torus(14, 9)),
        ("smallest torus".to_owned(), shapes::torus(3, 3)),
    ];
    all.extend((0..4).map(|holes| (format!("plate, genus {holes}"), plate(holes, 2))));
    all
}

fn cut(mesh: &QuadMesh, seams: &[EdgeId]) -> QuadMesh {
    let mut pieces = Chart::whole(mesh.clone()).cut(seams);
    assert_eq!(pieces.len(), 1, "a cut separates nothing");
    pieces.remove(0).mesh
}

/// `χ(cut) = χ(surface) − χ(seams)`, and for a planar patch with b loops `χ = 2 − b`: so seams with c pieces have
/// `2g − b + c` independent loops, 2g where one disk is left.
#[test]
fn seams_open_every_closed_surface() {
    for (name, mesh) in closed() {
        let genus = mesh.topology().genus;
        let seams = opening(&mesh);
        let patch = cut(&mesh, &seams).topology();
        assert!(patch.genus == 0 && patch.boundary_loops >= 1, "{name}: {patch:?}");
        assert_eq!(patch.boundary_loops, 1, "{name}");
        let mut ends: Vec<_> = seams.iter().flat_map(|&edge| mesh.edge_vertices(edge)).collect();
        ends.sort_unstable();
        ends.dedup();
        assert_eq!(seams.len() as i64 - ends.len() as i64, 2 * genus - 1, "{name}: connected, with 2g loops");
    }
}

/// Where no two vertices lie apart there are no paths, but a slit of two edges.
#[test]
fn a_surface_in_one_point_gets_a_slit() {
    let mesh = shapes::sphere(4);
    let mesh = mesh.clone().with_positions(mesh.vertex_data(|_| Vec3::zeros()));
    let seams = opening(&mesh);
    assert_eq!(seams.len(), 2);
    assert!(cut(&mesh, &seams).topology().is_disk());
}

/// Holes stay holes; what is a patch already is left alone.
#[test]
fn holes_are_no_reason_to_cut() {
    for mesh in [shapes::grid(4, 3), shapes::cylinder(8, 3), shapes::cap(5, 2.0)] {
        assert!(opening(&mesh).is_empty());
    }
    for holes in 1..3 {
        let whole = plate(holes, 3);
        let kept = whole.faces().filter(|face| ![5, 40].contains(&face.0));
        let faces: Vec<Vec<u32>> =
            kept.map(|face| whole.face_vertices(face).map(|v| v.0).collect()).collect();
        let positions: Vec<[f64; 3]> = whole.positions().iter().map(|&p| p.into()).collect();
        let mesh = QuadMesh::from_slices(&positions, faces).unwrap();
        assert_eq!((mesh.topology().genus, mesh.topology().boundary_loops), (holes as i64, 2));
        let patch = cut(&mesh, &opening(&mesh)).topology();
        assert!(patch.genus == 0 && patch.boundary_loops >= 2, "{patch:?}");
    }
}

/// A straight path is cheaper than any with a turn, though in a grid all have the same length.
#[test]
fn paths_go_straight_along_edge_loops() {
    let mesh = shapes::grid(12, 12);
    let cost = SeamCost::new(&mesh);
    let at = |i: usize, j: usize| mesh.vertices().nth(j * 13 + i).unwrap();
    let path = cheapest_path(&mesh, &cost, &[at(2, 3)], |vertex| vertex == at(10, 9));
    assert_eq!(path.len(), 14);
    let mut rows: Vec<_> = path
        .iter()
        .filter(|&&edge| {
            let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.position(vertex));
            (a.y - b.y).abs() < 1e-9
        })
        .map(|&edge| mesh.position(mesh.edge_vertices(edge)[0]).y.round() as i32)
        .collect();
    rows.dedup();
    assert_eq!(rows.len(), 1, "one turn: all of the way along is in one row");
}

/// On a cube with fine faces the seams run along its edges, where a path is cheaper, and reach all eight corners or tips.
#[test]
fn seams_prefer_creases() {
    let mesh = plate(0, 6);
    let bent = creases(&mesh, 60.0);
    let seams = opening(&mesh);
    let along = seams.iter().filter(|&&edge| {
        let [a, b] = mesh.edge_vertices(edge);
        bent.contains(a.0, b.0)
    });
    assert!(2 * along.count() > seams.len(), "most of the seam lies on creases");
}

/// Tips are where limbs end: a finger has one, at its far end; a plate has them at its ends and none inside, a sphere none.
#[test]
fn tips_are_the_ends_of_limbs() {
    let tips = |mesh: &QuadMesh| tips(mesh, &()).unwrap();
    let finger = shapes::finger(4, 60);
    let height = |vertex| finger.position(vertex).z;
    let top = finger.vertices().map(height).fold(f64::MIN, f64::max);
    let found: Vec<VertexId> = tips(&finger).into_iter().filter(|&tip| !finger.is_boundary(tip)).collect();
    assert!(found.len() == 1 && height(found[0]) > 0.9 * top, "{found:?}");
    let plate = plate(0, 3);
    let plate = plate
        .clone()
        .with_positions(plate.vertex_data(|v| plate.position(v).component_mul(&Vec3::new(12.0, 1.0, 1.0))));
    let ends: Vec<f64> = tips(&plate).into_iter().map(|tip| plate.position(tip).x).collect();
    assert!(ends.iter().any(|&x| x < 1.0) && ends.iter().any(|&x| x > 11.0), "{ends:?}");
    assert!(ends.iter().all(|&x| !(1.0..=11.0).contains(&x)), "none inside: {ends:?}");
    assert!(tips(&shapes::sphere(8)).len() < 2, "a sphere has no limbs");
}

/// A power of two rounds nothing: the same seams.
#[test]
fn size_does_not_matter() {
    for mesh in [plate(1, 3), shapes::sphere(7), shapes::torus(14, 9)] {
        let scaled = mesh.clone().with_positions(mesh.vertex_data(|v| mesh.position(v) / 1024.0));
        assert_eq!(opening(&mesh), opening(&scaled));
    }
}
