//! What can be said on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::exit;
pub(crate) use crate::unwrap_args::UnwrapArgs;

/// UV maps for quad meshes.
///
/// Reads a quad mesh (OBJ), computes a map of its surface to the plane without ever choosing a diagonal, and
/// writes the same file with UVs. What else the file holds stays as it is, byte for byte.
#[derive(Debug, Parser)]
#[command(name = "qparam", version, after_help = exit::TABLE, propagate_version = true, max_term_width = 110)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
#[allow(clippy::large_enum_variant, reason = "one value a process")]
pub(crate) enum Command {
    /// Compute UVs and write them into a copy of the file
    Unwrap(UnwrapArgs),
    /// Measure the UVs that files already have, side by side
    Measure(MeasureArgs),
    /// Say what a mesh is: counts, topology, what is odd
    Info(InfoArgs),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page (roff)
    Man {
        /// The page of this command; without it, the page of qparam itself
        command: Option<String>,
    },
}

/// Measure the UVs that files already have, whoever made them.
#[derive(Args, Debug)]
#[command(after_help = exit::TABLE)]
pub(crate) struct MeasureArgs {
    /// OBJ files with UVs; `-` is standard input
    #[arg(required = true, value_name = "UVED.obj")]
    pub(crate) files: Vec<PathBuf>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
    /// Exit with 7 when a file has flipped corners, folded faces or crossing boundaries
    #[arg(long)]
    pub(crate) check: bool,
}

/// Say what a mesh is: counts, topology, and what is odd about it. Works for meshes that `unwrap` refuses.
#[derive(Args, Debug)]
#[command(after_help = exit::TABLE)]
pub(crate) struct InfoArgs {
    /// An OBJ file; `-` is standard input
    #[arg(value_name = "IN.obj")]
    pub(crate) file: PathBuf,
    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}
