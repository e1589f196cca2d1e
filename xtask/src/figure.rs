//! `docs/figures/head-face.svg`, the picture that README opens with: a face and a head under a checkerboard, in the manner
//! of the paper's Fig. 3.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use qparam_cli::qmesh::{CornerData, QuadMesh, Vec2, Vec3, shapes};
use qparam_cli::qoptimize::{Method, Options, parameterize};

mod checker;
mod svg;
mod view;

use checker::{Pin, parts};
use svg::{Ink, Slab, UNITS_PER_PIXEL};

/// Width and height of a model's place, in pixels.
const FRAME: Vec2 = Vec2::new(236.0, 256.0);
const LABELS: f64 = 26.0;
const MARGIN: f64 = 8.0;
/// Polygons are painted in this many steps from back to front.
const SLABS: usize = 22;
/// Columns after the model itself.
const COLUMNS: [(f64, &str); 3] =
    [(1.0, "q = 1: angles first"), (0.5, "q = 0.5"), (0.0, "q = 0: areas first")];

struct Row {
    mesh: QuadMesh,
    /// From the model to the camera.
    towards: Vec3,
    /// How many checks as large as the average one would cover the surface.
    checks: f64,
}

fn rows() -> [Row; 2] {
    [
        Row { mesh: shapes::face(3), towards: Vec3::new(0.5, 0.12, 1.0), checks: 280.0 },
        Row { mesh: shapes::head(2), towards: Vec3::new(0.62, 0.12, 1.0), checks: 480.0 },
    ]
}

/// Writes the picture, or compares it with what is there (`--check`). Between machines the last digits of a descent may differ, and
/// with them a few corners by a tenth of a pixel.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err("the only argument is --check".to_owned()),
    };
    let name = "docs/figures/head-face.svg";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name(name);
    let picture = picture(&rows())?;
    if check {
        return match fs::read_to_string(&path) {
            Ok(found) if found == picture => {
                println!("{name} is as the code says");
                Ok(())
            }
            Ok(_) => Err(format!("{name} is not what the code draws; `cargo xtask figure` draws it anew")),
            Err(error) => Err(format!("{name}: {error}")),
        };
    }
    path.parent().map_or(Ok(()), fs::create_dir_all).map_err(|error| format!("{name}: {error}"))?;
    fs::write(&path, &picture).map_err(|error| format!("{name}: {error}"))?;
    println!("{name}: {} KB", picture.len().div_ceil(1000));
    Ok(())
}

fn picture(rows: &[Row]) -> Result<String, String> {
    let columns = (1 + COLUMNS.len()) as f64;
    let size = Vec2::new(columns * FRAME.x, rows.len() as f64 * FRAME.y + LABELS);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\">\n\
         <title>A face and a head: the model, and a checkerboard through its UVs for q = 1, 0.5 and 0</title>\n\
         <style>{}</style>\n",
        size.x,
        size.y,
        size.x * UNITS_PER_PIXEL,
        size.y * UNITS_PER_PIXEL,
        svg::styles()
    );
    for (i, row) in rows.iter().enumerate() {
        let middle = |column: usize| Vec2::new(column as f64 + 0.5, i as f64 + 0.5).component_mul(&FRAME);
        draw(&mut text, row, middle(0), None);
        for (column, (q, _)) in COLUMNS.iter().enumerate() {
            draw(&mut text, row, middle(column + 1), Some(&board(row, *q)?));
        }
    }
    label(&mut text, size, COLUMNS.iter().map(|(_, label)| *label));
    text.push_str("</svg>\n");
    Ok(text)
}

/// Where each corner is on a board whose checks have side 1.
fn board(row: &Row, q: f64) -> Result<CornerData<Vec2>, String> {
    let options = Options { q, method: Method::Direct, ..Options::default() };
    let mesh = &row.mesh;
    let map = parameterize(mesh, &options, &()).map_err(|error| error.to_string())?;
    let area = mesh.faces().map(|face| {
        let outline: Vec<Vec2> = mesh.face_corners(face).map(|corner| map.uv[corner]).collect();
        checker::doubled_area(&outline) / 2.0
    });
    let per_unit = (row.checks / area.sum::<f64>()).sqrt();
    // The models are symmetric in x, so this is the direction in which the map goes from one cheek to the other.
    let across: Vec2 = mesh.corners().map(|c| map.uv[c] * mesh.position(mesh.vertex(c)).x).sum();
    let right = across.normalize();
    let up = Vec2::new(-right.y, right.x);
    // Rounded, so that the last digits, which differ between machines, leave no trace; and shifted, so that no line of
    // the board runs along the mirror plane of the model, where a rounding would decide on a column of quads.
    let coordinate = |x: f64, shift: f64| (x * 1e6).round() / 1e6 * per_unit + shift;
    Ok(mesh.corner_data(|corner| {
        let uv = map.uv[corner];
        Vec2::new(coordinate(uv.dot(&right), 0.313), coordinate(uv.dot(&up), 0.171))
    }))
}

/// Paints from back to front; quads that turn their back are left out.
fn draw(text: &mut String, row: &Row, middle: Vec2, board: Option<&CornerData<Vec2>>) {
    let view = view::look(&row.mesh, row.towards, middle, FRAME - Vec2::repeat(2.0 * MARGIN));
    let mut slabs: Vec<Slab> = (0..SLABS).map(|_| Slab::default()).collect();
    for seen in &view.seen {
        let slab = &mut slabs[((seen.nearness * SLABS as f64) as usize).min(SLABS - 1)];
        let outline: Vec<Vec2> = row.mesh.face_vertices(seen.face).map(|v| view.place[v]).collect();
        let Some(board) = board else {
            slab.add(Ink::Clay, seen.light, &outline);
            continue;
        };
        let corners = row.mesh.face_corners(seen.face);
        let pins: Vec<Pin> =
            outline.iter().zip(corners).map(|(&place, c)| Pin { place, board: board[c] }).collect();
        for part in parts(&pins) {
            slab.add(if part.is_dark { Ink::Dark } else { Ink::Light }, seen.light, &part.outline);
        }
    }
    slabs.iter().for_each(|slab| slab.write(text));
}

fn label<'a>(text: &mut String, size: Vec2, labels: impl Iterator<Item = &'a str>) {
    // This grey is readable on white and on black pages.
    let _ = writeln!(
        text,
        "<g font-family=\"sans-serif\" font-size=\"{}\" fill=\"#808080\" text-anchor=\"middle\">",
        14.0 * UNITS_PER_PIXEL
    );
    for (column, label) in ["model"].into_iter().chain(labels).enumerate() {
        let x = (column as f64 + 0.5) * FRAME.x * UNITS_PER_PIXEL;
        let y = (size.y - 10.0) * UNITS_PER_PIXEL;
        let _ = writeln!(text, "<text x=\"{x}\" y=\"{y}\">{label}</text>");
    }
    text.push_str("</g>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat grid seen from above: every quad is painted once, half of it dark, and nothing from below.
    #[test]
    fn a_flat_grid_is_half_dark_and_has_no_back() {
        let mesh = shapes::grid(6, 6);
        let view = |z: f64| view::look(&mesh, Vec3::new(0.0, 0.0, z), Vec2::zeros(), Vec2::repeat(60.0));
        assert_eq!(view(1.0).seen.len(), 36);
        assert_eq!(view(-1.0).seen.len(), 0);
        let place = view(1.0).place;
        let dark: f64 = mesh
            .faces()
            .flat_map(|face| {
                let pins: Vec<Pin> = mesh
                    .face_vertices(face)
                    .map(|v| Pin { place: place[v], board: mesh.position(v).xy() })
                    .collect();
                parts(&pins)
            })
            .filter(|part| part.is_dark)
            .map(|part| checker::doubled_area(&part.outline).abs() / 2.0)
            .sum();
        assert!((dark - 1800.0).abs() < 1e-9, "{dark} of 3600 square pixels");
    }

    /// What is near is painted last.
    #[test]
    fn the_nose_is_painted_after_the_cheeks() {
        let mesh = shapes::face(2);
        let seen = view::look(&mesh, Vec3::z(), Vec2::zeros(), Vec2::repeat(100.0)).seen;
        let depth = |i: usize| {
            let corners: Vec<Vec3> = mesh.face_vertices(seen[i].face).map(|v| mesh.position(v)).collect();
            corners.iter().map(|p| p.z).sum::<f64>() / 4.0
        };
        assert!((1..seen.len()).all(|i| depth(i - 1) <= depth(i) + 1e-12));
    }
}
