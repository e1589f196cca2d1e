//! What can be said on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::exit;
pub(crate) use crate::picture_args::{LayoutArgs, RenderArgs};
pub(crate) use crate::unwrap_args::{MapArgs, UnwrapArgs, unit};

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
    /// Map one mesh with several q: the trade-off between angles and areas, and its knee
    ///
    /// The table has the form of the paper's Table 1, with the sum of both errors, flips and symmetric Dirichlet. No UVs
    /// are written. q moves the methods that mix angle-true and area-true weights; for the others all columns are alike.
    /// The knee is the map that lies farthest below the chord of the trade-off, on logarithmic scales from end to end.
    Sweep(SweepArgs),
    /// Measure the UVs that files already have, side by side
    Measure(MeasureArgs),
    /// Prove that the UVs of files overlap nowhere, or name every place where they do
    ///
    /// Whoever made the UVs: several islands, holes and seams, triangles, quads and polygons. Everything is decided exactly, on the
    /// coordinates as written in the file. A map is certified when every corner of a triangle or quad turns left, every other polygon
    /// is simple, boundaries neither cross nor touch each other, and no island lies on another's material; mirrored islands are
    /// not. Quads that no map can make convex, because they share their opposite vertices, are held to two corners.
    Check(CheckArgs),
    /// Say what a mesh is: counts, topology, what is odd
    Info(InfoArgs),
    /// Draw a mesh in space with its UVs: checkerboard, heat maps, islands, materials (PNG)
    Render(RenderArgs),
    /// Draw the map itself, flat: islands, seams in pairs, heat maps, texels (SVG or PNG)
    Layout(LayoutArgs),
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

/// Map one mesh with several q.
#[derive(Args, Clone, Debug)]
#[command(after_help = exit::TABLE)]
pub(crate) struct SweepArgs {
    /// The quad mesh, an OBJ file; `-` is standard input
    #[arg(value_name = "MESH.obj")]
    pub(crate) input: PathBuf,
    /// Also write the figures as CSV, one line a q, in full precision; `-` is standard output (the table then goes
    /// to standard error)
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub(crate) csv: Option<PathBuf>,
    /// The values of q, in the order of the columns
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1,0.8,0.5,0.2,0", value_parser = unit,
        allow_negative_numbers = true,
        help_heading = "Method")]
    pub(crate) q: Vec<f64>,
    #[command(flatten)]
    pub(crate) map: MapArgs,

    /// Print the report as JSON
    #[arg(long, help_heading = "Report")]
    pub(crate) json: bool,
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
    /// Exit with 7 when the UVs of a file are not certified: flips, overlaps, contacts (`check` names the places)
    #[arg(long)]
    pub(crate) check: bool,
}

/// Prove that the UVs of files overlap nowhere.
#[derive(Args, Debug)]
#[command(after_help = exit::TABLE)]
pub(crate) struct CheckArgs {
    /// OBJ files with UVs; `-` is standard input
    #[arg(required = true, value_name = "UVED.obj")]
    pub(crate) files: Vec<PathBuf>,
    /// Name at most this many violations of each kind; all are counted
    #[arg(long, value_name = "N", default_value = "20", allow_negative_numbers = true)]
    pub(crate) limit: usize,
    /// Print JSON instead of text
    #[arg(long)]
    pub(crate) json: bool,
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
