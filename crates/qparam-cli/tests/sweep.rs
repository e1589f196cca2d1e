//! `qparam sweep`: Table 1 for any mesh.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{CUBE, Folder, hill};

/// Of rule `all`, which lets q act on every interior vertex.
const ALL: &[&str] = &["sweep", "in.obj", "--method", "paper", "--rule", "all"];

/// What people read. Debug and release builds, one thread and several give the same text.
#[test]
fn the_table_for_people() {
    let folder = Folder::new();
    folder.write("in.obj", hill(10));
    for threads in ["1", "2"] {
        let run = folder.qparam(&[ALL, &["--weights", "star1", "--threads", threads]].concat()).code(0);
        assert_eq!(run.stderr, "");
        insta::assert_snapshot!("the_table_for_people", run.stdout);
    }
    assert_eq!(folder.names(), ["in.obj"], "a sweep writes no UVs");
}

/// Each column is the map that `unwrap` makes with that q.
#[test]
fn columns_are_what_unwrap_gives() {
    let folder = Folder::new();
    folder.write("in.obj", hill(8));
    let json = folder.qparam(&[ALL, &["--q", "0.9,0.1", "--json"]].concat()).code(0).json();
    assert_eq!((&json["command"], &json["options"]["q"]), (&"sweep".into(), &serde_json::json!([0.9, 0.1])));
    for (column, q) in json["columns"].as_array().unwrap().iter().zip(["0.9", "0.1"]) {
        let unwrapped =
            folder.qparam(&[&["unwrap"], &ALL[1..], &["--q", q, "--json"]].concat()).code(0).json();
        assert_eq!(column["distortion"], unwrapped["distortion"], "q = {q}");
        let sum = ["angle_error", "area_error"].map(|name| column["distortion"][name].as_f64().unwrap());
        // Reading JSON may round the last digit.
        let (found, sum) = (column["sum"].as_f64().unwrap(), sum[0] + sum[1]);
        assert!((found - sum).abs() <= 2.0 * f64::EPSILON * sum, "q = {q}: {found} {sum}");
    }
}

/// CSV, JSON and table show the same maps; with `--csv -` the table steps aside.
#[test]
fn csv_holds_every_digit() {
    let folder = Folder::new();
    folder.write("in.obj", hill(8));
    let json = folder.qparam(&[ALL, &["--json", "--csv", "out.csv"]].concat()).code(0).json();
    let csv = folder.read("out.csv");
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines.len(), 6);
    assert_eq!(lines[0][..4], ["q", "valid", "angle_error", "area_error"]);
    for (line, column) in lines[1..].iter().zip(json["columns"].as_array().unwrap()) {
        assert_eq!(line.len(), lines[0].len());
        // The test's reader of JSON rounds the last digit.
        let agree = |i: usize, value: &serde_json::Value| {
            let (csv, json) = (line[i].parse::<f64>().unwrap(), value.as_f64().unwrap());
            assert!((csv - json).abs() <= 1e-15 * json.abs(), "{}: {csv}, {json}", lines[0][i]);
        };
        agree(0, &column["q"]);
        agree(2, &column["distortion"]["angle_error"]);
        agree(8, &column["distortion"]["symmetric_dirichlet"]);
    }
    let run = folder.qparam(&[ALL, &["--csv", "-"]].concat()).code(0);
    assert_eq!(run.stdout, csv);
    assert!(run.stderr.contains("angle error (Eq. 13)") && run.stderr.contains("knee"), "{}", run.stderr);
}

/// Every vertex of a flat square stays on its place with the exact weights: no error, so nothing to trade.
#[test]
fn a_flat_mesh_has_no_knee() {
    let folder = Folder::new();
    folder.write("in.obj", common::flat_with_uv(4));
    let flat = ["--weights", "star1", "--boundary", "projection"];
    let run = folder.qparam(&[ALL, &flat].concat()).code(0);
    assert!(run.stdout.contains("knee of the trade-off: none, a map without error"), "{}", run.stdout);
    assert!(run.stdout.contains("angle error falls as q → 1: no, it stays level"), "{}", run.stdout);
}

/// The configuration file speaks to `sweep` as it does to `unwrap`, except about q and the report.
#[test]
fn the_configuration_file_counts() {
    let folder = Folder::new();
    folder.write("in.obj", hill(6));
    folder.write("qparam.toml", "rule = 'all'\nq = 0.25\nquiet = true\n");
    let json = folder.qparam(&["sweep", "in.obj", "--json"]).code(0).json();
    assert_eq!(json["options"]["simplify"]["rule"], "all");
    assert_eq!(json["columns"].as_array().unwrap().len(), 5);
}

#[test]
fn bad_sweeps_are_explained() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    folder.write("cube.obj", CUBE);
    let lines: &[(&[&str], i32)] = &[
        (&["sweep"], 2),
        (&["sweep", "in.obj", "--q", "0.5,1.5"], 2),
        (&["sweep", "in.obj", "--q", ""], 2),
        (&["sweep", "in.obj", "--q", "0.5,0.2,0.5"], 2),
        (&["sweep", "in.obj", "--json", "--csv", "-"], 2),
        (&["sweep", "in.obj", "--boundary", "fixed"], 2),
        (&["sweep", "missing.obj"], 3),
        (&["sweep", "cube.obj"], 4),
        (&["sweep", "in.obj", "--csv", "nowhere/out.csv"], 6),
        (&["sweep", "in.obj", "--method", "paper", "--residual-bound", "1e-300"], 5),
    ];
    let mut shown = String::new();
    for (line, code) in lines {
        let run = folder.qparam(line).code(*code);
        assert_eq!(run.stdout.is_empty(), !line.contains(&"--json"), "{line:?}");
        shown += &format!("$ qparam {}\n? {code}\n{}\n", line.join(" "), run.stderr);
    }
    assert_eq!(folder.names(), ["cube.obj", "in.obj"]);
    let mut settings = insta::Settings::clone_current();
    settings.add_filter(r"relative residual \S+,", "relative residual …,");
    settings.bind(|| insta::assert_snapshot!(shown));
}
