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
        &["unwrap", "in.obj", "--method", "lscm", "--simplified", "s.obj"],
        &["unwrap", "in.obj", "-o", "same.obj", "--simplified", "same.obj"],
        &["unwrap", "in.obj", "--config", "bad.toml"],
        &["unwrap", "in.obj", "--config", "missing.toml"],
        &["measure"],
        &["measure", "-", "-"],
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
