//! What the hierarchy promises.

use super::super::hessian::Hessian;
use super::super::{Descent, energy, find_start};
use super::*;
use crate::qmesh::VertexId;
use crate::qmesh::shapes::{self, Hostility, hostile_disk};

/// Everything is large enough to be mapped by way of coarser meshes.
const ALWAYS: Sizes = Sizes { least: 0, least_open: 0, coarsest: 120 };

fn arrived(mesh: &QuadMesh, objective: &Objective) -> (Rest, Vec<Vec2>) {
    let exempt = Exempt::find(mesh);
    let rest = Rest::new(mesh, &exempt);
    let uv = arrive(mesh, &exempt, &rest, objective, ALWAYS, &()).expect("a map arrives");
    (rest, uv)
}

fn minimized(rest: &Rest, objective: &Objective, uv: &mut [Vec2]) -> Descent {
    let mut hessian = Hessian::new(rest).unwrap();
    descend(rest, &mut hessian, uv, objective, &DescentOptions::default(), &()).unwrap()
}

/// A grid of 30 × 30 cells without the 8 × 8 in its middle.
fn grid_with_hole() -> QuadMesh {
    let grid = shapes::grid(30, 30);
    let positions: Vec<[f64; 3]> = grid.positions().iter().map(|p| [p.x, p.y, p.z]).collect();
    let is_kept = |face: usize| !((11..19).contains(&(face % 30)) && (11..19).contains(&(face / 30)));
    let faces = grid.faces().filter(|face| is_kept(face.index()));
    let faces: Vec<Vec<u32>> = faces.map(|face| grid.face_vertices(face).map(|v| v.0).collect()).collect();
    QuadMesh::from_slices(&positions, faces).unwrap()
}

/// Clusters are connected, lie side by side like the faces of a surface of the same topology, and lose nothing.
#[test]
fn clusters_make_a_surface_of_the_same_topology() {
    let meshes = [
        shapes::grid(40, 25),
        shapes::bump(30, 0.8),
        shapes::finger(2, 60),
        shapes::finger(4, 40),
        grid_with_hole(),
        // Too small and thin for much to be gained.
        hostile_disk(Hostility::Fingers, 1),
        hostile_disk(Hostility::Fingers, 7),
    ];
    for (number, mesh) in meshes.iter().enumerate() {
        let surface = Surface::new(mesh);
        let Some((coarse, clusters)) = dual::coarsened(&surface) else {
            assert!(number >= 5, "{number}: there are clusters that are a surface");
            continue;
        };
        assert!(2 * coarse.mesh.vertex_count() <= mesh.vertex_count());
        assert_eq!(coarse.mesh.topology(), mesh.topology(), "{number}");
        assert_eq!(coarse.counts.iter().sum::<f64>(), mesh.vertex_count() as f64);
        let (fine, sum): (f64, f64) = (surface.areas.iter().sum(), coarse.areas.iter().sum());
        assert!((fine - sum).abs() < 1e-12 * fine);
        for (k, &seed) in clusters.seeds.iter().enumerate() {
            let size = clusters.of.iter().filter(|&&of| of == k as u32).count();
            let mut reached = vec![seed];
            let mut at = 0;
            while let Some(&vertex) = reached.get(at) {
                let next = mesh.neighbors(vertex).filter(|v| clusters.of[v.index()] == k as u32);
                let next: Vec<VertexId> = next.filter(|v| !reached.contains(v)).collect();
                reached.extend(next);
                at += 1;
            }
            assert_eq!(reached.len(), size, "{number}: cluster {k} is connected");
        }
    }
}

/// The energy of an affine map of a regular grid is the same on the coarse mesh, for every objective: triangles there measure what
/// the quads measure, angles against their edges included.
#[test]
fn triangles_measure_what_the_quads_measure() {
    let mesh = shapes::grid(24, 31);
    let exempt = Exempt::find(&mesh);
    let fine = Rest::new(&mesh, &exempt);
    let (coarse, _) = dual::coarsened(&Surface::new(&mesh)).unwrap();
    let rest = sampled::rest(&coarse, &mesh, &exempt, fine.unit);
    for objective in [
        Objective::default(),
        Objective::Direct { q: 1.0, shape: 0.0, angle_term: super::super::AngleTerm::Paper },
        Objective::Direct { q: 0.0, shape: 0.0, angle_term: super::super::AngleTerm::Log },
        Objective::Conformal { q: 0.3 },
    ] {
        let affine = |mesh: &QuadMesh| -> Vec<Vec2> {
            let map = |p: Vec2| Vec2::new(1.3 * p.x + 0.4 * p.y, 0.7 * p.y - 0.2 * p.x) / fine.unit;
            mesh.vertices().map(|v| map(mesh.position(v).xy())).collect()
        };
        let here = energy::value(&objective, &rest, &affine(&coarse.mesh));
        let there = energy::value(&objective, &fine, &affine(&mesh));
        assert!((here - there).abs() < 1e-12 * there, "{objective:?}: {here} {there}");
    }
}

/// The gradient of the coarse energy is its derivative.
#[test]
fn coarse_gradients_are_derivatives() {
    let mesh = shapes::jittered_grid(25, 25, 0.25, 3);
    let exempt = Exempt::find(&mesh);
    let unit = Rest::new(&mesh, &exempt).unit;
    let (coarse, _) = dual::coarsened(&Surface::new(&mesh)).unwrap();
    let rest = sampled::rest(&coarse, &mesh, &exempt, unit);
    let mut uv = find_start(&coarse.mesh, &Exempt::default(), &()).unwrap().uv.into_vec();
    for objective in [Objective::default(), Objective::Conformal { q: 0.6 }] {
        to_best_scale(&rest, &objective, &mut uv);
        let mut hessian = Hessian::new(&rest).unwrap();
        let (_, gradient) = energy::derivatives(&objective, &rest, &mut hessian, &uv).unwrap();
        let largest = gradient.iter().fold(0.0, |a: f64, g| a.max(g.abs()));
        for place in (0..gradient.len()).step_by(7) {
            let value = |step: f64| {
                let mut moved = uv.clone();
                moved[place / 2][place % 2] += step;
                energy::value(&objective, &rest, &moved)
            };
            let difference = (value(1e-6) - value(-1e-6)) / 2e-6;
            assert!((difference - gradient[place]).abs() < 1e-6 * largest, "{objective:?} {place}");
        }
    }
}

/// Linear precision: an affine map of a flat mesh is carried up as it is.
#[test]
fn affine_maps_are_carried_up_exactly() {
    for mesh in [shapes::jittered_grid(30, 20, 0.3, 5), shapes::graded_grid(25, 25, 8.0), grid_with_hole()] {
        let surface = Surface::new(&mesh);
        let (coarse, clusters) = dual::coarsened(&surface).unwrap();
        let map = |p: Vec2| Vec2::new(0.9 * p.x + 0.5 * p.y + 3.0, 1.1 * p.y - 0.3 * p.x - 1.0);
        let of = |mesh: &QuadMesh| -> Vec<Vec2> {
            mesh.vertices().map(|v| map(mesh.position(v).xy() / 2.0)).collect()
        };
        let carried = carried(&surface, &coarse, &clusters.of, 2.0, &of(&coarse.mesh));
        let worst = carried.iter().zip(of(&mesh)).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{worst:e}");
    }
}

/// What arrives is valid and near the minimum, and the descent from there ends where it ends from Tutte's embedding.
#[test]
fn maps_arrive_near_the_minimum() {
    let objective = Objective::default();
    // How far above the minimum, relative: smooth surfaces that the coarse mesh resolves, and a limb.
    let cases = [(shapes::bump(60, 0.8), 0.02), (grid_with_hole(), 0.02), (shapes::finger(4, 40), 2.0)];
    for (number, (mesh, above)) in cases.into_iter().enumerate() {
        let (rest, mut uv) = arrived(&mesh, &objective);
        assert_eq!(judge(&rest, &uv).bad, 0);
        to_best_scale(&rest, &objective, &mut uv);
        let on_arrival = energy::value(&objective, &rest, &uv);
        let by_way_of_coarser = minimized(&rest, &objective, &mut uv);
        let start = find_start_with_holes(&mesh, &Exempt::find(&mesh), &()).unwrap();
        let mut uv: Vec<Vec2> = start.uv.iter().map(|p| p / rest.unit).collect();
        to_best_scale(&rest, &objective, &mut uv);
        let from_tutte = minimized(&rest, &objective, &mut uv);
        let least = from_tutte.energy;
        assert!(on_arrival < least * (1.0 + above) + 1e-9, "{number}: {on_arrival} {least}");
        assert!(by_way_of_coarser.energy < least * (1.0 + 1e-3) + 1e-9, "{number}");
        assert!(by_way_of_coarser.steps <= from_tutte.steps, "{number}: fewer steps");
    }
}

/// The same bits for any number of threads.
#[test]
fn the_number_of_threads_plays_no_part() {
    let mesh = shapes::bump(90, 0.9);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| arrived(&mesh, &Objective::default()).1)
    };
    let bits =
        |uv: Vec<Vec2>| -> Vec<[u64; 2]> { uv.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect() };
    assert!(bits(with(1)) == bits(with(3)));
}

/// A fold is undone, and what is far from it stays where it is.
#[test]
fn folds_are_undone_where_they_lie() {
    let mesh = shapes::grid(40, 40);
    let rest = Rest::new(&mesh, &Exempt::find(&mesh));
    let flat: Vec<Vec2> = mesh.vertices().map(|v| mesh.position(v).xy() / rest.unit).collect();
    let mut uv = flat.clone();
    let (folded, to) = (20 * 41 + 20, 20 * 41 + 22);
    uv[folded] = 0.5 * (flat[to] + flat[to + 41]);
    assert!(judge(&rest, &uv).bad > 0);
    repair(&rest, &mut uv, &());
    assert_eq!(judge(&rest, &uv).bad, 0);
    let far = |v: &usize| (v % 41).abs_diff(20) > 12 || (v / 41).abs_diff(20) > 12;
    assert!((0..uv.len()).filter(far).all(|v| uv[v] == flat[v]));
}

/// Who asks to stop during the work on coarse meshes is heard, and there is no map then.
#[test]
fn stopping_is_heard() {
    let mesh = shapes::bump(40, 0.8);
    let exempt = Exempt::find(&mesh);
    let rest = Rest::new(&mesh, &exempt);
    let fractions = std::sync::Mutex::new(Vec::new());
    let observer = |stage: &'static str, fraction: f64| {
        assert_eq!(stage, "coarse");
        fractions.lock().unwrap().push(fraction);
        ControlFlow::Continue(())
    };
    assert!(arrive(&mesh, &exempt, &rest, &Objective::default(), ALWAYS, &observer).is_some());
    let fractions = fractions.into_inner().unwrap();
    assert!(fractions.len() > 3 && fractions.is_sorted(), "{fractions:?}");
    let stop = |_: &'static str, _: f64| ControlFlow::Break(());
    let held = arrive(&mesh, &exempt, &rest, &Objective::default(), ALWAYS, &stop);
    assert!(held.is_none_or(|uv| judge(&rest, &uv).bad == 0));
}

/// Squares, disks and hills are open; heads, fingers and surfaces with holes are not.
#[test]
fn bags_are_not_open() {
    for mesh in
        [shapes::grid(5, 3), shapes::disk(6), shapes::bump(9, 0.8), shapes::nose(12), shapes::saddle(8)]
    {
        assert!(is_open(&mesh));
    }
    for mesh in [shapes::head(1), shapes::finger(4, 40), shapes::cap(10, 2.5), grid_with_hole()] {
        assert!(!is_open(&mesh));
    }
}

/// Open surfaces of a few thousand vertices are mapped by way of a coarser one, others of that size at once.
#[test]
fn open_surfaces_need_fewer_vertices() {
    let arrives = |mesh: &QuadMesh| {
        let (exempt, objective) = (Exempt::find(mesh), Objective::default());
        let rest = Rest::new(mesh, &exempt);
        arrive(mesh, &exempt, &rest, &objective, Sizes::default(), &()).is_some()
    };
    assert!(arrives(&shapes::nose(60)));
    assert!(!arrives(&shapes::nose(50)));
    assert!(!arrives(&shapes::finger(10, 100)));
}
