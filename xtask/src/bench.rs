//! `cargo xtask bench`: runs the criterion benches and writes time a quad and growth of each stage as a table.

mod estimates;
mod growth;

use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Parser;

use crate::arguments;
use crate::compare::machine;
use crate::instructions::rustc;
use estimates::{Estimate, collect};
use growth::{LARGE, Row, rows};

/// Run the benches of the stages and write benches/RESULTS.md.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask bench")]
struct Arguments {
    /// Only these benches (files of benches/benches, comma-separated)
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Quads at most; the sizes are 1024, 10 000, 99 856 and 1 000 000
    #[arg(long, default_value_t = 1_000_000)]
    largest: usize,
    /// Few samples: criterion stops as soon as two agree
    #[arg(long)]
    quick: bool,
    /// Keep the results of runs before, to complete them with --only or --largest
    #[arg(long)]
    keep: bool,
    /// Where the table goes
    #[arg(long, value_name = "FILE.md", default_value = "benches/RESULTS.md")]
    output: PathBuf,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    arguments::parsed("cargo xtask bench", arguments, bench)
}

fn bench(arguments: &Arguments) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")?;
    let folder = root.join("target/xtask-bench");
    if !arguments.keep && folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root).args(["bench", "--package", "qparam-benches"]);
    if arguments.only.is_empty() {
        command.arg("--benches");
    }
    for name in &arguments.only {
        command.args(["--bench", name]);
    }
    command.args(["--", "--noplot", "--warm-up-time", "0.5", "--measurement-time", "2"]);
    if arguments.quick {
        command.arg("--quick");
    }
    command.env("CRITERION_HOME", &folder).env("QPARAM_BENCH_LARGEST", arguments.largest.to_string());
    let status = command.status().map_err(|error| format!("cargo bench could not be started: {error}"))?;
    if !status.success() {
        return Err(format!("cargo bench ended with {status}"));
    }
    let text = markdown(&rows(&collect(&folder)?), arguments.quick);
    let path = root.join(&arguments.output);
    std::fs::write(&path, &text).map_err(|error| format!("{}: {error}", path.display()))?;
    print!("{text}");
    Ok(())
}

/// The table and what it was measured on.
fn markdown(rows: &[Row], quick: bool) -> String {
    let machine = machine::describe();
    let memory = machine.memory_gib.map_or_else(String::new, |gib| format!(", {gib} GiB of memory"));
    let mut text = format!(
        "# Time of each stage\n\nWritten by `cargo xtask bench{}`. {}, {} threads{memory}, {}, {}. The machine was shared with other work, so single \
         figures may be\ntoo large; growth says more. The meshes are square height fields with a bump (`qmesh::shapes::bump`), {}.\n\n\
         Microseconds a quad; growth is the exponent k of time ~ quads^k, fitted to all sizes (1: linear),\nand to \
         those from {LARGE} quads on.\n\n",
        if quick { " --quick" } else { "" },
        machine.processor,
        machine.threads,
        machine.system,
        rustc(),
        "with as many quads as the columns say"
    );
    let mut sizes: Vec<usize> = rows.iter().flat_map(|row| row.times.iter().map(|time| time.quads)).collect();
    sizes.sort_unstable();
    sizes.dedup();
    text += "| stage |";
    text += &sizes.iter().map(|size| format!(" {size} |")).collect::<String>();
    text += &format!(" growth | of large |\n| --- |{} ---: | ---: |\n", " ---: |".repeat(sizes.len()));
    for row in rows {
        text += &format!("| {} |", row.stage);
        for size in &sizes {
            let time = row.times.iter().find(|time| time.quads == *size);
            text += &time.map_or_else(|| " – |".to_owned(), |time| format!(" {} |", micros(time)));
        }
        for growth in [row.growth, row.growth_of_large] {
            text += &growth.map_or_else(|| " – |".to_owned(), |growth| format!(" {growth:.2} |"));
        }
        text += "\n";
    }
    text
}

/// Three digits at most.
fn micros(time: &Estimate) -> String {
    match time.nanoseconds / 1000.0 / time.quads as f64 {
        micros if micros >= 100.0 => format!("{micros:.0}"),
        micros if micros >= 10.0 => format!("{micros:.1}"),
        micros if micros >= 1.0 => format!("{micros:.2}"),
        micros => format!("{micros:.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_a_column_a_size_and_a_dash_where_nothing_was_measured() {
        let estimate = |quads, nanoseconds| Estimate { stage: "x".into(), quads, nanoseconds };
        let estimates =
            [estimate(100, 2e5), estimate(10_000, 2e7), Estimate { stage: "y".into(), ..estimate(100, 5e3) }];
        let text = markdown(&rows(&estimates), true);
        assert!(text.contains("| stage | 100 | 10000 | growth | of large |\n"), "{text}");
        assert!(text.contains("| x | 2.00 | 2.00 | 1.00 | – |\n| y | 0.050 | – | – | – |\n"), "{text}");
    }
}
