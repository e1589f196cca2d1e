//! Mean value weights (Floater 2003, "Mean value coordinates") in the immediate star of a vertex.

use crate::qcurv::corner_angle;
use crate::qmesh::{QuadMesh, VertexId};

use crate::weights::{Row, SHORTEST_EDGE};

/// Corner angles are kept this far, in radians, below π, where the tangent of their half is infinite.
const FLATTEST: f64 = 1e-6;

/// `λⱼ ∝ (tan δ_{j−1}/2 + tan δⱼ/2) / |v − vⱼ|`, with the corner angles δ right and left of the edge to `vⱼ`.
pub(super) fn row(mesh: &QuadMesh, vertex: VertexId) -> Row {
    let center = mesh.position(vertex);
    let edges: Vec<_> = mesh.outgoing(vertex).collect();
    let count = edges.len();
    let tangents: Vec<f64> = edges
        .iter()
        .map(|&edge| {
            let angle = mesh.corner(edge).map_or(0.0, |corner| corner_angle(mesh, corner));
            (0.5 * angle.min(std::f64::consts::PI - FLATTEST)).tan().max(FLATTEST)
        })
        .collect();
    let lengths: Vec<f64> =
        edges.iter().map(|&edge| (mesh.position(mesh.target(edge)) - center).norm()).collect();
    // The unit does not matter, since the weights are divided by their sum.
    let mean = lengths.iter().sum::<f64>() / count as f64;
    let unit = if mean > 0.0 { mean } else { 1.0 };
    let weight =
        |k: usize| (tangents[(k + count - 1) % count] + tangents[k]) / (lengths[k] / unit).max(SHORTEST_EDGE);
    let sum: f64 = (0..count).map(weight).sum();
    let neighbors = edges.iter().enumerate().map(|(k, &edge)| (mesh.target(edge), weight(k) / sum)).collect();
    Row { neighbors, diagonal: 1.0, negative: 0 }
}
