//! Real quad meshes, from the folder that `QPARAM_MESHES` names; skipped without it.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // in helpers: helpers of tests are tests too

use qcurv::qmesh::QuadMesh;
use qcurv::qmesh::obj::ObjDocument;
use qsimplify::{RemovalRule, Simplified, SimplifyOptions, Threshold, simplify};

fn meshes(names: &[&'static str]) -> Vec<(&'static str, QuadMesh)> {
    let Ok(folder) = std::env::var("QPARAM_MESHES") else {
        println!("skipped: QPARAM_MESHES is not set");
        return Vec::new();
    };
    let folder = std::path::Path::new(&folder);
    let load = |name: &&'static str| {
        let file = std::fs::File::open(folder.join(name).with_extension("obj")).unwrap();
        let document = ObjDocument::read(file).unwrap();
        (*name, QuadMesh::build(document.polygons()).unwrap())
    };
    names.iter().map(load).collect()
}

fn run(mesh: &QuadMesh, rule: RemovalRule, fraction: f64) -> Simplified {
    let options = SimplifyOptions { rule, threshold: Threshold::Fraction(fraction), ..Default::default() };
    simplify(mesh, &options, &()).unwrap()
}

/// Faces, heads, horns, terrain: deletion alone ends between a fifth and a quarter (the smoother, the more), rings go on
/// to nineteen in twenty; topology stays, and no vertex inside is left with fewer than three edges unless it had fewer.
#[test]
fn reach_of_the_guarded_rules() {
    for (name, mesh) in
        meshes(&["face_makehuman_disk", "head_soma", "goathead_qd", "terrain_jacksboro", "bob_cc2"])
    {
        let thin = |s: &Simplified| s.connectivity(&mesh).degree_2;
        let before = thin(&run(&mesh, RemovalRule::None, 0.0));
        for (rule, reach) in [(RemovalRule::Guarded, 0.19..0.25), (RemovalRule::Ring, 0.93..0.98)] {
            let simplified = run(&mesh, rule, 1.0);
            let share = simplified.removed.len() as f64 / simplified.candidates as f64;
            assert!(reach.contains(&share), "{name} {rule:?}: {share}");
            let connectivity = simplified.connectivity(&mesh);
            assert!(connectivity.degree_2 <= before, "{name} {rule:?}: {connectivity:?}");
            assert_eq!((connectivity.isolated, connectivity.degree_1), (0, 0), "{name} {rule:?}");
            assert_eq!(connectivity.cut_off == 0, mesh.topology().boundary_loops > 0, "{name} {rule:?}");
            let kept = QuadMesh::build(simplified.polygons(&mesh)).unwrap();
            assert_eq!(kept.topology(), mesh.topology(), "{name} {rule:?}");
        }
    }
}

/// What deletion as printed does to real meshes: at a third most of the interior has come loose, at six tenths all.
#[test]
fn naive_deletion_takes_meshes_apart() {
    for (name, mesh) in meshes(&["face_makehuman_disk", "head_soma"]) {
        let [few, some, many] =
            [0.1, 0.3, 0.6].map(|fraction| run(&mesh, RemovalRule::Naive, fraction).connectivity(&mesh));
        assert!(
            few.isolated > 0 && few.degree_1 > few.isolated && few.degree_2 > few.degree_1,
            "{name}: {few:?}"
        );
        assert!(few.cut_off * 100 < few.interior, "{name}: {few:?}");
        assert!(some.cut_off * 10 > some.interior * 9, "{name}: {some:?}");
        assert_eq!(many.cut_off, many.interior, "{name}: {many:?}");
    }
}
