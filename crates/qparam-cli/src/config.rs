//! Defaults for `unwrap` and `sweep` from a file, and the command line that results.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory, FromArgMatches, ValueEnum};

use crate::args::Cli;
use crate::choices::PresetChoice;
use crate::exit::Exit;
use crate::failure::Failure;

/// Where configuration files are looked for.
#[derive(Clone, Debug, Default)]
pub struct Environment {
    /// The working directory; `qparam.toml` there is read.
    pub working_directory: PathBuf,
    /// The user's settings; `qparam/config.toml` there is read.
    pub config_home: Option<PathBuf>,
}

/// A parsed command line.
pub(crate) struct Parsed {
    pub(crate) cli: Cli,
    /// The long names of the options that the caller typed.
    pub(crate) typed: Vec<String>,
}

/// Why a command line is none.
pub(crate) enum ParseFailure {
    /// Help and version are errors to clap, too.
    Clap(clap::Error),
    Config(Failure),
}

impl From<clap::Error> for ParseFailure {
    fn from(error: clap::Error) -> Self {
        Self::Clap(error)
    }
}

/// Options that exclude each other: naming one on the command line silences the other in the file.
const RIVALS: &[[&str; 2]] = &[["remove-fraction", "remove-below"], ["json", "quiet"]];
/// The commands that make maps; the file's keys are the options of the first.
const MAPPING: [&str; 2] = ["unwrap", "sweep"];
/// Options that mean something else, or nothing, to `sweep`.
const NOT_FOR_SWEEP: &[&str] = &[
    "q",
    "worst",
    "json",
    "quiet",
    "uv-precision",
    "seams",
    "max-stretch",
    "strict",
    "density",
    "up",
    "resolution",
    "margin",
    "no-pack",
];
/// Options about one run, not about habits.
const NOT_IN_FILES: &[&str] =
    &["output", "simplified", "pin", "pins", "report", "report-q", "config", "no-config", "help", "version"];

/// Parses the command line, with defaults from a configuration file.
pub(crate) fn parse(mut arguments: Vec<OsString>, environment: &Environment) -> Result<Parsed, ParseFailure> {
    let matches = Cli::command().try_get_matches_from(&arguments)?;
    let mut typed = Vec::new();
    if let Some((name, map)) = matches.subcommand().filter(|(name, _)| MAPPING.contains(name)) {
        typed = typed_options(map);
        let left_out = if name == "sweep" { NOT_FOR_SWEEP } else { &[] };
        let mut defaults = defaults(map, &typed, left_out, environment).map_err(ParseFailure::Config)?;
        apply_preset(map, &typed, left_out, &mut defaults);
        // The subcommand comes second: nothing may stand before it but the program.
        arguments.splice(2..2, defaults.into_iter().map(|(_, argument)| argument));
    }
    let matches = Cli::command().try_get_matches_from(&arguments)?;
    Ok(Parsed { cli: Cli::from_arg_matches(&matches)?, typed })
}

fn typed_options(unwrap: &ArgMatches) -> Vec<String> {
    let known = known_options();
    unwrap
        .ids()
        .filter(|id| unwrap.value_source(id.as_str()) == Some(ValueSource::CommandLine))
        // Argument ids are the field names of `UnwrapArgs`.
        .map(|id| id.as_str().replace('_', "-"))
        .filter(|name| known.contains(name))
        .collect()
}

/// What `--preset` stands for, as far as it is not said otherwise. Typed, it silences the file; in the file, whatever else
/// the file says comes first.
fn apply_preset(
    map: &ArgMatches,
    typed: &[String],
    left_out: &[&str],
    defaults: &mut Vec<(String, OsString)>,
) {
    let in_file = defaults.iter().find(|(key, _)| key == "preset");
    let in_file = in_file.and_then(|(_, argument)| argument.to_str()?.strip_prefix("--preset="));
    let typed_preset = map.get_one::<PresetChoice>("preset").copied();
    let Some(choice) = typed_preset.or_else(|| PresetChoice::from_str(in_file?, false).ok()) else { return };
    let settings = choice.arguments();
    if typed_preset.is_some() {
        defaults.retain(|(key, _)| !settings.iter().any(|(name, _)| name == key));
    }
    for (name, value) in settings {
        let is_said = typed.iter().any(|key| key == name) || defaults.iter().any(|(key, _)| key == name);
        if !is_said && !left_out.contains(&name) {
            defaults.push((name.to_owned(), format!("--{name}={value}").into()));
        }
    }
}

/// The long names of the options of `unwrap`.
fn known_options() -> Vec<String> {
    let command = Cli::command();
    let unwrap = command.find_subcommand("unwrap").into_iter();
    unwrap.flat_map(clap::Command::get_arguments).filter_map(clap::Arg::get_long).map(str::to_owned).collect()
}

fn defaults(
    unwrap: &ArgMatches,
    typed: &[String],
    left_out: &[&str],
    environment: &Environment,
) -> Result<Vec<(String, OsString)>, Failure> {
    if unwrap.get_flag("no_config") {
        return Ok(Vec::new());
    }
    let (path, text) = match unwrap.get_one::<PathBuf>("config") {
        Some(path) => (path.clone(), read(path)?),
        None => match find(environment)? {
            Some(found) => found,
            None => return Ok(Vec::new()),
        },
    };
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| {
        Failure::new(
            Exit::Usage,
            format!("{} is no valid TOML\n{}", place(&path, &text, &error), error.message()),
        )
        .help("write one `name = value` a line, for example `q = 0.8`")
    })?;
    let known = known_options();
    let mut arguments = Vec::new();
    for (key, value) in &table {
        let argument = argument(key, value, &known, &path)?;
        let silenced = |name: &String| {
            name == key
                || RIVALS.iter().any(|pair| pair.contains(&name.as_str()) && pair.contains(&key.as_str()))
        };
        if !left_out.contains(&key.as_str()) && !typed.iter().any(silenced) {
            arguments.extend(argument.map(|argument| (key.clone(), argument)));
        }
    }
    Ok(arguments)
}

fn place(path: &Path, text: &str, error: &toml::de::Error) -> String {
    let offset = error.span().map_or(0, |span| span.start).min(text.len());
    let before = &text.as_bytes()[..offset];
    let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
    let column = before.iter().rev().take_while(|&&byte| byte != b'\n').count() + 1;
    format!("{}:{line}:{column}", path.display())
}

fn find(environment: &Environment) -> Result<Option<(PathBuf, String)>, Failure> {
    let here = environment.working_directory.join("qparam.toml");
    let home = environment.config_home.as_ref().map(|home| home.join("qparam").join("config.toml"));
    for path in std::iter::once(here).chain(home) {
        // What is there but cannot be read is an error: silently other defaults would be worse.
        if path.symlink_metadata().is_ok() {
            let text = read(&path)?;
            return Ok(Some((path, text)));
        }
    }
    Ok(None)
}

fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| {
        Failure::new(Exit::Usage, format!("{}: the configuration could not be read", path.display()))
            .cause(&error)
            .help("name another file with --config, or read none with --no-config")
    })
}

/// One entry as an argument; checked alone, so that the message can name the file.
fn argument(
    key: &str,
    value: &toml::Value,
    known: &[String],
    path: &Path,
) -> Result<Option<OsString>, Failure> {
    let refuse = |why: String| Failure::new(Exit::Usage, format!("{}: `{key}`: {why}", path.display()));
    if NOT_IN_FILES.contains(&key) {
        return Err(refuse("belongs on the command line, not in a configuration file".into()));
    }
    if !known.iter().any(|name| name == key) {
        return Err(refuse("there is no such option".into())
            .help("keys are the long options of `qparam unwrap --help`, without the dashes"));
    }
    let argument = match value {
        toml::Value::Boolean(true) => format!("--{key}"),
        toml::Value::Boolean(false) => return Ok(None),
        toml::Value::String(text) => format!("--{key}={text}"),
        toml::Value::Integer(number) => format!("--{key}={number}"),
        toml::Value::Float(number) => format!("--{key}={number}"),
        other => return Err(refuse(format!("a value of type {} is none for an option", other.type_str()))),
    };
    match Cli::command().try_get_matches_from(["qparam", "unwrap", "-", &argument]) {
        Ok(_) => Ok(Some(argument.into())),
        Err(error) => {
            let text = error.to_string();
            let first = text.lines().next().unwrap_or_default();
            Err(refuse(first.trim_start_matches("error: ").to_owned()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Environment, ParseFailure, Parsed, parse};
    use crate::args::{Command, UnwrapArgs};

    fn with_file(text: &str, arguments: &[&str]) -> Result<UnwrapArgs, String> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("qparam.toml"), text).unwrap();
        let environment = Environment { working_directory: folder.path().to_owned(), config_home: None };
        let line = [&["qparam", "unwrap", "in.obj"], arguments].concat();
        match parse(line.into_iter().map(Into::into).collect(), &environment) {
            Ok(Parsed { cli, .. }) => match cli.command {
                Command::Unwrap(unwrap) => Ok(unwrap),
                _ => unreachable!(),
            },
            Err(ParseFailure::Config(failure)) => Err(failure.message),
            Err(ParseFailure::Clap(error)) => Err(error.to_string()),
        }
    }

    #[test]
    fn the_command_line_wins_over_the_file_and_the_file_over_the_defaults() {
        let unwrap = with_file("q = 0.25\nexponent = 2\n", &["--q", "1"]).unwrap();
        assert_eq!((unwrap.q, unwrap.map.exponent), (1.0, 2.0));
    }

    /// Naming one of two exclusive options is no conflict with the other one in the file.
    #[test]
    fn rivals_on_the_command_line_silence_the_file() {
        let unwrap =
            with_file("remove-fraction = 0.1\njson = true", &["--remove-below=2", "--quiet"]).unwrap();
        assert_eq!((unwrap.map.remove_below, unwrap.json, unwrap.quiet), (Some(2.0), false, true));
    }

    /// A preset is a set of defaults: what is typed beside it wins, and what the file says gives way to a typed one.
    #[test]
    fn presets_set_what_nobody_else_sets() {
        let shape = |text: &str, arguments: &[&str]| {
            let unwrap = with_file(text, arguments).unwrap();
            (unwrap.q, unwrap.map.shape)
        };
        assert_eq!(shape("", &["--preset", "arap-like"]), (0.95, 1.0));
        assert_eq!(shape("", &["--preset=least-stretch", "--q=0.8"]), (0.8, 10.0));
        assert_eq!(shape("q = 0.25", &["--preset=least-stretch"]), (0.5, 10.0));
        assert_eq!(shape("preset = 'least-stretch'\nq = 0.25", &[]), (0.25, 10.0));
        assert_eq!(shape("preset = 'least-stretch'\nshape = 3", &["--preset=even-texels"]), (0.5, 0.5));
    }

    #[test]
    fn the_file_can_be_left_out() {
        assert_eq!(with_file("q = 0.25", &["--no-config"]).unwrap().q, 0.6);
    }

    #[test]
    fn wrong_entries_are_named() {
        for (text, expected) in [
            ("colour = 1", "`colour`: there is no such option"),
            ("q = 2", "`q`: invalid value '2' for '--q <0..1>': expected a number between 0 and 1"),
            ("method = [1]", "`method`: a value of type array"),
            ("output = 'x.obj'", "`output`: belongs on the command line"),
            ("q = ", "qparam.toml:1:5 is no valid TOML"),
            ("json = 3", "`json`: unexpected value '3' for '--json'"),
        ] {
            let message = with_file(text, &[]).unwrap_err();
            assert!(message.contains(expected), "{text}: {message}");
        }
    }
}
