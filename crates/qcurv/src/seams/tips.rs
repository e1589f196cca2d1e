//! The tips of limbs.

use qmesh::{Observer, QuadMesh, VertexData, VertexId};

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
    // Each vertex leads on to one of its region; the last is the region's maximum.
    let mut above = VertexData::filled(mesh.vertex_count(), NONE);
    let mut found = Vec::new();
    let mut peaks = Vec::new();
    for &vertex in &order {
        peaks.clear();
        for neighbor in mesh.neighbors(vertex) {
            if above[neighbor] != NONE {
                peaks.push(peak(&mut above, neighbor));
            }
        }
        peaks.sort_by(|&a, &b| height[b].total_cmp(&height[a]).then(a.cmp(&b)));
        peaks.dedup();
        above[vertex] = peaks.first().copied().unwrap_or(vertex);
        for &lower in peaks.iter().skip(1) {
            found.push((height[lower] - height[vertex], lower));
            above[lower] = peaks[0];
        }
    }
    if let (Some(&highest), Some(&lowest)) = (order.first(), order.last()) {
        found.push((height[highest] - height[lowest], highest));
    }
    found
}

fn peak(above: &mut VertexData<VertexId>, mut vertex: VertexId) -> VertexId {
    while above[vertex] != vertex {
        let next = above[above[vertex]];
        above[vertex] = next;
        vertex = next;
    }
    vertex
}
