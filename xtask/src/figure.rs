//! `docs/figures/head-face.png`, the picture that README opens with: a face and a head under a checkerboard, for q = 1, 0.5
//! and 0, in the manner of the paper's Fig. 3.
//!
//! The maps are those of `cargo xtask sweep`: the reading of the paper's method that shows most of Table 1, and the direct method.

use std::fs;
use std::path::Path;

use qparam_cli::picture::color::{Linear, oklch};
use qparam_cli::picture::{
    Canvas, Ink, Lines, Model, Paint, Projection, Rgba, Shot, UpAxis, View, render, text,
};
use qparam_cli::qmesh::{QuadMesh, Vec2, Vec3, shapes};
use qparam_cli::qoptimize::{Options, parameterize};

use crate::sweep::best_and_direct;

/// Width and height of a model's place, in pixels.
const FRAME: [usize; 2] = [240, 250];
/// Beneath the last row, for the names of the columns.
const LABELS: usize = 34;
/// Height of capitals.
const LETTERS: f64 = 10.0;
const COLUMNS: [f64; 3] = [1.0, 0.5, 0.0];
const NAME: &str = "docs/figures/head-face.png";

struct Surface {
    mesh: QuadMesh,
    towards: Vec3,
    /// How many checks as large as the average one would cover the surface.
    checks: f64,
}

fn surfaces() -> [Surface; 2] {
    [
        Surface { mesh: shapes::face(3), towards: Vec3::new(0.5, 0.12, 1.0), checks: 280.0 },
        Surface { mesh: shapes::head(2), towards: Vec3::new(0.62, 0.12, 1.0), checks: 480.0 },
    ]
}

/// Runs the task: writes the picture, or compares it with what is there (`--check`).
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err("the only argument is --check".to_owned()),
    };
    if check { self::check() } else { write() }
}

/// Writes the picture, unless what is there is the same but for last digits.
pub(crate) fn write() -> Result<(), String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name(NAME);
    let picture = picture()?;
    if compare(&path, &picture).is_ok() {
        return Ok(());
    }
    let mut file = Vec::new();
    picture.write_png(&mut file).map_err(|error| error.to_string())?;
    path.parent().map_or(Ok(()), fs::create_dir_all).map_err(|error| format!("{NAME}: {error}"))?;
    fs::write(&path, &file).map_err(|error| format!("{NAME}: {error}"))?;
    println!("{NAME}: {} KB", file.len().div_ceil(1000));
    Ok(())
}

/// Compares the picture with what is there. Between machines and between profiles last digits differ, so the comparison allows a mean
/// difference of one step of 255, and one pixel in a hundred that differs by more than 24.
pub(crate) fn check() -> Result<(), String> {
    compare(&Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name(NAME), &picture()?)
}

fn compare(path: &Path, picture: &Canvas) -> Result<(), String> {
    let wrong = |what: String| format!("{NAME}: {what}");
    let file = fs::File::open(path).map_err(|error| wrong(error.to_string()))?;
    let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
    decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|error| wrong(error.to_string()))?;
    let mut found = vec![0; reader.output_buffer_size().unwrap_or(0)];
    reader.next_frame(&mut found).map_err(|error| wrong(error.to_string()))?;
    let expected = picture.bytes();
    let differences: Vec<u8> = found.iter().zip(&expected).map(|(a, b)| a.abs_diff(*b)).collect();
    let mean = differences.iter().map(|&d| f64::from(d)).sum::<f64>() / expected.len() as f64;
    let far = differences.chunks_exact(4).filter(|pixel| pixel.iter().any(|&d| d > 24)).count();
    if found.len() != expected.len() || mean > 1.0 || far * 400 > expected.len() {
        return Err(wrong(format!(
            "it is not what the code draws (mean difference {mean:.2}); `cargo xtask figure` draws it anew"
        )));
    }
    println!("{NAME} is as the code says");
    Ok(())
}

fn picture() -> Result<Canvas, String> {
    let rows: Vec<(Surface, usize)> =
        surfaces().into_iter().zip(surfaces()).flat_map(|(a, b)| [(a, 0), (b, 1)]).collect();
    let size = [FRAME[0] * (1 + COLUMNS.len()), FRAME[1] * rows.len() + LABELS];
    let mut canvas = Canvas::new(size[0], size[1], Rgba::CLEAR);
    for (row, (surface, method)) in rows.iter().enumerate() {
        let (name, options) = &best_and_direct(&surface.mesh)?[*method];
        let mut put = |column: usize, part: &Canvas| canvas.put(part, [column * FRAME[0], row * FRAME[1]]);
        put(0, &bare(surface)?);
        for (column, &q) in COLUMNS.iter().enumerate() {
            put(column + 1, &under_a_checkerboard(surface, &Options { q, ..options.clone() })?);
        }
        let low = (row + 1) * FRAME[1] - 6;
        label(&mut canvas, name, FRAME[0] as f64 / 2.0, low as f64);
    }
    for (column, &q) in COLUMNS.iter().enumerate() {
        let name = match column {
            0 => format!("q = {q}: angles first"),
            2 => format!("q = {q}: areas first"),
            _ => format!("q = {q}"),
        };
        label(&mut canvas, &name, (column as f64 + 1.5) * FRAME[0] as f64, size[1] as f64 - 12.0);
    }
    Ok(canvas)
}

/// In a grey that is readable on white and on black pages.
fn label(canvas: &mut Canvas, words: &str, middle: f64, base: f64) {
    let start = [middle - text::width(words, LETTERS) / 2.0, base];
    text::write(canvas, words, start, LETTERS, Linear::from(Rgba([128, 128, 128, 255])));
}

fn shot(surface: &Surface) -> Shot {
    Shot {
        view: View::From(surface.towards),
        up: UpAxis::Y,
        projection: Projection::Perspective(20.0),
        size: [FRAME[0], FRAME[1] - 14],
        background: Rgba::CLEAR,
        relief: 1.0,
    }
}

/// The model itself, with the edges of its faces.
fn bare(surface: &Surface) -> Result<Canvas, String> {
    let view = surface.mesh.view();
    let ink = Ink { color: Linear([0.01, 0.012, 0.02]), strength: 0.6, width: 0.9, fades: true };
    let lines = Lines { inks: vec![ink], of_corner: vec![1; view.corner_count()] };
    let model = Model::new(view).map_err(|error| error.to_string())?;
    Ok(render(&model, &Paint::Plain(oklch(0.82, 0.02, 75.0)), &lines, &shot(surface)))
}

fn under_a_checkerboard(surface: &Surface, options: &Options) -> Result<Canvas, String> {
    let mesh = &surface.mesh;
    let map = parameterize(mesh, options, &()).map_err(|error| error.to_string())?;
    // The models are symmetric in x, so this is the direction in which the map goes from one cheek to the other.
    let across: Vec2 = mesh.corners().map(|c| map.uv[c] * mesh.position(mesh.vertex(c)).x).sum();
    let right = across.normalize();
    let up = Vec2::new(-right.y, right.x);
    let area: f64 = mesh
        .faces()
        .map(|face| {
            let corners: Vec<Vec2> = mesh.face_corners(face).map(|corner| map.uv[corner]).collect();
            corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| a.perp(b)).sum::<f64>() / 2.0
        })
        .sum();
    let uv: Vec<Vec2> =
        mesh.corners().map(|c| Vec2::new(map.uv[c].dot(&right), map.uv[c].dot(&up))).collect();
    let colors = [[44, 104, 176, 255], [250, 249, 246, 255]].map(|color| Linear::from(Rgba(color)));
    let paint = Paint::Checker { uv: &uv, per_unit: (surface.checks / area.abs()).sqrt(), colors };
    let model = Model::new(mesh.view()).map_err(|error| error.to_string())?;
    Ok(render(&model, &paint, &Lines::default(), &shot(surface)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The models fill their places, and leave the corners free.
    #[test]
    fn models_are_seen() {
        for surface in surfaces() {
            let bytes = bare(&surface).unwrap().bytes();
            let covered = bytes.chunks_exact(4).filter(|pixel| pixel[3] == 255).count();
            assert!(covered * 10 > FRAME[0] * FRAME[1] * 3 && bytes[3] == 0, "{covered} pixels");
        }
    }
}
