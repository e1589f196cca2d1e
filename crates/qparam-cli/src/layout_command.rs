//! `qparam layout`: the map itself, as SVG or PNG.

use qoptimize::qmesh::Vec2;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::measure::without_uv;
use crate::output::Target;
use crate::picture::color::{Linear, pale};
use crate::picture::{Canvas, HeatScale, Layout, Legend, Seams};
use crate::picture_args::{LayoutArgs, LayoutStyle};
use crate::render_command::{check_range, clay, keep_inputs, measured, no_picture, tell};
use crate::streams::Streams;
use crate::threads;

enum Drawn {
    Pixels(Canvas),
    Vectors(String),
}

pub(crate) fn run(arguments: &LayoutArgs, io: &mut Streams<'_>) -> Result<Exit, Failure> {
    let target = Target::new(&arguments.output);
    keep_inputs(&[&arguments.input], &target)?;
    check_range(arguments.range, arguments.style.measure())?;
    target.probe()?;
    let input = Input::read(&arguments.input, io.stdin)?;
    let uv = input.document.corner_uv().ok_or_else(|| without_uv(&input))?;
    let drawn = threads::with(arguments.paper.threads, || draw(arguments, &input, &uv))??;
    target.write(io.stdout, io.interrupt, |mut writer| match &drawn {
        Drawn::Pixels(canvas) => canvas.write_png(&mut writer),
        Drawn::Vectors(text) => writer.write_all(text.as_bytes()),
    })?;
    tell(&target, &arguments.paper, &input, &[], io)?;
    Ok(Exit::Done)
}

fn draw(arguments: &LayoutArgs, input: &Input, uv: &[Vec2]) -> Result<Drawn, Failure> {
    let polygons = input.document.view();
    let measures = measured(input, uv)?;
    let measure = arguments.style.measure();
    let scale: Option<HeatScale> = measure.map(|measure| {
        arguments.range.map_or_else(|| measure.scale(&measures), |range| measure.scale_of(range))
    });
    let colors: Vec<Linear> = match (&scale, measure, arguments.style) {
        (Some(scale), Some(measure), _) => scale.colors(measure.values(&measures), &measures.flipped),
        (_, _, LayoutStyle::Plain) => vec![clay(); polygons.face_count()],
        // Pale, so that the colours of the seams stand out.
        _ => measures.island.iter().map(|&island| pale(island as usize)).collect(),
    };
    let seams = (!arguments.no_seams).then(|| Seams::find(polygons, uv, &measures.island));
    let has_flipped = measures.flipped.contains(&true);
    let legend = scale.as_ref().filter(|_| !arguments.paper.no_legend);
    let legend = legend.map(|scale| Legend { scale, has_flipped });
    let layout = Layout {
        polygons,
        uv,
        colors: &colors,
        seams: seams.as_ref(),
        edges: !arguments.no_edges,
        texels: arguments.texels,
        size: arguments.paper.size,
        background: arguments.paper.background,
        legend: legend.as_ref(),
    };
    let is_svg = arguments.output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg"));
    let drawn = if is_svg { layout.svg().map(Drawn::Vectors) } else { layout.canvas().map(Drawn::Pixels) };
    drawn.map_err(|error| no_picture(&error, input))
}
