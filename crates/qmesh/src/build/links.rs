//! Which halfedges belong together: twins, and the fan of each vertex.
//!
//! Twins are found without hashing: all halfedges between two vertices leave one of the two, so it is enough to
//! look through the shorter of their lists. Even adversarial poles keep that at `O(E^1.5)`.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use rayon::prelude::*;

use super::NONE;
use crate::error::BuildError;
use crate::ids::{FaceId, HalfedgeId};

/// The least that a thread does at once.
const AT_ONCE: usize = 1 << 12;

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
        let halfedges = self.corner_vertex.len() as u32;
        let twin: Vec<AtomicU32> =
            (0..halfedges).into_par_iter().with_min_len(AT_ONCE).map(|_| AtomicU32::new(NONE)).collect();
        // Whoever comes first to an edge sees to both of its sides; should two come at once, they find the same.
        let is_good = |halfedge: u32| {
            if twin[halfedge as usize].load(Relaxed) != NONE {
                return true;
            }
            match self.between(halfedge, fans) {
                (1, 0, _) => true,
                (1, 1, other) => {
                    twin[halfedge as usize].store(other, Relaxed);
                    twin[other as usize].store(halfedge, Relaxed);
                    true
                }
                _ => false,
            }
        };
        if !(0..halfedges).into_par_iter().with_min_len(AT_ONCE).all(is_good) {
            // The first in the order of the input is named.
            let is_bad = |&halfedge: &u32| !matches!(self.between(halfedge, fans), (1, 0 | 1, _));
            return Err(self.bad_edge((0..halfedges).find(is_bad).unwrap_or(0), fans));
        }
        Ok(twin.into_iter().map(AtomicU32::into_inner).collect())
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
        let vertices = || (0..fans.start.len() as u32 - 1).into_par_iter().with_min_len(AT_ONCE);
        let first = |vertex: u32| {
            let fan = fans.of(vertex);
            fan.iter().copied().find(|&h| twin[h as usize] == NONE).unwrap_or(fan[0])
        };
        let found: Option<Vec<HalfedgeId>> = vertices()
            .map(|vertex| {
                let first = first(vertex);
                (self.fan(first, twin).count() == fans.of(vertex).len()).then_some(HalfedgeId(first))
            })
            .collect();
        found.ok_or_else(|| {
            let is_bad = |&vertex: &u32| self.fan(first(vertex), twin).count() < fans.of(vertex).len();
            let vertex = (0..fans.start.len() as u32 - 1).find(is_bad).unwrap_or(0);
            let mut seen: Vec<u32> = self.fan(first(vertex), twin).collect();
            seen.sort_unstable();
            let fan = fans.of(vertex);
            let missed = fan.iter().find(|h| seen.binary_search(h).is_err()).unwrap_or(&fan[0]);
            let faces = [first(vertex), *missed].map(|h| self.corner_face[h as usize].0);
            BuildError::NonManifoldVertex { vertex, faces }
        })
    }

    /// The halfedges that leave a vertex from `first` on, counter-clockwise, up to the boundary or `first` again.
    fn fan<'b>(&'b self, first: u32, twin: &'b [u32]) -> impl Iterator<Item = u32> + 'b {
        std::iter::successors(Some(first), move |&current| {
            let following = twin[self.previous(current) as usize];
            (following != NONE && following != first).then_some(following)
        })
    }
}
