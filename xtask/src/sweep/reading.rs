//! Which methods are swept, and with which readings of the paper.

use qparam_cli::qembed::{BoundaryShape, Mixing, Weights};
use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qoptimize::direct::DescentOptions;
use qparam_cli::qoptimize::{Method, Options, parameterize};
use qparam_cli::qsimplify::{RemovalRule, SimplifyOptions};

/// A method that q moves.
#[derive(Clone, Debug)]
pub(super) struct Contender {
    pub(super) name: &'static str,
    pub(super) what: String,
    pub(super) way: Way,
}

/// The paper's method with a reading, or another method with its options.
#[derive(Clone, Debug)]
pub(super) enum Way {
    Paper(Reading),
    Other(Box<Options>),
}

impl Way {
    /// The options for one mesh.
    pub(super) fn options(&self, mesh: &QuadMesh) -> Result<Options, String> {
        match self {
            Self::Paper(reading) => reading.options(mesh),
            Self::Other(options) => Ok((**options).clone()),
        }
    }
}

/// What the paper leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    pub(super) rule: RemovalRule,
    pub(super) weights: Weights,
    pub(super) mixing: Mixing,
    pub(super) boundary: Boundary,
    pub(super) exponent: f64,
}

/// Where the boundary lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Boundary {
    Circle,
    Square,
    Projection,
    /// Where the least squares conformal map puts it.
    Lscm,
}

pub(super) const DEFAULT: Reading = Reading {
    rule: RemovalRule::Guarded,
    weights: Weights::Star4,
    mixing: Mixing::RowNormalized,
    boundary: Boundary::Circle,
    exponent: 1.0,
};

/// The reading under which most of Table 1 shows on the face and the head: the first of `cargo xtask sweep --search`.
pub(super) const BEST: Reading =
    Reading { rule: RemovalRule::All, weights: Weights::Star1, boundary: Boundary::Lscm, ..DEFAULT };

/// The methods that q moves, the default first.
pub(super) fn contenders() -> Vec<Contender> {
    let paper = |name, what: &str, reading: Reading| Contender {
        name,
        what: format!("{what}: {}", reading.words()),
        way: Way::Paper(reading),
    };
    let other = |name, what: &str, options| Contender {
        name,
        what: what.to_owned(),
        way: Way::Other(Box::new(options)),
    };
    let direct = tight(Method::Direct);
    let mut less_shape = direct.clone();
    less_shape.direct.shape = 0.1;
    vec![
        paper("paper", "the default reading", DEFAULT),
        paper(
            "paper, all",
            "the default reading with rule `all`, so that q acts on every interior vertex",
            Reading { rule: RemovalRule::All, ..DEFAULT },
        ),
        paper("paper, best", "the reading that shows most of Table 1", BEST),
        other(
            "direct",
            "minimisation of the errors themselves, with a free boundary and the default shape term",
            direct,
        ),
        other("direct, shape 0.1", "the same, nearer to the errors of Eqs. 13 and 14 alone", less_shape),
        other(
            "conformal",
            "the classical family q · MIPS + (1 − q) · (det + 1/det)/2, with a free boundary",
            tight(Method::Conformal),
        ),
    ]
}

/// Minimised so far that the digits of the tables are those of the minimum.
fn tight(method: Method) -> Options {
    let mut options = Options { method, ..Options::default() };
    options.direct.descent = DescentOptions { max_steps: 400, relative_decrease: 1e-9 };
    options
}

/// The methods that q does not move.
pub(super) const BASELINES: &[(Method, &str, &str)] = &[
    (Method::Uniform, "uniform", "Tutte 1963, circle"),
    (Method::MeanValue, "mean-value", "Floater 2003, circle"),
    (Method::Harmonic, "harmonic", "Eck et al. 1995, circle"),
    (Method::Lscm, "lscm", "Lévy et al. 2002, free boundary"),
];

impl Reading {
    /// In the words of the command line.
    pub(super) fn words(&self) -> String {
        let Self { rule, weights, mixing, boundary, exponent } = self;
        let rule = format!("{rule:?}").to_lowercase();
        let weights = format!("{weights:?}").to_lowercase();
        let boundary = match boundary {
            Boundary::Circle => "circle",
            Boundary::Square => "square",
            Boundary::Projection => "projection",
            Boundary::Lscm => "as in lscm",
        };
        let mixing = if *mixing == Mixing::Raw { ", mixing raw" } else { "" };
        // Nothing is left for Eq. 5 when all interior vertices go.
        let exponent = if rule == "all" { String::new() } else { format!(", r {exponent}") };
        format!("rule {rule}, weights {weights}, boundary {boundary}{exponent}{mixing}")
    }

    /// The options for one mesh.
    pub(super) fn options(&self, mesh: &QuadMesh) -> Result<Options, String> {
        let boundary = match self.boundary {
            Boundary::Circle => BoundaryShape::Circle,
            Boundary::Square => BoundaryShape::Square,
            Boundary::Projection => BoundaryShape::Projection,
            Boundary::Lscm => lscm_boundary(mesh)?,
        };
        Ok(Options {
            method: Method::Paper,
            boundary,
            weights: self.weights,
            mixing: self.mixing,
            exponent: self.exponent,
            simplify: SimplifyOptions { rule: self.rule, ..SimplifyOptions::default() },
            ..Options::default()
        })
    }
}

fn lscm_boundary(mesh: &QuadMesh) -> Result<BoundaryShape, String> {
    let options = Options { method: Method::Lscm, ..Options::default() };
    let map = parameterize(mesh, &options, &()).map_err(|error| error.to_string())?;
    let mut positions: Vec<_> = mesh
        .corners()
        .map(|corner| (mesh.vertex(corner), map.uv[corner]))
        .filter(|(vertex, _)| mesh.is_boundary(*vertex))
        .collect();
    positions.sort_by_key(|(vertex, _)| *vertex);
    positions.dedup_by_key(|(vertex, _)| *vertex);
    Ok(BoundaryShape::Fixed(positions))
}
