//! Held boundaries and pins, from the command line to the file.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{Folder, hill};

/// The `vt` line of each vertex: without seams they have the numbers of the vertices.
fn placed(folder: &Folder, file: &str) -> Vec<String> {
    folder.read(file).lines().filter_map(|line| Some(line.strip_prefix("vt ")?.to_owned())).collect()
}

/// Pins are in the file as they were typed; those of the file and of the command line count alike.
#[test]
fn pins_arrive_in_the_file() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    folder.write("pins.txt", "# vertex u v\n49 0.75 0.5\n");
    let pins = ["unwrap", "in.obj", "--pin", "1=-0.25,0.5", "--pins", "pins.txt"];
    folder.qparam(&pins).code(0);
    let vt = placed(&folder, "in_uv.obj");
    assert_eq!((vt[0].as_str(), vt[48].as_str()), ("-0.25 0.5", "0.75 0.5"));
    folder.qparam(&["unwrap", "in.obj", "--pin=25=0.5,0.5"]).code(0);
    assert_eq!(placed(&folder, "in_uv.obj")[24], "0.5 0.5");
}

/// A boundary is held where the file says, and the report says so.
#[test]
fn held_boundaries_arrive_in_the_file() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    let text = folder.qparam(&["unwrap", "in.obj", "--boundary", "square"]).code(0).stdout;
    assert!(text.contains("method direct, q 0.5, shape 1, boundary square\n"), "{text}");
    let corners = ["0.0 0.0", "1.0 0.0", "1.0 1.0", "0.0 1.0"];
    let vt = placed(&folder, "in_uv.obj");
    assert!(corners.iter().all(|corner| vt.iter().any(|line| line == corner)), "{vt:?}");
    let text = folder.qparam(&["unwrap", "in.obj", "--boundary", "free"]).code(0).stdout;
    assert!(text.contains("free boundary\n"), "{text}");
}

/// What cannot be had is refused in the words and numbers of the file.
#[test]
fn impossible_wishes_are_refused_with_the_place() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let dent: String = folder
        .read("in.obj")
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .zip(1..)
        .map(|(line, vertex)| {
            let fields: Vec<f64> = line.split(' ').map(|field| field.parse().unwrap()).collect();
            if vertex == 1 {
                "1 0.1 0.1\n".to_owned()
            } else {
                format!("{vertex} {} {}\n", fields[0], fields[1])
            }
        })
        .collect();
    folder.write("dent.txt", dent);
    for (arguments, code, expected) in [
        (&["--pin", "1=0,0", "--pin", "1=1,1"][..], 5, "vertex 1 (line"),
        (&["--pin", "1=0,0", "--pin", "2=0,0"][..], 5, "are pinned to the same place"),
        (&["--pin", "1=0,0", "--pin", "2=0,1", "--pin", "7=1,0"][..], 5, "short of its place"),
        (&["--pin", "1=0,0", "--boundary", "circle"][..], 5, "the boundary is held already"),
        (&["--pin", "99=0,0"][..], 3, "vertex 99 cannot be pinned: there are only 25 vertices"),
        (&["--pin", "1=0,0", "--method", "paper"][..], 2, "this method cannot hold pins"),
        (&["--pin", "x=0,0"][..], 2, "expected a vertex, counted from 1"),
        (&["--boundary", "free", "--method", "uniform"][..], 2, "needs positions for the boundary"),
        (
            &["--boundary", "fixed", "--boundary-uv", "dent.txt"][..],
            5,
            "face 1 lies with three vertices on the boundary, which does not turn left at vertex 1",
        ),
    ] {
        let run = folder.qparam(&[&["unwrap", "in.obj"], arguments].concat()).code(code);
        assert!(run.stderr.contains(expected), "{arguments:?}: {}", run.stderr);
        assert!(!folder.names().contains(&"in_uv.obj".to_owned()), "{arguments:?}");
    }
}
