//! The unit square: which vertices become its corners.

use crate::qcurv::corner_angle;
use crate::qmesh::{QuadMesh, Vec2, VertexId};

use super::{SHORTEST, check_count, shares};
use crate::EmbedError;
use crate::disk::edge_lengths;

/// Angles that differ by less than this count as equal.
const TIE: f64 = 1e-9;

pub(super) fn square(mesh: &QuadMesh, rim: &[VertexId]) -> Result<Vec<Vec2>, EmbedError> {
    check_count(rim, 4)?;
    let lengths = edge_lengths(mesh, rim);
    let corners = corners(mesh, rim, &lengths)?;
    check_chords(mesh, rim, &corners)?;
    let ends = [Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0), Vec2::new(0.0, 1.0)];
    let mut positions = vec![Vec2::zeros(); rim.len()];
    for side in 0..4 {
        let range = stretch(corners[side], corners[(side + 1) % 4], rim.len());
        let side_lengths: Vec<f64> = range.iter().map(|&k| lengths[k]).collect();
        let mut passed = 0.0;
        for (&k, share) in range.iter().zip(shares(&side_lengths, SHORTEST)) {
            positions[k] = ends[side] + passed * (ends[(side + 1) % 4] - ends[side]);
            passed += share;
        }
    }
    Ok(positions)
}

/// The places of the corners along the rim, ascending. A vertex with a single face has to be one, since on a side its
/// face would lose a corner's area; there is room for four of these.
fn corners(mesh: &QuadMesh, rim: &[VertexId], lengths: &[f64]) -> Result<[usize; 4], EmbedError> {
    let single = |k: &usize| mesh.vertex_corners(rim[*k]).count() == 1;
    let mut corners: Vec<usize> = (0..rim.len()).filter(single).collect();
    if corners.len() > 4 {
        return Err(EmbedError::TooManyCorners { vertex: rim[corners[4]], count: corners.len() });
    }
    if corners.is_empty() {
        corners.push(0);
    }
    while corners.len() < 4 {
        let corner = split_longest(mesh, rim, lengths, &corners);
        corners.push(corner);
        corners.sort_unstable();
    }
    Ok([corners[0], corners[1], corners[2], corners[3]])
}

/// A further corner inside the longest stretch between two corners: in its middle third where the boundary is
/// sharpest, of equally sharp vertices the one nearest to the middle.
fn split_longest(mesh: &QuadMesh, rim: &[VertexId], lengths: &[f64], corners: &[usize]) -> usize {
    let stretches = corners.iter().enumerate().map(|(k, &from)| {
        let edges = stretch(from, corners[(k + 1) % corners.len()], rim.len());
        let lengths: Vec<f64> = edges.iter().map(|&edge| lengths[edge]).collect();
        (edges, lengths)
    });
    // A stretch of one edge has no vertex inside.
    let divisible = stretches.filter(|(edges, _)| edges.len() > 1);
    let length = |lengths: &[f64]| lengths.iter().sum::<f64>();
    let longest = divisible.reduce(|best, next| {
        let (a, b) = (length(&best.1), length(&next.1));
        let longer = b > a * (1.0 + TIE) || (b >= a * (1.0 - TIE) && next.0.len() > best.0.len());
        if longer { next } else { best }
    });
    let Some((edges, lengths)) = longest else { return 0 };
    let shares = shares(&lengths, SHORTEST);
    let mut passed = 0.0;
    let mut inside: Vec<(usize, f64, f64)> = Vec::with_capacity(edges.len());
    for (k, share) in edges.iter().zip(&shares) {
        inside.push((*k, (passed - 0.5_f64).abs(), turned_angle(mesh, rim[*k])));
        passed += share;
    }
    inside.remove(0);
    let nearest = |a: &(usize, f64, f64), b: &(usize, f64, f64)| a.1 < b.1 - TIE;
    let sharper =
        |a: &(usize, f64, f64), b: &(usize, f64, f64)| a.2 < b.2 - TIE || (a.2 <= b.2 + TIE && nearest(a, b));
    let middle = inside.iter().filter(|vertex| vertex.1 <= 1.0 / 6.0);
    let best = middle.reduce(|best, next| if sharper(next, best) { next } else { best });
    let best =
        best.or_else(|| inside.iter().reduce(|best, next| if nearest(next, best) { next } else { best }));
    best.map_or(0, |vertex| vertex.0)
}

/// The edges from the vertex at `from` to that at `to`, once around when both are the same.
fn stretch(from: usize, to: usize, count: usize) -> Vec<usize> {
    let steps = if to > from { to - from } else { to + count - from };
    (0..steps).map(|step| (from + step) % count).collect()
}

/// The angle of the surface at a boundary vertex.
fn turned_angle(mesh: &QuadMesh, vertex: VertexId) -> f64 {
    mesh.vertex_corners(vertex).map(|corner| corner_angle(mesh, corner)).sum()
}

/// Refuses an inner edge between two vertices of one side.
fn check_chords(mesh: &QuadMesh, rim: &[VertexId], corners: &[usize; 4]) -> Result<(), EmbedError> {
    // Bit `s` says that the vertex lies on side `s`; corners lie on two.
    let mut sides = vec![0_u8; mesh.vertex_count()];
    for side in 0..4 {
        let to = corners[(side + 1) % 4];
        for k in stretch(corners[side], to, rim.len()).into_iter().chain([to]) {
            sides[rim[k].index()] |= 1 << side;
        }
    }
    let chord = mesh.edges().find(|&edge| {
        let [a, b] = mesh.edge_vertices(edge);
        !mesh.is_boundary_edge(edge) && sides[a.index()] & sides[b.index()] != 0
    });
    chord.map_or(Ok(()), |edge| Err(EmbedError::ChordOnSide { edge: mesh.edge_vertices(edge) }))
}
