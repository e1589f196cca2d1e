//! Cheapest paths along edges that would rather go straight on.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use qmesh::{EdgeId, HalfedgeData, HalfedgeId, QuadMesh, VertexData, VertexId};

use super::SeamCost;
use super::distances::key;

/// Cheapest paths from some vertices to all others. The state of the search is the last halfedge, since what the next one
/// costs depends on where the path comes from.
#[derive(Clone, Debug)]
pub struct SeamPaths {
    cost: HalfedgeData<f64>,
    before: HalfedgeData<HalfedgeId>,
    is_source: VertexData<bool>,
    is_known: VertexData<bool>,
    reached: Vec<HalfedgeId>,
}

const NONE: HalfedgeId = HalfedgeId(u32::MAX);
/// Where more edges meet, the first path that arrives is the only one that goes on: all pairs of edges would be too many.
const HUB: u32 = 64;

impl SeamPaths {
    /// Searches from `sources`, until a vertex is reached for which `is_goal` holds; to the end when there is none. Paths may not
    /// pass through sources again. Takes `O(n log n)` for `n` edges; where more than 64 of them meet, paths go on from the first
    /// that arrives.
    #[must_use]
    pub fn search(
        mesh: &QuadMesh,
        cost: &SeamCost,
        sources: &[VertexId],
        is_goal: impl FnMut(VertexId) -> bool,
    ) -> Self {
        let mut paths = Self::new(mesh);
        paths.run(mesh, cost, sources, |_| true, is_goal);
        paths
    }

    /// No paths yet.
    pub(super) fn new(mesh: &QuadMesh) -> Self {
        Self {
            cost: HalfedgeData::filled(mesh.halfedge_count(), f64::INFINITY),
            before: HalfedgeData::filled(mesh.halfedge_count(), NONE),
            is_source: VertexData::filled(mesh.vertex_count(), false),
            is_known: VertexData::filled(mesh.vertex_count(), false),
            reached: Vec::new(),
        }
    }

    /// As [`SeamPaths::search`], along vertices for which `is_allowed` holds; sources do not count.
    pub(super) fn run(
        &mut self,
        mesh: &QuadMesh,
        cost: &SeamCost,
        sources: &[VertexId],
        is_allowed: impl Fn(VertexId) -> bool,
        mut is_goal: impl FnMut(VertexId) -> bool,
    ) {
        let leaving = |vertex| mesh.outgoing(vertex).filter(|&halfedge| is_allowed(mesh.target(halfedge)));
        sources.iter().for_each(|&vertex| self.is_source[vertex] = true);
        let mut heap = BinaryHeap::new();
        for halfedge in sources.iter().flat_map(|&vertex| leaving(vertex)) {
            self.improve(&mut heap, halfedge, cost.edges[mesh.edge(halfedge)], NONE);
        }
        while let Some(Reverse((known, halfedge))) = heap.pop() {
            if known != key(self.cost[halfedge]) {
                continue;
            }
            let vertex = mesh.target(halfedge);
            if self.is_source[vertex] {
                continue;
            }
            if !std::mem::replace(&mut self.is_known[vertex], true) {
                self.reached.push(halfedge);
                if is_goal(vertex) {
                    break;
                }
            } else if cost.valence(vertex) > HUB {
                continue;
            }
            for next in leaving(vertex).filter(|&next| next != mesh.twin(halfedge)) {
                let there =
                    self.cost[halfedge] + cost.turn(mesh, halfedge, next) + cost.edges[mesh.edge(next)];
                self.improve(&mut heap, next, there, halfedge);
            }
        }
    }

    /// Makes ready for another [`SeamPaths::run`] after one along `vertices` only.
    pub(super) fn forget(&mut self, mesh: &QuadMesh, vertices: &[VertexId]) {
        for &vertex in vertices {
            (self.is_source[vertex], self.is_known[vertex]) = (false, false);
            for halfedge in mesh.outgoing(vertex) {
                (self.cost[halfedge], self.before[halfedge]) = (f64::INFINITY, NONE);
            }
        }
        self.reached.clear();
    }

    fn improve(
        &mut self,
        heap: &mut BinaryHeap<Reverse<(u64, HalfedgeId)>>,
        halfedge: HalfedgeId,
        cost: f64,
        before: HalfedgeId,
    ) {
        if cost < self.cost[halfedge] {
            self.cost[halfedge] = cost;
            self.before[halfedge] = before;
            heap.push(Reverse((key(cost), halfedge)));
        }
    }

    /// The halfedges by which vertices were reached, the cheapest first, with what their paths cost.
    pub fn reached(&self) -> impl DoubleEndedIterator<Item = (HalfedgeId, f64)> + '_ {
        self.reached.iter().map(|&halfedge| (halfedge, self.cost[halfedge]))
    }

    /// The edges of the path that ends with `last`, from there back to a source.
    #[must_use]
    pub fn path(&self, mesh: &QuadMesh, last: HalfedgeId) -> Vec<EdgeId> {
        let mut edges = Vec::new();
        let mut current = last;
        // A path that turns back is cut short: no edge comes twice.
        while current != NONE && edges.len() <= mesh.edge_count() {
            edges.push(mesh.edge(current));
            current = self.before[current];
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The edges of the path to the vertex that was reached last, if `is_goal` holds there.
    pub(super) fn path_to(&self, mesh: &QuadMesh, is_goal: impl Fn(VertexId) -> bool) -> Vec<EdgeId> {
        match self.reached.last() {
            Some(&last) if is_goal(mesh.target(last)) => self.path(mesh, last),
            _ => Vec::new(),
        }
    }
}

/// The edges of the cheapest path from one of `sources` to a vertex for which `is_goal` holds; none when no path leads there.
#[must_use]
pub fn cheapest_path(
    mesh: &QuadMesh,
    cost: &SeamCost,
    sources: &[VertexId],
    is_goal: impl Fn(VertexId) -> bool,
) -> Vec<EdgeId> {
    SeamPaths::search(mesh, cost, sources, &is_goal).path_to(mesh, &is_goal)
}
