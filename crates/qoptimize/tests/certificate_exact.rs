//! The certificate against brute force with long integers, on random maps: proper ones, broken ones, and soups.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::maps::{Soup, disk_with_hole, grid_uv};
use common::{Random, exact, random_map};
use proptest::prelude::*;
use qoptimize::qmesh::{Polygons, Vec2};
use qoptimize::{Certificate, ViolationKind, certify};

fn verdict(soup: &Soup) -> Certificate {
    certify(soup.polygons.view(), &soup.uv, 3).unwrap()
}

fn brute_force(soup: &Soup) -> Option<String> {
    let view = soup.polygons.view();
    let faces: Vec<Vec<u32>> = (0..view.face_count()).map(|face| view.face(face).to_vec()).collect();
    let uv: Vec<[f64; 2]> = soup.uv.iter().map(|&p| p.into()).collect();
    exact::fault(&faces, &uv)
}

fn agree(soup: &Soup) -> bool {
    let (found, expected) = (verdict(soup), brute_force(soup));
    // Mirrored as a whole, a map overlaps nowhere, but is not certified.
    assert_eq!(found.holds, expected.is_none(), "{found}; {expected:?}");
    found.holds
}

/// A map that overlaps nowhere: a grid, perhaps with a hole, whose vertices are off their places by less than keeps quads convex, turned,
/// and scaled, beside another and one in its hole.
fn proper(seed: u64) -> Soup {
    let mut random = Random::new(seed);
    let n = 3 + random.below(4) as i32;
    let mut soup = if random.below(2) == 0 { grid_uv(n, n) } else { disk_with_hole(n, 1..n - 1) };
    jitter(&mut soup, &mut random, 0.15);
    if soup.uv.len() < 4 * (n * n) as usize {
        let mut inner = grid_uv(2, 2).placed([1.5, 1.5], f64::from(n - 3).max(0.1) / 2.0);
        inner.uv.iter_mut().for_each(|p| *p -= Vec2::new(0.25, 0.25));
        soup = soup.with(&inner);
    }
    let mut beside = grid_uv(2, 3).placed([f64::from(n) + 0.5, 0.0], 1.0);
    jitter(&mut beside, &mut random, 0.15);
    soup = soup.with(&beside);
    let (sin, cos) = (random.signed() * 3.2).sin_cos();
    let scale = f64::exp2(random.signed() * 30.0);
    soup.uv.iter_mut().for_each(|p| *p = Vec2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y) * scale);
    soup
}

/// Moves each vertex at random, all its corners alike.
fn jitter(soup: &mut Soup, random: &mut Random, amount: f64) {
    let shifts: Vec<Vec2> = soup
        .polygons
        .positions
        .iter()
        .map(|_| Vec2::new(random.signed(), random.signed()) * amount)
        .collect();
    for (p, &vertex) in soup.uv.iter_mut().zip(&soup.polygons.corner_vertex) {
        *p += shifts[vertex as usize];
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 120, failure_persistence: None, ..Default::default() })]

    /// What overlaps nowhere is certified, at any angle and size.
    #[test]
    fn proper_maps_hold(seed: u64) {
        let found = verdict(&proper(seed));
        prop_assert!(found.holds, "{found}");
        prop_assert_eq!(brute_force(&proper(seed)), None);
    }

    /// One vertex moved across the map breaks it, whichever it is, and its own faces are among those named.
    #[test]
    fn one_vertex_moved_across_breaks_it(seed: u64) {
        let mut soup = proper(seed);
        let mut random = Random::new(!seed);
        let count = soup.polygons.positions.len() as u32;
        let [from, to] = [random.below(count), random.below(count)];
        let place = |vertex: u32| {
            let corner = soup.polygons.corner_vertex.iter().position(|&v| v == vertex).unwrap();
            soup.uv[corner]
        };
        let (here, there) = (place(from), place(to));
        // Beyond another vertex, by the distance to it: out of reach of every quad around.
        let target = there + (there - here) * 0.75;
        for (p, &vertex) in soup.uv.iter_mut().zip(&soup.polygons.corner_vertex) {
            if vertex == from {
                *p = target;
            }
        }
        let (found, expected) = (verdict(&soup), brute_force(&soup));
        prop_assert_eq!(found.holds, expected.is_none(), "{}; {:?}", found, expected);
        if from == to {
            prop_assert!(found.holds);
        }
    }

    /// On soups of quads, triangles and hexagons with seams, on a lattice where touching and collinear edges are common, both say the same.
    #[test]
    fn agrees_with_brute_force(seed: u64, noise in 0_u32..7, seams: bool) {
        let (polygons, uv) = random_map(seed, noise, seams);
        agree(&Soup { polygons, uv });
    }

    /// The same on few faces over few vertices, whose edges need not pair up.
    #[test]
    fn agrees_on_tiny_soups(seed: u64) {
        agree(&tiny(seed));
    }
}

/// Up to four faces of three to six corners over nine lattice points, each vertex at its own place most of the time.
fn tiny(seed: u64) -> Soup {
    let mut random = Random::new(seed);
    let mut soup = Soup { polygons: Polygons { face_start: vec![0], ..Polygons::default() }, uv: Vec::new() };
    soup.polygons.positions = vec![Default::default(); 16];
    for _ in 0..=random.below(4) {
        let degree = [3, 3, 4, 4, 4, 5, 6][random.below(7) as usize];
        let mut vertices: Vec<u32> = Vec::new();
        while vertices.len() < degree {
            let vertex = random.below(16);
            if !vertices.contains(&vertex) {
                vertices.push(vertex);
            }
        }
        // By angle around a middle: polygons that are simple more often than not.
        let place = |v: u32| Vec2::new(f64::from(v % 4), f64::from(v / 4));
        let middle = vertices.iter().map(|&v| place(v)).sum::<Vec2>() / degree as f64;
        vertices.sort_by(|&a, &b| {
            let angle = |v: u32| (place(v).y - middle.y).atan2(place(v).x - middle.x);
            angle(a).total_cmp(&angle(b))
        });
        soup.uv.extend(vertices.iter().map(|&v| place(v)));
        soup.polygons.push_face(&vertices);
    }
    soup
}

/// The comparison is not empty: both verdicts are frequent, and every kind that a soup can have occurs.
#[test]
fn both_verdicts_occur() {
    let (mut holds, mut kinds) = ([0, 0], std::collections::BTreeSet::new());
    for seed in 0..600 {
        let (polygons, uv) = random_map(seed, (seed % 5) as u32, seed % 3 == 0);
        for soup in [Soup { polygons, uv }, tiny(seed)] {
            holds[usize::from(agree(&soup))] += 1;
            kinds.extend(verdict(&soup).counts.into_keys());
        }
    }
    assert!(holds.iter().all(|&count| count > 100), "{holds:?}");
    for kind in [
        ViolationKind::FlippedCorner,
        ViolationKind::ConcaveQuad,
        ViolationKind::FlatCorner,
        ViolationKind::NotSimple,
        ViolationKind::MirroredIsland,
        ViolationKind::NonmanifoldEdge,
        ViolationKind::Pinch,
        ViolationKind::Crossing,
        ViolationKind::Touching,
        ViolationKind::IslandOnIsland,
    ] {
        assert!(kinds.contains(&kind), "{kind:?} never occurred: {kinds:?}");
    }
}
