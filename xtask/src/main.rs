//! Chores of the workspace: `cargo xtask TASK`.
//!
//! Each task is one file; the table below is the help text.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line tool")]

use std::process::ExitCode;

/// A task gets the arguments after its name.
type Task = fn(&[String]) -> Result<(), String>;

const TASKS: &[(&str, &str, Task)] = &[
    ("bench", "time a quad and growth of each stage, into benches/RESULTS.md", bench::run),
    (
        "compare",
        "league table of qparam and its rivals on the same meshes (fetches the rivals)",
        compare::run,
    ),
    (
        "dial",
        "certify the disks over q and tabulate what each term does, into docs/tables/dial.md",
        dial::run,
    ),
    (
        "disks",
        "map hostile disks of all kinds, certify each map, check by brute force (--count N, --seed S), into docs/tables/disks.md",
        disks::run,
    ),
    ("figure", "draw docs/figures/head-face.png anew; --check compares instead", figure::run),
    (
        "fixtures",
        "regenerate fixtures/ from formulas, byte for byte; --check compares instead",
        fixtures::run,
    ),
    (
        "instructions",
        "count the instructions of small runs, into benches/instructions.toml; --check compares instead",
        instructions::run,
    ),
    (
        "meshes",
        "unwrap every mesh in the folder QPARAM_MESHES, and compare seams (--python PROGRAM for the rivals), into docs/tables/meshes.md",
        meshes::run,
    ),
    (
        "packing",
        "what our packing and xatlas's fill with the same islands (--python PROGRAM), into docs/tables/meshes.md",
        packing::run,
    ),
    (
        "readings",
        "the tables behind docs/paper.md; --check compares them, --times prints ratios of times",
        readings::run,
    ),
    (
        "refine",
        "does the map converge as the mesh is refined, or grow shear bands? into docs/tables/refine.md; --quick only shows",
        refine::run,
    ),
    (
        "sweep",
        "distortion tables in the form of Table 1, into fixtures/tables/ and README.md; --check compares",
        sweep::run,
    ),
    ("tidy", "house rules: the chain of crates, module headers, every equation cited, links", tidy::run),
];

mod arguments;
mod bench;
mod chart;
mod compare;
mod dial;
mod disks;
mod figure;
mod fixtures;
mod instructions;
mod links;
mod meshes;
mod packing;
mod readings;
mod refine;
mod section;
mod sweep;
mod tidy;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((name, rest)) = arguments.split_first() else {
        return usage();
    };
    let Some((_, _, task)) = TASKS.iter().find(|(known, _, _)| known == name) else {
        return usage();
    };
    match task(rest) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{name}: {message}");
            ExitCode::FAILURE
        }
    }
}

fn usage() -> ExitCode {
    eprintln!("usage: cargo xtask TASK\n");
    for (name, what, _) in TASKS {
        eprintln!("  {name:10} {what}");
    }
    ExitCode::from(2)
}
