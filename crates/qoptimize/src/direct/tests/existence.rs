//! Which quads can be convex, and that the start makes all others so.

use std::collections::BTreeSet;

use super::super::rest::Rest;
use super::super::start::judge;
use super::super::{DescentOptions, Objective, find_start, minimize};
use crate::convexity::Exempt;
use crate::qmesh::shapes::{Hostility, hostile_disk};
use crate::qmesh::{FaceId, QuadMesh};

/// Quads that share their opposite vertices with another, found by comparing all pairs of quads.
fn brute_force(mesh: &QuadMesh) -> Vec<FaceId> {
    let diagonals = |face: FaceId| -> Vec<BTreeSet<u32>> {
        let v: Vec<u32> = mesh.face_vertices(face).map(|v| v.0).collect();
        vec![BTreeSet::from([v[0], v[2]]), BTreeSet::from([v[1], v[3]])]
    };
    mesh.faces()
        .filter(|&face| {
            mesh.faces()
                .any(|other| other != face && diagonals(face).iter().any(|d| diagonals(other).contains(d)))
        })
        .collect()
}

/// The sorted list of diagonals finds exactly the quads that no planar map can make convex.
#[test]
fn exempt_quads_are_those_that_share_a_diagonal() {
    for hostility in Hostility::ALL {
        for seed in 0..10 {
            let mesh = hostile_disk(hostility, seed);
            let found = Exempt::find(&mesh).faces();
            assert_eq!(found, brute_force(&mesh), "{hostility:?} {seed}");
            let one_by_one: Vec<FaceId> =
                mesh.faces().filter(|&face| Exempt::contains(&mesh, face)).collect();
            assert_eq!(found, one_by_one, "{hostility:?} {seed}");
        }
    }
}

/// Every hostile disk gets a start in which all corners turn left, exempt ones aside, and the descent keeps it so while the
/// energy falls.
#[test]
fn hostile_disks_start_and_stay_valid() {
    for hostility in Hostility::ALL {
        for seed in 0..6 {
            let mesh = hostile_disk(hostility, seed);
            let exempt = Exempt::find(&mesh);
            let rest = Rest::new(&mesh, &exempt);
            let start = find_start(&mesh, &exempt, &())
                .unwrap_or_else(|error| panic!("{hostility:?} {seed}: {error}"));
            assert!(judge(&rest, &start.uv).valid().is_some(), "{hostility:?} {seed}: start");
            let mut uv = start.uv;
            let options = DescentOptions { max_steps: 20, ..Default::default() };
            let descent = minimize(&mesh, &mut uv, &exempt, &Objective::default(), &options, &())
                .unwrap_or_else(|error| panic!("{hostility:?} {seed}: {error}"));
            assert!(judge(&rest, &uv).valid().is_some(), "{hostility:?} {seed}: end");
            assert!(descent.energy <= descent.energy_before, "{hostility:?} {seed}: {descent:?}");
        }
    }
}
