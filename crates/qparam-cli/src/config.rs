//! Defaults for `unwrap` and `sweep` from a file, and the command line that results.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, CommandFactory, FromArgMatches, ValueEnum};

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

/// The commands that make maps, whose options are the keys of the file.
const MAPPING: [&str; 2] = ["unwrap", "sweep"];
/// Options that `sweep` has, too, but that mean something else there: several values, and one report of many.
const OTHER_IN_SWEEP: [&str; 2] = ["q", "json"];
/// Options about one run, not about habits.
const NOT_IN_FILES: &[&str] = &[
    "output",
    "simplified",
    "pin",
    "pins",
    "report",
    "report-q",
    "csv",
    "config",
    "no-config",
    "help",
    "version",
];

/// A command that reads the file, with what was typed for it.
struct Reader<'a> {
    command: Command,
    matches: &'a ArgMatches,
    /// The long names of the options that the caller typed.
    typed: Vec<String>,
}

impl<'a> Reader<'a> {
    fn new(name: &str, matches: &'a ArgMatches) -> Option<Self> {
        let command = subcommand(name).filter(|_| MAPPING.contains(&name))?;
        let is_typed = |arg: &&Arg| {
            let id = arg.get_id().as_str();
            matches.try_contains_id(id).is_ok() && matches.value_source(id) == Some(ValueSource::CommandLine)
        };
        let typed = command.get_arguments().filter(is_typed).filter_map(Arg::get_long);
        let typed = typed.map(str::to_owned).collect();
        Some(Self { command, matches, typed })
    }

    fn option(&self, name: &str) -> Option<&Arg> {
        option(&self.command, name)
    }

    /// Whether the command has this option, with the meaning that it has in the file.
    fn reads(&self, name: &str) -> bool {
        let is_other = self.command.get_name() == "sweep" && OTHER_IN_SWEEP.contains(&name);
        self.option(name).is_some() && !is_other
    }

    /// Whether something typed says the same, or excludes it.
    fn silences(&self, name: &str) -> bool {
        let excludes = |a: &Arg, b: &Arg| self.command.get_arg_conflicts_with(a).contains(&b);
        let Some(option) = self.option(name) else { return false };
        let mut typed = self.typed.iter().filter_map(|name| self.option(name));
        typed.any(|typed| typed == option || excludes(typed, option) || excludes(option, typed))
    }
}

fn subcommand(name: &str) -> Option<Command> {
    Cli::command().find_subcommand(name).cloned()
}

fn option<'a>(command: &'a Command, name: &str) -> Option<&'a Arg> {
    command.get_arguments().find(|arg| arg.get_long() == Some(name))
}

/// Parses the command line, with defaults from a configuration file.
pub(crate) fn parse(mut arguments: Vec<OsString>, environment: &Environment) -> Result<Parsed, ParseFailure> {
    let matches = Cli::command().try_get_matches_from(&arguments)?;
    let reader = matches.subcommand().and_then(|(name, matches)| Reader::new(name, matches));
    if let Some(reader) = &reader {
        let mut defaults = defaults(reader, environment).map_err(ParseFailure::Config)?;
        apply_preset(reader, &mut defaults);
        // The subcommand comes second: nothing may stand before it but the program.
        arguments.splice(2..2, defaults.into_iter().map(|(_, argument)| argument));
    }
    let typed = reader.map(|reader| reader.typed).unwrap_or_default();
    let matches = Cli::command().try_get_matches_from(&arguments)?;
    Ok(Parsed { cli: Cli::from_arg_matches(&matches)?, typed })
}

/// What `--preset` stands for, as far as it is not said otherwise. Typed, it silences the file; in the file, whatever else
/// the file says comes first.
fn apply_preset(reader: &Reader<'_>, defaults: &mut Vec<(String, OsString)>) {
    let in_file = defaults.iter().find(|(key, _)| key == "preset");
    let in_file = in_file.and_then(|(_, argument)| argument.to_str()?.strip_prefix("--preset="));
    let typed_preset = reader.matches.get_one::<PresetChoice>("preset").copied();
    let Some(choice) = typed_preset.or_else(|| PresetChoice::from_str(in_file?, false).ok()) else { return };
    let settings = choice.arguments();
    if typed_preset.is_some() {
        defaults.retain(|(key, _)| !settings.iter().any(|(name, _)| name == key));
    }
    for (name, value) in settings {
        let is_said = reader.silences(name) || defaults.iter().any(|(key, _)| key == name);
        if !is_said && reader.reads(name) {
            defaults.push((name.to_owned(), format!("--{name}={value}").into()));
        }
    }
}

fn defaults(reader: &Reader<'_>, environment: &Environment) -> Result<Vec<(String, OsString)>, Failure> {
    if reader.matches.get_flag("no_config") {
        return Ok(Vec::new());
    }
    let (path, text) = match reader.matches.get_one::<PathBuf>("config") {
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
    let mut arguments = Vec::new();
    for (key, value) in &table {
        let argument = argument(key, value, &path)?;
        if reader.reads(key) && !reader.silences(key) {
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
fn argument(key: &str, value: &toml::Value, path: &Path) -> Result<Option<OsString>, Failure> {
    let refuse = |why: String| Failure::new(Exit::Usage, format!("{}: `{key}`: {why}", path.display()));
    if NOT_IN_FILES.contains(&key) {
        return Err(refuse("belongs on the command line, not in a configuration file".into()));
    }
    let Some(command) =
        MAPPING.into_iter().find(|name| subcommand(name).is_some_and(|c| option(&c, key).is_some()))
    else {
        return Err(refuse("there is no such option".into())
            .help("keys are the long options of `qparam unwrap --help`, without the dashes"));
    };
    let argument = match value {
        toml::Value::Boolean(true) => format!("--{key}"),
        toml::Value::Boolean(false) => return Ok(None),
        toml::Value::String(text) => format!("--{key}={text}"),
        toml::Value::Integer(number) => format!("--{key}={number}"),
        toml::Value::Float(number) => format!("--{key}={number}"),
        other => return Err(refuse(format!("a value of type {} is none for an option", other.type_str()))),
    };
    match Cli::command().try_get_matches_from(["qparam", command, "-", &argument]) {
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
    use super::{Environment, MAPPING, NOT_IN_FILES, ParseFailure, Parsed, parse, subcommand};
    use crate::args::{Cli, Command, UnwrapArgs};

    fn with_file(text: &str, arguments: &[&str]) -> Result<UnwrapArgs, String> {
        match parsed(text, &[&["unwrap", "in.obj"], arguments].concat())?.command {
            Command::Unwrap(unwrap) => Ok(unwrap),
            _ => unreachable!(),
        }
    }

    fn parsed(text: &str, arguments: &[&str]) -> Result<Cli, String> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("qparam.toml"), text).unwrap();
        let environment = Environment { working_directory: folder.path().to_owned(), config_home: None };
        let line = [&["qparam"], arguments].concat();
        match parse(line.into_iter().map(Into::into).collect(), &environment) {
            Ok(Parsed { cli, .. }) => Ok(cli),
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

    /// Every option with a value that it takes, but for those that files may not have: name, value, and whether it is typed without one.
    fn all_options() -> Vec<(String, String, bool)> {
        let unwrap = subcommand("unwrap").unwrap();
        let options = unwrap
            .get_arguments()
            .filter(|arg| arg.get_long().is_some_and(|name| !NOT_IN_FILES.contains(&name)));
        options
            .map(|arg| {
                let name = arg.get_long().unwrap().to_owned();
                let named = arg.get_possible_values().first().map(|value| value.get_name().to_owned());
                let default =
                    arg.get_default_values().first().map(|value| value.to_str().unwrap().to_owned());
                let is_flag = !arg.get_action().takes_values();
                (name, named.or(default).unwrap_or_else(|| "2".to_owned()), is_flag)
            })
            .collect()
    }

    fn entry((name, value, is_flag): &(String, String, bool)) -> String {
        if *is_flag { format!("{name} = true") } else { format!("{name} = \"{value}\"") }
    }

    fn typed((name, value, is_flag): &(String, String, bool)) -> String {
        if *is_flag { format!("--{name}") } else { format!("--{name}={value}") }
    }

    /// What one command has no option for says nothing to it; what no command has an option for is an error to all.
    #[test]
    fn every_key_is_read_by_every_command_that_makes_maps() {
        let options = all_options();
        assert!(options.len() > 40, "{options:?}");
        for command in MAPPING {
            for option in &options {
                let text = entry(option);
                assert!(
                    parsed(&text, &[command, "in.obj"]).is_ok(),
                    "{command}, {text}: {:?}",
                    parsed(&text, &[command, "in.obj"])
                );
            }
            assert!(parsed("colour = 1", &[command, "in.obj"]).is_err());
        }
    }

    /// Whatever is typed, no line of the file contradicts it.
    #[test]
    fn no_key_conflicts_with_what_is_typed() {
        let mut options = all_options();
        for one_run in ["pin=1=0,0", "pins=FILE", "report=PAGE.html"] {
            let (name, value) = one_run.split_once('=').unwrap();
            options.push((name.to_owned(), value.to_owned(), false));
        }
        for option in &options {
            for other in all_options() {
                let text = entry(&other);
                let typed = typed(option);
                let found = with_file(&text, &[&typed]);
                assert!(found.is_ok(), "{typed} with {text}: {:?}", found.err());
            }
        }
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
            ("csv = 'x.csv'", "`csv`: belongs on the command line"),
            ("q = ", "qparam.toml:1:5 is no valid TOML"),
            ("json = 3", "`json`: unexpected value '3' for '--json'"),
        ] {
            let message = with_file(text, &[]).unwrap_err();
            assert!(message.contains(expected), "{text}: {message}");
        }
    }
}
