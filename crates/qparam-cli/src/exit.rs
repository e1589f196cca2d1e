//! Exit codes: one per class of failure, so that scripts need not read messages.

use serde::Serialize;

/// How a run ended. The number is the process's exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u8)]
pub enum Exit {
    /// Done; for `unwrap`, the map was written and is valid: no flips, no overlaps.
    Done = 0,
    /// The command line or the configuration file is wrong.
    Usage = 2,
    /// The input could not be read or parsed.
    Input = 3,
    /// The mesh is refused.
    Mesh = 4,
    /// The computation failed.
    Computation = 5,
    /// The output could not be written.
    Output = 6,
    /// UVs were written, but are not certified: flips or overlaps remain.
    Invalid = 7,
    /// The time limit ended the work: the best map so far was written, and is valid.
    TimeLimit = 8,
    /// The time limit was over before there was a map.
    OutOfTime = 9,
    /// Interrupted with ctrl-C.
    Interrupted = 130,
}

impl Exit {
    /// The process's exit code.
    #[must_use]
    pub fn code(self) -> u8 {
        self as u8
    }
}

/// The table of exit codes in `--help`.
pub(crate) const TABLE: &str = "\
Exit codes:
    0  done; for unwrap: the map is written and certified (no flips, no overlaps)
    2  wrong usage: an option, or the configuration file
    3  the input could not be read or parsed
    4  the mesh is refused; the message says why (with --strict: what would have to be mended)
    5  the computation failed
    6  the output could not be written
    7  UVs were written, but flips or overlaps remain (check, measure --check: were found)
    8  --time-limit ended the work: the best map so far is written and certified
    9  --time-limit was over before there was a map; nothing is written
  130  interrupted";

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::{Exit, TABLE};
    use crate::args::Cli;

    /// Whoever shows a table of exit codes shows this one.
    #[test]
    fn every_help_has_this_table() {
        for command in Cli::command().get_subcommands_mut() {
            for help in [command.render_help(), command.render_long_help()] {
                let text = help.to_string();
                assert!(text.contains(TABLE) || !text.contains("Exit codes"), "{text}");
            }
        }
        let unwrap =
            Cli::command().find_subcommand_mut("unwrap").map(|unwrap| unwrap.render_long_help().to_string());
        assert!(unwrap.is_some_and(|text| text.contains(TABLE) && text.contains("Configuration file")));
    }

    /// `--help` names every code there is.
    #[test]
    fn the_table_is_complete() {
        use Exit::{
            Computation, Done, Input, Interrupted, Invalid, Mesh, OutOfTime, Output, TimeLimit, Usage,
        };
        let others = [TimeLimit, OutOfTime, Interrupted];
        for exit in [Done, Usage, Input, Mesh, Computation, Output, Invalid].into_iter().chain(others) {
            let start = format!("{:>5}  ", exit.code());
            assert!(TABLE.lines().any(|line| line.starts_with(&start)), "{exit:?} is missing");
        }
    }
}
