//! The sum over all corners, its gradient, and its sparse Hessian.
//!
//! Sums run in chunks of fixed size whose results are added in order, so they do not depend on the number of threads.

use crate::qmesh::{CornerId, Vec2};
use rayon::prelude::*;

use super::Objective;
use super::element::{self, Edges, Element};
use super::hessian::Hessian;
use super::rest::{Rest, RestCorner};

/// Corners that are summed by one task.
const CHUNK: usize = 2048;
/// Corners whose elements are held at once.
const BLOCK: usize = 64 * CHUNK;

pub(super) fn edges(corner: &RestCorner, uv: &[Vec2]) -> Edges {
    let [here, next, previous] = corner.vertices.map(|v| uv[v as usize]);
    let (f1, f0) = (next - here, previous - here);
    [f1.x, f1.y, f0.x, f0.y]
}

/// The energy of `uv`; infinite where a corner is not positive.
pub(super) fn value(objective: &Objective, rest: &Rest, uv: &[Vec2]) -> f64 {
    let sums: Vec<f64> = rest
        .corners
        .par_chunks(CHUNK)
        .map(|chunk| chunk.iter().map(|corner| element::value(objective, corner, edges(corner, uv))).sum())
        .collect();
    sums.iter().sum()
}

/// Adds the Hessian at `uv` to `hessian` and returns energy and gradient (2 entries a vertex), or the first corner that is not
/// positive.
pub(super) fn derivatives(
    objective: &Objective,
    rest: &Rest,
    hessian: &mut Hessian,
    uv: &[Vec2],
) -> Result<(f64, Vec<f64>), CornerId> {
    let mut value = 0.0;
    let mut gradient = vec![0.0; 2 * rest.vertex_count];
    hessian.clear();
    // Blocks of corners, so that the elements never all stand in memory at once.
    for (block, corners) in rest.corners.chunks(BLOCK).enumerate() {
        let elements: Vec<Option<Element>> = corners
            .par_iter()
            .with_min_len(CHUNK)
            .map(|corner| element::derivatives(objective, corner, edges(corner, uv)))
            .collect();
        for (index, (corner, element)) in corners.iter().zip(&elements).enumerate() {
            let index = block * BLOCK + index;
            let element = element.as_ref().ok_or(rest.ids[index])?;
            value += element.value;
            add_gradient(&mut gradient, corner, &element.gradient);
            hessian.add(index, corner.vertices, &element.hessian);
        }
    }
    Ok((value, gradient))
}

pub(super) fn add_gradient(gradient: &mut [f64], corner: &RestCorner, [f1x, f1y, f0x, f0y]: &Edges) {
    let [here, next, previous] = corner.vertices.map(|v| 2 * v as usize);
    for (at, x, y) in [(next, *f1x, *f1y), (previous, *f0x, *f0y), (here, -f1x - f0x, -f1y - f0y)] {
        gradient[at] += x;
        gradient[at + 1] += y;
    }
}
