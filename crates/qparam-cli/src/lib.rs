//! The `qparam` command line: arguments, files, progress, reports. The only crate that prints.
//!
//! Everything that the binary does happens in [`run`], with streams that the caller gives, so that tests and
//! other programs can run commands without a process:
//!
//! ```
//! use qparam_cli::{Environment, Exit, Interrupt, Streams, run};
//!
//! let (mut output, mut messages) = (Vec::new(), Vec::new());
//! let mut streams = Streams {
//!     stdin: &mut "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n".as_bytes(),
//!     stdout: &mut output,
//!     stderr: &mut messages,
//!     stdout_color: false,
//!     stderr_color: false,
//!     stderr_is_terminal: false,
//!     interrupt: &Interrupt::new(),
//! };
//! let exit = run(["qparam", "info", "-"].map(Into::into), &Environment::default(), &mut streams);
//! assert_eq!(exit, Exit::Done);
//! assert!(String::from_utf8_lossy(&output).contains("a disk"));
//! ```
//!
//! Guaranteed: a file is replaced as a whole or not at all; every failure has one message and one documented exit
//! code; the UVs are the same for any number of threads. Not guaranteed: the wording of messages and tables.
//! Programs read the JSON reports, whose fields change only with [`SCHEMA_VERSION`].

mod exit;
mod failure;
mod interrupt;
mod streams;

mod args;
mod choices;
mod config;
mod layout_args;
mod unwrap_args;
mod worst;

mod boundary;
mod disk;
mod input;
mod output;
mod seams;
mod translate;

mod check;
mod info;
mod layout_command;
mod measure;
mod orientation;
mod page_report;
pub mod picture;
mod picture_args;
mod render_command;
pub mod sweep;
mod sweep_command;
mod threads;
mod unwrap;

mod islands;
mod keep;
mod pages;
mod pins;
mod progress;
mod report;
mod table;

use std::ffi::OsString;

use serde::Serialize;

pub use config::Environment;
pub use exit::Exit;
pub use failure::{Failure, INTERRUPTED};
pub use interrupt::Interrupt;
pub use qoptimize::{self, qcurv, qembed, qmesh, qsimplify, qsolve};
pub use report::SCHEMA_VERSION;
pub use streams::Streams;

use args::{CheckArgs, Command, InfoArgs, MeasureArgs, SweepArgs, UnwrapArgs};
use config::{ParseFailure, Parsed};

/// Runs a command line; its first word is the program's name.
pub fn run(
    arguments: impl IntoIterator<Item = OsString>,
    environment: &Environment,
    streams: &mut Streams<'_>,
) -> Exit {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let json = wants_json(&arguments);
    let Parsed { cli, typed } = match config::parse(arguments, environment) {
        Ok(parsed) => parsed,
        Err(ParseFailure::Clap(error)) => return clap_says(&error, json, streams),
        Err(ParseFailure::Config(failure)) => return fail(&failure, json, streams),
    };
    let (result, json) = match cli.command {
        Command::Unwrap(arguments) => {
            let UnwrapArgs { json, .. } = arguments;
            (unwrap::run(&arguments, &typed, streams), json.then_some("unwrap"))
        }
        Command::Sweep(arguments) => {
            let SweepArgs { json, .. } = arguments;
            (sweep_command::run(&arguments, streams), json.then_some("sweep"))
        }
        Command::Measure(arguments) => {
            let MeasureArgs { json, .. } = arguments;
            (measure::run(&arguments, streams), json.then_some("measure"))
        }
        Command::Check(arguments) => {
            let CheckArgs { json, .. } = arguments;
            (check::run(&arguments, streams), json.then_some("check"))
        }
        Command::Info(arguments) => {
            let InfoArgs { json, .. } = arguments;
            (info::run(&arguments, streams), json.then_some("info"))
        }
        Command::Render(arguments) => (render_command::run(&arguments, streams), None),
        Command::Layout(arguments) => (layout_command::run(&arguments, streams), None),
        Command::Completions { shell } => (pages::completions(shell, streams), None),
        Command::Man { command } => (pages::man(command.as_deref(), streams), None),
    };
    result.unwrap_or_else(|failure| fail(&failure, json, streams))
}

/// The command that was asked for a report as JSON, on a command line that may be wrong otherwise.
fn wants_json(arguments: &[OsString]) -> Option<&'static str> {
    let name = arguments.get(1)?;
    let command =
        ["unwrap", "sweep", "measure", "check", "info"].into_iter().find(|command| name == command)?;
    let mut options = arguments.iter().take_while(|argument| *argument != "--");
    options.any(|argument| argument == "--json").then_some(command)
}

/// Help and version go to standard output, complaints to standard error.
fn clap_says(error: &clap::Error, json: Option<&'static str>, streams: &mut Streams<'_>) -> Exit {
    let show = |color: bool| {
        let text = error.render();
        if color { text.ansi().to_string() } else { text.to_string() }
    };
    if error.use_stderr() {
        if let Some(command) = json {
            let _ = streams.say(&failure_json(&Failure::usage(error), command));
        }
        let text = show(streams.stderr_color);
        streams.say_err(&text);
        return Exit::Usage;
    }
    let text = show(streams.stdout_color);
    streams.say(&text).map_or_else(|failure| fail(&failure, None, streams), |()| Exit::Done)
}

/// The message for people; for a caller who asked for JSON, the same there.
fn fail(failure: &Failure, json: Option<&'static str>, streams: &mut Streams<'_>) -> Exit {
    if let Some(command) = json {
        // When standard output is what failed, the message below remains.
        let _ = streams.say(&failure_json(failure, command));
    }
    let text = failure.render(streams.stderr_color);
    streams.say_err(&text);
    failure.class
}

fn failure_json(failure: &Failure, command: &'static str) -> String {
    #[derive(Serialize)]
    struct Report<'a> {
        #[serde(flatten)]
        head: report::Head,
        exit_code: u8,
        error: &'a Failure,
    }
    json_text(&Report { head: report::Head::new(command), exit_code: failure.class.code(), error: failure })
}

/// Indented JSON with a newline; numbers that are not finite become `null`.
fn json_text(report: &impl Serialize) -> String {
    serde_json::to_string_pretty(report)
        .map_or_else(|error| format!("{{\"error\": \"{error}\"}}\n"), |text| text + "\n")
}

/// The README's example is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
