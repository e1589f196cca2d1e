//! `qparam unwrap`: the same file with UVs, and an honest report.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{Folder, hill, without_uv};

#[test]
fn the_output_is_the_input_with_uvs() {
    let folder = Folder::new();
    folder.write("in.obj", hill(8));
    let run = folder.qparam(&["unwrap", "in.obj"]).code(0);
    assert_eq!(run.stdout.lines().last(), Some("UVs written to in_uv.obj"));
    assert_eq!(run.stderr, "", "nothing is drawn into a pipe");
    assert_eq!(folder.names(), ["in.obj", "in_uv.obj"]);
    let output = folder.read("in_uv.obj");
    assert_eq!(without_uv(&output), hill(8));
    assert_eq!(output.lines().filter(|line| line.starts_with("vt ")).count(), 81);
}

/// The report is about what the file holds: measuring the file gives the same figures, for every method.
#[test]
fn the_report_agrees_with_the_file() {
    for method in ["direct", "conformal", "paper", "uniform", "mean-value", "harmonic", "lscm"] {
        let folder = Folder::new();
        folder.write("in.obj", hill(8));
        let report = folder.qparam(&["unwrap", "in.obj", "--json", "--method", method]).code(0).json();
        let measured = folder.qparam(&["measure", "in_uv.obj", "--json"]).code(0).json();
        assert_eq!(report["valid"], true, "{method}");
        assert_eq!(report["options"]["method"], method);
        let (said, found) = (&report["distortion"], &measured["files"][0]["distortion"]);
        let fields =
            said.as_object().unwrap().iter().filter_map(|(name, value)| Some((name, value.as_f64()?)));
        for (name, value) in fields {
            let other = found[name].as_f64().unwrap();
            assert!(
                (value - other).abs() <= 1e-9 * (1.0 + value.abs()),
                "{method}, {name}: {value}, {other}"
            );
        }
    }
}

#[test]
fn the_report_for_programs_has_every_part() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    let json = folder.qparam(&["unwrap", "in.obj", "--json", "--q", "0.25"]).code(0).json();
    assert_eq!((&json["schema_version"], &json["command"]), (&2.into(), &"unwrap".into()));
    assert_eq!((&json["input"]["quads"], &json["input"]["boundary_edges"]), (&36.into(), &24.into()));
    assert_eq!((&json["options"]["q"], &json["output"]), (&0.25.into(), &"in_uv.obj".into()));
    assert_eq!(json["record"]["interior_vertices"], 25);
    for name in ["read", "build", "parameterize", "write", "total"] {
        assert!(json["timings_seconds"][name].as_f64().unwrap() >= 0.0, "{name}");
    }
    let stages = json["timings_seconds"]["stages"].as_array().unwrap();
    assert!(stages.iter().all(|stage| stage["stage"].is_string() && stage["seconds"].is_f64()));
    assert!(!stages.is_empty());
}

#[test]
fn the_report_for_people() {
    let folder = Folder::new();
    folder.write("in.obj", hill(8));
    let text = |method: &str| folder.qparam(&["unwrap", "in.obj", "--method", method]).code(0).stdout;
    let mut settings = insta::Settings::clone_current();
    settings.add_filter(r"(?m)^time .*$", "time …");
    settings.add_filter(r"relative residual \S+", "relative residual …");
    settings.bind(|| {
        insta::assert_snapshot!(text("paper"));
        insta::assert_snapshot!("the_report_for_people_direct", text("direct"));
    });
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let folder = Folder::new();
    folder.write("in.obj", hill(24));
    for method in ["paper", "mean-value", "lscm"] {
        for threads in ["1", "2", "5"] {
            let out = format!("out{threads}.obj");
            folder
                .qparam(&[
                    "unwrap",
                    "in.obj",
                    "-o",
                    &out,
                    "--threads",
                    threads,
                    "--method",
                    method,
                    "--quiet",
                ])
                .code(0);
        }
        assert_eq!(folder.read("out1.obj"), folder.read("out2.obj"), "{method}");
        assert_eq!(folder.read("out1.obj"), folder.read("out5.obj"), "{method}");
    }
}

/// In a pipe, the mesh takes standard output and the report steps aside.
#[test]
fn standard_input_and_output() {
    let folder = Folder::new();
    folder.write("in.obj", hill(5));
    folder.qparam(&["unwrap", "in.obj", "--quiet"]).code(0);
    let piped = folder.qparam_with(&["unwrap", "-"], hill(5).as_bytes()).code(0);
    assert_eq!(piped.stdout, folder.read("in_uv.obj"));
    assert!(piped.stderr.ends_with("UVs written to <stdout>\n"), "{}", piped.stderr);
    let json = folder.qparam_with(&["unwrap", "-", "-o", "-", "--json"], hill(5).as_bytes()).code(0);
    let report: serde_json::Value = serde_json::from_str(&json.stderr).unwrap();
    assert_eq!(report["input"]["file"], "<stdin>");
    assert_eq!(json.stdout, piped.stdout);
}

#[test]
fn quiet_is_quiet() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let run = folder.qparam(&["unwrap", "in.obj", "--quiet"]).code(0);
    assert_eq!(run.stdout + &run.stderr, "");
}

#[test]
fn the_simplified_mesh_can_be_looked_at() {
    let folder = Folder::new();
    folder.write("in.obj", hill(8));
    let paper = ["unwrap", "in.obj", "--method", "paper", "--simplified", "simple.obj", "--json"];
    let json = folder.qparam(&paper).code(0).json();
    let removed = json["record"]["removed_vertices"].as_u64().unwrap();
    assert!(removed > 0);
    let simple = folder.qparam(&["info", "simple.obj", "--json"]).code(0).json();
    assert_eq!(simple["vertices"], 81 - removed);
    assert_eq!((&simple["is_disk"], &simple["boundary_edges"]), (&true.into(), &32.into()));
    assert!(simple["polygons"].as_u64().unwrap() > 0, "the faces around a removed vertex become one");
}

/// Positions for the boundary from a list or from an OBJ; UVs keep their units then.
#[test]
fn a_fixed_boundary_is_kept() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let on_boundary = |v: usize| v / 5 == 0 || v / 5 == 4 || v.is_multiple_of(5) || v % 5 == 4;
    let place = |v: usize| [(v % 5) as f64 * 2.0 + 10.0, (v / 5) as f64];
    let list: String = (0..25)
        .filter(|&v| on_boundary(v))
        .map(|v| format!("{} {} {}\n", v + 1, place(v)[0], place(v)[1]))
        .collect();
    folder.write("boundary.txt", format!("# vertex u v\n\n{list}"));
    let arguments =
        ["unwrap", "in.obj", "--method", "paper", "--boundary", "fixed", "--quiet", "--boundary-uv"];
    let with = |file: &str, out: &str| folder.qparam(&[&arguments[..], &[file, "-o", out]].concat()).code(0);
    with("boundary.txt", "a.obj");
    let output = folder.read("a.obj");
    let uv: Vec<Vec<f64>> = output
        .lines()
        .filter_map(|line| line.strip_prefix("vt "))
        .map(|line| line.split(' ').map(|x| x.parse().unwrap()).collect())
        .collect();
    for vertex in (0..25).filter(|&v| on_boundary(v)) {
        assert_eq!(uv[vertex], place(vertex), "vertex {vertex}");
    }
    // The result itself is an OBJ with UVs on the same vertices.
    with("a.obj", "b.obj");
    assert_eq!(folder.read("b.obj"), output);
}

#[test]
fn mistakes_in_boundary_files_are_named() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    for (list, expected) in [
        ("1 0 0\n2 x 0\n", "list.txt:2: `x 0` is no position"),
        ("1 0 0\n\n99 0 0\n", "list.txt:3: `99` is no vertex of the mesh, which has 9"),
        ("1 0\n", "list.txt:1: expected three values, found 2"),
        ("1 0 0\n2 1 0\n1 0 1\n", "list.txt:3: vertex 1 has a position already, from line 1"),
        ("1 0 0\n", "list.txt: no position for vertex 2 (in.obj:5)"),
    ] {
        folder.write("list.txt", list);
        let arguments =
            ["unwrap", "in.obj", "--method=paper", "--boundary", "fixed", "--boundary-uv", "list.txt"];
        let run = folder.qparam(&arguments).code(3);
        assert!(run.stderr.contains(expected), "{}", run.stderr);
        assert!(!folder.path("in_uv.obj").exists());
    }
}

/// A boundary that crosses itself cannot be mended by moving interior vertices: the UVs are written, and the
/// exit code and the warning say what remains.
#[test]
fn what_remains_wrong_is_said() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    // A bow tie: the upper row runs backwards.
    folder.write("bow.txt", "1 0 0\n2 1 0\n3 2 0\n4 0.5 1\n6 1.5 1\n7 2 2\n8 1 2\n9 0 2\n");
    let arguments =
        ["unwrap", "in.obj", "--method", "paper", "--boundary", "fixed", "--boundary-uv", "bow.txt"];
    let run = folder.qparam(&arguments).code(7);
    assert!(
        run.stderr.starts_with("warning: the UVs are written, but not certified: the certificate fails: "),
        "{}",
        run.stderr
    );
    assert!(run.stdout.ends_with("UVs written to in_uv.obj\n"));
    assert!(folder.path("in_uv.obj").exists());
    folder.qparam(&["measure", "--check", "in_uv.obj"]).code(7);
}

/// The file of defaults is found in the working directory, and the command line wins.
#[test]
fn a_configuration_file_sets_defaults() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    folder.write("qparam.toml", "q = 0.125\nmethod = 'uniform'\njson = true\n");
    let json = folder.qparam(&["unwrap", "in.obj", "--method", "paper"]).code(0).json();
    assert_eq!((&json["options"]["q"], &json["options"]["method"]), (&0.125.into(), &"paper".into()));
}
