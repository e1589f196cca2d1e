//! Who takes part, and with which command.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::Serialize;

/// One method of one tool.
#[derive(Clone, Debug)]
pub(super) struct Contestant {
    /// As in the table.
    pub(super) name: String,
    /// Whether it is a method of `qparam`.
    pub(super) ours: bool,
    /// How quads reach it.
    pub(super) input: &'static str,
    /// What runs, before the arguments that depend on the mesh.
    pub(super) program: PathBuf,
    /// Its first arguments.
    pub(super) leading: Vec<OsString>,
}

/// A tool that is not installed.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Absent {
    pub(super) tool: String,
    /// And the way to have it.
    pub(super) why: String,
}

impl Contestant {
    /// The command that reads `mesh` and writes `output`; rivals also write a `report` with the time of the solve.
    pub(super) fn command(&self, mesh: &Path, output: &Path, report: &Path) -> Vec<OsString> {
        let mut command = vec![self.program.clone().into_os_string()];
        command.extend(self.leading.iter().cloned());
        if self.ours {
            command.extend([mesh.into(), "--output".into(), output.into()]);
        } else {
            command.extend([mesh, output, report].map(OsString::from));
        }
        command
    }
}
