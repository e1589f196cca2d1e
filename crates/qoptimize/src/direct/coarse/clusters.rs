//! Which vertices become one.

use crate::qmesh::{QuadMesh, VertexId};

/// Seeds are more than so many edges apart, where nothing speaks for less.
pub(super) const RADIUS: u8 = 3;
const FAR: u8 = u8::MAX;

/// A partition of the vertices into connected clusters about their seeds.
pub(super) struct Clusters {
    /// The cluster of each vertex.
    pub(super) of: Vec<u32>,
    pub(super) seeds: Vec<VertexId>,
}

impl Clusters {
    /// Clusters whose seeds are more than `radius` edges away from each other, which is given for each vertex.
    pub(super) fn new(mesh: &QuadMesh, radius: &[u8]) -> Self {
        let seeds = seeds(mesh, radius);
        let of = nearest(mesh, &seeds);
        Self { of, seeds }
    }
}

/// As many vertices as there is room for: along the boundary first, then inwards.
fn seeds(mesh: &QuadMesh, radius: &[u8]) -> Vec<VertexId> {
    let mut distance = vec![FAR; mesh.vertex_count()];
    let mut seeds = Vec::new();
    let mut queue = Vec::new();
    for vertex in inwards(mesh) {
        if distance[vertex.index()] <= radius[vertex.index()] {
            continue;
        }
        seeds.push(vertex);
        distance[vertex.index()] = 0;
        queue.clear();
        queue.push(vertex);
        let mut at = 0;
        while let Some(&vertex) = queue.get(at) {
            at += 1;
            let next = distance[vertex.index()] + 1;
            if next > RADIUS {
                break;
            }
            for neighbor in mesh.neighbors(vertex) {
                if next < distance[neighbor.index()] {
                    distance[neighbor.index()] = next;
                    queue.push(neighbor);
                }
            }
        }
    }
    seeds
}

/// All vertices, breadth first from the boundary loops, which come in their own order.
fn inwards(mesh: &QuadMesh) -> Vec<VertexId> {
    let loops = mesh.boundary_loops();
    let mut order: Vec<VertexId> = Vec::with_capacity(mesh.vertex_count());
    let mut seen = vec![false; mesh.vertex_count()];
    for outline in &loops {
        for vertex in mesh.loop_vertices(outline) {
            if !std::mem::replace(&mut seen[vertex.index()], true) {
                order.push(vertex);
            }
        }
    }
    spread(mesh, &mut order, |_, to| !std::mem::replace(&mut seen[to.index()], true));
    order
}

/// The number of the seed nearest to each vertex, in edges; the first to arrive among equals.
fn nearest(mesh: &QuadMesh, seeds: &[VertexId]) -> Vec<u32> {
    let mut of = vec![u32::MAX; mesh.vertex_count()];
    for (number, seed) in seeds.iter().enumerate() {
        of[seed.index()] = number as u32;
    }
    let mut queue = seeds.to_vec();
    spread(mesh, &mut queue, |from, to| {
        let is_new = of[to.index()] == u32::MAX;
        if is_new {
            of[to.index()] = of[from.index()];
        }
        is_new
    });
    of
}

/// Breadth first from what `queue` has; `enters(from, to)` tells whether `to` is new.
fn spread(mesh: &QuadMesh, queue: &mut Vec<VertexId>, mut enters: impl FnMut(VertexId, VertexId) -> bool) {
    let mut at = 0;
    while let Some(&vertex) = queue.get(at) {
        at += 1;
        for neighbor in mesh.neighbors(vertex) {
            if enters(vertex, neighbor) {
                queue.push(neighbor);
            }
        }
    }
}
