//! `cargo xtask sweep [MESHES…]`: distortion against q, in the form of the paper's Table 1.
//!
//! Without meshes, every fixture that is a disk is swept; the tables and the curves of Table 1 go to `fixtures/tables/`, their short
//! form to `README.md`, the picture of the face and the head to `docs/figures/`, and `--check` compares all with what is there. Figures have four digits, so that machines that round
//! sums differently write the same tables.

mod curves;
mod files;
mod mesh_report;
pub(crate) mod printed;
mod reading;
mod search;
mod short;

use std::path::{Path, PathBuf};

use clap::Parser;
use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qmesh::obj::ObjDocument;
use qparam_cli::qoptimize::Options;
use qparam_cli::sweep::{Column, TABLE_1_Q};

use mesh_report::MeshReport;

use crate::arguments;
use crate::{figure, section};

/// Distortion against q for every method, in the form of the paper's Table 1.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask sweep")]
struct Arguments {
    /// Quad meshes (OBJ) that are disks; default: the disks of fixtures/
    meshes: Vec<PathBuf>,
    /// The values of q, in the order of the columns
    #[arg(long, value_delimiter = ',', default_values_t = TABLE_1_Q)]
    q: Vec<f64>,
    /// Compare with the committed tables instead of writing them
    #[arg(long, conflicts_with_all = ["meshes", "q", "output", "search"])]
    check: bool,
    /// Instead: try every reading of the paper's method on the face and the head, and rank them
    #[arg(long, conflicts_with_all = ["meshes", "q", "output"])]
    search: bool,
    /// Where the tables go [default: fixtures/tables; with meshes or --q: target/sweep]
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    arguments::parsed("cargo xtask sweep", arguments, sweep)
}

fn sweep(arguments: &Arguments) -> Result<(), String> {
    if let Some(q) = arguments.q.iter().find(|q| !(0.0..=1.0).contains(*q)) {
        return Err(format!("--q: {q} is not between 0 and 1"));
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")?;
    let fixtures = disks(&root.join("fixtures"))?;
    if arguments.search {
        let models = fixtures.into_iter().filter(|mesh| ["face", "head"].contains(&mesh.name.as_str()));
        let text = search::table(&models.collect::<Vec<_>>())?;
        return files::write(&root.join("fixtures/tables"), &[("search.md".to_owned(), text)]);
    }
    let chosen = !arguments.meshes.is_empty();
    let meshes = if chosen {
        arguments.meshes.iter().map(|path| load(path)).collect::<Result<Vec<_>, _>>()?
    } else {
        fixtures
    };
    let reports =
        meshes.iter().map(|mesh| MeshReport::new(mesh, &arguments.q)).collect::<Result<Vec<_>, _>>()?;
    let mut tables = Vec::new();
    for report in &reports {
        tables.push((format!("{}.md", report.name), report.markdown()));
        tables.push((format!("{}.csv", report.name), report.csv()));
    }
    let standard = !chosen && arguments.q == TABLE_1_Q && arguments.output.is_none();
    if standard {
        tables.push(("README.md".to_owned(), short::overview(&reports)));
        tables.push(("curves.svg".to_owned(), curves::picture(&reports)));
    }
    let folder = match &arguments.output {
        Some(folder) => folder.clone(),
        None if standard => root.join("fixtures/tables"),
        None => root.join("target/sweep"),
    };
    let readme = root.join("README.md");
    let short = short::table(&reports);
    if arguments.check {
        files::compare(&folder, &tables, &["search.md"])?;
        section::compare(&readme, "sweep", &short)?;
        return figure::check();
    }
    files::write(&folder, &tables)?;
    if standard {
        section::write(&readme, "sweep", &short)?;
        figure::write()?;
    }
    Ok(())
}

/// The reading of the paper's method that shows most of Table 1, and the direct method: names and options for a mesh.
pub(crate) fn best_and_direct(mesh: &QuadMesh) -> Result<[(String, Options); 2], String> {
    let find = |name: &str| {
        let contender = reading::contenders().into_iter().find(|contender| contender.name == name);
        contender.ok_or_else(|| format!("no method {name}"))?.way.options(mesh)
    };
    Ok([("paper".to_owned(), find("paper, best")?), ("direct".to_owned(), find("direct")?)])
}

/// A mesh and its file name without folder and ending.
pub(crate) struct Mesh {
    pub(crate) name: String,
    pub(crate) mesh: QuadMesh,
}

fn load(path: &Path) -> Result<Mesh, String> {
    let wrong = |what: String| format!("{}: {what}", path.display());
    let bytes = std::fs::read(path).map_err(|error| wrong(error.to_string()))?;
    let document = ObjDocument::parse(bytes).map_err(|error| wrong(error.to_string()))?;
    let mesh = QuadMesh::build(document.polygons()).map_err(|error| wrong(error.to_string()))?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Mesh { name, mesh })
}

/// Every disk in a folder; the face and the head first, as in Table 1, then by name.
pub(crate) fn disks(folder: &Path) -> Result<Vec<Mesh>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "obj"));
    let mut meshes = paths.iter().map(|path| load(path)).collect::<Result<Vec<_>, _>>()?;
    meshes.retain(|mesh| mesh.mesh.topology().is_disk());
    let rank = |name: &str| ["face", "head"].iter().position(|model| *model == name).unwrap_or(2);
    meshes.sort_by(|a, b| (rank(&a.name), &a.name).cmp(&(rank(&b.name), &b.name)));
    Ok(meshes)
}
