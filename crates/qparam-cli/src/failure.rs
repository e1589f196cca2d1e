//! One failure, one message: what, where, the chain of causes, and the way out.

use std::error::Error;
use std::fmt::Write as _;

use anstyle::{AnsiColor, Style};
use serde::Serialize;

use crate::exit::Exit;

const ERROR: Style = AnsiColor::Red.on_default().bold();
const HELP: Style = AnsiColor::Cyan.on_default();

/// What an interruption left behind: nothing.
pub const INTERRUPTED: &str = "interrupted: nothing was written";

/// Why a command ended early.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failure {
    /// The class, which is the exit code.
    pub class: Exit,
    /// What failed and where.
    pub message: String,
    /// What lay beneath, outermost first.
    pub causes: Vec<String>,
    /// The way out.
    pub help: Option<String>,
}

impl Failure {
    pub(crate) fn new(class: Exit, message: impl Into<String>) -> Self {
        Self { class, message: message.into(), causes: Vec::new(), help: None }
    }

    /// Adds the way out.
    #[must_use]
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds `error` and everything beneath it to the causes.
    #[must_use]
    pub(crate) fn cause(mut self, error: &(dyn Error + 'static)) -> Self {
        let mut current = Some(error);
        while let Some(error) = current {
            let text = error.to_string();
            // `#[error(transparent)]` repeats the text of its source.
            if self.causes.last() != Some(&text) {
                self.causes.push(text);
            }
            current = error.source();
        }
        self
    }

    /// Adds a line beneath the message.
    #[must_use]
    pub(crate) fn note(mut self, note: impl Into<String>) -> Self {
        self.causes.push(note.into());
        self
    }

    /// What is wrong with the command line: the first paragraph of clap's complaint.
    pub(crate) fn usage(error: &clap::Error) -> Self {
        let text = error.render().to_string();
        let paragraph = text.split("\n\n").next().unwrap_or_default();
        let mut lines = paragraph.lines().map(str::trim);
        let message = lines.next().unwrap_or_default().trim_start_matches("error: ");
        let mut failure = Self::new(Exit::Usage, message);
        failure.causes.extend(lines.map(str::to_owned));
        failure.help("`--help` lists the options")
    }

    pub(crate) fn interrupted() -> Self {
        Self::new(Exit::Interrupted, INTERRUPTED)
    }

    /// The message for people, with a newline at its end.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let paint = |style: Style, text: &str| {
            if color { format!("{style}{text}{style:#}") } else { text.to_owned() }
        };
        let mut text = format!("{} {}\n", paint(ERROR, "error:"), self.message);
        for cause in &self.causes {
            let _ = writeln!(text, "  {cause}");
        }
        if let Some(help) = &self.help {
            let _ = writeln!(text, "  {} {help}", paint(HELP, "help:"));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{Exit, Failure};

    #[test]
    fn chain_and_way_out_are_shown() {
        let io = std::io::Error::other("disk on fire");
        let failure = Failure::new(Exit::Output, "out.obj could not be written").cause(&io).help("use water");
        insta::assert_snapshot!(failure.render(false), @r"
        error: out.obj could not be written
          disk on fire
          help: use water
        ");
    }
}
