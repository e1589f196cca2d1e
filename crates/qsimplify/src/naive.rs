//! Deletion as printed: vertices and their edges go, and nothing is asked.
//!
//! The faces around deleted vertices merge to *regions*. A region may end up with several boundary walks (around
//! islands of kept vertices), with walks that run to the tip of a chain and back, or with none. Polygons hold one simple
//! cycle, so this much is listed: of each region the walk that hangs together with the boundary of the mesh, the
//! longest of several, cut at vertices that it passes twice into simple cycles of three vertices or more. Not listed are
//! the walks around islands, chains and isolated vertices.

use qcurv::qmesh::{Components, HalfedgeId, QuadMesh, VertexData, VertexId};

use crate::simplified::Simplified;

pub(crate) fn delete(mesh: &QuadMesh, candidates: &[VertexId]) -> Simplified {
    let mut simplified = Simplified::full(mesh);
    simplified.remove(candidates);
    let kept = &simplified.kept;
    simplified.springs.retain(|&[a, b]| kept[a] && kept[b]);
    let attached = simplified.attached(mesh);
    (simplified.face_start, simplified.face_vertex) = faces(mesh, kept, &attached);
    simplified
}

/// A boundary walk of a region.
struct Walk {
    attached: bool,
    vertices: Vec<VertexId>,
}

fn faces(mesh: &QuadMesh, kept: &VertexData<bool>, attached: &[bool]) -> (Vec<u32>, Vec<VertexId>) {
    let stays = |h: HalfedgeId| kept[mesh.origin(h)] && kept[mesh.target(h)];
    let mut regions = Components::new(mesh.face_count());
    let mut seen = vec![false; mesh.corner_count()];
    for corner in mesh.corners().filter(|c| !stays(c.halfedge())) {
        if let Some(across) = mesh.corner(mesh.twin(corner.halfedge())) {
            regions.join(mesh.face(corner).0, mesh.face(across).0);
        }
    }
    // Regions are named by their first face, so untouched faces keep their place.
    let mut walks: Vec<Option<Walk>> = mesh.faces().map(|_| None).collect();
    for corner in mesh.corners() {
        if seen[corner.index()] || !stays(corner.halfedge()) {
            continue;
        }
        let vertices = walk(mesh, kept, corner.halfedge(), &mut seen);
        let walk = Walk { attached: attached[vertices[0].index()], vertices };
        let best = &mut walks[regions.root(mesh.face(corner).0) as usize];
        let rank = |walk: &Walk| (walk.attached, walk.vertices.len());
        if best.as_ref().is_none_or(|best| rank(best) < rank(&walk)) {
            *best = Some(walk);
        }
    }
    let (mut face_start, mut face_vertex) = (vec![0], Vec::new());
    let mut place = vec![usize::MAX; mesh.vertex_count()];
    for walk in walks.into_iter().flatten() {
        push_simple_cycles(&walk.vertices, &mut place, &mut face_start, &mut face_vertex);
    }
    (face_start, face_vertex)
}

/// The kept vertices around the region to the left of `start`.
fn walk(mesh: &QuadMesh, kept: &VertexData<bool>, start: HalfedgeId, seen: &mut [bool]) -> Vec<VertexId> {
    let mut vertices = Vec::new();
    let mut current = start;
    loop {
        vertices.push(mesh.origin(current));
        // Never a boundary halfedge: turning clockwise, the boundary edge that lies in a face comes before it.
        if let Some(corner) = mesh.corner(current) {
            seen[corner.index()] = true;
        }
        current = mesh.next(current);
        while !kept[mesh.target(current)] {
            current = mesh.next(mesh.twin(current)); // the next edge clockwise; at the latest the one we came by
        }
        if current == start {
            return vertices;
        }
    }
}

/// Cuts a closed walk where it comes back to a vertex; what is cut off is a face if it has three vertices or more.
fn push_simple_cycles(
    walk: &[VertexId],
    place: &mut [usize],
    face_start: &mut Vec<u32>,
    face_vertex: &mut Vec<VertexId>,
) {
    let mut open: Vec<VertexId> = Vec::with_capacity(walk.len());
    let mut push = |cycle: &[VertexId]| {
        if cycle.len() >= 3 {
            face_vertex.extend_from_slice(cycle);
            face_start.push(face_vertex.len() as u32);
        }
    };
    for &vertex in walk {
        let before = place[vertex.index()];
        if before != usize::MAX {
            push(&open[before..]);
            for closed in open.drain(before..) {
                place[closed.index()] = usize::MAX;
            }
        }
        place[vertex.index()] = open.len();
        open.push(vertex);
    }
    push(&open);
    for vertex in open {
        place[vertex.index()] = usize::MAX;
    }
}
