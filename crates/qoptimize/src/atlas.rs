//! The whole way for any polygons: charts, a map of each, and a layout.
//!
//! [`unwrap`] makes oriented manifold pieces of whatever comes ([`qmesh::charts`](qembed::qmesh::charts)), cuts open what cannot be
//! flattened ([`qcurv::seams`](qembed::qcurv::seams)), maps every piece by itself and in parallel ([`parameterize`](crate::parameterize())), turns it
//! upright, scales it to its density, and packs all into the unit square ([`crate::pack`]). A mesh that is one planar
//! patch already comes out as [`parameterize`](crate::parameterize()) maps it, unless an upright axis is asked for.
//!
//! A piece for which the method fails (a boundary shape that does not fit it, a surface of no area) is mapped by
//! [`Method::Direct`](crate::Method::Direct), and if that fails too, by the convex start alone; [`Island::fallback`] says why. Only when the one
//! piece there is fails, it is an error.

mod keep;
mod layout;
mod measures;
mod options;
mod refine;
mod solve;
mod stretch;
mod upright;

pub use keep::kept_seams;
pub use measures::consistent;
pub use options::{AtlasError, AtlasOptions, Density, UpAxis};
pub use refine::{Cut, Refinement, RefinementEnd};
pub use stretch::{StretchMeasure, stretch};

use qembed::qcurv::seams::{Interrupted, opening};
use qembed::qmesh::{COORDINATE_LIMIT, Chart, Observer, PolygonView, Polygons, Repairs, Seams, Vec2, charts};
use rayon::prelude::*;

use self::solve::Solved;
use crate::certificate::{Certificate, judge};
use crate::direct::Continuation;
use crate::distortion::Distortion;
use crate::parameterize::RunRecord;
use crate::rounding::{LISTED, Rounding, to_precision};

/// UVs of any polygons, and how they came about.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Atlas {
    /// One UV per corner of the polygons.
    pub uv: Vec<Vec2>,
    /// The islands, by first face.
    pub islands: Vec<Island>,
    /// Their charts, cut further where that was asked for and needed.
    pub charts: Vec<Chart>,
    /// How good the whole is, each island with the orientation of its chart.
    pub distortion: Distortion,
    /// The proof that nothing overlaps, or what is in the way; in the numbers of the polygons.
    pub certificate: Certificate,
    /// What had to be mended in the polygons.
    pub repairs: Repairs,
    /// Edges with several faces that lie apart in the map, and their length in space.
    pub seams: SeamLength,
    /// The layout, when there was one to make.
    pub layout: Option<Layout>,
    /// The faces that are turned over in their chart, ascending.
    pub turned_faces: Vec<u32>,
    /// What rounding to single precision did to the whole, when it was asked for; in the numbers of the polygons.
    pub rounding: Option<Rounding>,
}

impl Atlas {
    /// The polygons and their UVs with the faces turned over that run against their neighbours: what measures and certificates
    /// are about.
    #[must_use]
    pub fn oriented(&self, polygons: PolygonView<'_>) -> (Polygons, Vec<Vec2>) {
        measures::oriented(polygons, &self.turned_faces, &self.uv)
    }
}

/// How much was cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SeamLength {
    /// How many edges.
    pub edges: usize,
    /// Their length in space.
    pub length: f64,
}

/// One island.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Island {
    /// Its first face in the polygons.
    pub first_face: u32,
    /// How many faces it has.
    pub faces: usize,
    /// Its boundary loops: one, and one for each hole.
    pub boundary_loops: usize,
    /// Its area in space.
    pub area: f64,
    /// Its area in the plane.
    pub uv_area: f64,
    /// What 99 % of its area stays below in stretch: see [`stretch`].
    pub stretch: f64,
    /// Area-weighted mean symmetric Dirichlet energy; 1 for an isometry.
    pub symmetric_dirichlet: Option<f64>,
    /// Corners that do not turn left.
    pub flipped_corners: usize,
    /// Pairs of boundary edges that meet.
    pub boundary_crossings: usize,
    /// Whether more time would have made another map of it: see [`Observer::is_late`].
    pub ended_by_time: bool,
    /// Why the method was not the one asked for.
    pub fallback: Option<String>,
    /// How it was cut further: nothing where that was not asked for or not needed.
    pub refinement: Option<Refinement>,
    /// How its map came about.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub record: RunRecord,
}

/// How islands were laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Layout {
    /// Whether the islands were fitted into the unit square.
    pub fitted: bool,
    /// Width of the layout; 1 at most when it was fitted.
    pub width: f64,
    /// Height of the layout.
    pub height: f64,
    /// The share of `width × height` (of the unit square, when fitted) that islands cover.
    pub filled: f64,
    /// The margin between islands, in texels: less than was asked for where it left no room.
    pub margin: f64,
    /// Texels for a unit of length in space, at the resolution that was asked for; nothing when densities differ.
    pub texels_per_unit: Option<f64>,
}

/// UVs for any polygons, opened along `seams` and wherever else it is needed.
///
/// When the observer [is late](Observer::is_late), descents end with the maps at hand, of several islands those that have none yet are left with
/// their convex start, and the rest is done as always. [`Island::ended_by_time`] says of which islands that is true.
///
/// The observer hears of `"charts"`, then of the stages of the one island there is, or of `"islands"` when there are
/// several, then of `"layout"` and `"measure"`.
///
/// # Errors
/// Polygons of which no chart can be made, options out of range, cancelled by the observer, or no map of the only island:
/// see [`AtlasError`].
pub fn unwrap(
    polygons: PolygonView<'_>,
    seams: &Seams,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Atlas, AtlasError> {
    options.check(polygons.corner_count())?;
    tell(observer, "charts", 0.0)?;
    let mut seams = seams.clone();
    seams.extend(kept_seams(polygons, &options.keep).iter());
    let cut = charts::cut(polygons, &seams)?;
    let pieces = if options.open { open(cut.charts, observer)? } else { cut.charts };
    tell(observer, "charts", 1.0)?;
    unwrap_charts(polygons, pieces, cut.repairs, options, observer)
}

/// Cuts the charts open that are no planar patches, by automatic seams; by any that open them when the observer
/// [is late](Observer::is_late).
///
/// # Errors
/// [`AtlasError::Cancelled`] when the observer says so.
pub fn open(charts: Vec<Chart>, observer: &dyn Observer) -> Result<Vec<Chart>, AtlasError> {
    let shared = solve::Shared::new(observer, "charts", charts.len());
    let opened: Vec<Result<Vec<Chart>, AtlasError>> = charts
        .into_par_iter()
        .map(|chart| {
            let edges = opening(&chart.mesh, &shared)?;
            shared.count_one();
            Ok(if edges.is_empty() { vec![chart] } else { chart.cut(&edges) })
        })
        .collect();
    Ok(opened.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

impl From<Interrupted> for AtlasError {
    fn from(interrupted: Interrupted) -> Self {
        match interrupted {
            Interrupted::Cancelled => Self::Cancelled,
            Interrupted::OutOfTime => Self::OutOfTime,
        }
    }
}

/// As [`unwrap`], for charts that are there already; each face of `polygons` has to lie in one of them.
///
/// # Errors
/// As [`unwrap`].
pub fn unwrap_charts(
    polygons: PolygonView<'_>,
    pieces: Vec<Chart>,
    repairs: Repairs,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Atlas, AtlasError> {
    options.check(polygons.corner_count())?;
    let solved = solve::all(pieces, None, options, observer)?;
    finish(polygons, solved, repairs, options, observer)
}

/// As [`unwrap_charts`] for several settings, one after the other: the map of each chart starts from the one before where
/// [`parameterize_from`](crate::parameterize_from) can. `before` is empty at first, and the charts are to be the same in all calls.
///
/// # Errors
/// As [`unwrap`].
pub fn unwrap_charts_from(
    before: &mut Vec<Continuation>,
    polygons: PolygonView<'_>,
    pieces: Vec<Chart>,
    repairs: Repairs,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Atlas, AtlasError> {
    options.check(polygons.corner_count())?;
    before.resize_with(pieces.len(), Continuation::default);
    let solved = solve::all(pieces, Some(before), options, observer)?;
    finish(polygons, solved, repairs, options, observer)
}

/// Further cuts, the layout, and what there is to say of the whole.
fn finish(
    polygons: PolygonView<'_>,
    mut solved: Vec<Solved>,
    repairs: Repairs,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Atlas, AtlasError> {
    if let Some(bound) = options.max_stretch {
        solved = refine::refine(solved, bound, options, observer)?;
    }
    let layout = if options.keeps_any() {
        layout::beside(&mut solved, options);
        None
    } else if solved.len() > 1 || options.up.is_some() || options.true_scale {
        tell(observer, "layout", 0.0)?;
        let layout = layout::arrange(&mut solved, options);
        tell(observer, "layout", 1.0)?;
        Some(layout)
    } else {
        None
    };
    tell(observer, "measure", 0.0)?;
    let mut uv = gather(polygons, &solved);
    if uv.iter().flat_map(|p| p.iter()).any(|x| x.is_finite() && x.abs() > COORDINATE_LIMIT) {
        return Err(AtlasError::OutOfRange);
    }
    let turned_faces = measures::turned_faces(&solved);
    let (distortion, certificate, rounding) = match &solved[..] {
        // Nobody moved it since it was measured.
        [Solved { distortion: Some(distortion), certificate: Some(certificate), chart, record, .. }]
            if layout.is_none() && turned_faces.is_empty() && !options.keeps_any() =>
        {
            let certificate = measures::in_source_numbers(certificate, &chart.mesh);
            (distortion.clone(), certificate, record.rounding.clone())
        }
        _ => {
            let (turned, mut turned_uv) = measures::oriented(polygons, &turned_faces, &uv);
            let rounding = to_precision(turned.view(), &mut turned_uv, options.map.precision)
                .map_err(AtlasError::of_the_whole)?;
            (_, uv) = measures::oriented(polygons, &turned_faces, &turned_uv);
            let (distortion, certificate) = judge(turned.view(), &turned_uv, LISTED)?;
            (distortion, certificate, rounding)
        }
    };
    tell(observer, "measure", 1.0)?;
    let seams = measures::seam_length(polygons, &solved);
    let (islands, charts) = solved.into_par_iter().map(Solved::island).unzip();
    Ok(Atlas { uv, islands, charts, distortion, certificate, repairs, seams, layout, turned_faces, rounding })
}

/// The UVs of all charts at the corners of the polygons.
fn gather(polygons: PolygonView<'_>, solved: &[Solved]) -> Vec<Vec2> {
    let mut uv = vec![Vec2::zeros(); polygons.corner_count()];
    for island in solved {
        for (&corner, &place) in island.chart.corners.iter().zip(island.uv.iter()) {
            uv[corner as usize] = place;
        }
    }
    uv
}

fn tell(observer: &dyn Observer, stage: &'static str, fraction: f64) -> Result<(), AtlasError> {
    if observer.progress(stage, fraction).is_break() { Err(AtlasError::Cancelled) } else { Ok(()) }
}
