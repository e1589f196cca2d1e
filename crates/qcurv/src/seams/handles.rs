//! Loops that open handles: a shortest path tree, a spanning tree of the faces across the other edges, and what is left.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use qmesh::{Components, EdgeData, EdgeId, HalfedgeId, Observer, QuadMesh, VertexData, VertexId};

use super::distances::{distances, farthest, key};
use super::interrupted::look;
use super::{Interrupted, SeamCost, patch, paths, prune};

/// Base points that are tried.
const BASES: usize = 12;
/// How far from a loop its straightened copy may lie, in edges.
const CORRIDOR: usize = 4;

/// A short system of edges along which cutting makes a planar patch of a connected mesh with handles.
pub(super) fn open(
    mesh: &QuadMesh,
    cost: &SeamCost,
    observer: &dyn Observer,
) -> Result<Vec<EdgeId>, Interrupted> {
    let mut loops: Vec<EdgeId> = Vec::new();
    let bases = bases(mesh, observer)?;
    for (done, &base) in bases.iter().enumerate() {
        look(observer, 0.1 + 0.3 * done as f64 / bases.len() as f64)?;
        let next = system(mesh, cost, base);
        if done == 0 || cost.of(&next) < cost.of(&loops) {
            loops = next;
        }
    }
    let straight = straightened(mesh, cost, &loops, observer)?;
    // The same patch, not one that is left with another number of loops because two arcs came to lie on each other.
    let is_alike = patch(mesh, &straight).is_some_and(|found| Some(found) == patch(mesh, &loops));
    Ok(if cost.of(&straight) < 1.5 * cost.of(&loops) && is_alike { straight } else { loops })
}

/// Points spread over the surface.
fn bases(mesh: &QuadMesh, observer: &dyn Observer) -> Result<Vec<VertexId>, Interrupted> {
    let mut bases = vec![farthest(&distances(mesh, &[VertexId(0)]))];
    let mut nearest = distances(mesh, &bases);
    while bases.len() < BASES {
        look(observer, 0.1 * bases.len() as f64 / BASES as f64)?;
        let next = farthest(&nearest);
        let from_next = distances(mesh, &[next]);
        for vertex in mesh.vertices() {
            nearest[vertex] = nearest[vertex].min(from_next[vertex]);
        }
        bases.push(next);
    }
    Ok(bases)
}

/// The union of the greedy loops through `base`, without what hangs loose.
fn system(mesh: &QuadMesh, cost: &SeamCost, base: VertexId) -> Vec<EdgeId> {
    let (distance, mut parent) = tree(mesh, cost, base);
    let mut in_tree = mesh.edge_data(|_| false);
    for halfedge in parent.iter().flatten() {
        in_tree[mesh.edge(*halfedge)] = true;
    }
    let mut edges = Vec::new();
    for edge in left_over(mesh, cost, &distance, &in_tree) {
        edges.push(edge);
        for mut vertex in mesh.edge_vertices(edge) {
            // Taken: from here on another loop went the same way.
            while let Some(halfedge) = parent[vertex].take() {
                edges.push(mesh.edge(halfedge));
                vertex = mesh.origin(halfedge);
            }
        }
    }
    edges.sort_unstable();
    edges.dedup();
    prune(mesh, edges)
}

/// Short paths from `base` that would rather go straight on: what they cost, and the last halfedge of each. Each vertex keeps one way to it,
/// so that the paths are a tree; with turns they are not always the cheapest.
fn tree(
    mesh: &QuadMesh,
    cost: &SeamCost,
    base: VertexId,
) -> (VertexData<f64>, VertexData<Option<HalfedgeId>>) {
    let mut distance = mesh.vertex_data(|_| f64::INFINITY);
    let mut parent = mesh.vertex_data(|_| None);
    distance[base] = 0.0;
    let mut heap = BinaryHeap::from([Reverse((key(0.0), base))]);
    while let Some(Reverse((known, vertex))) = heap.pop() {
        if known != key(distance[vertex]) {
            continue;
        }
        for halfedge in mesh.outgoing(vertex) {
            let turn = parent[vertex].map_or(0.0, |before| cost.turn(mesh, before, halfedge));
            let (to, there) =
                (mesh.target(halfedge), distance[vertex] + turn + cost.edges[mesh.edge(halfedge)]);
            if there < distance[to] {
                distance[to] = there;
                parent[to] = Some(halfedge);
                heap.push(Reverse((key(there), to)));
            }
        }
    }
    (distance, parent)
}

/// The edges outside the tree that are also outside a spanning tree of the faces (and boundary loops, which count as faces),
/// where edges with long loops join faces first: two for each handle.
fn left_over(
    mesh: &QuadMesh,
    cost: &SeamCost,
    distance: &VertexData<f64>,
    in_tree: &EdgeData<bool>,
) -> Vec<EdgeId> {
    let side = sides(mesh);
    let around = |edge: EdgeId| {
        let [a, b] = mesh.edge_vertices(edge);
        distance[a] + distance[b] + cost.edges[edge]
    };
    let mut others: Vec<EdgeId> = mesh.edges().filter(|&edge| !in_tree[edge]).collect();
    others.sort_by(|&a, &b| around(b).total_cmp(&around(a)).then(a.cmp(&b)));
    let mut joined = Components::new(mesh.halfedge_count());
    let is_left = |edge: &EdgeId| {
        let halfedge = mesh.halfedge(*edge);
        !joined.join(side[halfedge.index()], side[mesh.twin(halfedge).index()])
    };
    others.into_iter().filter(is_left).collect()
}

/// A number for the face or boundary loop on the left of each halfedge.
fn sides(mesh: &QuadMesh) -> Vec<u32> {
    let mut side: Vec<u32> = mesh.corners().map(|corner| mesh.face(corner).0).collect();
    side.resize(mesh.halfedge_count(), 0);
    for (place, walk) in mesh.boundary_loops().iter().enumerate() {
        walk.iter().for_each(|halfedge| side[halfedge.index()] = (mesh.face_count() + place) as u32);
    }
    side
}

/// The same arcs between the same branchings, each led anew along edge loops as far as they stay close.
fn straightened(
    mesh: &QuadMesh,
    cost: &SeamCost,
    edges: &[EdgeId],
    observer: &dyn Observer,
) -> Result<Vec<EdgeId>, Interrupted> {
    let mut result = Vec::new();
    let arcs = arcs(mesh, edges);
    let mut others = mesh.vertex_data(|_| 0u32);
    for vertex in arcs.iter().flatten() {
        others[*vertex] += 1;
    }
    // Made once, for there may be many arcs.
    let mut search = paths::SeamPaths::new(mesh);
    let (mut is_near, mut near) = (mesh.vertex_data(|_| false), Vec::new());
    for (done, arc) in arcs.iter().enumerate() {
        look(observer, 0.4 + 0.1 * done as f64 / arcs.len() as f64)?;
        corridor(mesh, arc, &others, &mut is_near, &mut near);
        let is_end = |vertex| vertex == arc[arc.len() - 1];
        search.run(mesh, cost, &arc[..1], |vertex| is_near[vertex], is_end);
        result.extend(search.path_to(mesh, is_end));
        search.forget(mesh, &near);
        near.drain(..).for_each(|vertex| is_near[vertex] = false);
    }
    result.sort_unstable();
    result.dedup();
    Ok(result)
}

/// Marks and lists the vertices near an arc, not counting those of other arcs.
fn corridor(
    mesh: &QuadMesh,
    arc: &[VertexId],
    taken: &VertexData<u32>,
    is_near: &mut VertexData<bool>,
    near: &mut Vec<VertexId>,
) {
    arc.iter().for_each(|&vertex| is_near[vertex] = true);
    near.extend(arc);
    let mut front = 0;
    for _ in 0..CORRIDOR.min(arc.len() / 3) {
        let end = near.len();
        for place in front..end {
            for vertex in mesh.neighbors(near[place]) {
                let is_free = taken[vertex] == 0 && !mesh.is_boundary(vertex);
                if is_free && !std::mem::replace(&mut is_near[vertex], true) {
                    near.push(vertex);
                }
            }
        }
        front = end;
    }
}

/// The edges as walks between vertices where they branch or end; closed walks are split in three.
fn arcs(mesh: &QuadMesh, edges: &[EdgeId]) -> Vec<Vec<VertexId>> {
    let mut at: Vec<(VertexId, EdgeId)> =
        edges.iter().flat_map(|&edge| mesh.edge_vertices(edge).map(|vertex| (vertex, edge))).collect();
    at.sort_unstable();
    let around = |vertex: VertexId| {
        let from = at.partition_point(|&(v, _)| v < vertex);
        at[from..].iter().take_while(move |&&(v, _)| v == vertex).map(|&(_, edge)| edge)
    };
    let is_node = |vertex: VertexId| around(vertex).take(3).count() != 2;
    let mut seen = std::collections::HashSet::new();
    let mut walks = Vec::new();
    let mut vertices: Vec<VertexId> = at.iter().map(|&(vertex, _)| vertex).collect();
    vertices.dedup();
    let nodes = vertices.iter().copied().filter(|&vertex| is_node(vertex));
    for start in nodes.chain(vertices.iter().copied()) {
        for first in around(start).collect::<Vec<_>>() {
            let (mut walk, mut edge, mut vertex) = (vec![start], first, start);
            while seen.insert(edge) {
                let [a, b] = mesh.edge_vertices(edge);
                vertex = if a == vertex { b } else { a };
                walk.push(vertex);
                if is_node(vertex) {
                    break;
                }
                match around(vertex).find(|&next| next != edge) {
                    Some(next) => edge = next,
                    None => break,
                }
            }
            if walk.len() > 1 {
                walks.extend(split(&walk));
            }
        }
    }
    walks
}

/// A walk whose ends are the same, or that is long, in parts: the copy of a part cannot go round the other way.
fn split(walk: &[VertexId]) -> Vec<Vec<VertexId>> {
    let closed = walk[0] == walk[walk.len() - 1];
    let parts = if closed { 3 } else { 1 };
    let steps = walk.len() - 1;
    let at = |part: usize| part * steps / parts;
    (0..parts).map(|part| walk[at(part)..=at(part + 1)].to_vec()).filter(|part| part.len() > 1).collect()
}
