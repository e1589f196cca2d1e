//! `max_stretch`: no island is stretched more, or it is said why; more stretch allowed, fewer cuts.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use qoptimize::atlas::{self, Atlas, RefinementEnd};
use qoptimize::qmesh::{Polygons, QuadMesh, Seams, shapes};
use qoptimize::{AtlasError, AtlasOptions, Options};

fn polygons(mesh: &QuadMesh) -> Polygons {
    let view = mesh.view();
    Polygons {
        positions: view.positions.to_vec(),
        face_start: view.face_start.to_vec(),
        corner_vertex: view.corner_vertex.to_vec(),
    }
}

fn unwrapped(mesh: &QuadMesh, bound: Option<f64>) -> Atlas {
    let options = AtlasOptions { max_stretch: bound, ..AtlasOptions::default() };
    atlas::unwrap(polygons(mesh).view(), &Seams::default(), &options, &()).unwrap()
}

fn surfaces() -> [(&'static str, QuadMesh); 3] {
    [("sphere", shapes::sphere(4)), ("cap", shapes::cap(8, 2.6)), ("torus", shapes::torus(16, 10))]
}

/// No island is stretched by more than the bound, unless its refinement says that more cuts would not help; certified all the same. With a
/// lower bound there are never fewer cuts, and what is cut for a higher one is how the cuts for a lower one begin.
#[test]
fn the_bound_holds_or_it_is_said_why_not() {
    for (name, mesh) in surfaces() {
        let free = unwrapped(&mesh, None);
        assert!(free.islands.iter().all(|island| island.refinement.is_none()), "{name}");
        let mut before: (usize, f64, Vec<f64>) = (0, free.seams.length, Vec::new());
        let mut reached = 0;
        for bound in [1e3, 3.0, 2.0, 1.6, 1.4, 1.25, 1.15] {
            let atlas = unwrapped(&mesh, Some(bound));
            assert!(atlas.certificate.holds, "{name}, {bound}: {}", atlas.certificate);
            assert_eq!(atlas.islands.len(), free.islands.len(), "{name}: cuts open, they do not take apart");
            let [island] = &atlas.islands[..] else { panic!("{name}: one island") };
            let cuts: Vec<f64> =
                island.refinement.iter().flat_map(|r| &r.cuts).map(|cut| cut.stretch).collect();
            let last = cuts.last().copied().unwrap_or(free.islands[0].stretch);
            assert!((last / island.stretch - 1.0).abs() < 1e-9, "{name}, {bound}: {last} {}", island.stretch);
            match &island.refinement {
                None => assert!(free.islands[0].stretch <= bound, "{name}, {bound}"),
                Some(refinement) if refinement.end == RefinementEnd::Reached => {
                    assert!(island.stretch <= bound, "{name}, {bound}: {}", island.stretch);
                    assert!(cuts[..cuts.len() - 1].iter().all(|&s| s > bound), "{name}: no cut too many");
                    reached += 1;
                }
                Some(refinement) => {
                    assert!(island.stretch > bound, "{name}, {bound}");
                    assert!(cuts.iter().all(|&s| s >= island.stretch), "{name}: the best of all");
                    assert!(island.stretch <= refinement.stretch, "{name}: no worse than without");
                    continue;
                }
            }
            assert!(cuts.len() >= before.0 && atlas.seams.length >= before.1 - 1e-9, "{name}, {bound}");
            assert_eq!(cuts[..before.2.len()], before.2, "{name}, {bound}: the same cuts first");
            let added: f64 = island.refinement.iter().flat_map(|r| &r.cuts).map(|cut| cut.length).sum();
            assert!(
                (free.seams.length + added - atlas.seams.length).abs() < 1e-9,
                "{name}, {bound}: lengths add up"
            );
            before = (cuts.len(), atlas.seams.length, cuts);
        }
        assert!(reached > 0, "{name}: some bound is reached by cutting");
    }
}

/// What belongs to the vertices of one island as it is cannot go with further cuts.
#[test]
fn cuts_exclude_given_places() {
    let mesh = polygons(&shapes::cap(4, 2.0));
    let map = Options { symmetric: true, ..Options::default() };
    let options = AtlasOptions { max_stretch: Some(2.0), map, ..AtlasOptions::default() };
    let refused = atlas::unwrap(mesh.view(), &Seams::default(), &options, &()).unwrap_err();
    assert_eq!(refused, AtlasError::CutsExclude("symmetric maps"));
}
