//! Where the boundary goes: circle, square, projection, or as the caller says.

mod polygon;
mod projection;
mod square;

use std::f64::consts::TAU;

use crate::qmesh::{COORDINATE_LIMIT, QuadMesh, Vec2, VertexId};

use crate::disk::edge_lengths;
use crate::{BoundaryShape, EmbedError};

/// Edges shorter than this fraction of the mean count as that long.
const SHORTEST: f64 = 1e-3;
/// The smallest step on the circle, in radians, unless there are so many vertices that the mean step is not twice as
/// long. Its sagitta, a tenth of a millionth of a millionth, still stands out from the rounding of the coordinates.
const SMALLEST_STEP: f64 = 1e-5;

/// Where the vertices of the outer boundary go, counter-clockwise along it.
///
/// # Errors
/// The mesh is no planar patch, or its boundary does not fit the shape; `Free` is no shape.
pub fn place_boundary(mesh: &QuadMesh, shape: &BoundaryShape) -> Result<Vec<(VertexId, Vec2)>, EmbedError> {
    crate::check_patch(mesh)?;
    let rim = crate::disk::rim(mesh);
    let positions = place(mesh, &rim, shape)?;
    Ok(rim.into_iter().zip(positions).collect())
}

/// One position for each vertex of the rim, which is given counter-clockwise.
pub(crate) fn place(
    mesh: &QuadMesh,
    rim: &[VertexId],
    shape: &BoundaryShape,
) -> Result<Vec<Vec2>, EmbedError> {
    match shape {
        BoundaryShape::Auto | BoundaryShape::Circle => circle(mesh, rim),
        BoundaryShape::Free => Err(EmbedError::NoFreeBoundary),
        BoundaryShape::Square => square::square(mesh, rim),
        BoundaryShape::Projection => projection::project(mesh, rim),
        BoundaryShape::Fixed(positions) => fixed(mesh, rim, positions),
    }
}

fn circle(mesh: &QuadMesh, rim: &[VertexId]) -> Result<Vec<Vec2>, EmbedError> {
    check_count(rim, 3)?;
    let mean = TAU / rim.len() as f64;
    let floor = (SMALLEST_STEP / mean).clamp(SHORTEST, 0.5);
    let shares = shares(&edge_lengths(mesh, rim), floor);
    let mut passed = 0.0;
    let at = |share: &f64| {
        let (sine, cosine) = (TAU * passed).sin_cos();
        passed += share;
        Vec2::new(cosine, sine)
    };
    Ok(shares.iter().map(at).collect())
}

/// Lengths as fractions of their sum; none is less than about `floor` times the mean.
fn shares(lengths: &[f64], floor: f64) -> Vec<f64> {
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    if mean <= 0.0 {
        return vec![1.0 / lengths.len() as f64; lengths.len()];
    }
    let raised: Vec<f64> = lengths.iter().map(|length| (length / mean).max(floor)).collect();
    let total: f64 = raised.iter().sum();
    raised.iter().map(|length| length / total).collect()
}

fn fixed(mesh: &QuadMesh, rim: &[VertexId], positions: &[(VertexId, Vec2)]) -> Result<Vec<Vec2>, EmbedError> {
    let mut place = vec![u32::MAX; mesh.vertex_count()];
    for (k, vertex) in rim.iter().enumerate() {
        place[vertex.index()] = k as u32;
    }
    let mut given = vec![None; rim.len()];
    for &(vertex, position) in positions {
        let k = place.get(vertex.index()).copied().filter(|&k| k != u32::MAX);
        let slot = k.and_then(|k| given.get_mut(k as usize)).ok_or(EmbedError::FixedInside { vertex })?;
        if !position.iter().all(|x| x.abs() <= COORDINATE_LIMIT) {
            return Err(EmbedError::FixedNotFinite { vertex });
        }
        if slot.replace(position).is_some() {
            return Err(EmbedError::FixedTwice { vertex });
        }
    }
    let missing = |k: usize| EmbedError::FixedMissing { vertex: rim[k], count: rim.len() };
    given.into_iter().enumerate().map(|(k, position)| position.ok_or_else(|| missing(k))).collect()
}

fn check_count(rim: &[VertexId], needed: usize) -> Result<(), EmbedError> {
    if rim.len() < needed {
        return Err(EmbedError::BoundaryTooShort { found: rim.len(), needed });
    }
    Ok(())
}
