//! Numbers for edges, and the halfedges along the boundary that make every halfedge have a twin.

use super::NONE;
use super::links::Links;
use crate::ids::{EdgeId, HalfedgeId};

/// Edges, and the halfedges along the boundary.
pub(super) struct Edges {
    pub(super) twin: Vec<HalfedgeId>,
    pub(super) halfedge_edge: Vec<EdgeId>,
    pub(super) edge_halfedge: Vec<HalfedgeId>,
    pub(super) boundary_next: Vec<HalfedgeId>,
}

impl Edges {
    pub(super) fn new(links: &Links<'_>, twin: Vec<u32>, vertex_halfedge: &[HalfedgeId]) -> Self {
        let inner = twin.len();
        let boundary = twin.iter().filter(|&&t| t == NONE).count();
        let edge_count = (inner - boundary) / 2 + boundary;
        let mut edges = Self {
            twin: Vec::with_capacity(inner + boundary),
            halfedge_edge: vec![EdgeId(NONE); inner + boundary],
            edge_halfedge: Vec::with_capacity(edge_count),
            boundary_next: Vec::new(),
        };
        let mut outside = Vec::with_capacity(boundary);
        for (halfedge, other) in twin.into_iter().enumerate() {
            let halfedge = halfedge as u32;
            let other = if other == NONE {
                outside.push(halfedge);
                (inner + outside.len() - 1) as u32
            } else {
                other
            };
            edges.twin.push(HalfedgeId(other));
            if halfedge < other {
                let edge = EdgeId(edges.edge_halfedge.len() as u32);
                edges.edge_halfedge.push(HalfedgeId(halfedge));
                edges.halfedge_edge[halfedge as usize] = edge;
                edges.halfedge_edge[other as usize] = edge;
            }
        }
        edges.twin.extend(outside.iter().map(|&h| HalfedgeId(h)));
        edges.boundary_next =
            outside.iter().map(|&inside| edges.boundary_after(links, inside, vertex_halfedge)).collect();
        edges
    }

    /// The boundary halfedge after the twin of `inside`: it leaves the origin of `inside`, as the last of its fan.
    fn boundary_after(&self, links: &Links<'_>, inside: u32, vertex_halfedge: &[HalfedgeId]) -> HalfedgeId {
        let vertex = links.corner_vertex[inside as usize];
        let mut current = vertex_halfedge[vertex as usize].0;
        loop {
            let following = self.twin[links.previous(current) as usize];
            if following.index() >= links.corner_vertex.len() {
                return following;
            }
            current = following.0;
        }
    }
}
