//! The `qparam` command: connects the process to the library.

use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use anstream::{AutoStream, ColorChoice};
use qparam_cli::{Environment, Exit, INTERRUPTED, Interrupt, Streams, run};

/// How long work has to stop by itself, and to say so itself.
const PATIENCE: Duration = Duration::from_millis(40);

static INTERRUPT: Interrupt = Interrupt::new();

fn main() -> ExitCode {
    // Without a handler ctrl-C still ends the process, only less politely.
    let _ = ctrlc::set_handler(|| {
        let exit = || std::process::exit(i32::from(Exit::Interrupted.code()));
        if INTERRUPT.request() {
            exit();
        }
        // Work looks between its steps, which take seconds on large meshes.
        std::thread::sleep(PATIENCE);
        if INTERRUPT.end_what_is_observed() {
            let _ = writeln!(io::stderr(), "error: {INTERRUPTED}");
            exit();
        }
    });
    let mut streams = Streams {
        stdout_color: AutoStream::choice(&io::stdout()) != ColorChoice::Never,
        stderr_color: AutoStream::choice(&io::stderr()) != ColorChoice::Never,
        stderr_is_terminal: io::stderr().is_terminal(),
        stdin: &mut io::stdin(),
        stdout: &mut io::stdout(),
        stderr: &mut io::stderr(),
        interrupt: &INTERRUPT,
    };
    ExitCode::from(run(std::env::args_os(), &environment(), &mut streams).code())
}

fn environment() -> Environment {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    Environment {
        working_directory: std::env::current_dir().unwrap_or_default(),
        config_home: variable("XDG_CONFIG_HOME")
            .or_else(|| variable("HOME").map(|home| home.join(".config")))
            .or_else(|| variable("APPDATA")),
    }
}
