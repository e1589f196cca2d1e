//! Completions and manual pages, made from the arguments themselves.

use clap::CommandFactory;
use clap_complete::Shell;

use crate::args::Cli;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::streams::Streams;

pub(crate) fn completions(shell: Shell, streams: &mut Streams<'_>) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "qparam", &mut script);
    streams.say(&String::from_utf8_lossy(&script)).map(|()| Exit::Done)
}

pub(crate) fn man(command: Option<&str>, streams: &mut Streams<'_>) -> Result<Exit, Failure> {
    let mut root = Cli::command();
    root.build();
    let page = match command {
        None => root,
        Some(name) => root.find_subcommand(name).cloned().ok_or_else(|| {
            Failure::new(Exit::Usage, format!("there is no command `{name}`"))
                .help("`qparam --help` lists the commands")
        })?,
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page)
        .render(&mut text)
        .map_err(|error| Failure::new(Exit::Output, "the manual page could not be made").cause(&error))?;
    streams.say(&String::from_utf8_lossy(&text)).map(|()| Exit::Done)
}
