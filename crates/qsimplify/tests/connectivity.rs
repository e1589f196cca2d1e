//! What `Guarded` and `Ring` promise: a 3-connected graph of the same topology, on which Tutte's theorem holds.
#![allow(clippy::unwrap_used)] // in helpers: helpers of tests are tests too

mod common;

use std::f64::consts::TAU;

use common::{bumpy, flat, lifted, patch, torus, tube};
use proptest::prelude::*;
use qcurv::qmesh::{Polygons, QuadMesh, Vec2, VertexId};
use qsimplify::{RemovalRule, SimplifyOptions, Threshold, simplify};

fn as_far_as_it_goes(mesh: &QuadMesh, rule: RemovalRule) -> QuadMesh {
    let options = SimplifyOptions { rule, threshold: Threshold::Fraction(1.0), ..Default::default() };
    QuadMesh::build(simplify(mesh, &options, &()).unwrap().polygons(mesh)).unwrap()
}

/// The neighbours of every vertex, and of one more vertex in each boundary loop, joined to all of it.
fn graph_with_hubs(mesh: &QuadMesh) -> Vec<Vec<usize>> {
    let mut graph: Vec<Vec<usize>> =
        mesh.vertices().map(|v| mesh.neighbors(v).map(VertexId::index).collect()).collect();
    for halfedges in mesh.boundary_loops() {
        let hub = graph.len();
        let rim: Vec<usize> = mesh.loop_vertices(&halfedges).iter().map(|v| v.index()).collect();
        for &v in &rim {
            graph[v].push(hub);
        }
        graph.push(rim);
    }
    graph
}

fn connected_without(graph: &[Vec<usize>], gone: [usize; 2]) -> bool {
    let mut seen = vec![false; graph.len()];
    gone.iter().for_each(|&v| seen[v] = true);
    let Some(start) = seen.iter().position(|s| !s) else { return true };
    let mut stack = vec![start];
    seen[start] = true;
    while let Some(v) = stack.pop() {
        for &n in &graph[v] {
            if !std::mem::replace(&mut seen[n], true) {
                stack.push(n);
            }
        }
    }
    seen.iter().all(|&s| s)
}

/// Straight from the definition: no two vertices separate the graph.
fn is_three_connected(mesh: &QuadMesh) -> bool {
    let graph = graph_with_hubs(mesh);
    graph.len() >= 4
        && (0..graph.len()).all(|a| (a + 1..graph.len()).all(|b| connected_without(&graph, [a, b])))
}

/// Tutte's embedding with unit weights and the boundary on a circle, by sweeps until nothing moves.
fn tutte(mesh: &QuadMesh) -> Vec<Vec2> {
    let rim = mesh.loop_vertices(&mesh.boundary_loops()[0]);
    let mut at = vec![Vec2::zeros(); mesh.vertex_count()];
    for (i, v) in rim.iter().enumerate() {
        let angle = TAU * i as f64 / rim.len() as f64;
        at[v.index()] = Vec2::new(angle.cos(), angle.sin());
    }
    for _ in 0..20_000 {
        let mut moved: f64 = 0.0;
        for v in mesh.vertices().filter(|&v| !mesh.is_boundary(v)) {
            let neighbors: Vec<Vec2> = mesh.neighbors(v).map(|n| at[n.index()]).collect();
            let mean = neighbors.iter().sum::<Vec2>() / neighbors.len() as f64;
            moved = moved.max((mean - at[v.index()]).amax());
            at[v.index()] = mean;
        }
        if moved < 1e-14 {
            break;
        }
    }
    at
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// The kept graph is 3-connected, by brute force, whatever the order of removal; and so it stays when what one
    /// rule leaves is simplified by the other, so the theorem is put to the test on polygons of many sizes.
    #[test]
    fn kept_graphs_are_three_connected(
        (columns, rows) in (2..7u32, 2..6u32),
        heights in prop::collection::vec(-1.0..1.0f64, 56),
        again in prop::collection::vec(-1.0..1.0f64, 56),
        rules in prop::sample::select(vec![
            [RemovalRule::Guarded, RemovalRule::Ring],
            [RemovalRule::Ring, RemovalRule::Guarded],
            [RemovalRule::Ring, RemovalRule::Ring],
        ]),
        base in prop::sample::select(vec![flat as fn(u32, u32) -> QuadMesh, tube, torus]),
    ) {
        let mesh = lifted(&base(columns + 2, rows + 2), &heights);
        prop_assume!(is_three_connected(&mesh));
        let once = as_far_as_it_goes(&mesh, rules[0]);
        prop_assert!(once.vertex_count() < mesh.vertex_count());
        prop_assert!(is_three_connected(&once));
        let twice = as_far_as_it_goes(&lifted(&once, &again), rules[1]);
        prop_assert!(is_three_connected(&twice));
        prop_assert_eq!(once.topology(), mesh.topology());
        prop_assert_eq!(twice.topology(), mesh.topology());
    }

    /// Tutte: with positive weights and a strictly convex boundary every face of the kept graph is strictly convex.
    #[test]
    fn tutte_draws_kept_graphs_with_convex_faces(
        heights in prop::collection::vec(-1.0..1.0f64, 56),
        rule in prop::sample::select(vec![RemovalRule::Guarded, RemovalRule::Ring]),
    ) {
        let kept = as_far_as_it_goes(&lifted(&flat(7, 6), &heights), rule);
        let at = tutte(&kept);
        for corner in kept.corners() {
            let [here, next, previous] = [corner, kept.next_corner(corner), kept.previous_corner(corner)]
                .map(|c| at[kept.vertex(c).index()]);
            prop_assert!((next - here).perp(&(previous - here)) > 1e-9);
        }
    }
}

/// χ, the number of boundary loops and the loops themselves stay, for disks, tubes and closed surfaces.
#[test]
fn topology_and_boundary_stay() {
    for mesh in [bumpy(12, 9), tube(14, 8), torus(12, 10)] {
        for rule in [RemovalRule::Guarded, RemovalRule::Ring] {
            let kept = as_far_as_it_goes(&mesh, rule);
            assert_eq!(kept.topology(), mesh.topology(), "{rule:?}");
            let rim = |m: &QuadMesh| {
                let loops = m.boundary_loops();
                let at = |l: &Vec<_>| m.loop_vertices(l).iter().map(|&v| m.position(v)).collect::<Vec<_>>();
                let mut loops: Vec<_> = loops.iter().map(at).collect();
                // A loop is the same from any start.
                loops.iter_mut().for_each(|l| {
                    let first =
                        (0..l.len()).min_by(|&a, &b| l[a].as_slice().partial_cmp(l[b].as_slice()).unwrap());
                    l.rotate_left(first.unwrap());
                });
                loops.sort_by(|a, b| a[0].as_slice().partial_cmp(b[0].as_slice()).unwrap());
                loops
            };
            assert_eq!(rim(&kept), rim(&mesh), "{rule:?}");
        }
    }
}

/// On the regular grid each tree of `k` deleted vertices takes `2k + 2` edges from kept ones, which can spare one each.
/// So deletion ends below a third, which row after row nearly reaches, and near a fifth (single vertices) in an order
/// that is spread out. With rings nearly everything can go.
#[test]
fn reach() {
    let share = |mesh: &QuadMesh, rule| {
        let options = SimplifyOptions { rule, threshold: Threshold::Fraction(1.0), ..Default::default() };
        let simplified = simplify(mesh, &options, &()).unwrap();
        simplified.removed.len() as f64 / simplified.candidates as f64
    };
    let in_rows = share(&flat(60, 60), RemovalRule::Guarded);
    assert!((0.3..0.34).contains(&in_rows), "{in_rows}");
    assert!(is_three_connected(&as_far_as_it_goes(&flat(7, 8), RemovalRule::Guarded)));
    let noise: Vec<f64> = (0..3721u64).map(|i| (i * i * 7919 % 10_007) as f64 / 10_007.0).collect();
    let spread = share(&lifted(&flat(60, 60), &noise), RemovalRule::Guarded);
    assert!((0.18..0.23).contains(&spread), "{spread}");
    let ring = share(&bumpy(60, 60), RemovalRule::Ring);
    assert!(ring > 0.9, "{ring}");
}

/// Two quads that share two edges: the vertex between them has two edges. Both rules can heal that, and neither makes
/// a second such vertex.
#[test]
fn doublets_are_healed() {
    let grid = flat(6, 6);
    let middle = 24u32; // of 7 by 7 vertices
    let mut polygons = Polygons { positions: grid.positions().to_vec(), ..Default::default() };
    for face in grid.faces() {
        let quad: Vec<u32> = grid.face_vertices(face).map(|v| v.0).collect();
        // The quad above the middle becomes two, with a new vertex inside.
        if quad[0] == middle {
            polygons.push_face(&[quad[0], quad[1], quad[2], 49]);
            polygons.push_face(&[quad[0], 49, quad[2], quad[3]]);
        } else {
            polygons.push_face(&quad);
        }
    }
    let inside = (polygons.positions[24] + polygons.positions[32]) / 2.0;
    polygons.positions.push(inside);
    let mesh = QuadMesh::build(polygons).unwrap();
    assert_eq!(mesh.valence(VertexId(49)), 2);
    for rule in [RemovalRule::Guarded, RemovalRule::Ring] {
        let options = SimplifyOptions { rule, threshold: Threshold::Fraction(1.0), ..Default::default() };
        // Highest first and a lifted vertex: the doublet is the first to be tried.
        let options = SimplifyOptions { side: qsimplify::RemovedSide::High, ..options };
        let mesh = lifted(&mesh, &[[0.0; 49].as_slice(), &[1.0]].concat());
        let simplified = simplify(&mesh, &options, &()).unwrap();
        assert_eq!(simplified.connectivity(&mesh).degree_2, 0, "{rule:?}");
        let kept = QuadMesh::build(simplified.polygons(&mesh)).unwrap();
        assert!(is_three_connected(&kept), "{rule:?}");
    }
}

/// A polygon fan around one vertex of many edges is nothing special.
#[test]
fn poles() {
    let mut polygons = Polygons::new(&[[0.0; 3]], [[0u32; 0]; 0]);
    let n = 40;
    for ring in 1..=3 {
        for i in 0..n {
            let angle = TAU * f64::from(i) / f64::from(n);
            polygons
                .positions
                .push([angle.cos() * f64::from(ring), angle.sin() * f64::from(ring), 0.1].into());
        }
    }
    for i in 0..n {
        let j = (i + 1) % n;
        polygons.push_face(&[0, 1 + i, 1 + j]);
        for base in [1, 1 + n] {
            polygons.push_face(&[base + i, base + n + i, base + n + j, base + j]);
        }
    }
    let mesh = QuadMesh::build(polygons).unwrap();
    for rule in [RemovalRule::Guarded, RemovalRule::Ring] {
        let kept = as_far_as_it_goes(&mesh, rule);
        assert!(is_three_connected(&kept), "{rule:?}");
        assert!(kept.vertex_count() < mesh.vertex_count());
    }
}

/// In the order of the indices a plane would merge to strips as long as its rows; merged faces stop at 64 corners.
#[test]
fn merged_faces_stay_moderate() {
    let kept = as_far_as_it_goes(&flat(200, 9), RemovalRule::Guarded);
    let largest = kept.faces().map(|f| kept.degree(f)).max().unwrap();
    assert!((60..=64).contains(&largest), "{largest}");
    assert!(is_three_connected(&as_far_as_it_goes(&flat(45, 5), RemovalRule::Guarded)));
}

/// The smallest 3-connected graphs cannot lose anything.
#[test]
fn tetrahedron_stays() {
    let mesh = QuadMesh::from_slices(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    )
    .unwrap();
    for rule in [RemovalRule::Guarded, RemovalRule::Ring] {
        assert_eq!(as_far_as_it_goes(&mesh, rule).vertex_count(), 4);
    }
    // One quad has no interior vertex at all.
    let quad = patch(1, 1, [false, false], |s, t| [s, t, 0.0]);
    assert_eq!(as_far_as_it_goes(&quad, RemovalRule::All).vertex_count(), 4);
}
