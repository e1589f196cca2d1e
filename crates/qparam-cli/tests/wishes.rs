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
    folder.write("pins.txt", "49 0.75 0.5\n49 0.5 0.5\n");
    let run = folder.qparam(&["unwrap", "in.obj", "--pins", "pins.txt"]).code(3);
    assert!(
        run.stderr.contains("pins.txt:2: vertex 49 has a position already, from line 1"),
        "{}",
        run.stderr
    );
}

/// A boundary is held where the file says, and the report says so.
#[test]
fn held_boundaries_arrive_in_the_file() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    let text = folder.qparam(&["unwrap", "in.obj", "--boundary", "square"]).code(0).stdout;
    assert!(text.contains("method direct, q 0.6, shape 1, boundary square\n"), "{text}");
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
            "face 1 (line 31) lies with three vertices on the boundary, which does not turn left at vertex 1",
        ),
    ] {
        let run = folder.qparam(&[&["unwrap", "in.obj"], arguments].concat()).code(code);
        assert!(run.stderr.contains(expected), "{arguments:?}: {}", run.stderr);
        assert!(!folder.names().contains(&"in_uv.obj".to_owned()), "{arguments:?}");
    }
}

/// A symmetric map is mirrored in the file: partners have the same v and the same sum of u.
#[test]
fn symmetry_arrives_in_the_file() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    let text = folder.qparam(&["unwrap", "in.obj", "--symmetric"]).code(0).stdout;
    assert!(
        text.contains("symmetry: mirrored exactly; the plane has the normal (1.000, 0.000, 0.000)"),
        "{text}"
    );
    let vt: Vec<[f64; 2]> = placed(&folder, "in_uv.obj")
        .iter()
        .map(|line| {
            let (u, v) = line.split_once(' ').unwrap();
            [u.parse().unwrap(), v.parse().unwrap()]
        })
        .collect();
    for row in vt.chunks(7) {
        for k in 0..7 {
            assert_eq!((row[k][0] + row[6 - k][0], row[k][1]), (vt[0][0] + vt[6][0], row[6 - k][1]));
        }
    }
    // A vertex on none of the hill's four mirrors.
    let tenth = hill(6).lines().filter(|line| line.starts_with("v ")).nth(9).unwrap().to_owned();
    let lopsided = hill(6).replace(&tenth, "v 0 0 3");
    folder.write("lopsided.obj", lopsided);
    let run = folder.qparam(&["unwrap", "lopsided.obj", "--symmetric"]).code(5);
    assert!(
        run.stderr.contains("the mesh has no mirror symmetry: the nearest one misses vertex"),
        "{}",
        run.stderr
    );
    folder.qparam(&["unwrap", "in.obj", "--symmetric", "--boundary", "circle"]).code(2);
    folder.qparam(&["unwrap", "in.obj", "--symmetric", "--pin", "1=0,0"]).code(2);
}

/// The worst faces are named in the numbers of the file, as many as asked for, in both reports.
#[test]
fn the_worst_faces_are_named() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    let text = folder.qparam(&["unwrap", "in.obj", "--worst", "2"]).code(0).stdout;
    let lines: Vec<&str> = text.lines().skip_while(|line| *line != "worst faces").skip(1).take(3).collect();
    assert!(lines[0].starts_with("  face ") && lines[0].contains("curvature of"), "{text}");
    assert!(lines[1].starts_with("  face ") && lines[2].is_empty(), "{text}");
    let report = folder.qparam(&["unwrap", "in.obj", "--json"]).code(0).json();
    let worst = report["worst_faces"].as_array().unwrap();
    assert_eq!(worst.len(), 5);
    let energies: Vec<f64> = worst.iter().map(|face| face["symmetric_dirichlet"].as_f64().unwrap()).collect();
    assert!(energies.is_sorted_by(|a, b| *a >= b * (1.0 - 1e-6)), "{energies:?}");
    let face = worst[0]["face"].as_u64().unwrap();
    assert!((1..=36).contains(&face) && lines[0].starts_with(&format!("  face {face} at ")), "{face} {text}");
    assert_eq!(worst[0]["causes"][0]["kind"], "curvature");
}
