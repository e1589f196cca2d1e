//! `qparam info`: what a mesh is, and what `unwrap` would mend.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{CUBE, Folder, hill};

fn info(text: &str) -> String {
    let folder = Folder::new();
    folder.write("in.obj", text);
    folder.qparam(&["info", "in.obj"]).code(0).stdout
}

#[test]
fn a_hill() {
    insta::assert_snapshot!(info(&hill(8)));
}

#[test]
fn a_cube_is_closed() {
    insta::assert_snapshot!(info(CUBE));
}

/// A vertex that nobody uses, a doublet, a face that is there twice, an edge of three faces.
#[test]
fn what_is_odd_is_listed() {
    let text = "\
v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0.2\nv 9 9 9\nv 9 9 9
f 1 2 3 5\nf 1 5 3 4\nf 1 5 3 4\nf 1 2 4
";
    insta::assert_snapshot!(info(text));
}

#[test]
fn programs_get_the_same_as_json() {
    let folder = Folder::new();
    folder.write("in.obj", CUBE);
    let json = folder.qparam(&["info", "in.obj", "--json"]).code(0).json();
    for (field, expected) in
        [("vertices", 8), ("edges", 12), ("faces", 6), ("quads", 6), ("boundary_edges", 0)]
    {
        assert_eq!(json[field], expected, "{field}");
    }
    assert_eq!(json["topology"]["euler_characteristic"], 2);
    assert_eq!(json["interior_valences"]["3"], 8);
    assert_eq!((&json["is_disk"], &json["refusal"]), (&false.into(), &serde_json::Value::Null));
}
