//! The table's arithmetic and words, and the independent script's own test.

use std::process::Command;

use super::agreement::{self, Independent};
use super::contestant::Absent;
use super::dominance::Dominance;
use super::league::{About, Figures, League, Measures, MeshTable, Outcome, Row};
use super::machine::{self, Machine};
use super::numbers::{against, count_against, median, short};
use super::{defaults, markdown, ours, race, shell};

fn measures(angle_error: f64) -> Measures {
    Measures {
        faces: 10,
        islands: 1,
        mirrored_islands: 0,
        angle_error,
        area_error: 8.0,
        symmetric_dirichlet: Some(1.25),
        flipped_corners: 0,
        flipped_faces: 0,
        folded_faces: 0,
        boundary_crossings: 0,
    }
}

fn figures(measures: Measures) -> Outcome {
    Outcome::Measured(Box::new(Figures {
        measures,
        torn_quads: 0,
        solve_seconds: 0.5,
        process_seconds: 1.0,
        cpu_seconds: 1.0,
        peak_memory_bytes: 20_000_000,
        repeatable: true,
    }))
}

fn row(name: &str, outcome: Outcome) -> Row {
    let (input, boundary) = ("quads".to_owned(), "free".to_owned());
    Row { name: name.to_owned(), ours: name.starts_with("qparam"), input, boundary, outcome }
}

fn league(rows: Vec<Row>) -> League {
    let about = About { vertices: 18, faces: 10, quads: 10, not_a_disk: None };
    League {
        schema_version: 2,
        arguments: " --runs 3 m.obj".to_owned(),
        machine: Machine {
            processor: "Model X".to_owned(),
            threads: 2,
            memory_gib: Some(24),
            system: "linux x86_64".to_owned(),
        },
        versions: vec!["qparam 0.1.0".to_owned()],
        runs: 3,
        timeout_seconds: 60.0,
        baseline: "qparam-paper".to_owned(),
        meshes: vec![MeshTable { name: "m.obj".to_owned(), about, rows, ..MeshTable::default() }],
        ours_again: false,
        absent: vec![Absent { tool: "CGAL".to_owned(), why: "no headers\nsecond line".to_owned() }],
    }
}

fn line<'a>(text: &'a str, start: &str) -> &'a str {
    text.lines().find(|line| line.starts_with(start)).unwrap_or("")
}

#[test]
fn three_digits_whatever_the_size() {
    let shown = [0.0, 1.0, 9.999, 57.84, 99_950.0, 123_456.0, 0.001_234, 0.000_999_9, 4.4e9, -2.5];
    let expected = ["0", "1.00", "10.0", "57.8", "1.00e5", "1.23e5", "0.00123", "0.00100", "4.40e9", "-2.50"];
    assert_eq!(shown.map(short), expected);
}

#[test]
fn median_is_the_middle_in_any_order() {
    assert_eq!(median(vec![3.0, 1.0, 2.0]).to_bits(), 2.0_f64.to_bits());
    assert_eq!(median(vec![4.0, 1.0, 2.0, 9.0]).to_bits(), 3.0_f64.to_bits());
}

/// A ratio is theirs over ours; against nothing there is none, only a difference.
#[test]
fn ratios() {
    assert_eq!(against(6.0, Some(3.0)), "6.00 (×2.00)");
    assert_eq!(against(1.5, Some(3.0)), "1.50 (×0.500)");
    assert_eq!(against(6.0, Some(0.0)), "6.00");
    assert_eq!(against(6.0, None), "6.00");
    assert_eq!(count_against(12, Some(0)), "12 (+12)");
    assert_eq!(count_against(0, Some(0)), "0");
    assert_eq!(count_against(12, Some(4)), "12 (×3.00)");
    assert_eq!(count_against(0, Some(4)), "0 (×0)");
    assert_eq!(count_against(12, None), "12");
}

/// Ours is bold and has no ratio; a rival has one in each column; one that failed says why, in one row.
#[test]
fn rows_of_the_table() {
    let mut flipped = measures(4.0);
    flipped.flipped_corners = 3;
    let league = league(vec![
        row("qparam-paper", figures(measures(2.0))),
        row("rival-a", figures(flipped)),
        row("rival-b", Outcome::Failed { message: "Error: a | b\nmore".to_owned() }),
    ]);
    assert_eq!(league.verdict(), Ok(()), "a rival that fails is a row, not a failure of the task");
    let text = markdown::render(&league, None);
    assert_eq!(
        line(&text, "| **qparam-paper**"),
        "| **qparam-paper** | free | yes | 2.00 | 8.00 | 1.25 | 0 | 0 | 0 | 0 | 1 | 1 | 1 | 1 |"
    );
    assert_eq!(
        line(&text, "| rival-a"),
        "| rival-a | free | no | 4.00 (×2.00) | 8.00 (×1.00) | 1.25 (×1.00) | 3 (+3) | 0 | 0 | 0 | 1 | 1.0 | 1.0 | 1.0 |"
    );
    assert!(line(&text, "| rival-b").starts_with("| rival-b | free | failed: Error: a \\| b |"));
    assert_eq!(line(&text, "- CGAL"), "- CGAL: no headers");
    let pipes = |line: &str| line.replace("\\|", "").matches('|').count();
    let table: Vec<usize> = text.lines().filter(|line| line.starts_with('|')).map(pipes).collect();
    assert_eq!(table, [15; 5], "every row has every column");
}

/// The table says nothing of the machine, so that it reads the same wherever it was made.
#[test]
fn no_machine_in_the_table() {
    let league = league(vec![row("qparam-paper", figures(measures(2.0)))]);
    let text = markdown::render(&league, Some("fronts.svg"));
    assert!(!text.contains("Model X") && !text.contains("24 GiB"), "{text}");
    assert!(text.contains("](fronts.svg)") && text.contains("`cargo xtask compare --runs 3 m.obj`"));
}

/// A map of ours with these errors, and a rival's.
fn with_errors(name: &str, [angle_error, area_error, stretch]: [f64; 3]) -> Row {
    row(name, figures(Measures { area_error, symmetric_dirichlet: Some(stretch), ..measures(angle_error) }))
}

/// Both errors no larger, symmetric Dirichlet within 5 %, and within 2 % with the preset for least stretch; against conformal maps
/// only the sum counts, and methods that aim at neither are left out.
#[test]
fn what_the_defaults_are_to_hold() {
    let rows = |ours: [f64; 3], least: f64| {
        let names = ["libigl-slim", "blender-abf", "cgal-lscm", "libigl-arap"];
        let errors = [[2.0, 8.0, 1.25], [1.0, 20.0, 3.0], [1.0, 8.5, 3.0], [1.0, 1.0, 1.0]];
        let theirs = names.into_iter().zip(errors).map(|(name, errors)| with_errors(name, errors));
        let ours = [with_errors("qparam-paper", ours), with_errors(ours::LEAST_STRETCH, [9.0, 9.0, least])];
        league(ours.into_iter().chain(theirs).collect())
    };
    let held = |league: &League| -> Vec<bool> {
        defaults::versus(&league.meshes[0], "qparam-paper").iter().map(defaults::Versus::holds).collect()
    };
    assert_eq!(held(&rows([2.0, 7.0, 1.31], 1.27)), [true, true, true]);
    assert_eq!(held(&rows([2.1, 7.0, 1.31], 1.27)), [false, true, true], "angles");
    assert_eq!(held(&rows([2.0, 7.0, 1.32], 1.27)), [false, true, true], "5 %");
    assert_eq!(held(&rows([2.0, 7.0, 1.31], 1.28)), [false, true, true], "2 %");
    assert_eq!(held(&rows([2.0, 7.9, 1.31], 1.27)), [true, true, false], "the sum");
    let text = markdown::render(&rows([2.1, 7.0, 1.31], 1.27), None);
    assert!(
        text.contains("\nNot held: libigl-slim: the defaults weigh the errors otherwise; no setting"),
        "{text}"
    );
    let text = markdown::render(&rows([2.0, 7.0, 1.31], 1.27), None);
    assert!(!text.contains("Not held"), "{text}");
    assert_eq!(
        line(&text, "| libigl-slim | yes | 1 |"),
        "| libigl-slim | yes | 1 | 1.00 | 0.875 | 1.05 | 1.02 |  | yes |"
    );
    assert_eq!(
        line(&text, "| m | 10 |"),
        "| m | 10 | 1.00, 0.875, 1.05 | 1.02 | – | – | 0.947 | 0 of 0 | – | 0 of 0 | – |"
    );
}

/// Counted are valid maps and others apart; what is worse than the tolerance does not count.
#[test]
fn dominance_is_counted() {
    let found = |rival: &str, valid, worst| Dominance {
        rival: rival.to_owned(),
        valid,
        setting: "--q 0.5 --shape 1".to_owned(),
        ratios: [0.5, worst, 1.0],
    };
    let mut league = league(vec![
        row("qparam-paper", figures(measures(2.0))),
        with_errors("libigl-slim", [2.0, 8.0, 1.25]),
    ]);
    league.meshes[0].dominance =
        vec![found("a", true, 1.019), found("b", true, 1.021), found("c", false, 1.0)];
    let text = markdown::render(&league, None);
    assert!(
        text.contains("no worse than 1 of the 2 valid maps in one island, and than 1 of the 1"),
        "{text}"
    );
    assert!(line(&text, "| m | 10 |").ends_with("| 1 of 2 | 1.02 | 1 of 1 | 1.00 |"), "{text}");
    assert!(text.contains("\nNot matched: b (1.02): no setting that was tried is nearer.\n"), "{text}");
    league.meshes[0].dominance[1].setting = "--q 0.9999 --shape 0.001".to_owned();
    league.meshes[0].dominance[1].ratios = [1.021, 0.5, 0.9];
    assert!(markdown::render(&league, None).contains("\nNot matched: b (1.02), whose angles"));
    assert_eq!(line(&text, "| b "), "| b | yes | `--q 0.5 --shape 1` | 0.500 | 1.02 | 1.00 | 1.02 |");
}

/// Run again are ours alone: the rivals' rows and what was found against them stay.
#[test]
fn rivals_are_kept_when_ours_run_again() {
    let found =
        Dominance { rival: "a".to_owned(), valid: true, setting: "--q 0.5".to_owned(), ratios: [1.0; 3] };
    let mut earlier =
        league(vec![with_errors("qparam-paper", [2.0; 3]), with_errors("libigl-slim", [3.0; 3])]);
    let mut earlier = earlier.meshes.remove(0);
    earlier.dominance = vec![found];
    earlier.disagreements = vec!["qparam-paper: x".to_owned(), "libigl-slim: y".to_owned()];
    let mut again = league(vec![with_errors("qparam-paper", [1.0; 3])]).meshes.remove(0);
    again.keep_rivals(earlier);
    assert_eq!(
        again.rows.iter().map(|row| row.name.as_str()).collect::<Vec<_>>(),
        ["qparam-paper", "libigl-slim"]
    );
    assert!(
        matches!(&again.rows[0].outcome, Outcome::Measured(figures) if figures.measures.angle_error == 1.0)
    );
    assert_eq!((again.dominance.len(), again.disagreements), (1, vec!["libigl-slim: y".to_owned()]));
}

/// Without our own result there is nothing to compare with: the rivals' figures stand, the task fails.
#[test]
fn no_ratios_when_ours_failed() {
    let league = league(vec![
        row("qparam-paper", Outcome::Failed { message: "no".to_owned() }),
        row("rival-a", figures(measures(4.0))),
    ]);
    assert_eq!(league.verdict(), Err("m.obj: qparam-paper failed: no".to_owned()));
    let text = markdown::render(&league, None);
    assert!(line(&text, "| rival-a").contains("| 4.00 |"));
}

#[test]
fn a_mesh_that_is_no_disk_is_listed_as_refused() {
    let mut league = league(Vec::new());
    league.meshes[0].about.not_a_disk = Some("closed".to_owned());
    assert!(markdown::render(&league, None).contains("Refused: not a disk (closed)."));
    assert_eq!(league.verdict(), Ok(()));
}

fn independent(measures: &Measures, rounding: f64) -> Independent {
    let mut value = serde_json::to_value(measures).expect("plain data");
    value["torn_quads"] = 0.into();
    value["rounding"] = serde_json::json!({ "angle_error": rounding });
    serde_json::from_value(value).expect("the script's form")
}

/// The tolerance is 1e-6, and ten times the rounding where a double holds less than that; counts have none.
#[test]
fn disagreement_of_the_measurers_fails_the_task() {
    let ours = measures(2.0);
    let script = |angle: f64, rounding: f64| independent(&measures(angle), rounding);
    assert!(agreement::disagreements(&ours, &script(2.0 + 1e-6, 0.0)).is_empty());
    assert_eq!(agreement::disagreements(&ours, &script(2.0 + 1e-5, 0.0)).len(), 1);
    assert!(agreement::disagreements(&ours, &script(2.0 + 1e-5, 1e-6)).is_empty());
    assert_eq!(agreement::disagreements(&ours, &script(f64::INFINITY.min(1e300), 0.0)).len(), 1);
    assert!(
        agreement::disagreements(&measures(2e15), &script(3e15, 0.0)).is_empty(),
        "no digit means anything"
    );
    assert_eq!(agreement::disagreements(&measures(2e14), &script(3e15, 0.0)).len(), 1);
    let mut other = measures(2.0);
    other.flipped_corners = 1;
    other.symmetric_dirichlet = None;
    let found = agreement::disagreements(&ours, &independent(&other, 0.0));
    assert_eq!(found.len(), 2, "{found:?}");

    let mut league = league(vec![row("qparam-paper", figures(measures(2.0)))]);
    league.meshes[0].disagreements = found;
    assert!(league.verdict().is_err());
    assert!(markdown::render(&league, None).contains("**Disagreement**"));
}

#[test]
fn order_alternates() {
    assert_eq!(race::order(3, 0), [0, 1, 2]);
    assert_eq!(race::order(3, 1), [2, 1, 0]);
    assert_eq!(race::order(3, 2), [0, 1, 2]);
}

/// The list of methods comes from the help, however it is wrapped, so that a new method takes part by itself.
#[test]
fn methods_are_read_from_the_help() {
    let help = "Method:\n      --method <METHOD>\n          Which way to a map [default: paper] [possible values: paper,\n\
                          uniform, mean-value]\n      --q <0..1>  dial [default: 0.5]\n";
    let (methods, default) = ours::methods(help).expect("listed");
    assert_eq!(methods, ["paper", "uniform", "mean-value"]);
    assert_eq!(default, "paper");
    assert_eq!(ours::methods("Usage: qparam unwrap [OPTIONS]"), None);
}

#[test]
fn our_report_names_time_and_memory() {
    let report = r#"{"timings_seconds": {"parameterize": 0.25, "total": 1.0}, "peak_memory_bytes": 4096}"#;
    let account = race::Account { solve_seconds: 0.25, peak_memory_bytes: Some(4096) };
    assert_eq!(ours::own_account(report), Some(account));
    assert_eq!(ours::own_account("{}"), None);
}

#[test]
fn complaints_are_one_line() {
    let traceback = "noise\nTraceback (most recent call last):\n  File \"x.py\", line 1\n    boom()\nValueError: no\nbye\n";
    assert_eq!(shell::complaint(traceback).as_deref(), Some("ValueError: no"));
    assert_eq!(
        shell::complaint("\nnote\nerror: not a disk\n  help: cut\n").as_deref(),
        Some("error: not a disk")
    );
    let panic =
        "thread 'main' (12) panicked at src/x.rs:1:2:\nindex out of bounds\nnote: run with RUST_BACKTRACE\n";
    assert_eq!(shell::complaint(panic).as_deref(), Some("index out of bounds"));
    assert_eq!(shell::complaint("something else\nmore").as_deref(), Some("something else"));
    assert_eq!(shell::complaint("\n \n"), None);
}

#[test]
fn machine_fields() {
    let text = "processor\t: 0\nmodel name\t: Model X @ 2: fast\nmodel name\t: again\n";
    assert_eq!(machine::field(text, "model name").as_deref(), Some("Model X @ 2: fast"));
    assert_eq!(machine::field(text, "MemTotal"), None);
}

/// The script that checks `qparam measure` is itself held by maps whose measures are known on paper.
#[test]
fn independent_script_passes_its_own_test() {
    let places = super::places::Places::new().expect("target/ can be written");
    let pythons = [places.venv.join("bin/python"), "python3".into()];
    let has_numpy = |python: &std::path::PathBuf| {
        shell::output(Command::new(python).args(["-c", "import numpy"])).is_ok()
    };
    let Some(python) = pythons.iter().find(|python| has_numpy(python)) else {
        println!("skipped: there is no python3 with numpy");
        return;
    };
    let mut command = Command::new(python);
    command.arg("test_measure.py").current_dir(&places.scripts).envs(places.install_environment());
    let output = command.output().expect("python runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
