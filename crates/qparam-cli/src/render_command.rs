//! `qparam render`: a mesh in space with its UVs, as PNG.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use qoptimize::qmesh::obj::ObjDocument;
use qoptimize::qmesh::{PolygonView, Vec2};
use qoptimize::{FaceMeasures, measure_faces};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{Input, read_bytes};
use crate::measure::without_uv;
use crate::output::Target;
use crate::picture::color::{Linear, category, oklch, pale};
use crate::picture::materials::{Look, MaterialNames, read_library};
use crate::picture::{
    Canvas, HeatScale, Ink, Legend, Lines, Measure, Model, Paint, PictureError, Projection, Rgba, Seams,
    Shot, Texture, UpAxis, View, sheet, uv_area,
};
use crate::picture_args::{PaperArgs, RenderArgs, StyleChoice, UpChoice};
use crate::streams::Streams;
use crate::table::counted;
use crate::threads;

/// Of a surface that shows nothing, and of faces without a material.
pub(crate) fn clay() -> Linear {
    oklch(0.82, 0.02, 75.0)
}

/// The two colours of a checkerboard.
pub(crate) fn checks() -> [Linear; 2] {
    [Linear::from(Rgba([44, 104, 176, 255])), Linear::from(Rgba([250, 249, 246, 255]))]
}

pub(crate) fn run(arguments: &RenderArgs, io: &mut Streams<'_>) -> Result<Exit, Failure> {
    let target = Target::new(&arguments.output);
    refuse_clashes(arguments, &target)?;
    target.probe()?;
    let input = Input::read(&arguments.input, io.stdin)?;
    let texture = arguments.texture.as_deref().map(|path| read_texture(path, io)).transpose()?;
    let mut notes = Vec::new();
    let canvas = {
        let work = || draw(arguments, &input, texture, &mut notes);
        threads::with(arguments.paper.threads, work)??
    };
    target.write(io.stdout, io.interrupt, |writer| canvas.write_png(writer))?;
    tell(&target, &arguments.paper, &input, &notes, io)?;
    Ok(Exit::Done)
}

fn refuse_clashes(arguments: &RenderArgs, target: &Target) -> Result<(), Failure> {
    let inputs: Vec<&Path> = [Some(&arguments.input), arguments.texture.as_ref()]
        .into_iter()
        .flatten()
        .map(PathBuf::as_path)
        .collect();
    if inputs.iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        return Err(Failure::new(Exit::Usage, "standard input cannot be read twice").help("name `-` once"));
    }
    keep_inputs(&inputs, target)?;
    check_range(arguments.range, arguments.style.measure())
}

/// A picture that replaces what it is made from is always a slip.
pub(crate) fn keep_inputs(inputs: &[&Path], target: &Target) -> Result<(), Failure> {
    let is_target = |path: &&Path| {
        let place = Target::new(path);
        matches!(place, Target::File(_)) && place.is_same_place(target)
    };
    if inputs.iter().any(is_target) {
        return Err(Failure::new(Exit::Usage, "the picture would replace what it is made from")
            .help("name another file with -o"));
    }
    Ok(())
}

/// `--range` belongs to heat maps, and on logarithmic scales is positive.
pub(crate) fn check_range(range: Option<[f64; 2]>, measure: Option<Measure>) -> Result<(), Failure> {
    match (range, measure) {
        (Some(_), None) => Err(Failure::new(Exit::Usage, "--range has no effect without a heat map")
            .help("choose --style heat-angle, heat-area or heat-stretch")),
        (Some(range), Some(measure)) if !measure.accepts(range) => {
            Err(Failure::new(Exit::Usage, "the scale is logarithmic: --range must be positive")
                .help("write for example --range 0.25,4"))
        }
        _ => Ok(()),
    }
}

fn read_texture(path: &Path, io: &mut Streams<'_>) -> Result<Texture, Failure> {
    let bytes = read_bytes(path, io.stdin)?;
    Texture::read_png(Cursor::new(bytes)).map_err(|error| {
        Failure::new(Exit::Input, format!("{}: the image cannot be used", path.display()))
            .cause(&error)
            .help("convert it to PNG")
    })
}

fn draw(
    arguments: &RenderArgs,
    input: &Input,
    texture: Option<Texture>,
    notes: &mut Vec<String>,
) -> Result<Canvas, Failure> {
    let polygons = input.document.view();
    let model = Model::new(polygons).map_err(|error| no_picture(&error, input))?;
    let look = Surface::of(arguments, input, texture, notes)?;
    let lines = lines(arguments, polygons, &look);
    let legend = look.scale.as_ref().filter(|_| !arguments.paper.no_legend);
    let has_flipped = look.measures.as_ref().is_some_and(|measures| measures.flipped.contains(&true));
    let shot = Shot {
        view: View::Front,
        up: match arguments.up {
            UpChoice::Y => UpAxis::Y,
            UpChoice::Z => UpAxis::Z,
        },
        projection: match arguments.orthographic {
            true => Projection::Orthographic,
            false => Projection::Perspective(arguments.angle),
        },
        size: arguments.paper.size,
        background: arguments.paper.background,
        // Colours that mean values keep most of their own brightness.
        relief: if look.scale.is_some() { 0.35 } else { 1.0 },
    };
    let legend = legend.map(|scale| Legend { scale, has_flipped });
    Ok(sheet(&model, &look.paint(), &lines, &shot, &arguments.view, legend.as_ref()))
}

pub(crate) fn no_picture(error: &PictureError, input: &Input) -> Failure {
    Failure::new(Exit::Input, format!("{}: there is no picture", input.name)).cause(error)
}

/// Measures of the faces, or why there are none.
pub(crate) fn measured(input: &Input, uv: &[Vec2]) -> Result<FaceMeasures, Failure> {
    measure_faces(input.document.view(), uv).map_err(|error| {
        Failure::new(Exit::Input, format!("{}: the UVs cannot be shown", input.name)).cause(&error)
    })
}

/// Says what was drawn, unless it should not.
pub(crate) fn tell(
    target: &Target,
    paper: &PaperArgs,
    input: &Input,
    notes: &[String],
    io: &mut Streams<'_>,
) -> Result<(), Failure> {
    if paper.quiet {
        return Ok(());
    }
    notes.iter().for_each(|note| io.say_err(&format!("note: {note}\n")));
    let [width, height] = paper.size;
    let faces = counted(input.document.face_count(), "face");
    io.report(*target == Target::Stdout, &format!("{target}: {width} × {height} pixels, {faces}\n"))
}

/// What the surface shows, before it is borrowed as paint.
struct Surface {
    uv: Vec<Vec2>,
    measures: Option<FaceMeasures>,
    scale: Option<HeatScale>,
    kind: Kind,
}

enum Kind {
    Plain,
    Faces(Vec<Linear>),
    Checker { per_unit: f64 },
    Textures { of_face: Vec<u32>, textures: Vec<Texture> },
}

impl Surface {
    fn of(
        arguments: &RenderArgs,
        input: &Input,
        texture: Option<Texture>,
        notes: &mut Vec<String>,
    ) -> Result<Self, Failure> {
        let document = &input.document;
        let optional =
            texture.is_none() && matches!(arguments.style, StyleChoice::Wire | StyleChoice::Material);
        let uv = match document.corner_uv() {
            Some(uv) => uv,
            None if optional && !arguments.seams => Vec::new(),
            None => return Err(needs_uv(input, arguments)),
        };
        let mut surface = Self { uv, measures: None, scale: None, kind: Kind::Plain };
        if !surface.uv.is_empty() && (arguments.seams || !optional) {
            surface.measures = Some(measured(input, &surface.uv)?);
        }
        surface.kind = surface.kind_of(arguments, document, texture, notes);
        Ok(surface)
    }

    fn kind_of(
        &mut self,
        arguments: &RenderArgs,
        document: &ObjDocument,
        texture: Option<Texture>,
        notes: &mut Vec<String>,
    ) -> Kind {
        if let Some(texture) = texture {
            return Kind::Textures { of_face: vec![0; document.face_count()], textures: vec![texture] };
        }
        match (arguments.style, &self.measures) {
            (StyleChoice::Material, _) => materials(document, &arguments.input, !self.uv.is_empty(), notes),
            (StyleChoice::Checker, _) => {
                Kind::Checker { per_unit: (arguments.checks / uv_area(document.view(), &self.uv)).sqrt() }
            }
            (StyleChoice::Islands, Some(measures)) => {
                let color = if arguments.seams { pale } else { category };
                Kind::Faces(measures.island.iter().map(|&island| color(island as usize)).collect())
            }
            (style, Some(measures)) if style.measure().is_some() => {
                let measure = style.measure().unwrap_or(Measure::Angle);
                let scale =
                    arguments.range.map_or_else(|| measure.scale(measures), |range| measure.scale_of(range));
                let colors = scale.colors(measure.values(measures), &measures.flipped);
                self.scale = Some(scale);
                Kind::Faces(colors)
            }
            _ => Kind::Plain,
        }
    }

    fn paint(&self) -> Paint<'_> {
        match &self.kind {
            Kind::Plain => Paint::Plain(clay()),
            Kind::Faces(colors) => Paint::Faces(colors),
            Kind::Checker { per_unit } => {
                Paint::Checker { uv: &self.uv, per_unit: *per_unit, colors: checks() }
            }
            Kind::Textures { of_face, textures } => Paint::Textures { uv: &self.uv, of_face, textures },
        }
    }
}

fn needs_uv(input: &Input, arguments: &RenderArgs) -> Failure {
    let mut failure = without_uv(input);
    let remedy = "`qparam unwrap` computes UVs";
    failure.help = Some(if arguments.seams {
        format!("leave --seams away, or see to the UVs: {remedy}")
    } else {
        format!("--style wire shows the mesh without UVs; {remedy}")
    });
    failure
}

/// Images and colours of the materials; what cannot be had is said and shown in clay.
fn materials(document: &ObjDocument, input: &Path, has_uv: bool, notes: &mut Vec<String>) -> Kind {
    let names = MaterialNames::of(document);
    let folder = if input.as_os_str() == "-" { None } else { input.parent() };
    let mut looks: Vec<(String, Look)> = Vec::new();
    if names.libraries.is_empty() {
        notes.push("the file names no materials (`mtllib`)".into());
    }
    for library in &names.libraries {
        let Some(folder) = folder else {
            notes.push(format!("{library}: standard input has no folder to look for it in"));
            continue;
        };
        let path = folder.join(library);
        match std::fs::read(&path).map_err(|error| error.to_string()).and_then(|text| read_library(&text)) {
            Ok(found) => looks.extend(found),
            Err(error) => notes.push(format!("{}: {error}", path.display())),
        }
    }
    let mut textures = vec![Texture::plain(clay())];
    let mut missing = Vec::new();
    let numbers: Vec<u32> = names
        .names
        .iter()
        .map(|name| {
            let Some((_, look)) = looks.iter().find(|(known, _)| known == name) else {
                missing.push(name.as_str());
                return 0;
            };
            let image = look.image.as_deref().filter(|_| has_uv);
            let image = image.and_then(|image| material_image(&folder?.join(image), notes));
            textures.push(image.unwrap_or_else(|| Texture::plain(look.color)));
            textures.len() as u32 - 1
        })
        .collect();
    if !missing.is_empty() && !looks.is_empty() {
        notes.push(format!("no library has the material {}", missing.join(", ")));
    }
    let of_face: Vec<u32> =
        names.of_face.iter().map(|name| name.map_or(0, |name| numbers[name as usize])).collect();
    if has_uv {
        return Kind::Textures { of_face, textures };
    }
    Kind::Faces(of_face.iter().map(|&number| textures[number as usize].mean()).collect())
}

fn material_image(path: &Path, notes: &mut Vec<String>) -> Option<Texture> {
    let read = std::fs::read(path).map_err(|error| error.to_string());
    let image =
        read.and_then(|bytes| Texture::read_png(Cursor::new(bytes)).map_err(|error| error.to_string()));
    image.map_err(|error| notes.push(format!("{}: {error}", path.display()))).ok()
}

/// Edges of faces, and seams over them.
fn lines(arguments: &RenderArgs, polygons: PolygonView<'_>, look: &Surface) -> Lines {
    let [width, height] = arguments.paper.size;
    let unit = width.min(height) as f32 / 900.0;
    let dark = Linear::from(Rgba([24, 30, 44, 255]));
    let mut lines = Lines::default();
    let seams = look.measures.as_ref().filter(|_| arguments.seams || arguments.style == StyleChoice::Islands);
    if arguments.edges || (arguments.style == StyleChoice::Wire && arguments.texture.is_none()) {
        lines.inks.push(Ink { color: dark, strength: 0.75, width: (1.3 * unit).max(0.8), fades: true });
        lines.of_corner = vec![1; polygons.corner_count()];
    }
    if let Some(measures) = seams {
        let found = Seams::find(polygons, &look.uv, &measures.island);
        lines.of_corner.resize(polygons.corner_count(), 0);
        let width = (4.0 * unit).max(1.5);
        let ink = |color: Linear| Ink { color, strength: 1.0, width, fades: false };
        lines.inks.push(ink(dark));
        let outline = lines.inks.len() as u32;
        found.boundary.iter().for_each(|&corner| lines.of_corner[corner as usize] = outline);
        for (cut, run) in found.cuts.iter().zip(&found.run) {
            let number = if arguments.seams { outline + 1 + run } else { outline };
            cut.iter().for_each(|&corner| lines.of_corner[corner as usize] = number);
        }
        if arguments.seams {
            lines.inks.extend((0..found.runs).map(|run| ink(category(run))));
        }
    }
    lines
}
