//! A map of every chart.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use qembed::qmesh::obj::UvPrecision;
use qembed::qmesh::{Chart, CornerData, Observer, Vec2};
use rayon::prelude::*;

use super::refine::{Refinement, RefinementEnd};
use super::{AtlasError, AtlasOptions, Island, keep, measures, stretch};
use crate::certificate::Certificate;
use crate::convexity::Exempt;
use crate::direct::{Continuation, Stop, find_start};
use crate::distortion::{Distortion, measure};
use crate::error::ParameterizeError;
use crate::parameterize::{Method, Options, RunRecord, parameterize_from};

/// A chart with its map.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub(super) chart: Chart,
    pub(super) uv: CornerData<Vec2>,
    /// Nothing for a surface of no area.
    pub(super) distortion: Option<Distortion>,
    /// The proof, as long as nobody moves the map.
    pub(super) certificate: Option<Certificate>,
    pub(super) record: RunRecord,
    pub(super) fallback: Option<String>,
    /// Whether time was up before it had a map of its method.
    pub(super) out_of_time: bool,
    /// How it was cut further, where that was asked for and needed.
    pub(super) refinement: Option<Refinement>,
}

/// Maps all charts, in parallel and each as if it were alone; from the maps before, if there is one `Continuation` for each chart.
pub(super) fn all(
    charts: Vec<Chart>,
    mut before: Option<&mut [Continuation]>,
    options: &AtlasOptions,
    observer: &dyn Observer,
) -> Result<Vec<Solved>, AtlasError> {
    if let [chart] = &charts[..]
        && !keep::is_touched(chart, &options.keep)
    {
        let mut fresh = Continuation::default();
        let before = before.as_mut().map_or(&mut fresh, |before| &mut before[0]);
        return charts.into_iter().map(|chart| alone(chart, before, &options.map, observer)).collect();
    }
    let map = of_many(options);
    let shared = Shared::new(observer, "islands", charts.len());
    let solve = |chart: Chart, before: &mut Continuation| {
        let solved = if keep::is_touched(&chart, &options.keep) {
            keep::solve(chart, &options.keep, &map, &shared)
        } else {
            among_others(chart, before, &map, &shared)
        };
        shared.count_one();
        solved
    };
    let charts = charts.into_par_iter();
    let solved: Vec<Result<Solved, AtlasError>> = match before {
        Some(before) => charts.zip(before).map(|(chart, before)| solve(chart, before)).collect(),
        None => charts.map(|chart| solve(chart, &mut Continuation::default())).collect(),
    };
    solved.into_iter().collect()
}

/// The options of one island of several: what is done to the whole is not done to each.
pub(super) fn of_many(options: &AtlasOptions) -> Options {
    Options { normalize: true, precision: UvPrecision::Double, ..options.map.clone() }
}

/// Hands on the request to stop, and says how many islands are done.
pub(super) struct Shared<'a> {
    observer: &'a dyn Observer,
    stage: &'static str,
    done: AtomicUsize,
    total: usize,
}

impl<'a> Shared<'a> {
    pub(super) fn new(observer: &'a dyn Observer, stage: &'static str, total: usize) -> Self {
        Self { observer, stage, done: AtomicUsize::new(0), total }
    }

    /// One more is done.
    pub(super) fn count_one(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}

impl Observer for Shared<'_> {
    fn progress(&self, _: &'static str, _: f64) -> ControlFlow<()> {
        self.observer.progress(self.stage, self.done.load(Ordering::Relaxed) as f64 / self.total as f64)
    }

    fn is_late(&self) -> bool {
        self.observer.is_late()
    }
}

/// The only chart: errors are errors.
pub(super) fn alone(
    chart: Chart,
    before: &mut Continuation,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Solved, AtlasError> {
    match parameterize_from(before, &chart.mesh, options, observer) {
        Ok(map) => Ok(Solved {
            chart,
            uv: map.uv,
            distortion: Some(map.distortion),
            certificate: Some(map.certificate),
            record: map.record,
            fallback: None,
            out_of_time: false,
            refinement: None,
        }),
        Err(error) => Err(refusal(chart, error)),
    }
}

fn refusal(chart: Chart, error: ParameterizeError) -> AtlasError {
    match error {
        ParameterizeError::Cancelled => return AtlasError::Cancelled,
        ParameterizeError::OutOfTime => return AtlasError::OutOfTime,
        _ => {}
    }
    AtlasError::Island { chart: Box::new(chart), error }
}

/// One chart of several: what the method cannot do, another one does; the convex start does where there is no time left.
pub(super) fn among_others(
    chart: Chart,
    before: &mut Continuation,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Solved, AtlasError> {
    if let Err(error) = qembed::check_patch(&chart.mesh) {
        return Err(refusal(chart, error.into()));
    }
    let error = match alone(chart.clone(), before, options, observer) {
        Err(AtlasError::Island { error, .. }) => error,
        Err(AtlasError::OutOfTime) => ParameterizeError::OutOfTime,
        other => return other,
    };
    let out_of_time = error == ParameterizeError::OutOfTime;
    let direct = Options { method: Method::Direct, ..options.clone() };
    if options.method != Method::Direct
        && !out_of_time
        && let Ok(solved) = alone(chart.clone(), &mut Continuation::default(), &direct, observer)
    {
        return Ok(Solved { fallback: Some(error.to_string()), ..solved });
    }
    match convex(&chart, observer) {
        Ok(uv) => {
            let distortion = measure(chart.mesh.view(), &uv).ok();
            let (record, fallback) = (RunRecord::default(), Some(error.to_string()));
            let (certificate, refinement) = (None, None);
            Ok(Solved { chart, uv, distortion, certificate, record, fallback, out_of_time, refinement })
        }
        Err(error) => Err(refusal(chart, error)),
    }
}

/// The convex start, which asks nothing of the shape.
fn convex(chart: &Chart, observer: &dyn Observer) -> Result<CornerData<Vec2>, ParameterizeError> {
    let filled = chart.mesh.filled();
    let mesh = filled.as_ref().unwrap_or(&chart.mesh);
    let start = find_start(mesh, &Exempt::find(mesh), observer);
    let start = start.map_err(|error| error.outside_of_fillings(&chart.mesh, mesh))?;
    Ok(chart.mesh.corner_data(|corner| 0.5 * (start.uv[chart.mesh.vertex(corner)] + Vec2::repeat(1.0))))
}

impl Solved {
    /// Whether more time would have made another map of it.
    fn is_ended_by_time(&self) -> bool {
        let descent = self.record.direct.as_ref().map(|direct| direct.descent.stop);
        let refinement = self.refinement.as_ref().map(|refinement| refinement.end);
        self.out_of_time || descent == Some(Stop::Cancelled) || refinement == Some(RefinementEnd::OutOfTime)
    }

    /// What 99 % of its area stays below: see [`stretch`](super::stretch()).
    pub(super) fn stretch(&self) -> f64 {
        stretch::quantile(&self.chart.mesh, &self.uv, measures::areas(&self.chart.mesh, &self.uv))
    }

    pub(super) fn island(self) -> (Island, Chart) {
        let mesh = &self.chart.mesh;
        let areas = measures::areas(mesh, &self.uv);
        let [area, uv_area] = areas;
        let island = Island {
            first_face: self.chart.faces.first().copied().unwrap_or(0),
            faces: mesh.face_count(),
            boundary_loops: mesh.boundary_loops().len(),
            area,
            uv_area,
            stretch: stretch::quantile(mesh, &self.uv, areas),
            symmetric_dirichlet: self.distortion.as_ref().and_then(|found| found.symmetric_dirichlet),
            flipped_corners: self.distortion.as_ref().map_or(0, |found| found.flipped_corners),
            boundary_crossings: self.distortion.as_ref().map_or(0, |found| found.boundary_crossings),
            ended_by_time: self.is_ended_by_time(),
            fallback: self.fallback,
            refinement: self.refinement,
            record: self.record,
        };
        (island, self.chart)
    }
}
