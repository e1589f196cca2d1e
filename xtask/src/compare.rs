//! `cargo xtask compare [MESHES…]`: a league table of `qparam` and its rivals on the same quad meshes.
//!
//! The rivals are installed into `target/compare`, each runs in a process of its own, all results are measured by
//! `qparam measure` and again by `xtask/compare/measure.py`, which shares no code with it. That the two disagree fails
//! the task.

mod agreement;
mod cgal;
mod contestant;
mod dominance;
mod league;
pub(crate) mod machine;
mod markdown;
mod numbers;
mod ours;
mod places;
mod python;
mod race;
mod shell;

use std::path::{Path, PathBuf};

use clap::Parser;

use contestant::{Absent, Contestant};
use league::{League, MeshTable, Outcome, Row};
use places::Places;
use race::Race;

/// Run `qparam` and its rivals on the same quad meshes and write a league table.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask compare")]
struct Arguments {
    /// Quad meshes (OBJ) that are disks; default: the face and the head of fixtures/
    meshes: Vec<PathBuf>,
    /// Runs of each method on each mesh; times are medians
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
    /// Seconds after which a run is ended
    #[arg(long, default_value_t = 60.0)]
    timeout: f64,
    /// Only methods whose name contains one of these words (comma-separated); ours always run
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// The method of `qparam` that ratios are taken against; default: its default method
    #[arg(long, value_name = "METHOD")]
    against: Option<String>,
    /// The Python interpreter for the rivals (bpy needs 3.11)
    #[arg(long, value_name = "PATH")]
    python: Option<PathBuf>,
    /// Install nothing; rivals that are not there are listed so
    #[arg(long)]
    no_install: bool,
    /// Also look, for every valid rival in one island, for a setting of --q, --shape and --angle-term that is no worse in angle
    /// error, area error and symmetric Dirichlet (112 maps a mesh)
    #[arg(long)]
    dominance: bool,
    /// Where the table goes; JSON goes beside it with the ending .json
    #[arg(long, value_name = "FILE.md", default_value = "target/compare/league.md")]
    output: PathBuf,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let name = ["cargo xtask compare".to_owned()];
    match Arguments::try_parse_from(name.iter().chain(arguments)) {
        Ok(arguments) => compare(&arguments),
        Err(error) if error.use_stderr() => Err(error.to_string()),
        Err(help) => {
            print!("{help}");
            Ok(())
        }
    }
}

fn compare(arguments: &Arguments) -> Result<(), String> {
    let places = Places::new()?;
    let meshes = meshes(arguments, &places)?;
    let interpreter = python::prepare(&places, arguments.python.as_deref(), !arguments.no_install)?;
    let ours = ours::build(&places, arguments.against.as_deref())?;
    let cgal = cgal::build(&places);

    let mut contestants = ours.contestants();
    let (rivals, mut absent) = python::contestants(&places, &interpreter);
    contestants.extend(rivals);
    match &cgal {
        Ok(tool) => contestants.extend(tool.contestants()),
        Err(why) => absent.push(Absent { tool: "CGAL".to_owned(), why: why.clone() }),
    }
    let wanted =
        |name: &str| arguments.only.is_empty() || arguments.only.iter().any(|word| name.contains(word));
    contestants.retain(|contestant| contestant.ours || wanted(&contestant.name));

    let race =
        Race { places: &places, interpreter: &interpreter, runs: arguments.runs, timeout: arguments.timeout };
    let mut tables = Vec::new();
    for (number, mesh) in meshes.iter().enumerate() {
        let mut table = table(number, mesh, &contestants, &race, &ours)?;
        if arguments.dominance {
            table.dominance = dominance::against_all(mesh, &table.rows)?;
        }
        tables.push(table);
    }
    let mut versions = vec![ours.version.clone(), interpreter.version.clone()];
    versions.extend(interpreter.packages.iter().filter_map(|package| package.installed.clone().ok()));
    versions.extend(cgal.iter().map(|tool| tool.version.clone()));
    let league = League {
        schema_version: league::SCHEMA_VERSION,
        machine: machine::describe(),
        versions,
        runs: arguments.runs,
        timeout_seconds: arguments.timeout,
        baseline: ours.baseline.clone(),
        meshes: tables,
        absent,
    };
    write(&league, &places.root.join(&arguments.output))?;
    league.verdict()
}

/// The meshes to run on, as absolute paths.
fn meshes(arguments: &Arguments, places: &Places) -> Result<Vec<PathBuf>, String> {
    let fixtures = ["face.obj", "head.obj"].map(|name| places.root.join("fixtures").join(name));
    let chosen = if arguments.meshes.is_empty() { &fixtures[..] } else { &arguments.meshes };
    let absolute = |path: &PathBuf| {
        std::path::absolute(path)
            .and_then(|path| path.metadata().map(|_| path))
            .map_err(|error| format!("{}: {error}", path.display()))
    };
    chosen.iter().map(absolute).collect()
}

fn table(
    number: usize,
    mesh: &Path,
    contestants: &[Contestant],
    race: &Race<'_>,
    ours: &ours::Qparam,
) -> Result<MeshTable, String> {
    let name = mesh.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let about = python::inspect(race.places, race.interpreter, mesh)?;
    let mut table =
        MeshTable { name, about, rows: Vec::new(), disagreements: Vec::new(), dominance: Vec::new() };
    if let Some(reason) = &table.about.not_a_disk {
        eprintln!("{}: refused, not a disk: {reason}", table.name);
        return Ok(table);
    }
    let folder = race.places.runs.join(format!("{number}-{}", table.name.trim_end_matches(".obj")));
    eprintln!("{}: {} methods, {} runs each", table.name, contestants.len(), race.runs);
    for (contestant, finish) in contestants.iter().zip(race.run(contestants, mesh, &folder)?) {
        let outcome = match finish {
            Err(message) => Outcome::Failed { message },
            Ok(finish) => {
                let judgement = agreement::judge(race, ours, mesh, &finish);
                let named = |text: &String| format!("{}: {text}", contestant.name);
                table.disagreements.extend(judgement.disagreements.iter().map(named));
                judgement.outcome
            }
        };
        table.rows.push(Row {
            name: contestant.name.clone(),
            ours: contestant.ours,
            input: contestant.input.to_owned(),
            outcome,
        });
    }
    Ok(table)
}

fn write(league: &League, output: &Path) -> Result<(), String> {
    let json = serde_json::to_string_pretty(league).map_err(|error| error.to_string())?;
    if let Some(folder) = output.parent() {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    for (path, text) in
        [(output.to_owned(), markdown::render(league)), (output.with_extension("json"), json + "\n")]
    {
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("{}", path.display());
    }
    Ok(())
}

#[cfg(test)]
mod tests;
