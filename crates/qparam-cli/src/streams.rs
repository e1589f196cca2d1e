//! Where the command reads and prints: given by the caller, so that tests need no process.

use std::io::{self, Read, Write};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt::Interrupt;

/// Standard streams and what is known about them.
pub struct Streams<'a> {
    /// Standard input.
    pub stdin: &'a mut dyn Read,
    /// Standard output: reports, or the mesh with `-o -`.
    pub stdout: &'a mut dyn Write,
    /// Standard error: messages and progress.
    pub stderr: &'a mut dyn Write,
    /// Whether reports on standard output may be coloured.
    pub stdout_color: bool,
    /// Whether messages may be coloured.
    pub stderr_color: bool,
    /// Whether a progress bar makes sense.
    pub stderr_is_terminal: bool,
    /// The request to stop.
    pub interrupt: &'a Interrupt,
}

impl Streams<'_> {
    /// Prints a report. A reader that went away (`| head`) has seen enough: that is no failure.
    pub(crate) fn say(&mut self, text: &str) -> Result<(), Failure> {
        match self.stdout.write_all(text.as_bytes()).and_then(|()| self.stdout.flush()) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                Err(Failure::new(Exit::Output, "standard output could not be written").cause(&error))
            }
            _ => Ok(()),
        }
    }

    /// Prints a message. Without standard error there is nobody left to tell.
    pub(crate) fn say_err(&mut self, text: &str) {
        let _ = self.stderr.write_all(text.as_bytes()).and_then(|()| self.stderr.flush());
    }

    /// Prints a report, to standard error when standard output is taken (`aside`).
    pub(crate) fn report(&mut self, aside: bool, text: &str) -> Result<(), Failure> {
        if aside {
            self.say_err(text);
            return Ok(());
        }
        self.say(text)
    }
}
