//! Who takes part, and with which command.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

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
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Absent {
    pub(super) tool: String,
    /// And the way to have it.
    pub(super) why: String,
}

/// Words in the names of methods that hold the boundary on a circle.
const ON_A_CIRCLE: [&str; 9] = [
    "paper",
    "uniform",
    "harmonic",
    "mean-value",
    "tutte",
    "authalic",
    "cgal-conformal",
    "circle",
    "barycentric",
];
/// Tools that cut the surface into charts of their own.
const CUTS: [&str; 2] = ["xatlas", "uvunwrap"];

impl Contestant {
    /// What it does with the boundary: the rest leave it free.
    pub(super) fn boundary(&self) -> &'static str {
        let has = |words: &[&str]| words.iter().any(|word| self.name.contains(word));
        match () {
            () if has(&CUTS) => "own cuts",
            () if has(&ON_A_CIRCLE) => "circle",
            () => "free",
        }
    }

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
