//! `cargo xtask meshes`: every real mesh in the folder `QPARAM_MESHES` through `qparam unwrap`, and its seams beside those of others.
//!
//! The rivals are those of `cargo xtask compare`, whose interpreter `--python` names; without it their rows say so. Where a file
//! has UVs of its own, these are measured too, and mapped anew on their own seams.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use qparam_cli::qcurv::surface_area;
use qparam_cli::qmesh::charts::cut;
use qparam_cli::qmesh::obj::{ObjDocument, ObjError};
use qparam_cli::qmesh::{CornerId, QuadMesh, Seams, Vec2};
use qparam_cli::qoptimize::{atlas, certify, measure};
use qparam_cli::{Environment, Exit, Interrupt, Streams};
use serde_json::Value;

use crate::section;

/// Where the tables go, in the workspace.
pub(crate) const FILE: &str = "docs/tables/meshes.md";
/// Meshes whose seams are compared: closed, or with seams that an artist made.
const COMPARED: &[&str] = &["spot", "bob_cc2", "wingnut_6k", "teapot_fancy", "garment_casualsuit"];
/// Meshes of more faces are not cut further: each cut is several maps.
const SMALL: usize = 7000;
const RIVALS: &[&str] = &["xatlas", "blender-smart"];

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let python = match arguments {
        [] => None,
        [flag, program] if flag == "--python" => Some(PathBuf::from(program)),
        _ => return Err("the only argument is --python PROGRAM".to_owned()),
    };
    let folder = std::env::var_os("QPARAM_MESHES").ok_or("QPARAM_MESHES names no folder of meshes")?;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    let work = root.join("target/meshes");
    fs::create_dir_all(&work).map_err(|error| error.to_string())?;
    let mut meshes: Vec<PathBuf> = fs::read_dir(&folder)
        .and_then(|entries| entries.map(|entry| Ok(entry?.path())).collect())
        .map_err(|error| format!("QPARAM_MESHES: {error}"))?;
    meshes.retain(|path| path.extension().is_some_and(|extension| extension == "obj"));
    meshes.sort();
    let mut text = String::from(HEAD);
    for mesh in &meshes {
        let row = unwrapped_row(mesh, &work)?;
        eprint!("{row}");
        text += &row;
    }
    text += SEAMS;
    for mesh in meshes.iter().filter(|mesh| COMPARED.contains(&name(mesh))) {
        let rows = seam_rows(mesh, &work, python.as_deref(), root)?;
        eprint!("{rows}");
        text += &rows;
    }
    section::write(&root.join(FILE), "meshes", &text)
}

const HEAD: &str = "
# Real meshes

Each file through `qparam unwrap FILE.obj` with no other options. Files, their sources and licences are in
the folder that `QPARAM_MESHES` names. (13) and (14) are the angle and area errors of the paper, SD the area-weighted mean symmetric
Dirichlet energy (1 for an isometry), *stretch* what 99 % of the area of the worst island stays below. Seconds are wall time on two
cores, with whatever else ran there.

| file | faces | islands | seam edges | seam length | exit | certificate | (13) | (14) | SD | stretch | seconds |
|---|---:|---:|---:|---:|---:|---|---:|---:|---:|---:|---:|
";

const SEAMS: &str = "
# Seams

Who cuts how much for how little stretch. Lengths in space, as a multiple of the square root of the surface's area; *islands* that hang
together in the plane. *On its own seams* is the file's seams mapped by `qparam unwrap --seams uv`; *own UVs* are those in the file as
they are. xatlas gets fans of triangles, Blender (smart UV project, 66°) quads. Stretch and SD are of each island at its own scale, and then the
mean over islands by area; *faults* are what the certificate finds. Others stretch less, where they do, by cutting into dozens of islands with
several times the seams; `--max-stretch` makes that trade in one island.

| mesh | by | islands | seam edges | seam length | stretch, 99 % | SD | faults |
|---|---|---:|---:|---:|---:|---:|---|
";

fn name(mesh: &Path) -> &str {
    mesh.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default()
}

/// `qparam unwrap` in this process: its exit code and its report.
pub(crate) fn unwrap(mesh: &Path, output: &Path, more: &[&str]) -> Result<(Exit, Value), String> {
    let (mut report, mut messages) = (Vec::new(), Vec::new());
    let mut streams = Streams {
        stdin: &mut std::io::empty(),
        stdout: &mut report,
        stderr: &mut messages,
        stdout_color: false,
        stderr_color: false,
        stderr_is_terminal: false,
        interrupt: &Interrupt::new(),
    };
    let (mesh, output) = (mesh.display().to_string(), output.display().to_string());
    let arguments = ["qparam", "unwrap", &mesh, "-o", &output, "--json", "--no-config"];
    let arguments = arguments.iter().chain(more).map(|&argument| argument.into());
    let exit = qparam_cli::run(arguments, &Environment::default(), &mut streams);
    let report = serde_json::from_slice(&report)
        .map_err(|error| format!("{mesh}: {error}: {}", String::from_utf8_lossy(&messages)))?;
    Ok((exit, report))
}

fn unwrapped_row(mesh: &Path, work: &Path) -> Result<String, String> {
    let (exit, report) = unwrap(mesh, &work.join(format!("{}.obj", name(mesh))), &[])?;
    let islands = report["islands"].as_array().map_or(&[][..], |islands| islands);
    let stretch = islands.iter().filter_map(|island| island["stretch"].as_f64()).fold(0.0, f64::max);
    let found = &report["distortion"];
    let number = |value: &Value| value.as_f64().map_or_else(|| "–".to_owned(), digits);
    Ok(format!(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1} |\n",
        name(mesh),
        report["input"]["faces"],
        islands.len(),
        report["seams"]["edges"],
        number(&report["seams"]["length"]),
        exit.code(),
        if report["valid"] == true { "holds" } else { "fails" },
        number(&found["angle_error"]),
        number(&found["area_error"]),
        number(&found["symmetric_dirichlet"]),
        digits(stretch),
        report["timings_seconds"]["total"].as_f64().unwrap_or_default()
    ))
}

pub(crate) fn digits(x: f64) -> String {
    let x = x + 0.0;
    if x != 0.0 && !(0.01..1e4).contains(&x.abs()) { format!("{x:.2e}") } else { format!("{x:.3}") }
}

fn seam_rows(mesh: &Path, work: &Path, python: Option<&Path>, root: &Path) -> Result<String, String> {
    let mut rows = String::new();
    let document = document(mesh).map_err(|error| error.to_string())?;
    let mut put = |by: &str, file: &Path| -> Result<(), String> {
        let row = measured(file)?;
        // Writing to a string does not fail.
        let _ = writeln!(rows, "| {} | {by} | {row} |", name(mesh));
        Ok(())
    };
    let ours = work.join(format!("{}.obj", name(mesh)));
    put("qparam", &ours)?;
    if document.face_count() <= SMALL {
        let more = work.join(format!("{}_cuts.obj", name(mesh)));
        unwrap(mesh, &more, &["--max-stretch", "1.5"])?;
        put("qparam --max-stretch 1.5", &more)?;
    }
    if document.corner_uv().is_some() {
        let own = work.join(format!("{}_own.obj", name(mesh)));
        unwrap(mesh, &own, &["--seams", "uv"])?;
        put("qparam on its own seams", &own)?;
        put("own UVs", mesh)?;
    }
    for rival in RIVALS {
        let file = work.join(format!("{}_{rival}.obj", name(mesh)));
        let Some(python) = python else {
            let _ = writeln!(rows, "| {} | {rival} | | | | | | not run |", name(mesh));
            continue;
        };
        let mut command = Command::new(python);
        command.arg(root.join("xtask/compare/rival.py")).arg(rival).args([mesh, &file]);
        let status = command.arg(work.join("report.json")).status().map_err(|error| error.to_string())?;
        let mut put = |by: &str, file: &Path| -> Result<(), String> {
            let row = if status.success() { measured(file)? } else { " | | | | | failed".to_owned() };
            let _ = writeln!(rows, "| {} | {by} | {row} |", name(mesh));
            Ok(())
        };
        put(rival, &file)?;
    }
    Ok(rows)
}

/// What a file holds.
pub(crate) fn document(path: &Path) -> Result<ObjDocument, ObjError> {
    ObjDocument::read(fs::File::open(path)?)
}

/// Islands, seam edges and length, stretch, SD, and faults of the UVs of a file.
fn measured(file: &Path) -> Result<String, String> {
    let fail = |error: String| format!("{}: {error}", file.display());
    let document = document(file).map_err(|error| fail(error.to_string()))?;
    let uv = document.corner_uv().ok_or_else(|| fail("not every corner has a UV".to_owned()))?;
    let view = document.view();
    let seams = Seams::between(view, |a, b| (0..2).any(|end| uv[a[end]] != uv[b[end]]));
    let cut = cut(view, &seams).map_err(|error| fail(error.to_string()))?;
    let length = |[a, b]: [u32; 2]| (view.positions[b as usize] - view.positions[a as usize]).norm();
    let total: f64 = seams.iter().map(length).sum();
    let (mut area, mut stretch, mut energy) = (0.0, 0.0, 0.0);
    for chart in &cut.charts {
        let mut plane: Vec<Vec2> = chart.corners.iter().map(|&corner| uv[corner as usize]).collect();
        // A mirrored island is a fault, but no stretch.
        if signed_area(&chart.mesh, &plane) < 0.0 {
            plane.iter_mut().for_each(|p| p.x = -p.x);
        }
        let share = surface_area(&chart.mesh);
        area += share;
        stretch += share * atlas::stretch(&chart.mesh, &plane).quantile;
        let found = measure(chart.mesh.view(), &plane).ok().and_then(|found| found.symmetric_dirichlet);
        energy += share * found.unwrap_or(f64::INFINITY);
    }
    let certificate = certify(view, &uv, 0).map_err(|error| fail(error.to_string()))?;
    let faults = if certificate.holds { "no".to_owned() } else { certificate.to_string() };
    Ok(format!(
        "{} | {} | {} | {} | {} | {faults}",
        cut.charts.len(),
        seams.len(),
        digits(total / area.sqrt()),
        digits(stretch / area),
        digits(energy / area)
    ))
}

fn signed_area(mesh: &QuadMesh, plane: &[Vec2]) -> f64 {
    let edge = |corner: CornerId| plane[corner.index()].perp(&plane[mesh.next_corner(corner).index()]);
    0.5 * mesh.corners().map(edge).sum::<f64>()
}
