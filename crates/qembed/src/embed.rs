//! The paper's embedding: boundary, global step, local step.

use std::borrow::Cow;

use crate::qmesh::{Observer, QuadMesh, Vec2, VertexData};
use crate::qsimplify::Simplified;
use qsolve::SolveRecord;

use crate::boundary::place;
use crate::disk::{filled, rim};
use crate::frame::Frame;
use crate::global::global;
use crate::local::local;
use crate::{EmbedError, EmbedOptions, Embedding, StageSolve};

/// Sections 2.2 and 2.3: the boundary goes where the options say, the kept vertices follow by [Eq. 5](crate::EmbedOptions::exponent), and
/// the removed ones, all at once, by Eqs. 7 and 9 mixed as in Eq. 10.
///
/// With nothing removed the result is that of Eq. 5 alone; with every interior vertex removed it is that of Eq. 10
/// alone. The stage `"embed"` is reported to the observer.
///
/// Holes are filled for the time of the embedding. Their rims count as kept; to have them removed like other vertices,
/// simplify and embed [`QuadMesh::filled`] and leave its last vertices out.
///
/// # Errors
/// See [`EmbedError`].
pub fn embed(
    mesh: &QuadMesh,
    simplified: &Simplified,
    options: &EmbedOptions,
    observer: &dyn Observer,
) -> Result<Embedding, EmbedError> {
    check(mesh, simplified, options)?;
    tell(observer, 0.0)?;
    let patch = filled(mesh)?;
    let (given, mesh) = (mesh, &*patch);
    let simplified = &*with_filling(simplified, given, mesh);
    let rim = rim(mesh);
    let boundary = place(mesh, &rim, &options.boundary)?;
    let frame = Frame::new(&boundary);
    let mut uv = frame.enter(mesh, &rim, &boundary);
    let mean_edge = mean_edge(mesh);
    tell(observer, 0.1)?;
    let global = global(mesh, simplified, &mut uv, options.exponent, mean_edge, &options.solve)?;
    tell(observer, 0.5)?;
    let (record, negative_weights) = local(mesh, &global.placed, &mut uv, mean_edge, options)?;
    frame.leave(&mut uv, &rim, &boundary);
    let uv = without_filling(uv, given);
    tell(observer, 1.0)?;
    let solves = [("global", global.record), ("local", record)];
    let solves = solves.into_iter().filter_map(|(stage, record)| Some(StageSolve { stage, record: record? }));
    Ok(Embedding { uv, solves: solves.collect(), cut_off: global.cut_off, negative_weights })
}

/// `simplified` with what fills the holes of `mesh`: nothing of that is removed.
fn with_filling<'a>(simplified: &'a Simplified, mesh: &QuadMesh, filled: &QuadMesh) -> Cow<'a, Simplified> {
    if filled.vertex_count() == mesh.vertex_count() {
        return Cow::Borrowed(simplified);
    }
    let mut kept = simplified.kept.clone().into_vec();
    kept.resize(filled.vertex_count(), true);
    let mut springs = simplified.springs.clone();
    for center in filled.vertices().skip(mesh.vertex_count()) {
        springs.extend(filled.neighbors(center).map(|rim| [rim, center]));
    }
    Cow::Owned(Simplified { kept: VertexData::from_vec(kept), springs, ..simplified.clone() })
}

/// The positions of the vertices of `mesh` among those of the same mesh with its holes filled.
pub(crate) fn without_filling(uv: VertexData<Vec2>, mesh: &QuadMesh) -> VertexData<Vec2> {
    let mut uv = uv.into_vec();
    uv.truncate(mesh.vertex_count());
    VertexData::from_vec(uv)
}

/// The embedding of a method that solves one system.
pub(crate) fn single(
    uv: VertexData<Vec2>,
    stage: &'static str,
    record: Option<SolveRecord>,
    negative_weights: usize,
) -> Embedding {
    let solves = record.map(|record| StageSolve { stage, record }).into_iter().collect();
    Embedding { uv, solves, cut_off: 0, negative_weights }
}

/// Reports progress; an error when the observer wants to stop.
pub(crate) fn tell(observer: &dyn Observer, fraction: f64) -> Result<(), EmbedError> {
    if observer.progress("embed", fraction).is_break() { Err(EmbedError::Cancelled) } else { Ok(()) }
}

/// The mean edge length, 1 when all vertices are in one place.
pub(crate) fn mean_edge(mesh: &QuadMesh) -> f64 {
    let mean = mesh.edges().map(|edge| mesh.edge_length(edge)).sum::<f64>() / mesh.edge_count() as f64;
    if mean > 0.0 { mean } else { 1.0 }
}

fn check(mesh: &QuadMesh, simplified: &Simplified, options: &EmbedOptions) -> Result<(), EmbedError> {
    if !(0.0..=1.0).contains(&options.q) {
        return Err(EmbedError::BadMix(options.q));
    }
    if !(options.exponent >= 0.0 && options.exponent.is_finite()) {
        return Err(EmbedError::BadExponent(options.exponent));
    }
    let count = mesh.vertex_count();
    if simplified.kept.len() != count {
        return Err(EmbedError::OtherMesh("it has another number of vertices"));
    }
    if simplified.springs.iter().flatten().any(|end| end.index() >= count) {
        return Err(EmbedError::OtherMesh("one of its springs ends at no vertex"));
    }
    if mesh.vertices().any(|vertex| mesh.is_boundary(vertex) && !simplified.kept[vertex]) {
        return Err(EmbedError::OtherMesh("it removes a boundary vertex"));
    }
    Ok(())
}
