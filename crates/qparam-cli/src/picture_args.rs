//! The options of `qparam render` and `qparam layout`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::exit;
use crate::picture::{Measure, Rgba, View};

/// Draw a mesh in space with its UVs.
#[derive(Args, Clone, Debug)]
#[command(after_help = exit::TABLE)]
pub(crate) struct RenderArgs {
    /// An OBJ file with UVs; `-` is standard input
    #[arg(value_name = "UVED.obj")]
    pub(crate) input: PathBuf,
    /// Where the picture goes, as PNG; `-` is standard output
    #[arg(short, long, value_name = "PICTURE.png")]
    pub(crate) output: PathBuf,

    /// What the surface shows
    #[arg(long, value_enum, default_value = "checker", help_heading = "Surface")]
    pub(crate) style: StyleChoice,
    /// Show this image through the UVs, a PNG; it repeats beyond the unit square
    #[arg(long, value_name = "IMAGE.png", conflicts_with = "style", help_heading = "Surface")]
    pub(crate) texture: Option<PathBuf>,
    /// So many checks of the mean size would cover the surface
    #[arg(long, value_name = "N", default_value = "600", value_parser = positive, allow_negative_numbers = true, help_heading = "Surface")]
    pub(crate) checks: f64,
    /// The values at the ends of a heat map's scale, for comparing pictures: degrees, factors, or energies
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true, help_heading = "Surface")]
    pub(crate) range: Option<[f64; 2]>,
    /// Draw the edges of the faces, too
    #[arg(long, help_heading = "Surface")]
    pub(crate) edges: bool,
    /// Draw seams, each in a colour of its own, and the boundary
    #[arg(long, help_heading = "Surface")]
    pub(crate) seams: bool,

    /// From where: front, back, left, right, top, bottom, three-quarter, or the direction X,Y,Z from the model to the
    /// camera. Given several times, the views stand side by side
    #[arg(
        long,
        value_name = "VIEW",
        default_value = "three-quarter",
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    pub(crate) view: Vec<View>,
    /// Which axis points up; the front is +z when y is up, and -y when z is up
    #[arg(long, value_enum, default_value = "y", help_heading = "Camera")]
    pub(crate) up: UpChoice,
    /// Show parallel lines as parallel
    #[arg(long, conflicts_with = "angle", help_heading = "Camera")]
    pub(crate) orthographic: bool,
    /// Degrees that the narrower side of a frame spans; small angles look from afar
    #[arg(long, value_name = "1..120", default_value = "25", value_parser = angle, allow_negative_numbers = true, help_heading = "Camera")]
    pub(crate) angle: f64,

    #[command(flatten)]
    pub(crate) paper: PaperArgs,
}

// No doc comment: clap would make it the description of the commands. What both pictures are drawn on.
#[derive(Args, Clone, Debug)]
pub(crate) struct PaperArgs {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1200x900", value_parser = size, help_heading = "Picture")]
    pub(crate) size: [usize; 2],
    /// Behind everything: #rrggbb, #rrggbbaa, white, black, gray or transparent
    #[arg(long, value_name = "COLOUR", default_value = "white", help_heading = "Picture")]
    pub(crate) background: Rgba,
    /// Leave the scale of a heat map away
    #[arg(long, help_heading = "Picture")]
    pub(crate) no_legend: bool,
    /// Threads; 0 takes all. The picture does not depend on it
    #[arg(long, value_name = "N", default_value = "0", help_heading = "Picture")]
    pub(crate) threads: usize,
    /// Print nothing but errors
    #[arg(long, help_heading = "Picture")]
    pub(crate) quiet: bool,
}

/// Draw the map itself, flat.
#[derive(Args, Clone, Debug)]
#[command(after_help = exit::TABLE)]
pub(crate) struct LayoutArgs {
    /// An OBJ file with UVs; `-` is standard input
    #[arg(value_name = "UVED.obj")]
    pub(crate) input: PathBuf,
    /// Where the picture goes: PNG, or vectors when the name ends in .svg; `-` is standard output (PNG)
    #[arg(short, long, value_name = "LAYOUT.svg|.png")]
    pub(crate) output: PathBuf,

    /// What the colours of the faces say
    #[arg(long, value_enum, default_value = "islands", help_heading = "Map")]
    pub(crate) style: LayoutStyle,
    /// The values at the ends of a heat map's scale, for comparing pictures: degrees, factors, or energies
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true, help_heading = "Map")]
    pub(crate) range: Option<[f64; 2]>,
    /// Draw the texels of an image with so many a side; of very small ones every 2nd, 4th, …
    #[arg(long, value_name = "N", value_parser = positive, allow_negative_numbers = true, help_heading = "Map")]
    pub(crate) texels: Option<f64>,
    /// Leave the edges of the faces away
    #[arg(long, help_heading = "Map")]
    pub(crate) no_edges: bool,
    /// Leave seams and outlines away; the two sides of a seam have one colour
    #[arg(long, help_heading = "Map")]
    pub(crate) no_seams: bool,

    #[command(flatten)]
    pub(crate) paper: PaperArgs,
}

/// What the colours of a layout can say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LayoutStyle {
    /// A colour for each island
    Islands,
    /// By how many degrees the corners of each face are off
    HeatAngle,
    /// Red where a face is too large in the map, blue where it is too small
    HeatArea,
    /// Symmetric Dirichlet energy of each face, 1 where lengths are kept
    HeatStretch,
    /// Nothing: one colour
    Plain,
}

impl LayoutStyle {
    pub(crate) fn measure(self) -> Option<Measure> {
        match self {
            Self::HeatAngle => Some(Measure::Angle),
            Self::HeatArea => Some(Measure::Area),
            Self::HeatStretch => Some(Measure::Stretch),
            _ => None,
        }
    }
}

/// What a surface can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StyleChoice {
    /// A checkerboard through the UVs: squares of one size where nothing is distorted
    Checker,
    /// By how many degrees the corners of each face are off
    HeatAngle,
    /// Red where a face is too large in the map, blue where it is too small
    HeatArea,
    /// Symmetric Dirichlet energy of each face, 1 where lengths are kept
    HeatStretch,
    /// A colour for each island of the map
    Islands,
    /// The faces themselves; needs no UVs
    Wire,
    /// Colours and images of the file's materials
    Material,
}

impl StyleChoice {
    pub(crate) fn measure(self) -> Option<Measure> {
        match self {
            Self::HeatAngle => Some(Measure::Angle),
            Self::HeatArea => Some(Measure::Area),
            Self::HeatStretch => Some(Measure::Stretch),
            _ => None,
        }
    }
}

/// Which axis can point up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UpChoice {
    Y,
    Z,
}

/// The longest side of a picture, in pixels.
const SIDE_LIMIT: usize = 16384;

fn size(text: &str) -> Result<[usize; 2], String> {
    let sides: Vec<usize> = text.split(['x', '×']).filter_map(|side| side.trim().parse().ok()).collect();
    match *sides.as_slice() {
        [w, h]
            if text.split(['x', '×']).count() == 2
                && [w, h].iter().all(|side| (16..=SIDE_LIMIT).contains(side)) =>
        {
            Ok([w, h])
        }
        _ => Err(format!("expected WIDTHxHEIGHT, each between 16 and {SIDE_LIMIT}, for example 1600x1200")),
    }
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let ends: Vec<f64> = text.split(',').filter_map(|end| end.trim().parse().ok()).collect();
    match *ends.as_slice() {
        [low, high] if low < high && low.is_finite() && high.is_finite() => Ok([low, high]),
        _ => Err("expected LOW,HIGH with LOW below HIGH, for example 0,20".into()),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if number > 0.0 && f64::is_finite(number) => Ok(number),
        _ => Err("expected a number above 0".into()),
    }
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if (1.0..=120.0).contains(&degrees) => Ok(degrees),
        _ => Err("expected degrees between 1 and 120".into()),
    }
}
