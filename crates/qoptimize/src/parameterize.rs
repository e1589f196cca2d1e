//! The whole way, one call: check, simplify, embed, remove overlaps, measure.

use std::borrow::Cow;
use std::ops::ControlFlow;

use qembed::qmesh::obj::UvPrecision;
use qembed::qmesh::{CornerData, Observer, QuadMesh, Vec2, VertexData, VertexId};
use qembed::qsimplify::{SimplifyOptions, simplify};
use qembed::qsolve::SolveOptions;
use qembed::{
    BoundaryShape, Classic, EmbedError, EmbedOptions, Embedding, Mixing, StageSolve, Weights, check_patch,
    embed, embed_classic,
};

use crate::certificate::{Certificate, judge};
use crate::direct::{self, Continuation, DirectOptions, DirectReport, Objective, Wishes};
use crate::distortion::Distortion;
use crate::error::ParameterizeError;
use crate::overlap::{OverlapOptions, OverlapReport, remove_overlaps};
use crate::rounding::{self, Rounding};
use crate::timely;

/// Which way to a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Method {
    /// The errors themselves minimised over injective maps with a free boundary: see [`crate::direct`].
    #[default]
    Direct,
    /// The paper's stages.
    Paper,
    /// `q · MIPS + (1 − q) · (det + 1/det)/2` in the same way.
    Conformal,
    /// Tutte 1963.
    Uniform,
    /// Floater 2003.
    MeanValue,
    /// Eck et al. 1995.
    Harmonic,
    /// Lévy et al. 2002.
    Lscm,
}

impl Method {
    /// Whether it minimises an energy by Newton steps: [`Direct`](Self::Direct) and [`Conformal`](Self::Conformal).
    #[must_use]
    pub fn minimizes(self) -> bool {
        matches!(self, Self::Direct | Self::Conformal)
    }

    /// Whether the boundary is free when nothing else is asked for.
    #[must_use]
    pub fn has_free_boundary(self) -> bool {
        self.minimizes() || self == Self::Lscm
    }
}

/// Everything that can be chosen.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Options {
    /// Default `Direct`.
    pub method: Method,
    /// 1 angle-true (conformal), 0 area-true (authalic). Default 0.6: on every mesh of the
    /// league table no worse than the rivals that minimise symmetric Dirichlet, in angles, areas and stretch alike.
    pub q: f64,
    /// Default `Auto`: free for [`Method::Direct`], [`Method::Conformal`] and [`Method::Lscm`], the circle for the others.
    pub boundary: BoundaryShape,
    /// Vertices with the places that they are to take exactly, for [`Method::Direct`] and [`Method::Conformal`]. One pin moves the
    /// normalised map; with two or more there is no normalisation. Default none.
    pub pins: Vec<(VertexId, Vec2)>,
    /// Whether the map is to be exactly as symmetric as the mesh, mirrored at a line of constant u, for [`Method::Direct`] and
    /// [`Method::Conformal`] with a free boundary. Refused when there is no mirror symmetry. Default false.
    pub symmetric: bool,
    /// Section 2.1.
    pub simplify: SimplifyOptions,
    /// `r` of Eq. 5. Default 1.
    pub exponent: f64,
    /// Weights of Eqs. 6 and 8. Default `Star4`.
    pub weights: Weights,
    /// How Eq. 10 mixes. Default `RowNormalized`.
    pub mixing: Mixing,
    /// Section 2.4; `None` leaves overlaps as they are. Classic methods always do: they are there to compare with.
    pub overlaps: Option<OverlapOptions>,
    /// What [`Method::Direct`] and [`Method::Conformal`] need besides `q`.
    pub direct: DirectOptions,
    /// How linear systems are solved.
    pub solve: SolveOptions,
    /// Whether the UVs are moved and scaled so that their bounding box starts at 0 and its longer side is 1. Default true;
    /// not done for `BoundaryShape::Fixed` and with two or more pins.
    pub normalize: bool,
    /// What the UVs are rounded to in the end, before they are measured and certified. Default `Double`: nothing.
    pub precision: UvPrecision,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            method: Method::default(),
            q: 0.6,
            boundary: BoundaryShape::default(),
            pins: Vec::new(),
            symmetric: false,
            simplify: SimplifyOptions::default(),
            exponent: 1.0,
            weights: Weights::default(),
            mixing: Mixing::default(),
            overlaps: Some(OverlapOptions::default()),
            direct: DirectOptions::default(),
            solve: SolveOptions::default(),
            normalize: true,
            precision: UvPrecision::default(),
        }
    }
}

/// A map with its measures and the record of how it came about.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Parameterization {
    /// One UV per corner.
    pub uv: CornerData<Vec2>,
    /// How good it is.
    pub distortion: Distortion,
    /// Whether it is proven free of overlaps, and else where not; a hundred violations of each kind are listed.
    pub certificate: Certificate,
    /// How it came about.
    pub record: RunRecord,
}

/// What ran, with which reading of the paper, and what it met.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct RunRecord {
    /// Interior vertices before simplification.
    pub interior_vertices: usize,
    /// Interior vertices on the removed side of the threshold.
    pub removal_candidates: usize,
    /// Vertices removed by section 2.1 (0 for classic methods).
    pub removed_vertices: usize,
    /// Kept vertices that were cut off from the boundary.
    pub cut_off_vertices: usize,
    /// Negative weights that were met.
    pub negative_weights: usize,
    /// The linear systems.
    pub solves: Vec<StageSolve>,
    /// Overlap removal, when it ran.
    pub overlaps: Option<OverlapReport>,
    /// Start and descent, when a method minimised an energy.
    pub direct: Option<DirectReport>,
    /// What rounding to single precision did, when it was asked for.
    pub rounding: Option<Rounding>,
}

/// The whole way: section 2 of the paper, or a classic baseline, with measures.
///
/// The mesh must be a planar patch: a disk, or a disk with holes. The UVs are one per corner, and equal at all corners of a vertex. The internal unit of
/// length is a power of two near the size of the mesh, so meshes of any size are mapped alike, except with
/// [`Mixing::Raw`], whose very point is that it depends on the unit.
///
/// The observer hears of one stage after the other, each from 0 to 1: those of [`simplify`] and [`embed`] (or
/// [`embed_classic`]), then `"overlaps"` with [`Method::Paper`], then `"measure"`.
///
/// When the observer [is late](Observer::is_late), [`Method::Direct`] and [`Method::Conformal`] end start and descent with the map at hand
/// ([`Stop::Cancelled`](crate::direct::Stop::Cancelled)), which is as valid as any other.
///
/// Overlaps may remain: [`Parameterization::certificate`] proves that there are none, or names them.
///
/// # Errors
/// What is wrong with the options or why the mesh is no disk; a linear system without an acceptable answer; cancelled
/// by the observer, or late before there was a map. See [`ParameterizeError`].
pub fn parameterize(
    mesh: &QuadMesh,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Parameterization, ParameterizeError> {
    parameterize_from(&mut Continuation::for_one(), mesh, options, observer)
}

/// The same for several settings, one after the other: [`Method::Direct`] and [`Method::Conformal`] with a free boundary start each
/// map from the one before, which makes a sweep over q a fraction of as many single maps. A map may differ from that of
/// [`parameterize`] within the tolerance of its descent, or lie in another valley.
///
/// `mesh` is to be the same in all calls with one `continuation`.
///
/// # Errors
/// As [`parameterize`].
pub fn parameterize_from(
    continuation: &mut Continuation,
    mesh: &QuadMesh,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Parameterization, ParameterizeError> {
    options.check()?;
    check_patch(mesh)?;
    let (uv, mut record) = timely::within(observer, |observer| {
        let mesh = &in_own_unit(mesh, options.mixing);
        match options.method {
            Method::Paper => paper(mesh, options, observer),
            Method::Direct | Method::Conformal => direct(continuation, mesh, options, observer),
            Method::Uniform => classic(mesh, Classic::Uniform, options, observer),
            Method::MeanValue => classic(mesh, Classic::MeanValue, options, observer),
            Method::Harmonic => classic(mesh, Classic::Harmonic, options, observer),
            Method::Lscm => classic(mesh, Classic::Lscm, options, observer),
        }
    })?;
    let mut uv = mesh.to_corners(&uv);
    watch(observer, 0.0)?;
    record.rounding = rounding::to_precision(mesh.view(), &mut uv, options.precision)?;
    // From inside the pool, where short parallel loops do not have to wake it first.
    let (distortion, certificate) = rayon::scope(|_| judge(mesh.view(), &uv, rounding::LISTED))?;
    watch(observer, 1.0)?;
    Ok(Parameterization { uv, distortion, certificate, record })
}

impl Options {
    /// Whether the boundary is left to the method: nothing holds it.
    #[must_use]
    pub fn is_boundary_free(&self) -> bool {
        match self.boundary {
            BoundaryShape::Auto | BoundaryShape::Free => self.method.has_free_boundary(),
            _ => self.method == Method::Lscm,
        }
    }

    pub(crate) fn check(&self) -> Result<(), ParameterizeError> {
        if !(0.0..=1.0).contains(&self.q) {
            return Err(EmbedError::BadMix(self.q).into());
        }
        if !(self.exponent >= 0.0 && self.exponent.is_finite()) {
            return Err(EmbedError::BadExponent(self.exponent).into());
        }
        self.direct.check()?;
        if !self.pins.is_empty() && !self.method.minimizes() {
            return Err(ParameterizeError::OtherMethod("pins"));
        }
        if self.symmetric && !self.method.minimizes() {
            return Err(ParameterizeError::OtherMethod("symmetric maps"));
        }
        self.overlaps.as_ref().map_or(Ok(()), OverlapOptions::check)
    }
}

fn watch(observer: &dyn Observer, fraction: f64) -> Result<(), ParameterizeError> {
    match observer.progress("measure", fraction) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(ParameterizeError::Cancelled),
    }
}

/// The mesh with a longest side of its bounding box that is neither huge nor tiny, so that powers of lengths and areas
/// stay in the range of `f64`. A power of two rounds nothing.
fn in_own_unit(mesh: &QuadMesh, mixing: Mixing) -> Cow<'_, QuadMesh> {
    const NEAR_ONE: std::ops::Range<f64> = 1e-3..1e3;
    let positions = mesh.positions();
    let low = positions.iter().copied().reduce(|a, b| a.inf(&b));
    let high = positions.iter().copied().reduce(|a, b| a.sup(&b));
    let extent = low.zip(high).map_or(0.0, |(low, high)| (high - low).max());
    if mixing == Mixing::Raw || extent == 0.0 || NEAR_ONE.contains(&extent) {
        return Cow::Borrowed(mesh);
    }
    // In two steps: the factor that brings subnormal positions near one is itself too large for `f64`.
    let exponent = -extent.log2().floor();
    let half = (exponent / 2.0).floor();
    let (first, second) = (half.exp2(), (exponent - half).exp2());
    let scaled = mesh.vertex_data(|vertex| mesh.position(vertex) * first * second);
    Cow::Owned(mesh.clone().with_positions(scaled))
}

type Placed = (VertexData<Vec2>, RunRecord);

/// Sections 2.1 to 2.4. Holes are filled all the way, so that their rims may be removed and move like other vertices.
fn paper(patch: &QuadMesh, options: &Options, observer: &dyn Observer) -> Result<Placed, ParameterizeError> {
    let filled = patch.filled();
    let mesh = filled.as_ref().unwrap_or(patch);
    let simplified = simplify(mesh, &options.simplify, observer)?;
    let embed_options = EmbedOptions {
        q: options.q,
        boundary: options.boundary.clone(),
        exponent: options.exponent,
        weights: options.weights,
        mixing: options.mixing,
        solve: options.solve,
    };
    let mut embedding = embed(mesh, &simplified, &embed_options, observer)?;
    // First, because it rounds: what is mended afterwards stays mended.
    normalize(&mut embedding.uv, options);
    let overlaps = match &options.overlaps {
        Some(overlap_options) => Some(remove_overlaps(mesh, &mut embedding.uv, overlap_options, observer)?),
        None => None,
    };
    let mut record = RunRecord::new(patch, &embedding);
    record.removal_candidates = simplified.candidates;
    record.removed_vertices = simplified.removed.len();
    record.overlaps = overlaps;
    let mut uv = embedding.uv.into_vec();
    uv.truncate(patch.vertex_count());
    let mut uv = VertexData::from_vec(uv);
    normalize(&mut uv, options);
    Ok((uv, record))
}

/// A start, and the descent from it.
fn direct(
    continuation: &mut Continuation,
    mesh: &QuadMesh,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Placed, ParameterizeError> {
    let objective = match options.method {
        Method::Conformal => Objective::Conformal { q: options.q },
        _ => Objective::Direct {
            q: options.q,
            shape: options.direct.shape,
            angle_term: options.direct.angle_term,
        },
    };
    let wishes = Wishes { boundary: &options.boundary, pins: &options.pins, symmetric: options.symmetric };
    let (mut uv, report) =
        direct::embed_from(continuation, mesh, &objective, &wishes, &options.direct.descent, observer)?;
    let exact = mesh.to_corners(&uv);
    normalize(&mut uv, options);
    if let [(vertex, place)] = options.pins[..] {
        let shift = place - uv[vertex];
        uv.iter_mut().for_each(|p| *p += shift);
        uv[vertex] = place;
    }
    // Corners that the descent has left thinner than a unit in the last place may turn over.
    let mut corners = mesh.to_corners(&uv);
    if rounding::mend(mesh.view(), &exact, &mut corners, UvPrecision::Double).moved_points > 0 {
        mesh.corners().for_each(|corner| uv[mesh.vertex(corner)] = corners[corner]);
    }
    let record = RunRecord {
        interior_vertices: interior_vertices(mesh),
        direct: Some(report),
        ..RunRecord::default()
    };
    Ok((uv, record))
}

fn classic(
    mesh: &QuadMesh,
    method: Classic,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Placed, ParameterizeError> {
    let mut embedding = embed_classic(mesh, method, &options.boundary, &options.solve, observer)?;
    normalize(&mut embedding.uv, options);
    let record = RunRecord::new(mesh, &embedding);
    Ok((embedding.uv, record))
}

impl RunRecord {
    fn new(mesh: &QuadMesh, embedding: &Embedding) -> Self {
        Self {
            interior_vertices: interior_vertices(mesh),
            removal_candidates: 0,
            removed_vertices: 0,
            cut_off_vertices: embedding.cut_off,
            negative_weights: embedding.negative_weights,
            solves: embedding.solves.clone(),
            overlaps: None,
            direct: None,
            rounding: None,
        }
    }
}

fn interior_vertices(mesh: &QuadMesh) -> usize {
    mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).count()
}

/// Moves and scales the UVs so that their bounding box starts at 0 and its longer side is 1. Not to be done to UVs
/// whose boundary the caller has placed. Done twice, it changes nothing the second time.
fn normalize(uv: &mut VertexData<Vec2>, options: &Options) {
    let is_held = options.method != Method::Lscm && matches!(options.boundary, BoundaryShape::Fixed(_));
    let is_placed = is_held || options.pins.len() > 1;
    let low = uv.iter().copied().reduce(|a, b| a.inf(&b));
    let high = uv.iter().copied().reduce(|a, b| a.sup(&b));
    let Some((low, high)) = low.zip(high) else { return };
    let longer = (high - low).max();
    // A map onto one point stays as it is: measuring it says so.
    if !options.normalize || is_placed || longer <= 0.0 || !longer.is_finite() {
        return;
    }
    if options.symmetric && low.x == -high.x {
        let half = on_grid(high.x / longer);
        uv.iter_mut().for_each(|p| *p = Vec2::new(half + on_grid(p.x / longer), (p.y - low.y) / longer));
    } else {
        uv.iter_mut().for_each(|p| *p = (*p - low) / longer);
    }
}

/// The nearest multiple of 2⁻⁵²: sums of two such numbers up to 1 are exact, so what was mirrored at 0 is mirrored at `half`.
fn on_grid(x: f64) -> f64 {
    (x / f64::EPSILON).round() * f64::EPSILON
}
