//! `qparam unwrap --report`: the page that shows the map, and the maps for other `q` beside it.

use qoptimize::atlas::unwrap_charts_from;
use qoptimize::qmesh::charts::cut;
use qoptimize::qmesh::{self, Chart, PolygonView, Repairs, Vec2};
use qoptimize::{
    Atlas, AtlasError, AtlasOptions, Certificate, Distortion, FaceMeasures, Method, Options, measure_faces,
};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::interrupt::Phase;
use crate::picture::page::{MapEntry, Page, WORST};
use crate::picture::{
    Canvas, Layout, Lines, Model, Paint, PictureError, Projection, Rgba, Seams, Shot, UpAxis, View, render,
    uv_area,
};
use crate::progress::Watch;
use crate::render_command::{checks, clay};
use crate::streams::Streams;
use crate::sweep::{Errors, knee, middle_first};
use crate::threads;
use crate::worst;

/// What a page is made from.
pub(crate) struct Source<'a> {
    pub(crate) input: &'a Input,
    pub(crate) charts: &'a [Chart],
    pub(crate) repairs: &'a Repairs,
    pub(crate) options: &'a AtlasOptions,
    pub(crate) result: &'a Atlas,
    /// What was done, a sentence each.
    pub(crate) notes: Vec<String>,
    pub(crate) settings: serde_json::Value,
    /// The values of `q` to show; `None` takes the usual ones.
    pub(crate) q: Option<&'a [f64]>,
    pub(crate) threads: usize,
    /// Whether a bar may be drawn.
    pub(crate) draw: bool,
}

/// One map of the series with everything that the page says of it.
struct Entry {
    q: Option<f64>,
    uv: Vec<Vec2>,
    distortion: Distortion,
    certificate: Certificate,
    faces: FaceMeasures,
    causes: Vec<(usize, String)>,
}

/// The page; maps for other `q` are computed here.
pub(crate) fn html(source: &Source<'_>, io: &Streams<'_>) -> Result<String, Failure> {
    let watch = Watch::new(io.interrupt, source.draw);
    let work = || page(source, &watch);
    let result = io.interrupt.during(Phase::Watched, || threads::with(source.threads, work));
    watch.finish();
    let result = result?;
    if io.interrupt.is_requested() {
        return Err(Failure::interrupted());
    }
    result.map_err(|why| Failure::new(Exit::Computation, "the report could not be made").note(why))
}

fn page(source: &Source<'_>, watch: &Watch<'_>) -> Result<String, String> {
    let mut notes = source.notes.clone();
    let entries = entries(source, watch, &mut notes)?;
    let chosen_q = reads_q(source.options.map.method).then_some(source.options.map.q);
    let chosen = entries.iter().position(|entry| entry.q == chosen_q).unwrap_or(0);
    let errors: Vec<Errors> = entries
        .iter()
        .filter(|entry| entry.certificate.holds)
        .filter_map(|entry| {
            let (angle, area) = (entry.distortion.angle_error, entry.distortion.area_error);
            Some(Errors { q: entry.q?, angle, area })
        })
        .collect();
    let maps: Vec<MapEntry<'_>> = entries
        .iter()
        .map(|entry| MapEntry {
            q: entry.q,
            uv: &entry.uv,
            distortion: &entry.distortion,
            certificate: &entry.certificate,
            faces: &entry.faces,
            causes: &entry.causes,
        })
        .collect();
    let shown = &entries[chosen];
    let pictures =
        pictures(source.input.document.view(), &shown.uv, &shown.faces).map_err(|error| error.to_string())?;
    let page = Page {
        title: without_folders(&source.input.name),
        polygons: source.input.document.view(),
        face_line: &|face| source.input.document.face_line(face),
        maps: &maps,
        chosen,
        knee: knee(&errors).map(|knee| knee.q).map_err(|reason| reason.to_string()),
        notes: &notes,
        settings: &source.settings,
        pictures: [&pictures[0], &pictures[1]],
    };
    page.html().map_err(|error| error.to_string())
}

/// The name of a file alone.
pub(crate) fn without_folders(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or_default()
}

fn reads_q(method: Method) -> bool {
    matches!(method, Method::Paper | Method::Direct | Method::Conformal)
}

/// The values of `q` that a page shows for a mesh of this size: fewer for large ones, since each is a map to compute.
fn usual_q(faces: usize) -> &'static [f64] {
    match faces {
        0..=20_000 => &[1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0],
        20_001..=100_000 => &[1.0, 0.75, 0.5, 0.25, 0.0],
        _ => &[1.0, 0.5, 0.0],
    }
}

/// The maps with `q` falling, the one that was written among them.
fn entries(source: &Source<'_>, watch: &Watch<'_>, notes: &mut Vec<String>) -> Result<Vec<Entry>, String> {
    let options = source.options;
    let polygons = source.input.document.view();
    let charts = charts(source)?;
    let own = entry(source, &charts, None, source.result)?;
    if !reads_q(options.map.method) {
        return Ok(vec![own]);
    }
    let mut entries = vec![Entry { q: Some(options.map.q), ..own }];
    let mut series = source.q.unwrap_or_else(|| usual_q(polygons.face_count())).to_vec();
    series.retain(|q| q.total_cmp(&options.map.q).is_ne());
    series.sort_unstable_by(f64::total_cmp);
    series.dedup();
    let mut before = Vec::new();
    for q in middle_first(&series).into_iter().map(|place| series[place]) {
        let map = Options { q, ..options.map.clone() };
        let other = AtlasOptions { map, max_stretch: None, ..options.clone() };
        let repairs = source.repairs.clone();
        match unwrap_charts_from(&mut before, polygons, charts.clone(), repairs, &other, watch) {
            Ok(atlas) => entries.push(entry(source, &charts, Some(q), &atlas)?),
            Err(AtlasError::Cancelled) => return Err("interrupted".into()),
            // The map that was asked for is there: a page with a gap says more than an error.
            Err(error) => notes.push(format!("no map for q = {q}: {error}")),
        }
    }
    entries.sort_by(|a, b| b.q.unwrap_or(0.0).total_cmp(&a.q.unwrap_or(0.0)));
    Ok(entries)
}

/// The charts of the map that was written: all maps of the series have its seams, also where `--max-stretch` added some.
fn charts(source: &Source<'_>) -> Result<Vec<Chart>, String> {
    if source.options.max_stretch.is_none() {
        return Ok(source.charts.to_vec());
    }
    let (polygons, uv) = (source.input.document.view(), &source.result.uv);
    let seams = qmesh::Seams::between(polygons, |a, b| (0..2).any(|end| uv[a[end]] != uv[b[end]]));
    Ok(cut(polygons, &seams).map_err(|error| error.to_string())?.charts)
}

fn entry(source: &Source<'_>, charts: &[Chart], q: Option<f64>, atlas: &Atlas) -> Result<Entry, String> {
    let (oriented, uv) = atlas.oriented(source.input.document.view());
    let worst = worst::find(source.input, charts, atlas, source.options, WORST).unwrap_or_default();
    Ok(Entry {
        q,
        uv: atlas.uv.clone(),
        distortion: atlas.distortion.clone(),
        certificate: atlas.certificate.clone(),
        faces: measure_faces(oriented.view(), &uv).map_err(|error| error.to_string())?,
        causes: worst.iter().map(|face| (face.index(), face.reasons())).collect(),
    })
}

/// For browsers without WebGL, and for surfaces that are too large for it.
fn pictures(
    polygons: PolygonView<'_>,
    uv: &[Vec2],
    measures: &FaceMeasures,
) -> Result<[Canvas; 2], PictureError> {
    const SIZE: [usize; 2] = [640, 520];
    let per_unit = (600.0 / uv_area(polygons, uv)).sqrt();
    let shot = Shot {
        view: View::ThreeQuarter,
        up: UpAxis::Y,
        projection: Projection::Perspective(25.0),
        size: SIZE,
        background: Rgba::CLEAR,
        relief: 1.0,
    };
    let paint = Paint::Checker { uv, per_unit, colors: checks() };
    let surface = render(&Model::new(polygons)?, &paint, &Lines::default(), &shot);
    let seams = Seams::find(polygons, uv, &measures.island);
    let layout = Layout {
        polygons,
        uv,
        colors: &vec![clay(); polygons.face_count()],
        seams: Some(&seams),
        edges: true,
        texels: None,
        size: SIZE,
        background: Rgba::CLEAR,
        legend: None,
    };
    Ok([surface, layout.canvas()?])
}
