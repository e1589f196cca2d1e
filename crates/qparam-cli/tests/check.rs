//! `qparam check`: what is proven, what is named, and where.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{Folder, flat_with_uv, hill};

/// A grid whose middle vertex has gone too far, with an island across its side and another one apart.
fn faulty() -> String {
    let island = |x: f64, y: f64| -> String {
        let at = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]].map(|[u, v]| (x + u, y + v));
        let lines = at.map(|(u, v)| format!("v {u} {v} 1\nvt {u} {v}\n"));
        lines.concat() + "f -4/-4 -3/-3 -2/-2 -1/-1\n"
    };
    flat_with_uv(4).replace("vt 2 2\n", "vt 2.625 2.625\n") + &island(-0.25, 1.25) + &island(9.0, 9.0)
}

/// Each violation by the numbers of the file, on one line.
#[test]
fn violations_are_named_by_the_numbers_of_the_file() {
    let folder = Folder::new();
    folder.write("good.obj", flat_with_uv(4));
    folder.write("bad.obj", faulty());
    let run = folder.qparam(&["check", "good.obj", "bad.obj"]).code(7);
    insta::assert_snapshot!(run.stdout, @r"
    good.obj: certificate holds
      16 faces on 1 island with 1 boundary loop
    bad.obj: certificate fails: 1 concave corner of a quad, 2 boundary crossings
      face 11 (line 61), vertex 13 at (2.625, 2.625): the quad is concave here: split across the other diagonal it overlaps itself
      face 5 (line 55), edge 11-6 from (0, 2) to (0, 1) crosses face 17 (line 75), edge 26-27 from (-0.25, 1.25) to (0.25, 1.25) (islands 1 and 2)
      face 5 (line 55), edge 11-6 from (0, 2) to (0, 1) crosses face 17 (line 75), edge 28-29 from (0.25, 1.75) to (-0.25, 1.75) (islands 1 and 2)
    ");
    folder.qparam(&["check", "good.obj"]).code(0);
}

/// `--limit` bounds what is named, not what is counted.
#[test]
fn the_list_is_bounded() {
    let folder = Folder::new();
    folder.write("bad.obj", faulty());
    let run = folder.qparam(&["check", "bad.obj", "--limit", "1"]).code(7);
    assert!(run.stdout.contains("and 1 more boundary crossing (--limit names more)"), "{}", run.stdout);
    let json = folder.qparam(&["check", "bad.obj", "--limit", "1", "--json"]).code(7).json();
    let file = &json["files"][0];
    assert_eq!((&json["command"], &file["valid"]), (&"check".into(), &false.into()));
    assert_eq!(file["certificate"]["counts"]["crossing"], 2);
    assert_eq!(file["certificate"]["violations"].as_array().unwrap().len(), 2);
    assert_eq!(file["messages"].as_array().unwrap().len(), 2);
    let place = &file["certificate"]["violations"][0]["places"][0];
    assert_eq!((&place["face"], &place["vertex"], &place["uv"][0]), (&10.into(), &12.into(), &2.625.into()));
}

/// What cannot be checked is refused: no UVs, UVs of some faces only, UVs that are no numbers.
#[test]
fn files_that_cannot_be_checked() {
    let folder = Folder::new();
    folder.write("none.obj", hill(2));
    let run = folder.qparam(&["check", "none.obj"]).code(3);
    assert!(
        run.stderr.contains("16 of 16 corners have no UV, the first in face 1 (line 15)"),
        "{}",
        run.stderr
    );
    folder.write("nan.obj", flat_with_uv(2).replace("vt 2 2", "vt nan 2"));
    let run = folder.qparam(&["check", "nan.obj"]).code(3);
    assert!(run.stderr.contains("not finite"), "{}", run.stderr);
    let text = flat_with_uv(2);
    folder.write("part.obj", text.clone() + "f 1 2 3\n");
    let run = folder.qparam(&["check", "part.obj"]).code(3);
    assert!(run.stderr.contains("3 of 19 corners have no UV, the first in face 5"), "{}", run.stderr);
}

/// What `unwrap` certifies, `check` certifies in the file; with single precision, every coordinate is one and the same number for
/// readers of either precision.
#[test]
fn what_is_certified_is_what_is_written() {
    let folder = Folder::new();
    folder.write("in.obj", hill(12));
    for (precision, method) in [("f64", "direct"), ("f32", "direct"), ("f32", "paper")] {
        let options = ["unwrap", "in.obj", "--method", method, "--uv-precision", precision, "--json"];
        let json = folder.qparam(&options).code(0).json();
        assert_eq!((&json["valid"], &json["certificate"]["holds"]), (&true.into(), &true.into()));
        assert_eq!(json["record"]["rounding"].is_object(), precision == "f32");
        folder.qparam(&["check", "in_uv.obj"]).code(0);
        folder.qparam(&["measure", "--check", "in_uv.obj"]).code(0);
        let text = folder.read("in_uv.obj");
        let numbers =
            text.lines().filter_map(|line| line.strip_prefix("vt ")).flat_map(|line| line.split(' '));
        let is_single = |x: &str| x.parse::<f64>().unwrap() == f64::from(x.parse::<f32>().unwrap());
        assert_eq!(numbers.into_iter().all(is_single), precision == "f32");
    }
}

/// A limb so deep that its tip is thinner than single precision can tell: nothing is written, and the faces are named.
#[test]
fn what_single_precision_cannot_hold_is_refused() {
    let folder = Folder::new();
    folder.write("in.obj", tube(17));
    folder.qparam(&["unwrap", "in.obj", "--method", "uniform", "-o", "double.obj"]).code(0);
    let refused = ["unwrap", "in.obj", "--method", "uniform", "-o", "single.obj", "--uv-precision", "f32"];
    let run = folder.qparam(&refused).code(5);
    assert!(run.stderr.contains("in single precision the map would overlap itself"), "{}", run.stderr);
    assert!(
        run.stderr.contains("at the faces ") && run.stderr.contains("use --uv-precision f64"),
        "{}",
        run.stderr
    );
    assert_eq!(folder.names(), ["double.obj", "in.obj"]);
}

/// With several islands the whole is rounded: the report says what that did, and a refusal names the faces all the same.
#[test]
fn several_islands_are_rounded_as_one_is() {
    const SQUARE: &str = "v 50 0 0\nv 51 0 0\nv 51 1 0\nv 50 1 0\nf -4 -3 -2 -1\n";
    let folder = Folder::new();
    folder.write("in.obj", hill(6) + SQUARE);
    let arguments = ["unwrap", "in.obj", "-o", "out.obj", "--uv-precision", "f32"];
    let run = folder.qparam(&arguments).code(0);
    assert_eq!(run.stdout.matches("rounded to single precision").count(), 1, "{}", run.stdout);
    let json = folder.qparam(&[&arguments[..], &["--json"]].concat()).code(0).json();
    assert_eq!(json["rounding"]["broken_faces"], 0, "{json}");
    let json = folder.qparam(&["unwrap", "in.obj", "-o", "out.obj", "--json"]).code(0).json();
    assert!(json["rounding"].is_null(), "{json}");

    folder.write("thin.obj", tube(17) + SQUARE);
    let refused = ["unwrap", "thin.obj", "--method", "uniform", "-o", "no.obj", "--uv-precision", "f32"];
    let run = folder.qparam(&refused).code(5);
    let expected = [
        "in single precision the map would overlap itself",
        "at the faces ",
        "(line ",
        "use --uv-precision f64",
    ];
    assert!(expected.iter().all(|part| run.stderr.contains(part)), "{}", run.stderr);
}

/// A four-sided tube of `rings` rings, closed at one end.
fn tube(rings: usize) -> String {
    let mut text = String::new();
    for ring in 0..=rings {
        for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            text += &format!("v {x} {y} {ring}\n");
        }
    }
    for ring in 0..rings {
        for side in 0..4 {
            let (a, b) = (4 * ring + side + 1, 4 * ring + (side + 1) % 4 + 1);
            text += &format!("f {a} {b} {} {}\n", b + 4, a + 4);
        }
    }
    let last = 4 * rings;
    text + &format!("f {} {} {} {}\n", last + 1, last + 2, last + 3, last + 4)
}

/// A face that runs against its neighbours is judged as `unwrap` judges it: turned over, and named. Whole islands are not: their mirror
/// image is a fault.
#[test]
fn turned_faces_are_no_fault_of_the_uvs() {
    let folder = Folder::new();
    let flat = flat_with_uv(3);
    let face = flat.lines().filter(|line| line.starts_with('f')).nth(4).unwrap();
    let mut corners: Vec<&str> = face[2..].split(' ').collect();
    corners.reverse();
    folder.write("one.obj", flat.replace(face, &format!("f {}", corners.join(" "))));
    let run = folder.qparam(&["check", "one.obj"]).code(0);
    assert!(
        run.stdout.contains("1 face against the orientation around: turned over for this (face 5)"),
        "{}",
        run.stdout
    );
    let json = folder.qparam(&["check", "one.obj", "--json"]).code(0).json();
    assert_eq!(json["files"][0]["turned_faces"], serde_json::json!([4]));
    let measured = folder.qparam(&["measure", "--check", "one.obj", "--json"]).code(0).json();
    assert_eq!(measured["files"][0]["distortion"]["flipped_corners"], 0);
    // Unwrapped by us, checked by us: the same verdict.
    folder.qparam(&["unwrap", "one.obj", "-o", "out.obj"]).code(0);
    folder.qparam(&["check", "out.obj"]).code(0);
    let mirrored = flat.replace("vt ", "vt -");
    folder.write("mirrored.obj", mirrored);
    let run = folder.qparam(&["check", "mirrored.obj"]).code(7);
    assert!(!run.stdout.contains("turned over for this"), "{}", run.stdout);
}
