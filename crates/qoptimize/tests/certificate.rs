//! The certificate: each fault is found, under its own name and in its place, and nothing else is.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::maps::{Soup, at, chain, disk_with_hole, grid_uv};
use qoptimize::qmesh::{Polygons, QuadMesh, Vec2, shapes};
use qoptimize::{Certificate, ViolationKind, certify};

use ViolationKind::{
    BranchPoint, ConcaveQuad, Crossing, FlatCorner, FlippedCorner, FlippedFace, HoleCounterClockwise,
    IslandOnIsland, MirroredIsland, NoBoundary, NonmanifoldEdge, NotFinite, NotSimple, Pinch, TooFewCorners,
    Touching,
};

fn verdict(soup: &Soup) -> Certificate {
    let found = certify(soup.polygons.view(), &soup.uv, usize::MAX).unwrap();
    assert_eq!(found.holds, found.complete && found.counts.is_empty());
    assert_eq!(found.violation_count(), found.violations.len(), "all are listed");
    found
}

fn kinds(soup: &Soup) -> Vec<(ViolationKind, usize)> {
    verdict(soup).counts.into_iter().collect()
}

/// Faces of the places of all violations of a kind.
fn faces(found: &Certificate, kind: ViolationKind) -> Vec<usize> {
    let of_kind = found.violations.iter().filter(|violation| violation.kind == kind);
    let mut faces: Vec<usize> = of_kind.flat_map(|v| v.places.iter().map(|place| place.face)).collect();
    faces.sort_unstable();
    faces.dedup();
    faces
}

/// What is as it should be: a flat mesh over itself, of any size that `f64` can hold, moved anywhere.
#[test]
fn flat_meshes_hold_at_every_scale() {
    for scale in [1.0, 1e-300, 1e-310, 1e300, 1e-3] {
        let mut soup = grid_uv(6, 5);
        soup.uv.iter_mut().for_each(|p| *p *= scale);
        let found = verdict(&soup);
        assert!(found.holds, "{scale}: {found}");
        assert_eq!((found.faces, found.islands, found.boundary_loops), (30, 1, 1));
    }
    let mut soup = grid_uv(6, 5);
    soup.uv.iter_mut().for_each(|p| *p += Vec2::new(1e9, -3e12));
    assert!(verdict(&soup).holds);
}

/// One vertex too far: the quad that it leaves behind it is concave, or folded, and named.
#[test]
fn a_single_flip() {
    // Vertex (2, 2) of a 4 × 4 grid, towards the corner (3, 3) of the quad between them: face 10.
    let mut soup = grid_uv(4, 4);
    soup.move_vertex([2.0, 2.0], [2.6, 2.6]);
    let found = verdict(&soup);
    assert_eq!(found.counts, [(ConcaveQuad, 1)].into());
    let place = &found.violations[0].places[0];
    assert_eq!((place.face, place.uv, place.vertex), (10, [2.6, 2.6], 12));
    // Beyond the corner, no split of that quad works, and its neighbours are folded, too.
    let mut soup = grid_uv(4, 4);
    soup.move_vertex([2.0, 2.0], [3.4, 3.4]);
    let found = verdict(&soup);
    assert!(faces(&found, FlippedCorner).contains(&10), "{:?}", found.violations);
    assert!(!found.holds && !found.counts.contains_key(&Touching));
}

/// A triangle turned over.
#[test]
fn a_flipped_triangle() {
    let soup = Soup::new(&[&[[0, 0], [4, 0], [0, 4]], &[[4, 0], [0, 0], [4, 4]]]);
    let found = verdict(&soup);
    assert_eq!(faces(&found, FlippedCorner), [1]);
    assert_eq!(found.counts[&FlippedCorner], 3);
}

/// On the diagonal of a quad, exactly: one corner has no area. A hair to either side decides.
#[test]
fn a_corner_without_area() {
    let moved = |x: f64, y: f64| {
        let mut soup = grid_uv(4, 4);
        soup.move_vertex([2.0, 2.0], [x, y]);
        soup
    };
    let found = verdict(&moved(2.5, 2.5));
    assert_eq!(found.counts, [(FlatCorner, 1)].into());
    assert_eq!((found.violations[0].places[0].face, found.violations[0].places[0].uv), (10, [2.5, 2.5]));
    assert!(verdict(&moved(2.5, 2.5f64.next_down())).holds);
    assert_eq!(kinds(&moved(2.5, 2.5f64.next_up())), [(ConcaveQuad, 1)]);
    // Onto another vertex: an edge without length.
    let found = verdict(&moved(3.0, 2.0));
    assert!(faces(&found, FlatCorner).contains(&6) && faces(&found, FlatCorner).contains(&10));
}

/// A strip bent into a ring: its ends apart, touching along an edge, in a point, and crossing.
#[test]
fn boundaries_that_touch_and_cross() {
    let ring = [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]];
    assert!(verdict(&chain(&ring[..7])).holds);
    let closed = verdict(&chain(&ring));
    assert_eq!(closed.counts.keys().collect::<Vec<_>>(), [&Touching]);
    assert_eq!(
        faces(&closed, Touching),
        [0, 1, 7],
        "first and last, and the one that shares a vertex with the first"
    );
    // The far end of the seventh cell, drawn out to touch the first one in a point, then into it.
    let drawn = |tip: f64| {
        let mut soup = chain(&ring[..7]);
        soup.move_corner(6, [0.0, 2.0], [0.5, tip]);
        soup
    };
    assert!(verdict(&drawn(1.25)).holds);
    let touching = verdict(&drawn(1.0));
    assert_eq!(touching.counts, [(Touching, 2)].into());
    for violation in &touching.violations {
        assert_eq!(violation.places.iter().map(|place| place.face).collect::<Vec<_>>(), [0, 6]);
        assert!(violation.names_edges() && violation.islands == [0]);
    }
    let crossing = verdict(&drawn(0.75));
    assert_eq!(crossing.counts, [(Crossing, 2)].into());
    assert_eq!(faces(&crossing, Crossing), [0, 6]);
}

/// A slit: a boundary that runs back along itself.
#[test]
fn a_closed_slit_touches_itself() {
    // Around the end of a cut between two cells, whose sides lie on each other.
    let ring = [[1, 1], [0, 1], [0, 0], [1, 0]];
    let mut soup = chain(&ring);
    let found = verdict(&soup);
    assert_eq!(found.counts, [(Touching, 4)].into(), "along the slit, and three times where it begins");
    let is_neighbor = |edges: &[qoptimize::certificate::Place]| edges[0].to_vertex == Some(edges[1].vertex);
    let back: Vec<_> = found.violations.iter().filter(|violation| is_neighbor(&violation.places)).collect();
    assert_eq!((back.len(), back[0].places[1].uv), (1, [1.0, 1.0]), "it turns back in the middle");
    // Opened by a hair it is a proper boundary.
    soup.move_corner(3, [2.0, 1.0], [2.0, 1.0f64.next_down()]);
    assert!(verdict(&soup).holds);
}

/// Two sheets glued crosswise along a slit: every corner turns left, no boundaries meet, but the small sheet's boundary, a hole of
/// the whole, runs as an outer one does, and the map covers its inside twice.
#[test]
fn a_hole_that_runs_the_wrong_way_round() {
    let soup = common::maps::two_sheets();
    let found = verdict(&soup);
    assert_eq!((found.islands, found.boundary_loops), (1, 2));
    assert_eq!(found.counts, [(BranchPoint, 2), (HoleCounterClockwise, 1)].into());
    let branches = found.violations.iter().filter(|v| v.kind == BranchPoint);
    let ends: Vec<_> = branches.map(|v| (v.places[0].uv, v.times)).collect();
    assert_eq!(ends, [([3.0, 4.0], 2), ([5.0, 4.0], 2)]);
}

/// A proper hole holds; an island fits into it, and another into the hole of that one; on the material there is no room.
#[test]
fn one_island_inside_another() {
    let outer = disk_with_hole(9, 3..6);
    assert_eq!((verdict(&outer).holds, verdict(&outer).boundary_loops), (true, 2));
    let small = |corner: [f64; 2], size: f64| grid_uv(3, 3).placed(corner, size / 3.0);
    assert!(verdict(&outer.with(&small([3.5, 3.5], 2.0))).holds, "in the hole");
    let ring = disk_with_hole(9, 3..6).placed([3.25, 3.25], 2.5 / 9.0);
    assert!(verdict(&outer.with(&ring).with(&small([4.25, 4.25], 0.5))).holds, "in the hole in the hole");
    let found = verdict(&outer.with(&small([0.25, 0.25], 2.0)));
    assert_eq!(found.counts, [(IslandOnIsland, 1)].into());
    assert_eq!(found.violations[0].islands, [1, 0]);
    assert!(found.violations[0].places[0].face >= 72 && found.violations[0].places[1].face < 72);
    // In the hole, with the inner island's own hole around nothing: the innermost island lies on the ring's material.
    let found = verdict(&outer.with(&ring).with(&small([3.3, 3.3], 0.5)));
    assert_eq!(
        (found.counts, found.violations[0].islands.clone()),
        ([(IslandOnIsland, 1)].into(), vec![2, 1])
    );
}

/// An island exactly on another one, one that crosses it, and one whose corner touches its side.
#[test]
fn islands_that_meet() {
    let first = grid_uv(2, 2);
    let at = |x: f64, y: f64| first.with(&grid_uv(2, 2).placed([x, y], 1.0));
    let same = verdict(&at(0.0, 0.0));
    assert_eq!(same.islands, 2);
    assert_eq!(same.counts.keys().collect::<Vec<_>>(), [&Touching]);
    assert!(same.violations.iter().any(|v| v.islands == [0, 1]));
    let crossing = verdict(&at(0.5, 0.25));
    assert_eq!(crossing.counts, [(Crossing, 2)].into());
    assert!(crossing.violations.iter().all(|v| v.islands == [0, 1]));
    let diamond = Soup::new(&[&[[2, 1], [4, 0], [6, 1], [4, 2]]]);
    let found = verdict(&first.with(&diamond));
    assert!(found.counts.keys().eq([&Touching]), "{found}");
    assert!(found.violations.iter().all(|v| v.places[1].face == 4 && (v.places[0].uv[0] == 2.0)));
    assert!(verdict(&first.with(&diamond.placed([1e-15, 0.0], 1.0))).holds, "apart by a hair");
}

/// A pentagram turns left at every corner. A concave pentagon does not, and is fine; clockwise it is flipped, and mirrored as the whole
/// island that it is.
#[test]
fn polygons_of_five_corners_and_more() {
    let star: &[[i32; 2]] = &[[0, 9], [-6, -8], [9, 3], [-9, 3], [6, -8]];
    assert!(kinds(&Soup::new(&[star])).starts_with(&[(NotSimple, 1)]));
    let concave: &[[i32; 2]] = &[[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]];
    assert!(verdict(&Soup::new(&[concave])).holds);
    let notch: &[[i32; 2]] = &[[0, 4], [2, 1], [4, 4]];
    assert!(verdict(&Soup::new(&[concave, notch])).holds);
    let reversed: Vec<[i32; 2]> = concave.iter().rev().copied().collect();
    assert_eq!(kinds(&Soup::new(&[&reversed])), [(MirroredIsland, 1)]);
    let found = verdict(&Soup::new(&[&reversed, &[[0, 0], [0, -4], [4, 0]]]));
    assert_eq!(faces(&found, FlippedFace), [0]);
}

/// Wound twice round a ring, every corner turns left; a wheel wound twice has a branch point in its middle as well.
#[test]
fn double_covers_whose_corners_all_turn_left() {
    let wound = |mesh: &QuadMesh, wobble: f64| {
        let place = |p: qoptimize::qmesh::Vec3| {
            let (radius, angle) = (p.xy().norm() * (3.0 - p.z), p.y.atan2(p.x));
            Vec2::new((2.0 * angle).cos(), (2.0 * angle).sin())
                * radius
                * (1.0 + wobble * (angle / 2.0).sin())
        };
        Soup {
            polygons: polygons(mesh),
            uv: mesh.corners().map(|c| place(mesh.position(mesh.vertex(c)))).collect(),
        }
    };
    for wobble in [0.0, 0.1] {
        let found = verdict(&wound(&shapes::cylinder(24, 3), wobble));
        let kind = found.counts.keys().copied().collect::<Vec<_>>();
        assert_eq!((found.boundary_loops, found.islands), (2, 1));
        assert!(kind.iter().all(|kind| matches!(kind, Crossing | Touching)) && !kind.is_empty(), "{found}");
        let wheel = shapes::hostile_disk(shapes::Hostility::Pole, 10);
        assert_eq!(wheel.face_count(), 12);
        let found = verdict(&wound(&wheel, wobble));
        assert_eq!(found.counts[&BranchPoint], 1, "{found}");
        assert!(found.counts.contains_key(&Crossing) || found.counts.contains_key(&Touching));
        assert!(!found.counts.contains_key(&FlippedCorner));
        let branch = found.violations.iter().find(|v| v.kind == BranchPoint).unwrap();
        assert_eq!((branch.places[0].vertex, branch.times), (0, 2));
    }
}

fn polygons(mesh: &QuadMesh) -> Polygons {
    let view = mesh.view();
    Polygons {
        positions: view.positions.to_vec(),
        face_start: view.face_start.to_vec(),
        corner_vertex: view.corner_vertex.to_vec(),
    }
}

/// Coordinates that are no numbers are named, and nothing holds; nor is anything else made up.
#[test]
fn coordinates_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut soup = grid_uv(3, 3);
        soup.uv[21].y = bad;
        let found = verdict(&soup);
        assert_eq!(found.counts, [(NotFinite, 1)].into(), "{bad}");
        let place = &found.violations[0].places[0];
        assert_eq!((place.face, place.corner, found.complete), (5, 21, false));
        soup.uv.fill(Vec2::new(bad, bad));
        assert_eq!(kinds(&soup), [(NotFinite, 36)]);
    }
}

/// An island turned over as a whole has one violation, whatever else it has.
#[test]
fn a_mirrored_island() {
    let mirrored = {
        let mut soup = disk_with_hole(9, 3..6);
        soup.uv.iter_mut().for_each(|p| p.x = 20.0 - p.x);
        soup
    };
    let found = verdict(&disk_with_hole(9, 3..6).with(&mirrored));
    assert_eq!(found.counts, [(MirroredIsland, 1)].into());
    assert_eq!((found.violations[0].islands.clone(), found.violations[0].times), (vec![1], 72));
    // On another island's material even so.
    let found = verdict(&grid_uv(30, 30).with(&mirrored.placed([1.5, 1.5], 1.0)));
    assert_eq!(found.counts, [(MirroredIsland, 1), (IslandOnIsland, 1)].into());
}

/// Three faces at one edge; two that run the same way.
#[test]
fn edges_that_do_not_pair_up() {
    let [low, high, third]: [&[[i32; 2]]; 3] =
        [&[[0, 0], [4, 0], [4, -4]], &[[4, 0], [0, 0], [2, 4]], &[[4, 0], [0, 0], [3, 5]]];
    let mirrored: Vec<[i32; 2]> = low.iter().map(|p| [p[0], p[1]]).rev().collect();
    let found = verdict(&Soup::new(&[&mirrored, high, third]));
    assert_eq!(found.counts[&NonmanifoldEdge], 1);
    let violation = found.violations.iter().find(|v| v.kind == NonmanifoldEdge).unwrap();
    assert_eq!((violation.times, violation.places[0].to_vertex.is_some()), (3, true));
    assert_eq!(verdict(&Soup::new(&[high, third])).counts[&NonmanifoldEdge], 1);
}

/// Cells that share a point only: the boundary passes it twice.
#[test]
fn a_pinched_vertex() {
    let found = verdict(&Soup::new(&[&[[0, 0], [1, 0], [1, 1], [0, 1]], &[[1, 1], [2, 1], [2, 2], [1, 2]]]));
    assert_eq!(found.counts, [(Pinch, 1)].into());
    assert_eq!((found.violations[0].places[0].uv, found.violations[0].times), ([1.0, 1.0], 2));
}

/// A doublet is held to its two certified corners, and is named; it holds on the diagonal and off it, until the certified split breaks.
#[test]
fn quads_that_no_map_makes_convex() {
    let doublet =
        |x: i32, y: i32| Soup::new(&[&[[0, 0], [8, 0], [8, 8], [x, y]], &[[0, 0], [x, y], [8, 8], [0, 8]]]);
    for (x, y, exempt) in [(4, 4, vec![0, 1]), (5, 3, vec![0]), (2, 5, vec![1])] {
        let found = verdict(&doublet(x, y));
        assert!(found.holds, "({x}, {y}): {found}");
        assert_eq!(found.exempt_faces, exempt);
    }
    assert!(!verdict(&doublet(8, 4)).holds, "an edge of the other diagonal's triangles has no area");
    assert!(!verdict(&doublet(9, 4)).holds);
    // The same dart, with nothing that shares its diagonal, is not exempt.
    assert_eq!(kinds(&Soup::new(&[&[[0, 0], [8, 0], [8, 8], [5, 3]]])), [(ConcaveQuad, 1)]);
}

/// A sphere laid flat covers nothing without flips, and has no boundary.
#[test]
fn a_closed_surface() {
    let mesh = shapes::sphere(3);
    let uv = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy()).collect();
    let found = verdict(&Soup { polygons: polygons(&mesh), uv });
    assert_eq!(found.counts[&NoBoundary], 1);
    assert!(!found.holds && found.boundary_loops == 0);
}

/// Faces without enough corners, in any place.
#[test]
fn faces_of_fewer_than_three_corners() {
    let mut polygons = Polygons::new(&[[0.0; 3]; 4], [vec![], vec![0], vec![0, 1], vec![0, 1, 2], vec![]]);
    let uv = vec![at(0, 0), at(0, 0), at(4, 0), at(0, 0), at(4, 0), at(4, 4)];
    let found = verdict(&Soup { polygons: polygons.clone(), uv: uv.clone() });
    assert_eq!(faces(&found, TooFewCorners), [0, 1, 2, 4]);
    polygons.face_start[4] = 9;
    assert!(certify(polygons.view(), &uv, 9).is_err());
    assert!(certify(Polygons::default().view(), &[], 9).is_err());
}

/// The list is bounded, the counts are not; one thread and three give the same.
#[test]
fn bounded_lists_and_any_number_of_threads() {
    let mut soup = grid_uv(60, 60);
    soup.uv.iter_mut().enumerate().for_each(|(i, p)| p.x += (i * i % 97) as f64 / 31.0);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| certify(soup.polygons.view(), &soup.uv, 5).unwrap())
    };
    let found = on(1);
    assert_eq!(found, on(3));
    for (kind, &count) in &found.counts {
        let listed = found.violations.iter().filter(|violation| violation.kind == *kind).count();
        assert_eq!(listed, count.min(5), "{kind:?}");
    }
    assert!(found.violation_count() > 100);
}

/// What people read.
#[test]
fn in_words() {
    let mut soup = grid_uv(4, 4);
    soup.move_vertex([2.0, 2.0], [2.6, 2.6]);
    let across = grid_uv(1, 1).placed([1.5, -0.5], 1.0);
    let apart = grid_uv(3, 3).placed([9.0, 0.0], 1.0).with(&grid_uv(1, 1).placed([9.25, 1.25], 0.5));
    let found = verdict(&soup.with(&across).with(&apart));
    let text: Vec<String> = found.violations.iter().map(ToString::to_string).collect();
    insta::assert_snapshot!(format!("{found}\n{}", text.join("\n")), @r"
    fails: 1 concave corner of a quad, 2 boundary crossings, 1 island on another
    face 10, vertex 12 at (2.6, 2.6): the quad is concave here: split across the other diagonal it overlaps itself
    face 1, edge 1-4 from (1, 0) to (2, 0) crosses face 16, edge 28-25 from (1.5, 0.5) to (1.5, -0.5) (islands 0 and 1)
    face 2, edge 4-6 from (2, 0) to (3, 0) crosses face 16, edge 26-27 from (2.5, -0.5) to (2.5, 0.5) (islands 0 and 1)
    face 26, edge 45-46 from (9.25, 1.25) to (9.75, 1.25): island 3 lies on island 2, inside face 17, edge 29-30 from (9, 0) to (10, 0)
    ");
    assert_eq!(verdict(&grid_uv(2, 2)).to_string(), "holds");
}
