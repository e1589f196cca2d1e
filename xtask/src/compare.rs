//! `cargo xtask compare [MESHES…]`: a league table of `qparam` and its rivals on the same quad meshes.
//!
//! The rivals are installed into `target/compare`, each runs in a process of its own, all results are measured by
//! `qparam measure` and again by `xtask/compare/measure.py`, which shares no code with it. That the two disagree fails
//! the task.

mod agreement;
mod cgal;
mod contestant;
mod defaults;
mod dominance;
mod front;
mod league;
pub(crate) mod machine;
mod markdown;
mod meshes;
mod numbers;
mod ours;
mod places;
mod python;
mod race;
mod settings;
mod shell;
mod summary;

use std::path::{Path, PathBuf};

use clap::Parser;

use crate::arguments;

use contestant::{Absent, Contestant};
use league::{League, MeshTable, Outcome, Row};
use places::Places;
use race::Race;

/// Run `qparam` and its rivals on the same quad meshes and write a league table.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask compare")]
struct Arguments {
    /// Quad meshes that are disks: OBJ files, or shapes like nose:100, bump:100, finger:9,126; default: the face and the head of
    /// fixtures/
    meshes: Vec<String>,
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
    /// A `qparam` that is built already; default: cargo builds one in release mode
    #[arg(long, value_name = "PATH")]
    qparam: Option<PathBuf>,
    /// Install nothing; rivals that are not there are listed so
    #[arg(long)]
    no_install: bool,
    /// Also look, for every rival's map in one island, for a setting of --q, --shape and --angle-term that is no worse in angle
    /// error, area error and symmetric Dirichlet (112 maps a mesh and more), and draw both (SVG, beside the table)
    #[arg(long)]
    dominance: bool,
    /// Go on from the data of an earlier run: draw its table anew, with the given meshes added to it
    #[arg(long, value_name = "FILE.json")]
    from: Option<PathBuf>,
    /// With --from: run our own methods anew on the given meshes, which are in the data, and keep the rivals' figures
    #[arg(long, requires = "from")]
    ours: bool,
    /// Also put the short table into README.md
    #[arg(long)]
    readme: bool,
    /// Where the table goes; a picture goes beside it, JSON with all figures into target/compare
    #[arg(long, value_name = "FILE.md", default_value = "target/compare/league.md")]
    output: PathBuf,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    arguments::parsed("cargo xtask compare", arguments, compare)
}

fn compare(arguments: &Arguments) -> Result<(), String> {
    let places = Places::new()?;
    let earlier = arguments.from.as_deref().map(read).transpose()?;
    let league = match earlier {
        Some(earlier) if arguments.meshes.is_empty() => earlier,
        earlier => league(arguments, &places, earlier)?,
    };
    write(&league, &places, &arguments.output)?;
    if arguments.readme {
        crate::section::write(&places.root.join("README.md"), "compare", &summary::short_table(&league))?;
    }
    league.verdict()
}

/// The data of an earlier run.
fn read(path: &Path) -> Result<League, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| failed(&error))?;
    let league: League = serde_json::from_str(&text).map_err(|error| failed(&error))?;
    if league.schema_version == league::SCHEMA_VERSION {
        Ok(league)
    } else {
        Err(failed(&"was written by another version of this task"))
    }
}

/// Runs everybody on every mesh, and puts what comes of it behind what is there.
fn league(arguments: &Arguments, places: &Places, earlier: Option<League>) -> Result<League, String> {
    let meshes = meshes::files(&arguments.meshes, places)?;
    let interpreter = python::prepare(places, arguments.python.as_deref(), !arguments.no_install)?;
    let ours = ours::prepare(places, arguments.qparam.as_deref(), arguments.against.as_deref())?;
    let cgal = cgal::build(places);

    let mut contestants = ours.contestants();
    let (rivals, mut absent) = python::contestants(places, &interpreter);
    contestants.extend(rivals);
    match &cgal {
        Ok(tool) => contestants.extend(tool.contestants()),
        Err(why) => absent.push(Absent { tool: "CGAL".to_owned(), why: why.clone() }),
    }
    let wanted =
        |name: &str| arguments.only.is_empty() || arguments.only.iter().any(|word| name.contains(word));
    contestants.retain(|contestant| contestant.ours || wanted(&contestant.name));

    let mut versions = vec![ours.version.clone(), interpreter.version.clone()];
    versions.extend(interpreter.packages.iter().filter_map(|package| package.installed.clone().ok()));
    versions.extend(cgal.iter().map(|tool| tool.version.clone()));
    if arguments.ours {
        contestants.retain(|contestant| contestant.ours);
    }
    let mut league = League {
        schema_version: league::SCHEMA_VERSION,
        arguments: told(arguments),
        machine: machine::describe(),
        versions,
        runs: arguments.runs,
        timeout_seconds: arguments.timeout,
        baseline: ours.baseline.clone(),
        meshes: Vec::new(),
        absent,
        ours_again: arguments.ours,
    };
    if let Some(earlier) = earlier {
        if earlier.versions != league.versions || earlier.baseline != league.baseline {
            return Err(format!("the earlier run was made with {}", earlier.versions.join(", ")));
        }
        if arguments.ours {
            league.arguments = earlier.arguments;
        } else {
            league.arguments = format!("{} {}", earlier.arguments, names(&arguments.meshes));
            league.ours_again = earlier.ours_again;
        }
        league.meshes = earlier.meshes;
    }
    let race = Race { places, interpreter: &interpreter, runs: arguments.runs, timeout: arguments.timeout };
    for (number, mesh) in meshes.iter().enumerate() {
        let mut table = table(number, mesh, &contestants, &race, &ours)?;
        let place = league.meshes.iter().position(|earlier| earlier.name == table.name);
        if let Some(place) = place.filter(|_| arguments.ours) {
            table.keep_rivals(league.meshes.remove(place));
            league.meshes.insert(place, table.clone());
        }
        if arguments.dominance && table.about.not_a_disk.is_none() {
            let mesh = settings::load(mesh)?;
            table.grid = settings::grid(&mesh)?;
            table.dominance = dominance::against_all(&mesh, &table.rows, &table.grid);
        }
        match place {
            Some(place) => league.meshes[place] = table,
            None => league.meshes.push(table),
        }
        // A long run that is interrupted keeps what it has.
        save(&league, places, &arguments.output)?;
    }
    Ok(league)
}

/// The arguments that matter to the result, meshes without their folders.
fn told(arguments: &Arguments) -> String {
    let mut words = vec![format!(" --runs {} --timeout {}", arguments.runs, arguments.timeout)];
    if arguments.dominance {
        words.push("--dominance".to_owned());
    }
    if !arguments.only.is_empty() {
        words.push(format!("--only {}", arguments.only.join(",")));
    }
    words.push(names(&arguments.meshes));
    words.join(" ")
}

/// Without folders.
fn names(meshes: &[String]) -> String {
    let name = |mesh: &String| Path::new(mesh).file_name().unwrap_or_default().to_string_lossy().into_owned();
    meshes.iter().map(name).collect::<Vec<_>>().join(" ")
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
    let mut table = MeshTable { name, about, ..MeshTable::default() };
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
            boundary: contestant.boundary().to_owned(),
            outcome,
        });
    }
    Ok(table)
}

/// All figures as JSON in `target/compare`, the times of this machine included.
fn save(league: &League, places: &Places, output: &Path) -> Result<PathBuf, String> {
    let json = serde_json::to_string_pretty(league).map_err(|error| error.to_string())?;
    let path = places.data.join(output.with_extension("json").file_name().unwrap_or_default());
    put(&path, &(json + "\n"))?;
    Ok(path)
}

/// The table and its picture, which say nothing of the machine, and the data, which do.
fn write(league: &League, places: &Places, output: &Path) -> Result<(), String> {
    println!("{}", save(league, places, output)?.display());
    let table = places.root.join(output);
    let picture = table.with_extension("svg");
    let drawn = front::picture(league);
    let name = drawn.as_ref().and(picture.file_name()).map(|name| name.to_string_lossy().into_owned());
    put(&table, &markdown::render(league, name.as_deref()))?;
    println!("{}", table.display());
    if let Some(drawn) = drawn {
        put(&picture, &drawn)?;
        println!("{}", picture.display());
    }
    Ok(())
}

fn put(path: &Path, text: &str) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", path.display());
    path.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(failed)?;
    std::fs::write(path, text).map_err(failed)
}

#[cfg(test)]
mod tests;
