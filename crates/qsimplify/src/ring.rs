//! Deletion with a ring: the neighbours of a deleted vertex are joined around it.
//!
//! Each face at the vertex is cut off by a chord between its two neighbours and keeps the rest; a triangle has no rest
//! and vanishes, its far edge being the chord. The ring becomes a face. What must hold of the ring is what must hold of
//! the merged face in [`guarded`](crate::guarded): every other face, the rests included, meets it in one piece at most.
//! The rests need no look at each other, for they lost a vertex and gained nothing but their chords. A vertex of two edges (two quads that share two edges) leaves a ring of two edges,
//! which is closed to one.

use crate::Removal;
use crate::graph::{GONE, MAX_EDGES, PolygonGraph};
use crate::meetings::Meetings;

pub(crate) struct Ring {
    meetings: Meetings,
    sectors: Vec<Sector>,
}

/// A face at the vertex at hand, seen from it: out along `spoke`, along the far side, and back.
#[derive(Clone, Copy)]
struct Sector {
    spoke: u32,
    first: u32,
    last: u32,
    neighbor: u32,
}

impl Sector {
    fn new(graph: &PolygonGraph, spoke: u32) -> Self {
        let back = graph.previous[spoke as usize];
        let (first, last) = (graph.next[spoke as usize], graph.previous[back as usize]);
        Self { spoke, first, last, neighbor: graph.origin[first as usize] }
    }

    fn is_triangle(&self) -> bool {
        self.first == self.last
    }
}

impl Ring {
    pub(crate) fn new(graph: &PolygonGraph) -> Self {
        Self { meetings: Meetings::new(graph.face_count()), sectors: Vec::new() }
    }

    /// The edges that the neighbour at the start of sector `i` would have.
    fn new_degree(&self, graph: &PolygonGraph, i: usize) -> u32 {
        let count = self.sectors.len();
        let (after, before) =
            (self.sectors[i].is_triangle(), self.sectors[(i + count - 1) % count].is_triangle());
        let gained =
            if count == 2 { u32::from(!after && !before) } else { u32::from(!after) + u32::from(!before) };
        graph.degree[self.sectors[i].neighbor as usize] - 1 + gained
    }

    fn neighbors_have_few_edges(&self, graph: &PolygonGraph) -> bool {
        self.sectors.iter().all(|sector| graph.degree[sector.neighbor as usize] <= MAX_EDGES)
    }

    fn neighbors_keep_three_edges(&self, graph: &PolygonGraph) -> bool {
        (0..self.sectors.len())
            .all(|i| graph.on_boundary[self.sectors[i].neighbor as usize] || self.new_degree(graph, i) >= 3)
    }

    fn meets_all_in_one_piece(&mut self, graph: &PolygonGraph) -> bool {
        self.meetings.begin(graph.face_count());
        for sector in &self.sectors {
            // The chord, with what is cut off on its other side, and across the chord of a triangle.
            self.meetings.edge(graph.face[sector.spoke as usize]);
            if sector.is_triangle() {
                self.meetings.edge(graph.face[graph.twin[sector.first as usize] as usize]);
            }
            for around in graph.fan(sector.neighbor) {
                self.meetings.vertex(graph.face[around as usize]);
            }
        }
        self.meetings.all_in_one_piece()
    }

    fn remove(&self, graph: &mut PolygonGraph) {
        for i in 0..self.sectors.len() {
            graph.degree[self.sectors[i].neighbor as usize] = self.new_degree(graph, i);
        }
        let ring = graph.new_face();
        let inside: Vec<u32> = (0..self.sectors.len()).map(|i| self.cut_off(graph, i, ring)).collect();
        for (i, &side) in inside.iter().enumerate() {
            graph.link(side, inside[(i + 1) % inside.len()]);
            graph.leaving[self.sectors[i].neighbor as usize] = side;
        }
        if let [a, b] = inside[..] {
            close_ring_of_two(graph, a, b);
        }
    }

    /// Draws the chord of sector `i` with the halfedges of its spoke, and returns its side in the ring.
    fn cut_off(&self, graph: &mut PolygonGraph, i: usize, ring: u32) -> u32 {
        let Sector { spoke, first, last, neighbor } = self.sectors[i];
        let inward = graph.twin[spoke as usize];
        if self.sectors[i].is_triangle() {
            graph.face[spoke as usize] = GONE;
            graph.face[inward as usize] = GONE;
            graph.face[first as usize] = ring;
            return first;
        }
        graph.origin[inward as usize] = self.sectors[(i + 1) % self.sectors.len()].neighbor;
        graph.face[inward as usize] = graph.face[first as usize];
        graph.link(last, inward);
        graph.link(inward, first);
        graph.origin[spoke as usize] = neighbor;
        graph.face[spoke as usize] = ring;
        spoke
    }
}

fn close_ring_of_two(graph: &mut PolygonGraph, a: u32, b: u32) {
    let (outside_a, outside_b) = (graph.twin[a as usize], graph.twin[b as usize]);
    graph.pair(outside_a, outside_b);
    for (side, outside) in [(a, outside_b), (b, outside_a)] {
        graph.face[side as usize] = GONE;
        graph.leaving[graph.origin[side as usize] as usize] = outside;
    }
}

impl Removal for Ring {
    fn try_remove(&mut self, graph: &mut PolygonGraph, vertex: u32) -> bool {
        self.sectors.clear();
        self.sectors.extend(graph.fan(vertex).map(|spoke| Sector::new(graph, spoke)));
        let fits = self.neighbors_have_few_edges(graph)
            && self.neighbors_keep_three_edges(graph)
            && self.meets_all_in_one_piece(graph);
        if fits {
            self.remove(graph);
        }
        fits
    }
}
