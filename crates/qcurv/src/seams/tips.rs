//! The tips of limbs.

use qmesh::{Components, Observer, QuadMesh, VertexData, VertexId};

use super::Interrupted;
use super::distances::{distances, farthest};
use super::interrupted::look;

/// Places from which distances are averaged.
const SAMPLES: usize = 24;
/// A tip stands out by this fraction of the least mean distance at least.
const PROMINENCE: f64 = 0.08;
/// Tips at most; those that stand out most.
const MOST: usize = 16;

/// The ends of the limbs of a connected mesh: the maxima of the mean distance to points spread over the surface that stand
/// out against the pass to a higher one, those that stand out most first. None on a round surface.
///
/// # Errors
/// When the observer says so.
pub fn tips(mesh: &QuadMesh, observer: &dyn Observer) -> Result<Vec<VertexId>, Interrupted> {
    let mean = mean_distances(mesh, observer)?;
    let least = mean.iter().copied().filter(|d| d.is_finite()).fold(f64::INFINITY, f64::min);
    let mut found: Vec<(f64, VertexId)> = prominences(mesh, &mean);
    found.retain(|&(prominence, _)| prominence > PROMINENCE * least);
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    found.truncate(MOST);
    Ok(found.into_iter().map(|(_, vertex)| vertex).collect())
}

/// The mean distance to samples each of which is farthest from those before.
fn mean_distances(mesh: &QuadMesh, observer: &dyn Observer) -> Result<VertexData<f64>, Interrupted> {
    let mut sum = mesh.vertex_data(|_| 0.0);
    let start = farthest(&distances(mesh, &[VertexId(0)]));
    let mut nearest = distances(mesh, &[start]);
    let mut from_last = nearest.clone();
    for sample in 0..SAMPLES {
        look(observer, 0.5 + 0.4 * sample as f64 / SAMPLES as f64)?;
        for vertex in mesh.vertices() {
            sum[vertex] += from_last[vertex] / SAMPLES as f64;
            nearest[vertex] = nearest[vertex].min(from_last[vertex]);
        }
        if sample + 1 < SAMPLES {
            from_last = distances(mesh, &[farthest(&nearest)]);
        }
    }
    Ok(sum)
}

/// Each local maximum with the depth of the pass to a higher one: vertices join from the highest down, and where two
/// regions meet the lower one has its pass. The highest of all stands out against the lowest vertex.
fn prominences(mesh: &QuadMesh, height: &VertexData<f64>) -> Vec<(f64, VertexId)> {
    let mut order: Vec<VertexId> = mesh.vertices().filter(|&vertex| height[vertex].is_finite()).collect();
    order.sort_by(|&a, &b| height[b].total_cmp(&height[a]).then(a.cmp(&b)));
    const NONE: VertexId = VertexId(u32::MAX);
    let mut regions = Components::new(mesh.vertex_count());
    // The maximum of each region, at its root; something at all vertices that have joined one.
    let mut top = VertexData::filled(mesh.vertex_count(), NONE);
    let mut found = Vec::new();
    let mut peaks = Vec::new();
    for &vertex in &order {
        peaks.clear();
        for neighbor in mesh.neighbors(vertex).filter(|&neighbor| top[neighbor] != NONE) {
            peaks.push(top[VertexId(regions.root(neighbor.0))]);
        }
        peaks.sort_by(|&a, &b| height[b].total_cmp(&height[a]).then(a.cmp(&b)));
        peaks.dedup();
        found.extend(peaks.iter().skip(1).map(|&lower| (height[lower] - height[vertex], lower)));
        for neighbor in mesh.neighbors(vertex).filter(|&neighbor| top[neighbor] != NONE) {
            regions.join(vertex.0, neighbor.0);
        }
        let highest = peaks.first().copied().unwrap_or(vertex);
        top[vertex] = highest;
        top[VertexId(regions.root(vertex.0))] = highest;
    }
    if let (Some(&highest), Some(&lowest)) = (order.first(), order.last()) {
        found.push((height[highest] - height[lowest], highest));
    }
    found
}
