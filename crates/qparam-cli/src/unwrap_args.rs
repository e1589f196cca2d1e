//! The options of `qparam unwrap`, and the library options that they stand for.

use std::path::PathBuf;

use clap::{ArgAction, Args};
use qoptimize::direct::DescentOptions;
use qoptimize::qembed::BoundaryShape;
use qoptimize::qmesh::obj::UvPrecision;
use qoptimize::qsimplify::{SimplifyOptions, Threshold};
use qoptimize::qsolve::SolveOptions;
use qoptimize::{DirectOptions, Method, Options, OverlapOptions};

use crate::choices::{
    AngleChoice, AreaChoice, BackendChoice, BoundaryChoice, MeasureChoice, MethodChoice, MixingChoice,
    OrderChoice, PrecisionChoice, PresetChoice, RuleChoice, SideChoice, WeightsChoice,
};
use crate::exit::{self, Exit};
use crate::failure::Failure;
use crate::layout_args::LayoutArgs;
use crate::pins::{self, PinArg};

/// Compute UVs and write them into a copy of the file.
#[derive(Args, Clone, Debug)]
#[command(after_help = exit::TABLE, after_long_help = format!("{CONFIGURATION}\n\n{}", exit::TABLE))]
pub(crate) struct UnwrapArgs {
    /// The quad mesh, an OBJ file; `-` is standard input
    #[arg(value_name = "IN.obj")]
    pub(crate) input: PathBuf,
    /// Where the mesh with its UVs goes; `-` is standard output (the report then goes to standard error)
    ///
    /// Default: `IN_uv.obj` beside the input; standard output when the input is standard input. May be the
    /// input itself. A file that exists is replaced as a whole, or not at all.
    #[arg(short, long, value_name = "OUT.obj", help_heading = "Files")]
    pub(crate) output: Option<PathBuf>,
    /// Also write the simplified polygon mesh of section 2.1, for looking at it
    #[arg(long, value_name = "FILE.obj", help_heading = "Files")]
    pub(crate) simplified: Option<PathBuf>,
    /// Also write a page to look at the map: one HTML file that needs no network. It has maps for other q, too, which
    /// are computed for it
    #[arg(long, value_name = "REPORT.html", help_heading = "Files")]
    pub(crate) report: Option<PathBuf>,
    /// The values of q on that page [default: 11 from 1 to 0; for large meshes 5, or 3]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = unit, allow_negative_numbers = true,
        requires = "report", help_heading = "Files")]
    pub(crate) report_q: Option<Vec<f64>>,

    /// 1 is angle-true (conformal), 0 is area-true (authalic) (Eq. 10)
    #[arg(long, value_name = "0..1", default_value = "0.6", value_parser = unit, allow_negative_numbers = true, help_heading = "Method")]
    pub(crate) q: f64,
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) layout: LayoutArgs,
    /// What the UVs are rounded to before they are certified and written
    #[arg(long, value_enum, default_value = "f64", help_heading = "Files")]
    pub(crate) uv_precision: PrecisionChoice,

    /// Put this vertex (numbered from 1, as in the file) exactly there; once per vertex (direct, conformal)
    ///
    /// One pin moves the map; two also turn and scale it; more bend it, or are refused where that would need a flip. With two or more, the
    /// UVs are not fitted to the unit square.
    #[arg(long, value_name = "V=u,v", value_parser = pins::parse, allow_hyphen_values = true, help_heading = "Method")]
    pub(crate) pin: Vec<PinArg>,
    /// More pins: a file with lines `vertex u v`
    #[arg(long, value_name = "FILE", help_heading = "Method")]
    pub(crate) pins: Option<PathBuf>,

    /// After so many seconds, write the best map so far
    ///
    /// Counted from the start of the command. A descent ends with the map at hand, which is certified like any other, and the exit code is 8; of
    /// several islands those that have no map yet are left with their convex start. Where there is no map at all, the exit
    /// code is 9. Measuring and writing come on top, and the maps that --report adds.
    #[arg(long, value_name = "SECONDS", value_parser = not_negative, allow_negative_numbers = true, help_heading = "Method")]
    pub(crate) time_limit: Option<f64>,

    /// Name this many of the worst faces, each with what forces it
    #[arg(
        long,
        value_name = "N",
        default_value = "5",
        allow_negative_numbers = true,
        help_heading = "Report"
    )]
    pub(crate) worst: usize,
    /// Print the report as JSON
    #[arg(long, action = ArgAction::SetTrue, help_heading = "Report")]
    pub(crate) json: bool,
    /// Print nothing but errors
    #[arg(long, action = ArgAction::SetTrue, conflicts_with = "json", help_heading = "Report")]
    pub(crate) quiet: bool,
}

// No doc comment: clap would make it the description of the commands. The options that `unwrap` and `sweep` share;
// `q` is not among them, since one has one value and the other several.
#[derive(Args, Clone, Debug)]
pub(crate) struct MapArgs {
    /// Defaults for these options (else qparam.toml here, else qparam/config.toml among the user's settings)
    #[arg(long, value_name = "FILE.toml", help_heading = "Files", conflicts_with = "no_config")]
    pub(crate) config: Option<PathBuf>,
    /// Read no configuration file
    #[arg(long, help_heading = "Files")]
    pub(crate) no_config: bool,

    /// Method, q, shape and angle term for a purpose; each of them can still be given by itself
    #[arg(long, value_enum, help_heading = "Method")]
    pub(crate) preset: Option<PresetChoice>,
    /// Which way to a map
    #[arg(long, value_enum, default_value = "direct", help_heading = "Method")]
    pub(crate) method: MethodChoice,
    /// Where the boundary goes; holes keep free rims
    #[arg(long, value_enum, default_value = "auto", help_heading = "Method")]
    pub(crate) boundary: BoundaryChoice,
    /// Positions for --boundary fixed: an OBJ with UVs on the same vertices, or lines `vertex u v` (from 1)
    #[arg(long, value_name = "FILE", help_heading = "Method")]
    pub(crate) boundary_uv: Option<PathBuf>,
    /// Map a symmetric mesh exactly symmetrically; refused when it has no mirror plane (direct, conformal)
    ///
    /// Partners get the same v, and values of u whose sum is the same for all of them, to the last bit.
    #[arg(long, help_heading = "Method")]
    pub(crate) symmetric: bool,
    /// Leave the UVs in the units of the method instead of fitting them to the unit square
    #[arg(long, help_heading = "Method")]
    pub(crate) no_normalize: bool,

    /// What keeps the simplified mesh fit for the global embedding
    #[arg(long, value_enum, default_value = "guarded", help_heading = "Simplification (section 2.1)")]
    pub(crate) rule: RuleChoice,
    /// This fraction of the interior vertices are candidates for removal
    #[arg(long, value_name = "0..1", default_value = "0.5", value_parser = unit, allow_negative_numbers = true,
        help_heading = "Simplification (section 2.1)")]
    pub(crate) remove_fraction: f64,
    /// Instead of a fraction: vertices whose curvature lies below this value are candidates
    #[arg(long, value_name = "X", value_parser = not_negative, allow_negative_numbers = true, conflicts_with = "remove_fraction",
        help_heading = "Simplification (section 2.1)")]
    pub(crate) remove_below: Option<f64>,
    /// Which curvature decides
    #[arg(long, value_enum, default_value = "normalized", help_heading = "Simplification (section 2.1)")]
    pub(crate) curvature: MeasureChoice,
    /// Which area the curvature of a vertex is divided by (Eq. 2)
    #[arg(long, value_enum, default_value = "voronoi", help_heading = "Simplification (section 2.1)")]
    pub(crate) area: AreaChoice,
    /// Which side of the threshold is removed
    #[arg(long, value_enum, default_value = "low", help_heading = "Simplification (section 2.1)")]
    pub(crate) side: SideChoice,

    /// Exponent r of the edge lengths in the global embedding (Eq. 5)
    #[arg(long, value_name = "R", default_value = "1", value_parser = not_negative, allow_negative_numbers = true,
        help_heading = "Embedding (sections 2.2 and 2.3)")]
    pub(crate) exponent: f64,
    /// Edge weights of the local embedding (Eqs. 6 and 8)
    #[arg(long, value_enum, default_value = "star4", help_heading = "Embedding (sections 2.2 and 2.3)")]
    pub(crate) weights: WeightsChoice,
    /// How Eq. 10 mixes the conformal and the authalic weights
    #[arg(
        long,
        value_enum,
        default_value = "row-normalized",
        help_heading = "Embedding (sections 2.2 and 2.3)"
    )]
    pub(crate) mixing: MixingChoice,

    /// Leave overlaps as they are
    #[arg(long, help_heading = "Overlap removal (section 2.4)")]
    pub(crate) no_overlap_removal: bool,
    /// λ1 of Eq. 11, for the immediate one-ring; 0 < λ1 + λ2 < 1
    #[arg(long, value_name = "L", default_value = "0.6", value_parser = unit, allow_negative_numbers = true,
        help_heading = "Overlap removal (section 2.4)")]
    pub(crate) lambda1: f64,
    /// λ2 of Eq. 11, for the diagonal one-ring
    #[arg(long, value_name = "L", default_value = "0.3", value_parser = unit, allow_negative_numbers = true,
        help_heading = "Overlap removal (section 2.4)")]
    pub(crate) lambda2: f64,
    /// In which order overlapping vertices move
    #[arg(long, value_enum, default_value = "worst-first", help_heading = "Overlap removal (section 2.4)")]
    pub(crate) order: OrderChoice,
    /// Moves at most, as a multiple of the number of vertices
    #[arg(long, value_name = "N", default_value = "20", value_parser = not_negative, allow_negative_numbers = true,
        help_heading = "Overlap removal (section 2.4)")]
    pub(crate) max_moves: f64,

    /// Weight of the symmetric Dirichlet term (direct): more evens out all stretch, less lets quads stretch along their edges
    #[arg(long, value_name = "C", default_value = "1", value_parser = not_negative, allow_negative_numbers = true,
        help_heading = "Minimisation (direct, conformal)")]
    pub(crate) shape: f64,
    /// How angles are compared (direct)
    #[arg(long, value_enum, default_value = "log", help_heading = "Minimisation (direct, conformal)")]
    pub(crate) angle_term: AngleChoice,
    /// Newton steps at most
    #[arg(
        long,
        value_name = "N",
        default_value = "200",
        allow_negative_numbers = true,
        help_heading = "Minimisation (direct, conformal)"
    )]
    pub(crate) max_steps: usize,
    /// Stop when a step promises to lower the energy by less than this fraction
    #[arg(long, value_name = "R", default_value = "1e-5", value_parser = not_negative, allow_negative_numbers = true,
        help_heading = "Minimisation (direct, conformal)")]
    pub(crate) relative_decrease: f64,

    /// What solves the linear systems
    #[arg(long, value_enum, default_value = "auto", help_heading = "Linear systems")]
    pub(crate) backend: BackendChoice,
    /// Refuse a solution with a larger relative residual
    #[arg(long, value_name = "R", default_value = "1e-8", value_parser = positive, allow_negative_numbers = true,
        help_heading = "Linear systems")]
    pub(crate) residual_bound: f64,
    /// Iterations at most, for the iterative backend
    #[arg(
        long,
        value_name = "N",
        default_value = "2000",
        allow_negative_numbers = true,
        help_heading = "Linear systems"
    )]
    pub(crate) max_iterations: usize,
    /// Threads; 0 takes one per processor. The result is the same for any number
    #[arg(long, value_name = "N", default_value = "0", value_parser = thread_count, allow_negative_numbers = true,
        help_heading = "Linear systems")]
    pub(crate) threads: usize,
}

const CONFIGURATION: &str = "\
Configuration file:
  Defaults for the options above, one `name = value` a line, without the dashes:
      q = 0.8
      boundary = \"square\"
      no-overlap-removal = true
  Read from --config FILE, else from qparam.toml in the working directory, else from
  $XDG_CONFIG_HOME/qparam/config.toml (~/.config when that is not set). The command line wins.";

impl UnwrapArgs {
    /// The library's options. A fixed boundary is still empty: its file has not been read.
    pub(crate) fn options(&self) -> Result<Options, Failure> {
        let options = Options { precision: self.uv_precision.into(), ..self.map.options(self.q)? };
        let has_pins = !self.pin.is_empty() || self.pins.is_some();
        if has_pins && !options.method.minimizes() {
            return Err(Failure::new(Exit::Usage, "--pin, --pins: this method cannot hold pins")
                .help("use --method direct or conformal"));
        }
        if !self.layout.keep_uv.is_empty() && !options.method.minimizes() {
            return Err(Failure::new(Exit::Usage, "--keep-uv: this method cannot hold UVs")
                .help("use --method direct or conformal"));
        }
        let arranged = self.layout.up.is_some() || self.layout.no_pack;
        if arranged && (has_pins || options.symmetric) {
            return Err(Failure::new(
                Exit::Usage,
                "--up and --no-pack move the map, which pins and --symmetric place already",
            )
            .help("leave --up and --no-pack out"));
        }
        let placed = has_pins || options.symmetric || self.map.boundary == BoundaryChoice::Fixed;
        if placed && self.layout.max_stretch.is_some() {
            return Err(Failure::new(
                Exit::Usage,
                "--max-stretch cuts further; pins, --symmetric and --boundary fixed belong to the island as it is",
            )
            .help("leave --max-stretch out, or cut with --seams FILE first"));
        }
        if has_pins && options.symmetric {
            return Err(Failure::new(Exit::Usage, "--symmetric and pins exclude each other")
                .help("leave one of the two out"));
        }
        if self.map.method != MethodChoice::Paper && self.simplified.is_some() {
            return Err(Failure::new(Exit::Usage, "--simplified: only the method `paper` simplifies")
                .help("leave --simplified out, or use --method paper"));
        }
        Ok(options)
    }
}

impl MapArgs {
    /// The library's options with this `q`. A fixed boundary is still empty: its file has not been read.
    pub(crate) fn options(&self, q: f64) -> Result<Options, Failure> {
        self.check()?;
        let threshold = match self.remove_below {
            Some(value) => Threshold::Value(value),
            None => Threshold::Fraction(self.remove_fraction),
        };
        let overlaps = OverlapOptions {
            lambda1: self.lambda1,
            lambda2: self.lambda2,
            order: self.order.into(),
            max_moves_per_vertex: self.max_moves,
        };
        Ok(Options {
            method: self.method.into(),
            q,
            boundary: match self.boundary {
                BoundaryChoice::Auto => BoundaryShape::Auto,
                BoundaryChoice::Free => BoundaryShape::Free,
                BoundaryChoice::Circle => BoundaryShape::Circle,
                BoundaryChoice::Square => BoundaryShape::Square,
                BoundaryChoice::Projection => BoundaryShape::Projection,
                BoundaryChoice::Fixed => BoundaryShape::Fixed(Vec::new()),
            },
            simplify: SimplifyOptions {
                rule: self.rule.into(),
                measure: self.curvature.into(),
                area: self.area.into(),
                threshold,
                side: self.side.into(),
            },
            exponent: self.exponent,
            weights: self.weights.into(),
            mixing: self.mixing.into(),
            overlaps: (!self.no_overlap_removal).then_some(overlaps),
            solve: SolveOptions {
                backend: self.backend.into(),
                residual_bound: self.residual_bound,
                max_iterations: self.max_iterations,
            },
            direct: DirectOptions {
                shape: self.shape,
                angle_term: self.angle_term.into(),
                descent: DescentOptions {
                    max_steps: self.max_steps,
                    relative_decrease: self.relative_decrease,
                },
            },
            pins: Vec::new(),
            symmetric: self.symmetric,
            normalize: !self.no_normalize,
            precision: UvPrecision::default(),
        })
    }

    /// What no single option shows.
    fn check(&self) -> Result<(), Failure> {
        let refuse = |message: String, help: &str| Err(Failure::new(Exit::Usage, message).help(help));
        let sum = self.lambda1 + self.lambda2;
        let in_range = sum > 0.0 && sum < 1.0;
        if !self.no_overlap_removal && !in_range {
            return refuse(
                format!("--lambda1 {} and --lambda2 {} add up to {sum}", self.lambda1, self.lambda2),
                "Eq. 11 needs 0 < λ1 + λ2 < 1, for example --lambda1 0.6 --lambda2 0.3",
            );
        }
        if self.boundary == BoundaryChoice::Free && !Method::from(self.method).has_free_boundary() {
            return refuse(
                "--boundary free: this method needs positions for the boundary".into(),
                "use --method direct, conformal or lscm, or leave --boundary out",
            );
        }
        if self.symmetric && !Method::from(self.method).minimizes() {
            return refuse(
                "--symmetric: this method cannot keep a symmetry exactly".into(),
                "use --method direct or conformal",
            );
        }
        if self.symmetric && !matches!(self.boundary, BoundaryChoice::Auto | BoundaryChoice::Free) {
            return refuse(
                "--symmetric needs a free boundary".into(),
                "leave --boundary out, or leave --symmetric out",
            );
        }
        match (self.boundary, &self.boundary_uv) {
            (BoundaryChoice::Fixed, None) => refuse(
                "--boundary fixed needs the positions of the boundary vertices".into(),
                "name a file with --boundary-uv FILE: an OBJ with UVs, or lines `vertex u v`",
            ),
            (choice, Some(_)) if choice != BoundaryChoice::Fixed => refuse(
                "--boundary-uv has no effect without --boundary fixed".into(),
                "add --boundary fixed, or leave --boundary-uv out",
            ),
            _ => Ok(()),
        }
    }
}

fn number(text: &str, accept: impl Fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if accept(value) => Ok(value),
        _ => Err(format!("expected {expected}")),
    }
}

pub(crate) fn unit(text: &str) -> Result<f64, String> {
    number(text, |x| (0.0..=1.0).contains(&x), "a number between 0 and 1")
}

pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    number(text, |x| x >= 0.0 && x.is_finite(), "a number of at least 0")
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    number(text, |x| x > 0.0 && x.is_finite(), "a number above 0")
}

fn thread_count(text: &str) -> Result<usize, String> {
    const LIMIT: usize = 1024;
    match text.parse() {
        Ok(count) if count <= LIMIT => Ok(count),
        _ => Err(format!("expected a number of threads up to {LIMIT}")),
    }
}

#[cfg(test)]
mod tests;
