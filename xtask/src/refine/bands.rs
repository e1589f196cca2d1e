//! What a shear band looks like: the areas of two maps of one fine mesh, the second of an energy that is not elliptic.

use std::fs;
use std::path::Path;

use qparam_cli::picture::{Canvas, Layout, Legend, Measure, Rgba, letter_height, text, text_color};
use qparam_cli::qmesh::{QuadMesh, shapes};
use qparam_cli::qoptimize::{Options, Preset, measure_faces, parameterize};

const FILE: &str = "docs/figures/shear-bands.png";
/// Quads along a side.
const SIDE: usize = 316;
/// Height of the picture, and width of each map in it.
const SIZE: usize = 460;
const LABEL: usize = 30;
/// Ends of the scale, area in the plane over area in space.
const RANGE: [f64; 2] = [2.0 / 3.0, 1.5];
const WHITE: Rgba = Rgba([255, 255, 255, 255]);

/// Writes the picture: both energies are followed down as far as 200 steps go.
pub(super) fn write(root: &Path) -> Result<(), String> {
    let mesh = shapes::nose(SIDE);
    let scale = Measure::Area.scale_of(RANGE);
    let legend = Legend { scale: &scale, has_flipped: false };
    let strip = legend.width([SIZE, SIZE]);
    let mut canvas = Canvas::new(2 * SIZE + strip, SIZE + LABEL, WHITE);
    let ways =
        [("the defaults", Options::default()), ("--preset paper-errors", Preset::PaperErrors.options())];
    for (column, (name, mut options)) in ways.into_iter().enumerate() {
        options.direct.descent.relative_decrease = 1e-9;
        let last = column == 1;
        let size = [SIZE + if last { strip } else { 0 }, SIZE];
        canvas.put(&map(&mesh, &options, last.then_some(&legend), size)?, [column * SIZE, 0]);
        let letters = letter_height([SIZE, SIZE]) * 1.3;
        let start = column as f64 * SIZE as f64 + (SIZE as f64 - text::width(name, letters)) / 2.0;
        text::write(&mut canvas, name, [start, (SIZE + LABEL) as f64 - 10.0], letters, text_color(WHITE));
    }
    let mut file = Vec::new();
    canvas.write_png(&mut file).map_err(|error| error.to_string())?;
    fs::write(root.join(FILE), file).map_err(|error| format!("{FILE}: {error}"))?;
    println!("{FILE}");
    Ok(())
}

fn map(
    mesh: &QuadMesh,
    options: &Options,
    legend: Option<&Legend<'_>>,
    size: [usize; 2],
) -> Result<Canvas, String> {
    let map = parameterize(mesh, options, &()).map_err(|error| error.to_string())?;
    let faces = measure_faces(mesh.view(), &map.uv).map_err(|error| error.to_string())?;
    let colors = Measure::Area.scale_of(RANGE).colors(&faces.area_ratio, &faces.flipped);
    let layout = Layout {
        polygons: mesh.view(),
        uv: &map.uv,
        colors: &colors,
        seams: None,
        edges: false,
        texels: None,
        size,
        background: WHITE,
        legend,
    };
    layout.canvas().map_err(|error| error.to_string())
}
