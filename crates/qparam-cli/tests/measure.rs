//! `qparam measure`: figures for UVs that a file already has.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{Folder, flat_with_uv, hill};

/// A flat mesh with its own positions as UVs is an isometry: no error of any kind.
#[test]
fn a_flat_mesh_with_its_own_positions_has_no_error() {
    let folder = Folder::new();
    folder.write("flat.obj", flat_with_uv(3));
    let json = folder.qparam(&["measure", "flat.obj", "--json", "--check"]).code(0).json();
    let (file, distortion) = (&json["files"][0], &json["files"][0]["distortion"]);
    assert_eq!((&json["schema_version"], &file["valid"]), (&2.into(), &true.into()));
    for (field, expected) in [
        ("angle_error", 0.0),
        ("angle_error_mean", 0.0),
        ("area_error", 0.0),
        ("area_error_mean", 0.0),
        ("symmetric_dirichlet", 1.0),
        ("singular_ratio_max", 1.0),
        ("stretch_l2", 1.0),
    ] {
        assert!((distortion[field].as_f64().unwrap() - expected).abs() < 1e-12, "{field}: {distortion}");
    }
    for (field, expected) in
        [("faces", 9), ("islands", 1), ("flipped_corners", 0), ("folded_faces", 0), ("boundary_crossings", 0)]
    {
        assert_eq!(distortion[field], expected, "{field}");
    }
}

/// One vertex of a unit grid moved two cells away turns faces over; `--check` tells scripts.
#[test]
fn flips_are_found() {
    let folder = Folder::new();
    folder.write("bad.obj", flat_with_uv(3).replace("vt 1 1\n", "vt 2.5 2.5\n"));
    let run = folder.qparam(&["measure", "bad.obj", "--check", "--json"]).code(7);
    assert!(run.json()["files"][0]["distortion"]["flipped_corners"].as_u64().unwrap() > 0);
    assert_eq!(run.json()["files"][0]["valid"], false);
    folder.qparam(&["measure", "bad.obj"]).code(0);
}

#[test]
fn several_files_stand_side_by_side() {
    let folder = Folder::new();
    folder.write("flat.obj", flat_with_uv(2));
    folder.write("wide.obj", flat_with_uv(2).replace("vt 2 ", "vt 3 "));
    insta::assert_snapshot!(folder.qparam(&["measure", "flat.obj", "wide.obj"]).code(0).stdout);
}

#[test]
fn a_mesh_without_uvs_is_refused() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    let run = folder.qparam(&["measure", "in.obj"]).code(3);
    insta::assert_snapshot!(run.stderr, @r"
    error: in.obj: 16 of 16 corners have no UV, the first in face 1 (line 15)
      help: every corner needs a texture index (`f 1/1 2/2 …`); `qparam unwrap` computes UVs
    ");
}

/// UVs of some faces only, and UVs that are no place in the plane, are told apart and named by their line.
#[test]
fn uvs_that_are_lacking_are_named() {
    let folder = Folder::new();
    let text = flat_with_uv(2);
    let last = text.trim_end().rsplit('\n').next().unwrap().to_owned();
    let bare = last.replace("/5", "").replace("/6", "").replace("/8", "").replace("/9", "");
    for (content, expected) in [
        (text.replace(&last, &bare), "4 of 16 corners have no UV, the first in face 4 (line 22)"),
        (text.replace("vt 2 2", "vt nan 2"), "1 of 16 corners have a UV that is not finite"),
        (text.replace("vt 2 2", "vt 2 -inf"), "or beyond 1e60, the first in face 4 (line 22)"),
        (text.replace("vt 2 2", "vt 1e300 2"), "or beyond 1e60, the first in face 4 (line 22)"),
    ] {
        folder.write("in.obj", content);
        let run = folder.qparam(&["measure", "in.obj"]).code(3);
        assert!(run.stderr.contains(expected), "{expected}: {}", run.stderr);
    }
}
