//! Bad input gets one clear message with its place and the way out, a documented exit code, and no output.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

#[path = "../../qmesh/tests/obj/bad_texts.rs"]
mod bad_texts;
mod common;

use common::{CUBE, Folder, hill, in_process};
use qparam_cli::Exit;
use qparam_cli::qmesh::obj::{ObjDocument, ObjError};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn square(rest: &str) -> Vec<u8> {
    format!("{SQUARE}{rest}").into_bytes()
}

/// Name, content, exit code.
fn cases() -> Vec<(&'static str, Vec<u8>, i32)> {
    let hill = hill(4);
    vec![
        ("empty", Vec::new(), 3),
        ("binary", (0..4096_u32).map(|i| (i * 131 % 256) as u8).collect(), 3),
        ("truncated in a number", hill.as_bytes()[..hill.find("usemtl").unwrap() - 30].to_vec(), 3),
        ("truncated in a face", square("f 1 2"), 3),
        ("no faces", square(""), 3),
        ("not a number", b"v 0 0 0\nv 1 zero 0\nv 1 1 0\nf 1 2 3\n".to_vec(), 3),
        ("nan", b"v 0 0 0\nv 1 nan 0\nv 1 1 0\nf 1 2 3\n".to_vec(), 3),
        ("infinite", b"v 0 0 0\nv 1 1e999 0\nv 1 1 0\nf 1 2 3\n".to_vec(), 3),
        ("two coordinates", b"v 0 0\nv 1 1 0\nv 1 1 0\nf 1 2 3\n".to_vec(), 3),
        ("index out of range", square("f 1 2 3 9\n"), 3),
        ("index zero", square("f 0 1 2 3\n"), 3),
        ("index that wraps", square("f 1 2 3 4294967297\n"), 3),
        ("negative index too far", square("f -1 -2 -3 -9\n"), 3),
        ("two corners", square("f 1 2\n"), 3),
        ("letters for indices", square("f a b c d\n"), 3),
    ]
}

#[test]
fn every_bad_input_has_one_message_and_leaves_nothing() {
    let mut shown = String::new();
    for (name, content, code) in cases() {
        let folder = Folder::new();
        folder.write("in.obj", content);
        let run = folder.qparam(&["unwrap", "in.obj"]);
        assert_eq!(run.code, code, "{name}: {}", run.stderr);
        assert_eq!(folder.names(), ["in.obj"], "{name}");
        assert_eq!(run.stdout, "", "{name}");
        assert_eq!(run.stderr.matches("error:").count(), 1, "{name}: {}", run.stderr);
        assert!(!run.stderr.contains("panicked"), "{name}: {}", run.stderr);
        shown += &format!("## {name} ({code})\n{}\n", run.stderr);
    }
    insta::assert_snapshot!(shown);
}

/// Every bad text of the reader's own tests ends with code 3, its place, what was expected there, and no output.
#[test]
fn every_bad_text_is_refused_with_its_place() {
    let texts = bad_texts::bad_texts();
    assert!(texts.len() >= 57);
    for (name, text) in texts {
        let run = in_process(&["unwrap", "-"], &text);
        assert_eq!((run.exit, &*run.stdout), (Exit::Input, ""), "{name}: {}", run.stderr);
        let expected = match ObjDocument::parse(text).unwrap_err() {
            ObjError::Mistake(mistake) => {
                let place = format!("line {}, column {}: ", mistake.line, mistake.column);
                let what = mistake.to_string().replace(&place, "");
                format!("error: <stdin>:{}:{}: {what}\n", mistake.line, mistake.column)
            }
            other => format!("error: <stdin>: {other}\n"),
        };
        assert!(run.stderr.starts_with(&expected), "{name}: {}\n{expected}", run.stderr);
    }
}

/// Faces without area, and vertices in one place: a map may or may not exist, but nobody panics, and what is
/// written is reported truthfully.
#[test]
fn degenerate_positions_are_survived() {
    let flat = |position: fn(usize, usize) -> [f64; 3]| {
        let mut text = String::new();
        for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
            let [x, y, z] = position(row, column);
            text += &format!("v {x} {y} {z}\n");
        }
        for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
            let first = row * 4 + column + 1;
            text += &format!("f {} {} {} {}\n", first, first + 1, first + 5, first + 4);
        }
        text
    };
    const METHODS: [&str; 7] = ["direct", "conformal", "paper", "uniform", "mean-value", "harmonic", "lscm"];
    let cases = [
        ("coincident", flat(|_, _| [1.0, 2.0, 3.0])),
        ("collinear", flat(|row, column| [(row + column) as f64, 0.0, 0.0])),
        ("tiny", flat(|row, column| [1e-300 * row as f64, 1e-300 * column as f64, 0.0])),
        ("huge", flat(|row, column| [1e59 * row as f64, 1e59 * column as f64, 0.0])),
    ];
    let mut found = String::new();
    for (name, text) in cases {
        found += &format!("{name:12}");
        for method in METHODS {
            let run = in_process(&["unwrap", "-", "--method", method, "-o", "-"], text.as_bytes());
            assert_eq!(run.stdout.is_empty(), run.exit == Exit::Computation, "{name}, {method}");
            let key = match run.exit {
                Exit::Done => "certificate: holds",
                Exit::Computation => "error: ",
                _ => "warning: the UVs are written, but not certified",
            };
            assert!(run.stderr.contains(key), "{name}, {method}: {}", run.stderr);
            found += &format!("  {method} {}", run.exit.code());
        }
        found += "\n";
    }
    insta::assert_snapshot!(found, @r"
    coincident    direct 5  conformal 5  paper 5  uniform 5  mean-value 5  harmonic 5  lscm 5
    collinear     direct 5  conformal 5  paper 5  uniform 5  mean-value 5  harmonic 5  lscm 5
    tiny          direct 0  conformal 0  paper 0  uniform 0  mean-value 0  harmonic 0  lscm 0
    huge          direct 0  conformal 0  paper 0  uniform 0  mean-value 0  harmonic 0  lscm 0
    ");
}

#[test]
fn a_missing_file_is_named() {
    let folder = Folder::new();
    let run = folder.qparam(&["unwrap", "nowhere.obj"]).code(3);
    insta::assert_snapshot!(run.stderr, @r"
    error: nowhere.obj could not be read
      No such file or directory (os error 2)
      help: check the path; `-` reads standard input
    ");
}

/// Programs get the same failure on standard output.
#[test]
fn failures_are_json_for_programs() {
    let folder = Folder::new();
    folder.write("in.obj", CUBE);
    let json = folder.qparam(&["unwrap", "in.obj", "--json", "--seams", "none"]).code(4).json();
    assert_eq!((&json["schema_version"], &json["exit_code"]), (&2.into(), &4.into()));
    assert_eq!(json["error"]["class"], "mesh");
    assert!(json["error"]["message"].as_str().unwrap().contains("closed"));
}

/// An edge that is far shorter than the digits of the plane reach has no place on a projected boundary.
#[test]
fn a_projected_edge_without_length_is_named() {
    let folder = Folder::new();
    folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 0\nf 1 2 3 4 5\n");
    let run = folder.qparam(&["unwrap", "in.obj", "--method", "paper", "--boundary", "projection"]).code(5);
    assert!(
        run.stderr.contains("the boundary has no length at the edge between the vertices 4-5"),
        "{}",
        run.stderr
    );
}

/// A density at which UVs would be beyond what a file may hold is refused: nothing is written that could not be read back.
#[test]
fn a_layout_beyond_all_bounds_is_refused() {
    let square = |x: &str| format!("v {x} 0 0\nv {x} 1e59 0\nv 0 1e59 0\nv 0 0 0\nf -4 -3 -2 -1\n");
    let text = square("1e59") + &square("-1e59");
    for (more, exit) in [(&["--density", "1e9"][..], Exit::Computation), (&[], Exit::Done)] {
        let run = in_process(&[&["unwrap", "-"], more].concat(), text.as_bytes());
        assert_eq!(run.exit, exit, "{}", run.stderr);
        assert_eq!(run.stderr.contains("the layout would reach beyond 1e60"), exit == Exit::Computation);
        assert_eq!(run.stdout.is_empty(), exit == Exit::Computation);
    }
}
