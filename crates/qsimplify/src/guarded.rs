//! Pure deletion that keeps the graph 3-connected.
//!
//! A plane graph with at least four vertices is 3-connected if every face is bounded by a simple cycle and two faces
//! meet in nothing, in one vertex or in one edge. Deleting a vertex merges the faces around it and changes no other,
//! so it is enough to look at the merged one. Paths of several edges are let through: their inner vertices have two
//! edges only, which we allow at the boundary (a strictly convex outer polygon does not need a third) and find, but
//! never make, inside.

use crate::Removal;
use crate::graph::{GONE, MAX_EDGES, PolygonGraph};
use crate::meetings::{Marks, Meetings};

/// The most corners that a merged face may have. In an order that runs along rows whole rows would merge to one face:
/// quadratic time, and a graph that says nothing about where its vertices belong.
const MAX_CORNERS: usize = 64;

pub(crate) struct Guarded {
    meetings: Meetings,
    star: Marks,
    rim: Marks,
    /// The halfedges that leave the vertex at hand.
    spokes: Vec<u32>,
    /// The halfedges around the merged face.
    walk: Vec<u32>,
}

impl Guarded {
    pub(crate) fn new(graph: &PolygonGraph) -> Self {
        Self {
            meetings: Meetings::new(graph.face_count()),
            star: Marks::new(graph.face_count()),
            rim: Marks::new(graph.vertex_count()),
            spokes: Vec::new(),
            walk: Vec::new(),
        }
    }

    /// Whether the merged face, gathered in `walk` on the way, is simple and of moderate size.
    fn gather(&mut self, graph: &PolygonGraph) -> bool {
        self.walk.clear();
        self.star.begin(graph.face_count());
        self.rim.begin(graph.vertex_count());
        for &spoke in &self.spokes {
            self.star.insert(graph.face[spoke as usize]);
            let last = graph.previous[spoke as usize];
            let mut current = graph.next[spoke as usize];
            while current != last {
                let vertex = graph.origin[current as usize];
                let few = self.walk.len() < MAX_CORNERS && graph.degree[vertex as usize] <= MAX_EDGES;
                if !few || !self.rim.insert(vertex) {
                    return false;
                }
                self.walk.push(current);
                current = graph.next[current as usize];
            }
        }
        true
    }

    fn neighbors_keep_three_edges(&self, graph: &PolygonGraph) -> bool {
        self.spokes
            .iter()
            .map(|&spoke| graph.target(spoke) as usize)
            .all(|n| graph.on_boundary[n] || graph.degree[n] > 3)
    }

    fn meets_all_in_one_piece(&mut self, graph: &PolygonGraph) -> bool {
        self.meetings.begin(graph.face_count());
        for &halfedge in &self.walk {
            self.meetings.edge(graph.face[graph.twin[halfedge as usize] as usize]);
            for around in graph.fan(graph.origin[halfedge as usize]) {
                let face = graph.face[around as usize];
                if !self.star.contains(face) {
                    self.meetings.vertex(face);
                }
            }
        }
        self.meetings.all_in_one_piece()
    }

    fn remove(&self, graph: &mut PolygonGraph) {
        for &spoke in &self.spokes {
            let inward = graph.twin[spoke as usize];
            let neighbor = graph.origin[inward as usize] as usize;
            // The edge to the vertex is bridged: what came in before it goes on after it.
            let (before, after) = (graph.previous[inward as usize], graph.next[spoke as usize]);
            graph.link(before, after);
            graph.leaving[neighbor] = after;
            graph.degree[neighbor] -= 1;
        }
        let merged = graph.face[self.spokes[0] as usize];
        for &halfedge in &self.walk {
            graph.face[halfedge as usize] = merged;
        }
        for &spoke in &self.spokes {
            graph.face[spoke as usize] = GONE;
            graph.face[graph.twin[spoke as usize] as usize] = GONE;
        }
    }
}

impl Removal for Guarded {
    fn try_remove(&mut self, graph: &mut PolygonGraph, vertex: u32) -> bool {
        self.spokes.clear();
        self.spokes.extend(graph.fan(vertex));
        let fits = self.neighbors_keep_three_edges(graph)
            && self.gather(graph)
            && self.meets_all_in_one_piece(graph);
        if fits {
            self.remove(graph);
        }
        fits
    }
}
