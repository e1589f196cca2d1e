//! `cargo xtask packing`: how much of the square our packing fills, and xatlas's with the very same islands.
//!
//! Islands come from two sides: ours (`qparam unwrap --seams uv`, or no option where the file has no UVs), and the many small ones that xatlas
//! cuts. Every packer gets the same outlines at the same sizes, the same resolution and the same margin; what is filled is measured from
//! the UVs that it hands back. `--python` names an interpreter with numpy and xatlas.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use qparam_cli::qmesh::charts::cut;
use qparam_cli::qmesh::{Seams, Vec2};
use qparam_cli::qoptimize::pack::{PackOptions, Shape, pack};
use serde_json::Value;

use crate::meshes::{FILE, digits, unwrap};
use crate::section;

/// Meshes, and the options that give them several islands.
const OURS: &[(&str, &[&str])] = &[
    ("spot", &["--seams", "uv"]),
    ("teapot_fancy", &["--seams", "uv"]),
    ("garment_casualsuit", &["--seams", "uv"]),
    ("car_opensubdiv", &[]),
];
/// Meshes whose charts by xatlas are packed.
const THEIRS: &[&str] = &["spot", "teapot_fancy", "garment_casualsuit", "wingnut_6k"];

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let python = match arguments {
        [flag, program] if flag == "--python" => Path::new(program),
        _ => return Err("wants --python PROGRAM, an interpreter with numpy and xatlas".to_owned()),
    };
    let folder = std::env::var_os("QPARAM_MESHES").ok_or("QPARAM_MESHES names no folder of meshes")?;
    let folder = Path::new(&folder);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    let work = root.join("target/packing");
    fs::create_dir_all(&work).map_err(|error| error.to_string())?;
    let scripts = root.join("xtask/compare");
    let mut text = String::from(HEAD);
    for &(name, options) in OURS {
        let file = work.join(format!("{name}.obj"));
        unwrap(&folder.join(format!("{name}.obj")), &file, options)?;
        let label = format!("{name} | {}", if options.is_empty() { "ours" } else { "its own seams, ours" });
        rows(&mut text, &label, &file, python, &scripts)?;
    }
    for name in THEIRS {
        let file = work.join(format!("{name}_xatlas.obj"));
        let source = folder.join(format!("{name}.obj"));
        let arguments: [PathBuf; 3] = [source, file.clone(), work.join("report.json")];
        output(Command::new(python).arg(scripts.join("rival.py")).arg("xatlas").args(arguments))?;
        rows(&mut text, &format!("{name} | of xatlas"), &file, python, &scripts)?;
    }
    section::write(&root.join(FILE), "packing", &text)
}

const HEAD: &str = "
# Packing

What share of the square the islands cover, each packer with the same islands at one density, 2048 texels a side and 4 texels of margin.
xatlas is not bound to a square and may end a little above the resolution: *of the square* is of the smallest one around its layout,
*of its rectangle* of the layout's own box. Ours stands islands upright and turns none; xatlas turns them unless told not to.
Seconds are wall time on two cores.

| mesh | islands | number | packer | of the square | of its rectangle | seconds |
|---|---|---:|---|---:|---:|---:|
";

/// One row for each packer.
fn rows(text: &mut String, label: &str, file: &Path, python: &Path, scripts: &Path) -> Result<(), String> {
    let options = PackOptions::default();
    let mut put = |by: &str, islands: u64, [square, rectangle, seconds]: [f64; 3]| {
        let row = format!(
            "| {label} | {islands} | {by} | {:.1} % | {:.1} % | {} |\n",
            100.0 * square,
            100.0 * rectangle,
            digits(seconds)
        );
        eprint!("{row}");
        // Writing to a string does not fail.
        let _ = text.write_str(&row);
    };
    let (islands, ours) = packed(file, &options)?;
    put("qparam", islands, ours);
    let mut command = Command::new(python);
    command
        .arg(scripts.join("packing.py"))
        .args([options.resolution.to_string(), options.margin.to_string()]);
    for line in output(command.arg(file))?.lines() {
        let found: Value = serde_json::from_str(line).map_err(|error| format!("{line}: {error}"))?;
        let number = |name: &str| found[name].as_f64().unwrap_or(f64::NAN);
        let figures = ["of_square", "of_rectangle", "seconds"].map(number);
        put(found["by"].as_str().unwrap_or_default(), found["islands"].as_u64().unwrap_or_default(), figures);
    }
    Ok(())
}

fn output(command: &mut Command) -> Result<String, String> {
    let ended = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if !ended.status.success() {
        return Err(format!("{command:?}: {}", String::from_utf8_lossy(&ended.stderr)));
    }
    String::from_utf8(ended.stdout).map_err(|error| format!("{command:?}: {error}"))
}

/// The islands of a file with UVs, packed by ours: how many, and what shares of the square and of their rectangle they cover.
fn packed(file: &Path, options: &PackOptions) -> Result<(u64, [f64; 3]), String> {
    let fail = |error: String| format!("{}: {error}", file.display());
    let document = crate::meshes::document(file).map_err(|error| fail(error.to_string()))?;
    let uv = document.corner_uv().ok_or_else(|| fail("not every corner has a UV".to_owned()))?;
    let view = document.view();
    let seams = Seams::between(view, |a, b| (0..2).any(|end| uv[a[end]] != uv[b[end]]));
    let charts = cut(view, &seams).map_err(|error| fail(error.to_string()))?.charts;
    let places: Vec<Vec<Vec2>> = charts
        .iter()
        .map(|chart| chart.corners.iter().map(|&corner| uv[corner as usize]).collect())
        .collect();
    let shapes: Vec<Shape<'_>> = charts
        .iter()
        .zip(&places)
        .map(|(chart, uv)| Shape { face_start: chart.mesh.view().face_start, uv })
        .collect();
    let start = Instant::now();
    let found = pack(&shapes, options);
    let seconds = start.elapsed().as_secs_f64();
    let area: f64 = shapes.iter().map(Shape::area).sum::<f64>() * found.scale * found.scale;
    Ok((shapes.len() as u64, [area, area / (found.extent.x * found.extent.y), seconds]))
}
