//! What the fuzzer found worth keeping, run through the same checks without it.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]
#![allow(clippy::print_stdout, reason = "the name of the file is shown when the test fails")]

#[path = "../../fuzz/harness/mod.rs"]
mod harness;

use std::fs;
use std::path::Path;

/// Hands every file of a corpus to `run`, the name to standard output, which is shown when the test fails.
fn replay(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() > 20, "{} files: is the corpus there?", paths.len());
    for path in paths {
        println!("{}", path.display());
        run(&fs::read(path).unwrap());
    }
}

#[test]
fn any_bytes_are_read_or_refused() {
    replay("obj", harness::obj::run);
}

#[test]
fn any_polygons_are_charts_or_are_refused() {
    replay("soup", harness::soup::run);
}

#[test]
fn any_mesh_ends_with_a_verdict_that_is_true() {
    replay("unwrap", harness::unwrap::run);
}

/// For looking at what the fuzzer found: `CASE=FILE cargo test -p xtask --test corpus -- --ignored --nocapture`.
#[test]
#[ignore = "shows what the file named by the variable CASE stands for"]
fn show_case() {
    let bytes = fs::read(std::env::var_os("CASE").unwrap()).unwrap();
    let (text, options) = harness::unwrap::case(&bytes);
    println!("{text}\nqparam unwrap - {}", options.join(" "));
    harness::unwrap::run(&bytes);
}
