//! Which halfedges belong together: twins, and the fan of each vertex.
//!
//! Twins are found without hashing: all halfedges between two vertices leave one of the two, so it is enough to
//! look through the shorter of their lists. Even adversarial poles keep that at `O(E^1.5)`.

use super::NONE;
use crate::error::BuildError;
use crate::ids::{FaceId, HalfedgeId};

/// The halfedges that leave each vertex, in the order of their indices.
pub(super) struct Outgoing {
    start: Vec<u32>,
    halfedges: Vec<u32>,
}

impl Outgoing {
    pub(super) fn new(vertex_count: usize, corner_vertex: &[u32]) -> Self {
        let mut start = vec![0u32; vertex_count + 1];
        for &vertex in corner_vertex {
            start[vertex as usize + 1] += 1;
        }
        for i in 0..vertex_count {
            start[i + 1] += start[i];
        }
        let mut cursor = start.clone();
        let mut halfedges = vec![0u32; corner_vertex.len()];
        for (corner, &vertex) in corner_vertex.iter().enumerate() {
            let place = &mut cursor[vertex as usize];
            halfedges[*place as usize] = corner as u32;
            *place += 1;
        }
        Self { start, halfedges }
    }

    fn of(&self, vertex: u32) -> &[u32] {
        &self.halfedges[self.start[vertex as usize] as usize..self.start[vertex as usize + 1] as usize]
    }
}

/// What is known of the connectivity before twins are.
pub(super) struct Links<'a> {
    pub(super) face_start: &'a [u32],
    pub(super) corner_vertex: &'a [u32],
    pub(super) corner_face: &'a [FaceId],
}

impl Links<'_> {
    pub(super) fn next(&self, halfedge: u32) -> u32 {
        let face = self.corner_face[halfedge as usize].index();
        if halfedge + 1 == self.face_start[face + 1] { self.face_start[face] } else { halfedge + 1 }
    }

    pub(super) fn previous(&self, halfedge: u32) -> u32 {
        let face = self.corner_face[halfedge as usize].index();
        if halfedge == self.face_start[face] { self.face_start[face + 1] - 1 } else { halfedge - 1 }
    }

    fn ends(&self, halfedge: u32) -> [u32; 2] {
        [self.corner_vertex[halfedge as usize], self.corner_vertex[self.next(halfedge) as usize]]
    }

    /// All halfedges between the ends of `halfedge`: how many run its way, how many the other, and one of those.
    fn between(&self, halfedge: u32, fans: &Outgoing) -> (u32, u32, u32) {
        let [origin, target] = self.ends(halfedge);
        // Every halfedge between the two either leaves the vertex at hand or arrives there.
        let at_origin = fans.of(origin).len() <= fans.of(target).len();
        let (here, there) = if at_origin { (origin, target) } else { (target, origin) };
        let (mut leaving, mut arriving) = ((0, NONE), (0, NONE));
        for &candidate in fans.of(here) {
            if self.corner_vertex[self.next(candidate) as usize] == there {
                leaving = (leaving.0 + 1, candidate);
            }
            let before = self.previous(candidate);
            if self.corner_vertex[before as usize] == there {
                arriving = (arriving.0 + 1, before);
            }
        }
        if at_origin { (leaving.0, arriving.0, arriving.1) } else { (arriving.0, leaving.0, leaving.1) }
    }

    /// The twin of every halfedge, `NONE` at the boundary.
    pub(super) fn twins(&self, fans: &Outgoing) -> Result<Vec<u32>, BuildError> {
        let mut twin = vec![NONE; self.corner_vertex.len()];
        for halfedge in 0..self.corner_vertex.len() as u32 {
            if twin[halfedge as usize] != NONE {
                continue;
            }
            match self.between(halfedge, fans) {
                (1, 0, _) => {}
                (1, 1, other) => {
                    twin[halfedge as usize] = other;
                    twin[other as usize] = halfedge;
                }
                _ => return Err(self.bad_edge(halfedge, fans)),
            }
        }
        Ok(twin)
    }

    fn bad_edge(&self, halfedge: u32, fans: &Outgoing) -> BuildError {
        let [origin, target] = self.ends(halfedge);
        let leaving = |from: u32, to: u32| {
            fans.of(from)
                .iter()
                .filter(move |&&h| self.ends(h)[1] == to)
                .map(|&h| self.corner_face[h as usize].0)
        };
        let mut faces: Vec<u32> = leaving(origin, target).chain(leaving(target, origin)).collect();
        faces.sort_unstable();
        match faces[..] {
            [a, b] if self.are_duplicates([a, b]) => BuildError::DuplicateFaces { faces: [a, b] },
            [a, b] => BuildError::InconsistentOrientation { vertices: [origin, target], faces: [a, b] },
            _ => BuildError::NonManifoldEdge { vertices: [origin, target], faces },
        }
    }

    /// Whether two faces that share an edge in one direction are the same all around.
    fn are_duplicates(&self, faces: [u32; 2]) -> bool {
        let [a, b] = faces.map(|face| {
            let face = face as usize;
            &self.corner_vertex[self.face_start[face] as usize..self.face_start[face + 1] as usize]
        });
        let shift = b.iter().position(|&vertex| vertex == a[0]).unwrap_or(0);
        a.len() == b.len() && b[shift..].iter().chain(&b[..shift]).eq(a)
    }

    /// A halfedge out of each vertex, from which turning counter-clockwise reaches all others.
    pub(super) fn vertex_halfedges(
        &self,
        fans: &Outgoing,
        twin: &[u32],
    ) -> Result<Vec<HalfedgeId>, BuildError> {
        let mut firsts = Vec::with_capacity(fans.start.len() - 1);
        let mut seen = Vec::new();
        for vertex in 0..fans.start.len() as u32 - 1 {
            let fan = fans.of(vertex);
            let first = fan.iter().copied().find(|&h| twin[h as usize] == NONE).unwrap_or(fan[0]);
            seen.clear();
            let mut current = first;
            loop {
                seen.push(current);
                current = twin[self.previous(current) as usize];
                if current == NONE || current == first {
                    break;
                }
            }
            if seen.len() < fan.len() {
                seen.sort_unstable();
                let missed = fan.iter().find(|h| seen.binary_search(h).is_err()).unwrap_or(&fan[0]);
                let faces = [first, *missed].map(|h| self.corner_face[h as usize].0);
                return Err(BuildError::NonManifoldVertex { vertex, faces });
            }
            firsts.push(HalfedgeId(first));
        }
        Ok(firsts)
    }
}
