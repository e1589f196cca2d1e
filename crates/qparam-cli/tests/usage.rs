//! What people read first: help, and complaints about the command line and the configuration.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use common::{Folder, hill};

#[test]
fn help_texts() {
    trycmd::TestCases::new().env("COLUMNS", "100").case("tests/cmd/*.trycmd");
}

#[test]
fn wrong_usage_is_explained() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    folder.write("bad.toml", "q = 0.5\ncolour = 'red'\n");
    let lines: &[&[&str]] = &[
        &["unwrap"],
        &["unwrap", "in.obj", "--q", "1.5"],
        &["unwrap", "in.obj", "--q", "nan"],
        &["unwrap", "in.obj", "--method", "magic"],
        &["unwrap", "in.obj", "--lambda1", "0.7", "--lambda2", "0.3"],
        &["unwrap", "in.obj", "--boundary", "fixed"],
        &["unwrap", "in.obj", "--boundary-uv", "b.txt"],
        &["unwrap", "in.obj", "--remove-below", "1", "--remove-fraction", "0.5"],
        &["unwrap", "in.obj", "--simplified", "s.obj"],
        &["unwrap", "in.obj", "--preset", "pretty"],
        &["unwrap", "in.obj", "--method=paper", "-o", "same.obj", "--simplified", "same.obj"],
        &["unwrap", "in.obj", "--config", "bad.toml"],
        &["unwrap", "in.obj", "--config", "missing.toml"],
        &["measure"],
        &["measure", "-", "-"],
        &["check"],
        &["check", "-", "-"],
        &["check", "in.obj", "--limit", "-1"],
        &["man", "nonsense"],
        &["frobnicate"],
    ];
    let mut shown = String::new();
    for line in lines {
        let run = folder.qparam(line).code(2);
        assert_eq!(run.stdout, "", "{line:?}");
        shown += &format!("$ qparam {}\n{}\n", line.join(" "), run.stderr);
    }
    assert_eq!(folder.names(), ["bad.toml", "in.obj"]);
    insta::assert_snapshot!(shown);
}

#[test]
fn an_option_that_nothing_reads_is_noted() {
    let folder = Folder::new();
    folder.write("in.obj", hill(4));
    let run = folder.qparam(&["unwrap", "in.obj", "--method", "uniform", "--q", "0.2"]).code(0);
    assert!(
        run.stderr.contains("note: --q has no effect: only paper, direct and conformal read it"),
        "{}",
        run.stderr
    );
    let run = folder.qparam(&["unwrap", "in.obj", "--backend", "multigrid"]).code(0);
    let note = "note: --backend has no effect: Newton systems have solvers of their own";
    assert!(run.stderr.contains(note), "{}", run.stderr);
}

#[test]
fn manual_pages_and_completions_name_the_options() {
    let folder = Folder::new();
    assert!(folder.qparam(&["man"]).code(0).stdout.contains(".TH qparam 1"));
    assert!(folder.qparam(&["man", "unwrap"]).code(0).stdout.contains("residual"));
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.qparam(&["completions", shell]).code(0).stdout;
        assert!(script.contains("residual-bound") && script.contains("qparam"), "{shell}");
    }
}

/// `NO_COLOR` and a pipe both mean: no escape sequences. `CLICOLOR_FORCE` shows that there are some to leave out.
#[test]
fn colours_are_left_out_when_asked() {
    let folder = Folder::new();
    let colored = |name: &str, value: &str| {
        let output = folder.command(&["info", "missing.obj"]).env(name, value).output().unwrap();
        String::from_utf8_lossy(&output.stderr).contains('\u{1b}')
    };
    assert!(colored("CLICOLOR_FORCE", "1"));
    assert!(!colored("NO_COLOR", "1"));
    assert!(!colored("UNRELATED", "1"), "a pipe is no terminal");
}

/// Whoever asks for JSON gets JSON, also when the rest of the command line, or the configuration, is wrong.
#[test]
fn wrong_usage_is_json_for_programs() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    folder.write("bad.toml", "colour = 'red'\n");
    let lines: &[(&[&str], &str)] = &[
        (&["unwrap", "in.obj", "--json", "--q", "2"], "expected a number between 0 and 1"),
        (&["unwrap", "in.obj", "--json", "--quiet"], "cannot be used with"),
        (&["unwrap", "--json"], "required arguments"),
        (&["unwrap", "in.obj", "--json", "--config", "bad.toml"], "there is no such option"),
        (&["sweep", "in.obj", "--json", "--q", "-1"], "expected a number between 0 and 1"),
        (&["measure", "--json"], "required arguments"),
        (&["check", "--json"], "required arguments"),
        (&["info", "in.obj", "more", "--json"], "unexpected argument 'more'"),
    ];
    for (line, expected) in lines {
        let json = folder.qparam(line).code(2).json();
        assert_eq!((&json["command"], &json["exit_code"]), (&line[0].into(), &2.into()), "{line:?}");
        assert_eq!(json["error"]["class"], "usage", "{line:?}");
        assert!(json["error"]["message"].as_str().unwrap().contains(expected), "{line:?}: {json}");
    }
    // Behind `--` stand file names.
    assert_eq!(folder.qparam(&["unwrap", "--q", "2", "--", "--json"]).code(2).stdout, "");
}

/// A negative number is a value that is out of range, not an option that does not exist.
#[test]
fn negative_values_are_told_their_range() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    for (option, expected) in [
        ("--q", "expected a number between 0 and 1"),
        ("--exponent", "expected a number of at least 0"),
        ("--residual-bound", "expected a number above 0"),
        ("--threads", "expected a number of threads"),
        ("--remove-below", "expected a number of at least 0"),
        ("--max-iterations", "invalid digit"),
    ] {
        let run = folder.qparam(&["unwrap", "in.obj", option, "-1"]).code(2);
        assert!(run.stderr.contains(expected), "{option}: {}", run.stderr);
    }
}

/// A `qparam.toml` that is there but cannot be read does not silently give other defaults.
#[test]
fn an_unreadable_configuration_is_an_error() {
    let folder = Folder::new();
    folder.write("in.obj", hill(2));
    std::fs::create_dir(folder.path("qparam.toml")).unwrap();
    let run = folder.qparam(&["unwrap", "in.obj"]).code(2);
    assert!(run.stderr.contains("qparam.toml: the configuration could not be read"), "{}", run.stderr);
    folder.qparam(&["unwrap", "in.obj", "--no-config"]).code(0);
}
