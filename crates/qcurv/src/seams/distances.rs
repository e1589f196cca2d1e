//! Distances on the surface, along edges and diagonals.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use qmesh::{Id, QuadMesh, VertexData, VertexId};

/// A distance that can be compared: finite and not negative, so its bits are in the order of its values.
pub(super) fn key(distance: f64) -> u64 {
    distance.to_bits()
}

/// The length of the shortest path from each vertex to `sources`, along edges and across the diagonals of quads. Infinite where no
/// path leads.
pub(super) fn distances(mesh: &QuadMesh, sources: &[VertexId]) -> VertexData<f64> {
    let mut distance = VertexData::filled(mesh.vertex_count(), f64::INFINITY);
    let mut heap = BinaryHeap::new();
    for &source in sources {
        distance[source] = 0.0;
        heap.push(Reverse((key(0.0), source)));
    }
    while let Some(Reverse((known, vertex))) = heap.pop() {
        if known != key(distance[vertex]) {
            continue;
        }
        let mut visit = |to: VertexId| {
            let there = distance[vertex] + (mesh.position(to) - mesh.position(vertex)).norm();
            if there < distance[to] {
                distance[to] = there;
                heap.push(Reverse((key(there), to)));
            }
        };
        for halfedge in mesh.outgoing(vertex) {
            visit(mesh.target(halfedge));
            if let Some(corner) = mesh.corner(halfedge)
                && mesh.degree(mesh.face(corner)) == 4
            {
                visit(mesh.vertex(mesh.next_corner(mesh.next_corner(corner))));
            }
        }
    }
    distance
}

/// The vertex with the largest finite value; the first of several.
pub(super) fn farthest(values: &VertexData<f64>) -> VertexId {
    let finite = values.entries().filter(|(_, value)| value.is_finite());
    let best = finite.fold(None, |best: Option<(VertexId, f64)>, (vertex, &value)| match best {
        Some((_, known)) if known >= value => best,
        _ => Some((vertex, value)),
    });
    best.map_or(VertexId::from_index(0), |(vertex, _)| vertex)
}

/// Two vertices about as far apart as any: twice the farthest of the one before.
pub(super) fn farthest_pair(mesh: &QuadMesh) -> [VertexId; 2] {
    let first = farthest(&distances(mesh, &[VertexId::from_index(0)]));
    let second = farthest(&distances(mesh, &[first]));
    [first, second]
}
