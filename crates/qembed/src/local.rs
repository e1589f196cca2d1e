//! The local step (section 2.3): the removed vertices return, balanced among their neighbours.

use crate::qmesh::{QuadMesh, Vec2, VertexData};
use qsolve::SolveRecord;
use rayon::prelude::*;

use crate::dirichlet::{Unknowns, balance_rows};
use crate::weights::{Row, row};
use crate::{EmbedError, EmbedOptions};

/// Eqs. 7 and 9, mixed as Eq. 10 has it: `Σⱼ λᵢⱼ (uᵢ − uⱼ) = 0` at every vertex that is not `placed`.
///
/// These are conditions vertex by vertex, not the gradient of one energy: γ is not symmetric, and neither is the
/// system. All vertices are solved for at once, which is the same as one after the other where no two of them are
/// neighbours. Returns the record, if there were unknowns, and the number of negative weights.
pub(crate) fn local(
    mesh: &QuadMesh,
    placed: &VertexData<bool>,
    uv: &mut VertexData<Vec2>,
    mean_edge: f64,
    options: &EmbedOptions,
) -> Result<(Option<SolveRecord>, usize), EmbedError> {
    let unknowns = Unknowns::new(mesh, |vertex| !placed[vertex]);
    if unknowns.len() == 0 {
        return Ok((None, 0));
    }
    let rows: Vec<Row> = unknowns
        .vertices
        .par_iter()
        .with_min_len(512)
        .map(|&vertex| row(mesh, vertex, options, mean_edge))
        .collect();
    let negative = rows.iter().map(|row| row.negative).sum();
    let record = balance_rows(&rows, &unknowns, uv, &options.solve)?;
    Ok((Some(record), negative))
}
